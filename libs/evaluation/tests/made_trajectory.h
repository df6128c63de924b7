// Trajectories that are calculated, for the tests of evaluation.
#ifndef GSLAM_EVALUATION_TESTS_MADE_TRAJECTORY_H
#define GSLAM_EVALUATION_TESTS_MADE_TRAJECTORY_H

#include <gslam/core/trajectory.h>
#include <gslam/evaluation/pairs.h>

#include <cmath>
#include <cstddef>
#include <cstdint>
#include <random>
#include <utility>
#include <vector>

namespace made {

constexpr std::int64_t kSecond = 1000000000;

/// Where something is that goes about a hall, at a time in seconds; never the same twice.
inline gslam::SE3d poseAt(double t) {
  const gslam::Vec3d place = {{8 * std::sin(0.31 * t) + 0.8 * std::sin(1.7 * t),
                               5 * std::cos(0.23 * t) + 0.2 * t,
                               1.5 * std::sin(0.17 * t) + 0.3 * std::cos(1.3 * t)}};
  const gslam::Vec3d turn = {{0.3 * std::sin(0.9 * t), 0.2 * std::cos(0.7 * t), 0.4 * t}};
  return gslam::SE3d(gslam::SO3d::exp(turn), place);
}

/// So many poses, so many nanoseconds apart.
inline gslam::Trajectory trajectory(std::size_t count, std::int64_t step = kSecond / 20,
                                    std::int64_t first = 1000 * kSecond) {
  std::vector<gslam::StampedPose> poses;
  for (std::size_t i = 0; i < count; ++i) {
    const std::int64_t since = std::int64_t(i) * step;
    poses.push_back({first + since, poseAt(1e-9 * double(since))});
  }
  return gslam::Trajectory(std::move(poses));
}

/// Each pose as a function of it makes it.
template <class Change>
gslam::Trajectory changed(const gslam::Trajectory& trajectory, const Change& change) {
  std::vector<gslam::StampedPose> poses;
  for (const gslam::StampedPose& pose : trajectory)
    poses.push_back({pose.stamp, change(pose.pose)});
  return gslam::Trajectory(std::move(poses));
}

/// With a random motion at each pose, drawn for it alone.
inline gslam::Trajectory noisy(const gslam::Trajectory& trajectory, double metres, double radians,
                               unsigned seed = 1) {
  std::mt19937 random(seed);
  std::normal_distribution<double> normal;
  return changed(trajectory, [&](const gslam::SE3d& pose) {
    gslam::SE3d::Tangent d;
    for (std::size_t i = 0; i < 6; ++i) d[i] = normal(random) * (i < 3 ? metres : radians);
    return pose * gslam::SE3d::exp(d);
  });
}

/// Some rigid motion that is not small.
inline gslam::SE3d someMotion() {
  return gslam::SE3d(gslam::SO3d::exp({{0.7, -1.1, 0.4}}), {{12, -7, 3}});
}

/// The pairs of equal stamps.
inline gslam::PosePairs pairs(const gslam::Trajectory& reference,
                              const gslam::Trajectory& estimate) {
  return gslam::pairPoses(reference, estimate);
}

}  // namespace made

#endif  // GSLAM_EVALUATION_TESTS_MADE_TRAJECTORY_H
