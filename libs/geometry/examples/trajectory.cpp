#include <gslam/geometry/euler.h>
#include <gslam/geometry/interpolate.h>
#include <gslam/geometry/pose_with_covariance.h>
#include <gslam/geometry/se3.h>
#include <gslam/geometry/spline.h>

#include <cstdint>
#include <iostream>
#include <vector>

int main() {
  // A robot that drives a circle to the left, a pose every 0.1 s.
  std::vector<gslam::SE3d> T_world_body;
  for (int i = 0; i < 10; ++i)
    T_world_body.push_back(gslam::SE3d::exp({0.2 * i, 0, 0, 0, 0, 0.1 * i}));

  const gslam::SE3d between = gslam::interpolate(T_world_body[2], T_world_body[3], 0.5);
  const gslam::Vec3d angles = gslam::rollPitchYawOf(between.rotation());
  std::cout << "half way: " << between.translation() << ", yaw " << angles[2] << " rad\n";

  const std::int64_t start = 1000000000, interval = 100000000;  // ns
  const gslam::Spline<gslam::SE3d> motion(start, interval, T_world_body);
  const auto sample = motion.sampleAt(start + 3 * interval / 2);  // 1.5 after the second pose
  std::cout << "velocity in the body: " << sample.velocity << " m/s, rad/s\n";

  gslam::Mat<double, 6, 6> covariance{};  // 1 cm, 0.01 rad
  for (std::size_t i = 0; i < 6; ++i) covariance(i, i) = 1e-4;
  const gslam::PoseWithCovariance<gslam::SE3d> pose(between, covariance);
  const auto landmark = pose * gslam::Vec3d{10, 0, 0};  // seen 10 m ahead
  std::cout << "landmark in the world: " << landmark.point << "\n" << landmark.covariance << "\n";

  const bool is_right = between.isApprox(sample.value, 1e-12) &&
                        (sample.velocity - gslam::Vec<double, 6>{2, 0, 0, 0, 0, 1}).norm() < 1e-12;
  return is_right ? 0 : 1;
}
