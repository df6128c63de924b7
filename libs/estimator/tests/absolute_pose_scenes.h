// Points, the rays on which cameras and rigs see them, and what a pose must fulfil: for the tests
// of absolute pose.
#ifndef GSLAM_ESTIMATOR_TESTS_ABSOLUTE_POSE_SCENES_H
#define GSLAM_ESTIMATOR_TESTS_ABSOLUTE_POSE_SCENES_H

#include <gslam/geometry/random.h>
#include <gslam/geometry/se3.h>
#include <gslam/geometry/vec.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <limits>
#include <random>
#include <vector>

#include "closed_form_helpers.h"

namespace absolute_pose {

using gslam::SE3d;
using gslam::Vec3d;
using solver_test::isFinite;
using solver_test::poseError;
using Generator = std::mt19937;

struct PoseScene {
  std::array<Vec3d, 3> origins{};  // of the rays, in camera coordinates; zero for a camera
  std::array<Vec3d, 3> bearings;
  std::array<Vec3d, 3> points;
  SE3d T_camera_world;
};

inline Vec3d inView(Generator& generator, double near = 1, double far = 10) {
  const double z = gslam::randomUniform(generator, near, far);
  return {{z * gslam::randomUniform(generator, -1.0, 1.0),
           z * gslam::randomUniform(generator, -1.0, 1.0), z}};
}

// The scene of points in camera coordinates; their bearings are made from the rounded points.
inline PoseScene sceneOf(Generator& generator, const std::array<Vec3d, 3>& in_camera,
                         const std::array<Vec3d, 3>& origins = {}) {
  PoseScene scene;
  scene.origins = origins;
  scene.T_camera_world = gslam::randomOf<SE3d>(generator, 5.0);
  for (std::size_t i = 0; i < 3; ++i) {
    scene.points[i] = scene.T_camera_world.inverse() * in_camera[i];
    scene.bearings[i] = (scene.T_camera_world * scene.points[i] - origins[i]).normalized();
  }
  return scene;
}

inline PoseScene randomPoseScene(Generator& generator) {
  const Vec3d a = inView(generator), b = inView(generator), c = inView(generator);
  return sceneOf(generator, {a, b, c});
}

// The third point is off the line of the others by `height` of their distance.
inline PoseScene flatScene(Generator& generator, double height) {
  const Vec3d a = inView(generator), b = inView(generator);
  const double part = gslam::randomUniform(generator, 0.1, 0.9);
  const Vec3d off = (height * (b - a).norm()) * gslam::randomDirection<double>(generator);
  return sceneOf(generator, {a, b, (1 - part) * a + part * b + off});
}

inline double errorOf(const SE3d* found, std::size_t count, const SE3d& truth) {
  double least = std::numeric_limits<double>::infinity();
  for (std::size_t i = 0; i < count; ++i) least = std::min(least, poseError(found[i], truth));
  return least;
}

// The largest angle, about, between a ray and where the pose sees its point; in long double, from
// the quaternion. 2 where a point is behind.
inline double rayError(const SE3d& pose, const PoseScene& scene, std::size_t points = 3) {
  using Real = long double;
  const double* const n = pose.data();
  const Real x = n[0], y = n[1], z = n[2], w = n[3];
  const Real square = x * x + y * y + z * z + w * w;
  if (!(std::fabs(square - 1) < 2e-15L)) return 3;
  const Real r[3][3] = {{w * w + x * x - y * y - z * z, 2 * (x * y - z * w), 2 * (x * z + y * w)},
                        {2 * (x * y + z * w), w * w - x * x + y * y - z * z, 2 * (y * z - x * w)},
                        {2 * (x * z - y * w), 2 * (y * z + x * w), w * w - x * x - y * y + z * z}};
  double worst = 0;
  for (std::size_t i = 0; i < points; ++i) {
    Real p[3], dot = 0, norm = 0;
    for (std::size_t k = 0; k < 3; ++k) {
      p[k] = n[4 + k] - Real(scene.origins[i][k]);
      for (std::size_t l = 0; l < 3; ++l) p[k] += r[k][l] * scene.points[i][l] / square;
      dot += p[k] * scene.bearings[i][k];
      norm += p[k] * p[k];
    }
    Real off = 0;
    for (std::size_t k = 0; k < 3; ++k) {
      const Real difference = p[k] - dot * scene.bearings[i][k];
      off += difference * difference;
    }
    if (!(dot > 0)) return 2;
    worst = std::max(worst, static_cast<double>(std::sqrt(off / norm)));
  }
  return worst;
}

inline double quantile(std::vector<double> values, double part) {
  const auto at =
      values.begin() + static_cast<std::ptrdiff_t>(part * static_cast<double>(values.size() - 1));
  std::nth_element(values.begin(), at, values.end());
  return *at;
}

// Numbers that no camera gives.
inline std::vector<double> oddNumbers() {
  const double infinite = std::numeric_limits<double>::infinity();
  return {0, std::numeric_limits<double>::quiet_NaN(), infinite, -infinite, 1e300, 1e-300, 1e160};
}

}  // namespace absolute_pose

#endif  // GSLAM_ESTIMATOR_TESTS_ABSOLUTE_POSE_SCENES_H
