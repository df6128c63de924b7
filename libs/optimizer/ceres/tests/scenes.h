// Scenes with a known truth.
#ifndef GSLAM_OPTIMIZER_CERES_TESTS_SCENES_H
#define GSLAM_OPTIMIZER_CERES_TESTS_SCENES_H

#include <gslam/geometry/random.h>
#include <gslam/optimizer/bundle_problem.h>
#include <gslam/optimizer_ceres.h>

#include <cstddef>
#include <cstdint>
#include <random>
#include <vector>

namespace scenes {

using gslam::BundleProblem;
using gslam::Camera;
using gslam::SE3d;
using gslam::Vec2d;
using gslam::Vec3d;

inline double noise(std::mt19937_64& generator, double size) {
  return gslam::randomUniform(generator, -size, size);
}

inline SE3d smallMotion(std::mt19937_64& generator, double translation, double rotation) {
  SE3d::Tangent tangent;
  for (std::size_t i = 0; i < 6; ++i) tangent[i] = noise(generator, i < 3 ? translation : rotation);
  return SE3d::exp(tangent);
}

// A row of bodies that look at a cloud of points. All points are seen by all, exactly, by a camera
// for each body or by few.
struct Bundle {
  std::vector<SE3d> poses;
  std::vector<Vec3d> points;
  std::vector<Camera> cameras;
  std::vector<SE3d> T_body_camera;
  std::vector<std::uint32_t> observation_pose, observation_point, observation_camera;
  std::vector<Vec2d> pixels;
  std::vector<double> right_u, baseline;

  // camera_of(pose, k): cameras with which a pose looks; each of `cameras_of_pose`.
  static Bundle make(std::size_t pose_count, std::size_t point_count,
                     const std::vector<Camera>& cameras, const std::vector<SE3d>& extrinsics,
                     std::size_t cameras_of_pose) {
    std::mt19937_64 generator(7);
    Bundle scene;
    scene.cameras = cameras;
    scene.T_body_camera = extrinsics;
    for (std::size_t i = 0; i < pose_count; ++i) {
      const SE3d along(gslam::SO3d(), {0.4 * double(i), 0.1 * double(i % 2), 0});
      scene.poses.push_back(along * smallMotion(generator, 0.05, 0.1));
    }
    for (std::size_t j = 0; j < point_count; ++j) {
      scene.points.push_back({noise(generator, 2) + 0.2 * double(pose_count), noise(generator, 1.5),
                              6 + noise(generator, 2)});
    }
    for (std::size_t i = 0; i < pose_count; ++i) {
      for (std::size_t k = 0; k < cameras_of_pose; ++k) {
        const std::size_t c = (i * cameras_of_pose + k) % cameras.size();
        for (std::size_t j = 0; j < point_count; ++j) scene.see(i, j, c);
      }
    }
    return scene;
  }

  void see(std::size_t pose, std::size_t point, std::size_t camera) {
    const SE3d T_body_camera_here = T_body_camera.empty() ? SE3d() : T_body_camera[camera];
    Vec2d pixel{};
    const SE3d T_camera_world = (poses[pose] * T_body_camera_here).inverse();
    if (!cameras[camera].project(T_camera_world * points[point], pixel)) return;
    observation_pose.push_back(static_cast<std::uint32_t>(pose));
    observation_point.push_back(static_cast<std::uint32_t>(point));
    observation_camera.push_back(static_cast<std::uint32_t>(camera));
    pixels.push_back(pixel);
  }

  void disturb(double translation, double rotation, double position, std::size_t first_pose = 1) {
    std::mt19937_64 generator(8);
    for (std::size_t i = first_pose; i < poses.size(); ++i) {
      poses[i] *= smallMotion(generator, translation, rotation);
    }
    for (Vec3d& point : points) {
      for (double& value : point.values) value += noise(generator, position);
    }
  }

  BundleProblem problem() {
    BundleProblem views;
    views.T_world_body = poses;
    views.points = points;
    views.cameras = cameras;
    views.T_body_camera = T_body_camera;
    views.observation_pose = observation_pose;
    views.observation_point = observation_point;
    views.observation_camera = observation_camera;
    views.pixels = pixels;
    views.right_u = right_u;
    views.baseline = baseline;
    return views;
  }
};

inline Camera pinhole() {
  return Camera::fromParameters("pinhole", 640, 480, {400, 410, 320, 240});
}

inline Camera radtan() {
  return Camera::fromParameters("radtan", 640, 480,
                                {400, 410, 320, 240, -0.1, 0.02, 0.001, -0.002});
}

// The largest distance of two lists of points.
inline double farthest(const std::vector<Vec3d>& a, const std::vector<Vec3d>& b) {
  double largest = 0;
  for (std::size_t i = 0; i < a.size(); ++i) largest = std::fmax(largest, (a[i] - b[i]).norm());
  return largest;
}

inline double farthest(const std::vector<SE3d>& a, const std::vector<SE3d>& b) {
  double largest = 0;
  for (std::size_t i = 0; i < a.size(); ++i) {
    largest = std::fmax(largest, (a[i].inverse() * b[i]).log().norm());
  }
  return largest;
}

// With all digits there are.
inline gslam::OptimizerOptions exact() {
  gslam::OptimizerOptions options;
  options.function_tolerance = 1e-20;
  options.parameter_tolerance = 1e-14;
  options.gradient_tolerance = 1e-14;
  options.max_iterations = 100;
  return options;
}

inline gslam::OptimizerSummary solve(const BundleProblem& problem,
                                     const gslam::OptimizerOptions& options = {}) {
  return gslam::ceresBackend().bundle(problem, options);
}

// Of five poses.
const std::vector<std::uint8_t> kTwoFixed = {1, 1, 0, 0, 0};

}  // namespace scenes

#endif  // GSLAM_OPTIMIZER_CERES_TESTS_SCENES_H
