#include <gslam/base/error.h>
#include <gslam/datasets/synthetic.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "gnss.h"
#include "hash.h"
#include "imu.h"
#include "motion.h"
#include "options.h"
#include "pi.h"
#include "rays.h"
#include "render.h"
#include "sensor_image.h"
#include "world.h"

namespace gslam {
inline namespace v1 {
namespace detail {
namespace synthetic {
namespace {

constexpr std::int64_t kFirstStamp = 1000000000;
constexpr float kLowContrast = 0.06F;
constexpr double kSwingSeconds = 7;

// Cameras at one place, with the same rays: one picture for all of them.
struct Eye {
  std::unique_ptr<Renderer> renderer;
  SE3d T_body_camera;
  std::vector<std::size_t> sensors;  // places in SensorRig::cameras
  bool has_colour = false, has_image = false;
};

std::vector<Pause> pausesOf(const SyntheticOptions& o) {
  std::vector<Pause> pauses;
  for (const FrameRange& range : o.pure_rotation.ranges) {
    const int last = std::min(range.last, o.frames - 1);
    if (last > range.first) pauses.push_back({range.first / o.rate, last / o.rate});
  }
  std::sort(pauses.begin(), pauses.end(),
            [](const Pause& a, const Pause& b) { return a.begin < b.begin; });
  for (std::size_t i = 1; i < pauses.size(); ++i) {
    if (pauses[i].begin < pauses[i - 1].end) {
      throw ArgumentError("pure_rotation", "has ranges that overlap");
    }
  }
  return pauses;
}

MotionOptions motionOf(const SyntheticOptions& o) {
  MotionOptions motion;
  motion.duration = (o.frames - 1) / o.rate;
  motion.speed = o.speed;
  motion.seed = o.seed;
  motion.pauses = pausesOf(o);
  return motion;
}

class SyntheticDataset : public Dataset {
 public:
  SyntheticDataset(const SyntheticOptions& options, World world,
                   const std::vector<CameraSensor>& cameras)
      : options_(options),
        scene_(std::move(world.scene)),
        motion_(world.route, motionOf(options)),
        imu_(options, options.imu ? timeOf(options.frames - 1) : -1),
        gnss_(options) {
    info_.sensors.cameras = cameras;
    for (int i = 0; i < options_.frames; ++i) {
      if (!options_.dropped.contains(i)) kept_.push_back(i);
    }
    if (kept_.empty()) throw ArgumentError("dropped", "leaves no frame");
    describe();
    makeEyes();
  }

  const DatasetInfo& info() const override { return info_; }

  std::shared_ptr<const Frame> next() override {
    if (next_ >= kept_.size()) return nullptr;
    const auto frame = std::make_shared<Frame>();
    const std::int64_t time = timeOf(kept_[next_]);
    const std::int64_t before = next_ == 0 ? -1 : timeOf(kept_[next_ - 1]);
    frame->id = next_;
    frame->stamp = kFirstStamp + time;
    frame->images.resize(info_.sensors.cameras.size());
    for (Eye& eye : eyes_) look(eye, kept_[next_], *frame);
    if (options_.imu) frame->imu = imu_.samples(motion_, before, time, kFirstStamp);
    if (options_.gnss) frame->gnss = gnss_.samples(motion_, before, time, kFirstStamp);
    frame->imu_calibration = info_.sensors.imu;
    ++next_;
    return frame;
  }

  void seek(std::size_t index) override {
    if (index > kept_.size()) {
      throw ArgumentError("index", "is " + std::to_string(index) + ", but there are " +
                                       std::to_string(kept_.size()) + " frames");
    }
    next_ = index;
  }

 private:
  std::int64_t timeOf(int frame) const {
    return static_cast<std::int64_t>(std::llround(double(frame) * 1e9 / options_.rate));
  }

  void describe() {
    info_.name = options_.world + "-" + std::to_string(options_.seed);
    info_.format = "synthetic";
    info_.licence = "none: it is computed";
    info_.frame_count = kept_.size();
    info_.sensors.has_imu = options_.imu;
    if (options_.imu) info_.sensors.imu = imu_.calibration();
    info_.sensors.has_gnss = options_.gnss;
    for (const int frame : kept_) {
      info_.ground_truth.add(kFirstStamp + timeOf(frame), motion_.at(timeOf(frame)));
    }
  }

  void makeEyes() {
    std::vector<std::pair<Camera, std::shared_ptr<const Rays>>> known;
    const std::vector<CameraSensor>& cameras = info_.sensors.cameras;
    for (std::size_t i = 0; i < cameras.size(); ++i) {
      Eye& eye = eyeOf(cameras[i], known);
      eye.sensors.push_back(i);
      const bool is_depth = cameras[i].kind == ImageKind::depth;
      eye.has_image = eye.has_image || !is_depth;
      eye.has_colour = eye.has_colour || (!is_depth && cameras[i].kind != ImageKind::grey);
    }
  }

  // Grey and colour are not taken from one picture: grey is rendered as grey.
  Eye& eyeOf(const CameraSensor& sensor,
             std::vector<std::pair<Camera, std::shared_ptr<const Rays>>>& known) {
    const bool is_colour = sensor.kind == ImageKind::rgb || sensor.kind == ImageKind::bgr;
    for (Eye& eye : eyes_) {
      const CameraSensor& first = info_.sensors.cameras[eye.sensors[0]];
      const bool mixes = sensor.kind == ImageKind::grey
                             ? eye.has_colour
                             : is_colour && eye.has_image && !eye.has_colour;
      const bool is_same_place = first.T_body_camera.isApprox(sensor.T_body_camera, 0);
      if (first.camera == sensor.camera && is_same_place && !mixes) return eye;
    }
    std::shared_ptr<const Rays> rays;
    for (const auto& one : known) {
      if (one.first == sensor.camera) rays = one.second;
    }
    if (rays == nullptr) {
      rays = std::make_shared<const Rays>(sensor.camera);
      known.emplace_back(sensor.camera, rays);
    }
    Eye eye;
    eye.renderer.reset(new Renderer(rays));
    eye.T_body_camera = sensor.T_body_camera;
    eyes_.push_back(std::move(eye));
    return eyes_.back();
  }

  bool isBlurred() const { return options_.blur && options_.exposure > 0; }

  void look(Eye& eye, int index, Frame& frame) {
    const std::int64_t time = timeOf(index);
    const SplineSample<SE3d> body = motion_.sampleAt(time);
    const SO3d R_camera_body = eye.T_body_camera.rotation().inverse();
    const Vec3d v = body.velocity.segment<3>(0), w = body.velocity.segment<3>(3);
    CameraMotion motion;
    motion.turning = (R_camera_body * w).cast<float>();
    motion.velocity =
        (R_camera_body * (v + w.cross(eye.T_body_camera.translation()))).cast<float>();
    RenderOptions options;
    options.colour = eye.has_colour;
    options.motion = eye.has_image && isBlurred();
    options.threads = static_cast<unsigned>(options_.threads);
    const Picture& picture = eye.renderer->render(scene_, body.value * eye.T_body_camera,
                                                  double(time) * 1e-9, motion, options);
    for (const std::size_t sensor : eye.sensors) {
      frame.images[sensor] = imageOf(picture, eye.renderer->rays(), sensor, index);
    }
  }

  CameraImage imageOf(const Picture& picture, const Rays& rays, std::size_t place,
                      int index) const {
    const CameraSensor& sensor = info_.sensors.cameras[place];
    CameraImage image;
    image.name = sensor.name;
    image.kind = sensor.kind;
    image.camera = sensor.camera;
    image.T_body_camera = sensor.T_body_camera;
    image.depth_scale = sensor.depth_scale;
    if (sensor.kind == ImageKind::depth) {
      image.image = measureDepth(picture, rays, depthOf(sensor, place, index));
    } else {
      image.image = photograph(picture, sensor.kind, exposureOf(picture, place, index));
      image.exposure = static_cast<std::int64_t>(std::llround(options_.exposure * 1e9));
    }
    return image;
  }

  std::uint64_t keyFor(std::size_t place, int index) const {
    return keyOf(options_.seed, 50 + place, static_cast<std::uint64_t>(index));
  }

  // It comes from below and moves a little.
  Occluder occluderAt(int index, int width, int height) const {
    if (!options_.occlusion.contains(index)) return {};
    const auto swing = static_cast<float>(0.06 * std::sin(0.35 * index));
    const auto w = static_cast<float>(width), h = static_cast<float>(height);
    return {(0.42F + swing) * w, (0.72F + swing) * h, 0.46F * std::max(w, h)};
  }

  Exposure exposureOf(const Picture& picture, std::size_t place, int index) const {
    Exposure exposure;
    const double phase = 2 * kPi * index / options_.rate / kSwingSeconds;
    exposure.seconds = isBlurred() ? static_cast<float>(options_.exposure) : 0;
    exposure.gain = static_cast<float>(1 + options_.exposure_change * std::sin(phase));
    exposure.contrast = options_.low_texture.contains(index) ? kLowContrast : 1;
    exposure.vignette = static_cast<float>(options_.vignette);
    exposure.noise = static_cast<float>(options_.noise * options_.image_noise);
    exposure.occluder = occluderAt(index, picture.width, picture.height);
    exposure.key = keyFor(place, index);
    exposure.threads = static_cast<unsigned>(options_.threads);
    return exposure;
  }

  DepthSensor depthOf(const CameraSensor& camera, std::size_t place, int index) const {
    DepthSensor sensor;
    sensor.is_float = options_.depth_float;
    sensor.unit = camera.depth_scale;
    sensor.farthest = static_cast<float>(options_.depth_max);
    sensor.noise = static_cast<float>(options_.noise * options_.depth_noise);
    sensor.occluder = occluderAt(index, camera.camera.width(), camera.camera.height());
    sensor.key = keyFor(place, index);
    sensor.threads = static_cast<unsigned>(options_.threads);
    return sensor;
  }

  SyntheticOptions options_;
  Scene scene_;
  Motion motion_;
  Imu imu_;
  Gnss gnss_;
  DatasetInfo info_;
  std::vector<int> kept_;  // number of each frame, counted with those that are dropped
  std::vector<Eye> eyes_;
  std::size_t next_ = 0;
};

}  // namespace
}  // namespace synthetic
}  // namespace detail

std::unique_ptr<Dataset> openSynthetic(const SyntheticOptions& options) {
  using namespace detail::synthetic;  // NOLINT(google-build-using-namespace): one function
  checkOptions(options);
  // The world says how cameras are mounted, the cameras how fine its textures are.
  const std::vector<CameraSensor> cameras = camerasOf(options, *findWorld(options.world));
  World world = makeWorld(options.world, options.seed, textureDetail(cameras), options.movers);
  return std::unique_ptr<Dataset>(new SyntheticDataset(options, std::move(world), cameras));
}

}  // namespace v1
}  // namespace gslam
