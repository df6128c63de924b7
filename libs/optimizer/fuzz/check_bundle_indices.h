// What holds for every bundle that was read.
#ifndef GSLAM_OPTIMIZER_FUZZ_CHECK_BUNDLE_INDICES_H
#define GSLAM_OPTIMIZER_FUZZ_CHECK_BUNDLE_INDICES_H

#include <gslam/optimizer/bundle.h>

#include <cmath>
#include <cstddef>
#include <cstdlib>

inline void require(bool is_right) {
  if (!is_right) std::abort();
}

inline void checkBundleIndices(const gslam::Bundle& bundle) {
  const std::size_t n = bundle.pixels.size();
  require(bundle.observation_pose.size() == n && bundle.observation_point.size() == n);
  require(bundle.observation_camera.size() == n);
  for (std::size_t i = 0; i < n; ++i) {
    require(bundle.observation_pose[i] < bundle.T_world_body.size());
    require(bundle.observation_point[i] < bundle.points.size());
    require(bundle.observation_camera[i] < bundle.cameras.size());
    require(std::isfinite(bundle.pixels[i][0]) && std::isfinite(bundle.pixels[i][1]));
  }
  for (const gslam::Camera& camera : bundle.cameras) require(camera.isValid());
  for (const gslam::SE3d& pose : bundle.T_world_body) {
    require(std::fabs(pose.rotation().quaternion().squaredNorm() - 1) < 1e-9);
    for (std::size_t i = 0; i < 3; ++i) require(std::isfinite(pose.translation()[i]));
  }
  require(bundle.camera_freedom.size() == bundle.cameras.size());
}

#endif  // GSLAM_OPTIMIZER_FUZZ_CHECK_BUNDLE_INDICES_H
