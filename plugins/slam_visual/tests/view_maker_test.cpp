#include "features/view_maker.h"

#include <gtest/gtest.h>

#include <cmath>
#include <cstring>

#include "images.h"

namespace {

using gslam::Frame;
using gslam::ImageKind;
using gslam::SensorRig;
using visual::makeViewMaker;
using visual::Options;
using visual::SensorKind;
using visual::View;
using visual::ViewMaker;

std::string roomName(const std::string& options) {
  return "synthetic://room?" + options;
}

const SensorRig& roomRig(const std::string& options) {
  return images::worldOf(roomName(options)).info().sensors;
}

std::shared_ptr<const Frame> roomFrame(const std::string& options) {
  return images::frameOf(roomName(options), 0);
}

std::shared_ptr<const View> viewOf(ViewMaker& maker, const Frame& frame) {
  std::string problem;
  const auto view = maker.make(frame, problem);
  EXPECT_NE(view, nullptr) << problem;
  return view;
}

std::size_t depthsOf(const View& view) {
  std::size_t count = 0;
  for (std::size_t i = 0; i < view.size(); ++i) {
    count += view.depth[i] > 0 ? 1U : 0U;
    EXPECT_EQ(view.depth[i] > 0, std::isfinite(view.right_u[i]));
  }
  return count;
}

std::string refusalOf(const SensorRig& rig, const std::string& sensor) {
  Options options;
  options.sensor = sensor;
  try {
    makeViewMaker(rig, options);
  } catch (const gslam::ArgumentError& error) {
    return error.what();
  }
  return "";
}

bool contains(const std::string& text, const std::string& part) {
  return text.find(part) != std::string::npos;
}

TEST(ViewMaker, ChoosesByWhatTheDatasetHas) {
  const std::pair<const char*, SensorKind> cases[] = {{"sensors=mono", SensorKind::mono},
                                                      {"sensors=stereo", SensorKind::stereo},
                                                      {"sensors=rgbd", SensorKind::rgbd},
                                                      {"sensors=multi", SensorKind::mono}};
  for (const auto& one : cases) {
    const std::string name = one.first;
    const auto maker = makeViewMaker(roomRig(name), Options());
    EXPECT_EQ(maker->eye().kind, one.second) << one.first;
    const auto frame = roomFrame(name);
    const auto view = viewOf(*maker, *frame);
    EXPECT_EQ(view->frame, frame->id);
    EXPECT_EQ(view->stamp, frame->stamp);
    EXPECT_GT(view->size(), 900U);
    EXPECT_TRUE(view->content->images.empty());
    EXPECT_EQ(view->descriptors().height(), int(view->size()));
    const std::size_t depths = depthsOf(*view);
    const std::size_t least = one.second == SensorKind::mono   ? 0
                              : one.second == SensorKind::rgbd ? view->size() * 7 / 10
                                                               : view->size() * 3 / 10;
    EXPECT_GE(depths, least) << one.first;
    EXPECT_EQ(depths == 0, one.second == SensorKind::mono) << one.first;
    std::vector<std::uint32_t> near;
    view->grid.near(view->pixel(5), 0.01, 0, 7, near);
    EXPECT_EQ(std::count(near.begin(), near.end(), 5U), 1);
  }
}

TEST(ViewMaker, TheUserMayChooseLess) {
  Options options;
  options.sensor = "mono";
  const std::string name = "sensors=rgbd";
  const auto maker = makeViewMaker(roomRig(name), options);
  EXPECT_EQ(maker->eye().kind, SensorKind::mono);
  EXPECT_FALSE(maker->eye().hasDepth());
  EXPECT_EQ(depthsOf(*viewOf(*maker, *roomFrame(name))), 0U);
}

TEST(ViewMaker, SaysWhatTheDatasetLacks) {
  const SensorRig mono = roomRig("sensors=mono");
  EXPECT_TRUE(contains(refusalOf(mono, "stereo"), "2 cameras (it has 1)"));
  EXPECT_TRUE(contains(refusalOf(mono, "rgbd"), "depth images"));
  EXPECT_TRUE(contains(refusalOf(mono, "lidar"), "auto, mono, stereo, rgbd"));
  SensorRig bare = mono;
  bare.cameras[0].camera = gslam::Camera();
  for (const char* sensor : {"auto", "mono"}) {
    EXPECT_TRUE(contains(refusalOf(bare, sensor), "the calibration of camera 'camera'"));
  }
  EXPECT_TRUE(contains(refusalOf(SensorRig(), "auto"), "1 camera (it has 0)"));
  const SensorRig around = roomRig("sensors=multi");
  EXPECT_TRUE(contains(refusalOf(around, "stereo"), "two cameras side by side"));
}

TEST(ViewMaker, CamerasAboveEachOtherAreNoPair) {
  SensorRig rig = roomRig("sensors=stereo");
  rig.cameras[1].T_body_camera = gslam::SE3d(rig.cameras[1].T_body_camera.rotation(), {0, 0, -0.2});
  EXPECT_EQ(makeViewMaker(rig, Options())->eye().kind, SensorKind::mono);
  EXPECT_TRUE(contains(refusalOf(rig, "stereo"), "above or below"));
}

TEST(ViewMaker, TheEyeIsThatOfTheSensors) {
  const std::string name = "sensors=stereo";
  const SensorRig& rig = roomRig(name);
  Options options;
  options.mapping.far_baselines = 30;
  options.features.levels = 5;
  const auto maker = makeViewMaker(rig, options);
  const visual::Eye& eye = maker->eye();
  EXPECT_EQ(eye.camera, rig.cameras[0].camera);
  EXPECT_NEAR(eye.baseline, 0.11, 1e-12);
  EXPECT_NEAR(eye.far, 3.3, 1e-9);
  EXPECT_NEAR(eye.focal, eye.camera.parameter("fx"), 0.01);
  EXPECT_EQ(eye.levels.count(), 5);
}

TEST(ViewMaker, SwappedCamerasAreTurnedRound) {
  const std::string name = "sensors=stereo";
  SensorRig rig = roomRig(name);
  std::swap(rig.cameras[0], rig.cameras[1]);
  const auto frame = roomFrame(name);
  Frame swapped = *frame;
  std::swap(swapped.images[0], swapped.images[1]);
  const auto maker = makeViewMaker(roomRig(name), Options());
  const auto other = makeViewMaker(rig, Options());
  EXPECT_NEAR(other->eye().baseline, 0.11, 1e-12);
  const auto a = viewOf(*maker, *frame), b = viewOf(*other, swapped);
  EXPECT_EQ(a->depth, b->depth);
  EXPECT_EQ(a->features()[0].camera, 0);
  EXPECT_EQ(b->features()[0].camera, 1);
}

// A pair that is turned and bent gives the depth of a straight one.
TEST(ViewMaker, APairThatIsNotRectifiedIs) {
  gslam::SyntheticOptions world = gslam::syntheticOptions("synthetic://room?noise=0&blur=false");
  for (const char* model : {"radtan", "kannala_brandt"}) {
    world.cameras.clear();
    gslam::SyntheticOptions lens = world;
    lens.model = model;
    lens.sensors = "stereo";
    world.cameras = gslam::openSynthetic(lens)->info().sensors.cameras;
    world.cameras[1].T_body_camera =
        world.cameras[1].T_body_camera *
        gslam::SE3d(gslam::SO3d::exp({0.01, -0.03, 0.02}), {0, 0.004, 0.01});
    const auto dataset = gslam::openSynthetic(world);
    dataset->seek(40);
    const auto maker = makeViewMaker(dataset->info().sensors, Options());
    const visual::Eye& eye = maker->eye();
    ASSERT_EQ(eye.kind, SensorKind::stereo);
    EXPECT_EQ(eye.camera.modelName(), "pinhole");
    const auto view = viewOf(*maker, *dataset->next());
    // A depth camera at the place of the eye.
    gslam::CameraSensor depth;
    depth.kind = ImageKind::depth;
    depth.camera = eye.camera;
    depth.T_body_camera = eye.T_body_camera;
    world.cameras = {depth};
    const auto truth = gslam::openSynthetic(world);
    truth->seek(40);
    const auto frame = truth->next();
    std::vector<double> errors;
    for (std::size_t i = 0; i < view->size(); ++i) {
      if (!(view->depth[i] > 0)) continue;
      const gslam::Vec2d at = view->pixel(i);
      const double metres =
          frame->images[0].depth_scale * frame->images[0].image.at<std::uint16_t>(
                                             int(std::lround(at[0])), int(std::lround(at[1])));
      if (!(metres > 0)) continue;
      const double strength = eye.camera.parameter("fx") * eye.baseline;
      errors.push_back(std::fabs(strength / double(view->depth[i]) - strength / metres) /
                       eye.levels.factor(view->features()[i].octave));
    }
    ASSERT_GT(errors.size(), 300U) << model;
    std::sort(errors.begin(), errors.end());
    EXPECT_LT(errors[errors.size() / 2], 0.2) << model;
    EXPECT_LT(errors[errors.size() * 8 / 10], 0.6) << model;
  }
}

TEST(ViewMaker, SameBitsForAnyNumberOfWorkers) {
  for (const char* sensors : {"sensors=stereo", "sensors=rgbd&colour=true"}) {
    const std::string name = sensors;
    const auto frame = roomFrame(name);
    Options options;
    const auto one = viewOf(*makeViewMaker(roomRig(name), options), *frame);
    for (int workers : {2, 4, 0}) {
      options.workers = workers;
      const auto many = viewOf(*makeViewMaker(roomRig(name), options), *frame);
      ASSERT_EQ(one->size(), many->size());
      EXPECT_EQ(std::memcmp(one->features().data(), many->features().data(),
                            one->size() * sizeof(gslam::Feature)),
                0);
      EXPECT_EQ(one->descriptors(), many->descriptors());
      EXPECT_EQ(one->depth, many->depth);
    }
  }
}

TEST(ViewMaker, ASizeThatChangesIsAProblemAndTheNextFrameIsNone) {
  for (const char* sensors : {"sensors=mono", "sensors=stereo", "sensors=rgbd"}) {
    const std::string name = sensors;
    const auto maker = makeViewMaker(roomRig(name), Options());
    const auto frame = roomFrame(name);
    const auto before = viewOf(*maker, *frame);
    for (std::size_t i = 0; i < frame->images.size(); ++i) {
      Frame odd = *frame;
      odd.images[i].image = odd.images[i].image.view(0, 0, 320, 240);
      std::string problem;
      EXPECT_EQ(maker->make(odd, problem), nullptr);
      EXPECT_TRUE(contains(problem, odd.images[i].name)) << problem;
      EXPECT_TRUE(contains(problem, "640 x 480")) << problem;
      odd.images[i].image = gslam::Image();
      EXPECT_EQ(maker->make(odd, problem), nullptr);
      EXPECT_TRUE(contains(problem, "missing")) << problem;
      odd.images.resize(i);
      EXPECT_EQ(maker->make(odd, problem), nullptr);
      EXPECT_TRUE(contains(problem, "missing")) << problem;
    }
    const auto after = viewOf(*maker, *frame);
    EXPECT_EQ(before->descriptors(), after->descriptors());
    EXPECT_EQ(before->depth, after->depth);
  }
}

TEST(ViewMaker, BlackAndWhiteFramesAreNoProblem) {
  for (const char* sensors : {"sensors=mono", "sensors=stereo", "sensors=rgbd"}) {
    const std::string name = sensors;
    const auto maker = makeViewMaker(roomRig(name), Options());
    for (int brightness : {0, 255}) {
      Frame frame = *roomFrame(name);
      for (gslam::CameraImage& image : frame.images) {
        image.image = gslam::Image(640, 480, image.image.type());
        std::memset(image.image.bytes(), brightness, image.image.byteCount());
      }
      const auto view = viewOf(*maker, frame);
      EXPECT_EQ(view->size(), 0U);
      EXPECT_TRUE(view->descriptors().empty());
      std::vector<std::uint32_t> near;
      view->grid.near({320, 240}, 1000, 0, 7, near);
      EXPECT_TRUE(near.empty());
    }
  }
}

}  // namespace
