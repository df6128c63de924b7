#include "tracking/feature_picture.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cstdint>
#include <memory>

#include "short_run.h"

namespace {

using gslam::CameraImage;
using gslam::Frame;
using gslam::SE3d;
using gslam::SO3d;
using gslam::Vec2d;
using short_run::Frames;
using short_run::framesOf;
using short_run::Played;
using short_run::rigOf;

// How many pixels are clearly greener than they are red, within `radius` of a place.
int greenAround(const CameraImage& picture, const Vec2d& at, int radius) {
  int count = 0;
  const int x = int(std::lround(at[0])), y = int(std::lround(at[1]));
  for (int v = std::max(0, y - radius); v <= std::min(picture.image.height() - 1, y + radius);
       ++v) {
    for (int u = std::max(0, x - radius); u <= std::min(picture.image.width() - 1, x + radius);
         ++u) {
      const std::uint8_t* const rgb = picture.image.bytes(v) + 3 * u;
      count += rgb[1] > rgb[0] + 60 ? 1 : 0;
    }
  }
  return count;
}

visual::View viewWith(const Vec2d& pixel) {
  visual::View view;
  const auto content = std::make_shared<gslam::KeyframeContent>();
  gslam::Feature feature{};
  feature.pixel = {float(pixel[0]), float(pixel[1])};
  content->features.push_back(feature);
  view.content = content;
  return view;
}

TEST(FeaturePicture, IsMadeOnRequestOnly) {
  const Frames frames = framesOf();
  Played run(rigOf("sensors=rgbd"));
  std::vector<CameraImage> pictures;
  run.slam->feed(frames[0]);
  {
    const gslam::Subscriber subscriber = run.messenger.subscribe<CameraImage>(
        "image", [&](const CameraImage& picture) { pictures.push_back(picture); });
    run.slam->feed(frames[1]);
    run.slam->feed(frames[2]);
  }
  run.slam->feed(frames[3]);
  ASSERT_EQ(pictures.size(), 2U);
  const gslam::Image& image = pictures[0].image;
  EXPECT_EQ(image.width(), frames[1]->images[0].image.width());
  EXPECT_EQ(image.height(), frames[1]->images[0].image.height());
  EXPECT_EQ(pictures[0].kind, gslam::ImageKind::rgb);
  // Most features of the second frame see points of the first one.
  EXPECT_GT(greenAround(pictures[0], {160, 120}, 160), 1000);
}

// Rectified into another camera, or only turned.
class RectifiedPicture : public testing::TestWithParam<bool> {};
INSTANTIATE_TEST_SUITE_P(SameCamera, RectifiedPicture, testing::Bool());

TEST_P(RectifiedPicture, HasFeaturesWhereTheyAreInThePhotograph) {
  const Frame frame = *framesOf()[0];
  const CameraImage& photograph = frame.images[0];
  visual::Eye eye;
  eye.camera = GetParam()
                   ? photograph.camera
                   : gslam::Camera::fromParameters("pinhole", 320, 240, {300, 300, 160, 120});
  eye.T_body_camera = photograph.T_body_camera * SE3d(SO3d::exp({{0.1, -0.05, 0.2}}), {});
  const Vec2d pixel{{200, 90}};
  gslam::Vec3d ray;
  Vec2d expected;
  ASSERT_TRUE(eye.camera.unproject(pixel, ray));
  const SO3d R = photograph.T_body_camera.rotation().inverse() * eye.T_body_camera.rotation();
  ASSERT_TRUE(photograph.camera.project(R * ray, expected));
  ASSERT_GT((expected - pixel).norm(), 10);

  const visual::View view = viewWith(pixel);
  visual::Tracked tracked;
  EXPECT_EQ(greenAround(visual::drawFeatures(frame, view, eye, tracked), expected, 3), 0);
  tracked.matches.push_back({0, gslam::PointId(7), 0});
  const CameraImage drawn = visual::drawFeatures(frame, view, eye, tracked);
  EXPECT_GE(greenAround(drawn, expected, 3), 20);
  EXPECT_EQ(greenAround(drawn, pixel, 3), 0);
}

TEST(FeaturePicture, StandsFramesThatShowNothing) {
  const visual::Eye eye;
  visual::View view;
  view.content = std::make_shared<const gslam::KeyframeContent>();
  EXPECT_TRUE(visual::drawFeatures(Frame(), view, eye, {}).image.empty());
  Frame frame = *framesOf()[0];
  frame.images[0].image = gslam::Image();
  EXPECT_TRUE(visual::drawFeatures(frame, view, eye, {}).image.empty());
}

}  // namespace
