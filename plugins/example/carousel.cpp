#include "carousel.h"

#include <cmath>
#include <cstdint>
#include <memory>
#include <string>
#include <utility>

namespace example {
namespace {

using gslam::SE3d;
using gslam::SO3d;
using gslam::Vec2d;
using gslam::Vec3d;

constexpr double kPi = 3.14159265358979323846;
constexpr double kGravity = 9.81;  // m/s^2
constexpr double kHeight = 1.5;    // of the camera, m
constexpr double kTile = 0.5;      // edge of a tile, m

// One round in `duration` seconds, from rest to rest: velocity and acceleration begin and end at 0.
struct Motion {
  double radius;
  double duration;

  double angle(double t) const { return 2 * kPi * t / duration - std::sin(2 * kPi * t / duration); }
  double speed(double t) const {
    return 2 * kPi / duration * (1 - std::cos(2 * kPi * t / duration));
  }
  double acceleration(double t) const {
    return 4 * kPi * kPi / (duration * duration) * std::sin(2 * kPi * t / duration);
  }
  SE3d pose(double t) const {
    const double a = angle(t);
    return SE3d(SO3d::exp({{0, 0, a}}),
                {{radius * std::sin(a), radius * (1 - std::cos(a)), kHeight}});
  }
  gslam::ImuSample imu(std::int64_t stamp) const {
    const double t = double(stamp) * 1e-9, w = speed(t);
    return {stamp, {{0, 0, w}}, {{radius * acceleration(t), radius * w * w, kGravity}}};
  }
};

// The floor as the camera sees it; the sky is white. Tiles have grey levels of their own.
gslam::Image photographed(const gslam::Camera& camera, const SE3d& T_world_camera) {
  gslam::Image image(camera.width(), camera.height(), gslam::PixelType::u8);
  for (int v = 0; v < image.height(); ++v) {
    std::uint8_t* const row = image.row<std::uint8_t>(v);
    for (int u = 0; u < image.width(); ++u) {
      Vec3d ray{};
      row[u] = 255;
      if (!camera.unproject(Vec2d{{double(u), double(v)}}, ray)) continue;
      ray = T_world_camera.rotation() * ray;
      if (ray[2] >= -0.01) continue;
      const Vec3d hit = T_world_camera.translation() - (kHeight / ray[2]) * ray;
      const auto column = static_cast<std::int64_t>(std::floor(hit[0] / kTile));
      const auto line = static_cast<std::int64_t>(std::floor(hit[1] / kTile));
      const std::uint64_t tile =
          std::uint64_t(column) * 73856093U ^ std::uint64_t(line) * 19349663U;
      row[u] = static_cast<std::uint8_t>(40 + tile % 5 * 40);
    }
  }
  return image;
}

class Carousel : public gslam::Dataset {
 public:
  explicit Carousel(const gslam::Svar& parameters)
      : motion_{parameters.get<double>("radius"), parameters.get<double>("duration")},
        camera_rate_(parameters.get<double>("camera_rate")),
        imu_rate_(parameters.get<double>("imu_rate")) {
    checkPositive("radius", motion_.radius);
    checkPositive("duration", motion_.duration);
    checkPositive("camera_rate", camera_rate_);
    checkPositive("imu_rate", imu_rate_);
    describe();
  }

  const gslam::DatasetInfo& info() const override { return info_; }

  std::shared_ptr<const gslam::Frame> next() override {
    if (next_ >= info_.frame_count) return nullptr;
    const auto frame = std::make_shared<gslam::Frame>();
    frame->id = next_;
    frame->stamp = stampOf(next_, camera_rate_);
    const gslam::CameraSensor& sensor = info_.sensors.cameras[0];
    gslam::CameraImage image;
    image.name = sensor.name;
    image.kind = sensor.kind;
    image.camera = sensor.camera;
    image.T_body_camera = sensor.T_body_camera;
    image.image = photographed(sensor.camera,
                               motion_.pose(double(frame->stamp) * 1e-9) * sensor.T_body_camera);
    frame->images.push_back(std::move(image));
    frame->imu_calibration = info_.sensors.imu;
    addSamples(*frame);
    ++next_;
    return frame;
  }

  void seek(std::size_t index) override {
    if (index > info_.frame_count) {
      throw gslam::ArgumentError("index", "is " + std::to_string(index) + ", but there are " +
                                              std::to_string(info_.frame_count) + " frames");
    }
    next_ = index;
  }

 private:
  static void checkPositive(const char* name, double value) {
    if (value > 0 && value <= 10000) return;
    throw gslam::ArgumentError(
        name, "is " + std::to_string(value) + ", expected more than 0 and at most 10000");
  }

  static std::int64_t stampOf(std::size_t i, double rate) {
    return static_cast<std::int64_t>(std::llround(double(i) * 1e9 / rate));
  }

  void describe() {
    info_.name = info_.format = "carousel";
    info_.licence = "none: it is computed";
    info_.frame_count = static_cast<std::size_t>(motion_.duration * camera_rate_) + 1;
    gslam::CameraSensor camera;
    camera.name = "front";
    camera.camera = gslam::Camera::fromParameters("pinhole", 320, 240, {200, 200, 159.5, 119.5});
    // Camera axes (right, down, forward) in the body, then 20 degrees down.
    const SO3d straight = SO3d::fromMatrix({{0, 0, 1, -1, 0, 0, 0, -1, 0}});
    camera.T_body_camera = SE3d(straight * SO3d::exp({{-20 * kPi / 180, 0, 0}}), Vec3d{});
    camera.rate = camera_rate_;
    info_.sensors.cameras.push_back(std::move(camera));
    info_.sensors.has_imu = true;
    info_.sensors.imu.rate = imu_rate_;
    for (std::size_t i = 0; i < info_.frame_count; ++i) {
      const std::int64_t stamp = stampOf(i, camera_rate_);
      info_.ground_truth.add(stamp, motion_.pose(double(stamp) * 1e-9));
    }
  }

  // What the inertial unit measured after the frame before.
  void addSamples(gslam::Frame& frame) const {
    const std::int64_t after = frame.id == 0 ? -1 : stampOf(frame.id - 1, camera_rate_);
    auto i = static_cast<std::size_t>(double(after < 0 ? 0 : after) * 1e-9 * imu_rate_);
    for (; stampOf(i, imu_rate_) <= frame.stamp; ++i) {
      if (stampOf(i, imu_rate_) > after) frame.imu.push_back(motion_.imu(stampOf(i, imu_rate_)));
    }
  }

  Motion motion_;
  double camera_rate_;
  double imu_rate_;
  gslam::DatasetInfo info_;
  std::size_t next_ = 0;
};

}  // namespace

gslam::DatasetFactory carouselFactory() {
  gslam::DatasetFactory factory;
  factory.name = "carousel";
  factory.description = "A vehicle on a circle, computed: a camera, an IMU, exact ground truth";
  factory.parameters = gslam::Svar::object(
      {{"radius", 2.0}, {"duration", 10.0}, {"camera_rate", 20.0}, {"imu_rate", 200.0}});
  factory.help = gslam::Svar::object({{"radius", "of the circle, metres"},
                                      {"duration", "of one round, seconds"},
                                      {"camera_rate", "images a second"},
                                      {"imu_rate", "samples a second"}});
  factory.open = [](const std::string& path, const gslam::Svar& parameters) {
    if (path != "carousel" && path != "carousel://") {
      throw gslam::FileError(path, "is no carousel, which is computed: expected the name alone");
    }
    return std::unique_ptr<gslam::Dataset>(new Carousel(parameters));
  };
  return factory;
}

}  // namespace example
