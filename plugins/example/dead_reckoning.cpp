#include "dead_reckoning.h"

#include <cmath>
#include <cstdint>
#include <memory>

namespace example {
namespace {

using gslam::SE3d;
using gslam::SO3d;
using gslam::Vec3d;

constexpr double kHalfTurn = 3.14159265358979323846;

class DeadReckoning : public gslam::Slam {
 public:
  void configure(const gslam::SlamSetup& setup) override {
    gravity_ = setup.parameters.get<double>("gravity");
    T_body_imu_ = setup.sensors.imu.T_body_imu;
    pose_ = setup.messenger.advertise<gslam::TrackedPose>("pose");
  }

  void feed(const std::shared_ptr<const gslam::Frame>& frame) override {
    for (const gslam::ImuSample& sample : frame->imu) add(sample);
    const gslam::TrackingState state =
        has_begun_ ? gslam::TrackingState::guessed : gslam::TrackingState::starting;
    pose_.publish({frame->id, frame->stamp, T_world_imu_ * T_body_imu_.inverse(), state});
  }

  std::shared_ptr<const gslam::Map> map() override { return nullptr; }
  void finish() override {}

 private:
  // Half the way with the sample before, half with this one: the trapezoid rule.
  void add(const gslam::ImuSample& sample) {
    if (!has_begun_) {
      has_begun_ = true;
      T_world_imu_.setRotation(levelled(sample.accel));
    } else {
      const double dt = double(sample.stamp - before_.stamp) * 1e-9;
      const SO3d turned =
          T_world_imu_.rotation() * SO3d::exp((0.5 * dt) * (before_.gyro + sample.gyro));
      const Vec3d up = {{0, 0, gravity_}};
      const Vec3d accel =
          0.5 * (T_world_imu_.rotation() * before_.accel + turned * sample.accel) - up;
      const Vec3d way = dt * velocity_ + (0.5 * dt * dt) * accel;
      T_world_imu_ = SE3d(turned.normalized(), T_world_imu_.translation() + way);
      velocity_ = velocity_ + dt * accel;
    }
    before_ = sample;
  }

  // The rotation without a heading of its own that makes what is felt at rest point up.
  static SO3d levelled(const Vec3d& accel) {
    const Vec3d up = {{0, 0, 1}};
    const double norm = accel.norm();
    if (!(norm > 0)) return SO3d();
    const Vec3d axis = (1 / norm) * accel.cross(up);
    const double sine = axis.norm(), cosine = accel[2] / norm;
    if (sine < 1e-12) return cosine > 0 ? SO3d() : SO3d::exp({{kHalfTurn, 0, 0}});  // upside down
    return SO3d::exp((std::atan2(sine, cosine) / sine) * axis);
  }

  double gravity_ = 0;
  SE3d T_body_imu_;
  SE3d T_world_imu_;
  Vec3d velocity_{};
  gslam::ImuSample before_{};
  bool has_begun_ = false;
  gslam::Publisher<gslam::TrackedPose> pose_;
};

}  // namespace

gslam::SlamFactory deadReckoningFactory() {
  gslam::SlamFactory factory;
  factory.name = "dead_reckoning";
  factory.description = "Adds up what the IMU measures, from rest on; drifts";
  factory.parameters = gslam::Svar::object({{"gravity", 9.81}});
  factory.help = gslam::Svar::object({{"gravity", "m/s^2"}});
  factory.needs.cameras = 0;
  factory.needs.imu = true;
  factory.make = [] { return std::unique_ptr<gslam::Slam>(new DeadReckoning); };
  return factory;
}

}  // namespace example
