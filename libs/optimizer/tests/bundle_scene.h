// Bundles whose truth is known.
#ifndef GSLAM_OPTIMIZER_TESTS_BUNDLE_SCENE_H
#define GSLAM_OPTIMIZER_TESTS_BUNDLE_SCENE_H

#include <gslam/optimizer/bundle.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>
#include <random>
#include <vector>

namespace bundle_scene {

using gslam::Bundle;
using gslam::BundleProblem;
using gslam::Camera;
using gslam::CameraFreedom;
using gslam::Mat;
using gslam::Mat3d;
using gslam::SE3d;
using gslam::Vec2d;
using gslam::Vec3d;

/// A bundle and what a file cannot hold of it.
struct Scene {
  Bundle bundle;
  Bundle truth;
  std::vector<std::uint32_t> point_anchor;
  std::vector<std::uint8_t> T_body_camera_free;
  std::vector<double> right_u;
  std::vector<double> baseline;
  std::vector<gslam::PositionPrior> position_priors;
  std::vector<gslam::AbsolutePosePrior> pose_priors;
  std::vector<gslam::RelativePosePrior> relative_priors;
  std::vector<gslam::WindowPrior> window_priors;

  BundleProblem problem() {
    BundleProblem p = bundle.problem();
    p.point_anchor = point_anchor;
    p.T_body_camera_free = T_body_camera_free;
    p.right_u = right_u;
    p.baseline = baseline;
    p.position_priors = position_priors;
    p.pose_priors = pose_priors;
    p.relative_priors = relative_priors;
    p.window_priors = window_priors;
    return p;
  }
};

class Random {
 public:
  explicit Random(unsigned seed) : engine_(seed) {}
  double uniform() { return std::uniform_real_distribution<double>(-1, 1)(engine_); }
  double normal() { return std::normal_distribution<double>()(engine_); }
  Vec3d vector() { return {uniform(), uniform(), uniform()}; }
  SE3d::Tangent tangent(double translation, double rotation) {
    SE3d::Tangent t;
    for (std::size_t i = 0; i < 6; ++i) t[i] = (i < 3 ? translation : rotation) * uniform();
    return t;
  }
  Mat<double, 6, 6> information() {  // positive definite
    Mat<double, 6, 6> root;
    for (double& value : root.values) value = uniform();
    return root.transpose() * root + 0.5 * Mat<double, 6, 6>::identity();
  }

 private:
  std::mt19937 engine_;
};

/// A pose at `position` that looks at `target`.
inline SE3d lookAt(const Vec3d& position, const Vec3d& target) {
  const Vec3d z = (target - position).normalized();
  const Vec3d x = Vec3d{0, 1, 0}.cross(z).normalized();
  const Vec3d y = z.cross(x);
  const Mat3d r = {x[0], y[0], z[0], x[1], y[1], z[1], x[2], y[2], z[2]};
  return SE3d(gslam::SO3d::fromMatrix(r), position);
}

/// Poses on an arc of radius 8 around points in a cube of 4 m; every pose sees every point by the
/// camera whose number is that of the pose modulo their number, or by all (a rig).
inline Scene makeScene(std::size_t poses, std::size_t points, const std::vector<Camera>& cameras,
                       bool is_rig = false, unsigned seed = 1) {
  Scene scene;
  Random random(seed);
  Bundle& b = scene.truth;
  b.cameras = cameras;
  for (std::size_t i = 0; i < poses; ++i) {
    const double angle = 1.8 * (double(i) / double(std::max<std::size_t>(poses - 1, 1)) - 0.5);
    const Vec3d position = {8 * std::sin(angle), 0.6 * random.uniform(), -8 * std::cos(angle)};
    b.T_world_body.push_back(lookAt(position, 0.3 * random.vector()));
  }
  for (std::size_t i = 0; i < points; ++i) b.points.push_back(2 * random.vector());
  for (std::size_t c = 0; c < cameras.size(); ++c) {
    b.T_body_camera.push_back(is_rig ? SE3d::exp(random.tangent(0.4, 0.15)) : SE3d());
  }
  for (std::uint32_t p = 0; p < poses; ++p) {
    for (std::uint32_t c = 0; c < cameras.size(); ++c) {
      if (!is_rig && p % cameras.size() != c) continue;
      for (std::uint32_t i = 0; i < points; ++i) {
        const SE3d T_world_camera = b.T_world_body[p] * b.T_body_camera[c];
        Vec2d pixel{};
        if (!cameras[c].project(T_world_camera.inverse() * b.points[i], pixel)) continue;
        b.observation_pose.push_back(p);
        b.observation_point.push_back(i);
        b.observation_camera.push_back(c);
        b.pixels.push_back(pixel);
      }
    }
  }
  scene.bundle = b;
  return scene;
}

/// Moves poses (those that are not fixed) and points away from the truth.
inline void disturb(Scene& scene, double poses, double points, unsigned seed = 7) {
  Random random(seed);
  for (std::size_t i = 0; i < scene.bundle.T_world_body.size(); ++i) {
    const SE3d::Tangent t = random.tangent(poses, 0.1 * poses);
    if (!scene.bundle.pose_fixed.empty() && scene.bundle.pose_fixed[i] != 0) continue;
    scene.bundle.T_world_body[i] *= SE3d::exp(t);
  }
  for (std::size_t i = 0; i < scene.bundle.points.size(); ++i) {
    const Vec3d shift = points * random.vector();
    if (!scene.bundle.point_fixed.empty() && scene.bundle.point_fixed[i] != 0) continue;
    scene.bundle.points[i] += shift;
  }
}

inline void addNoise(Scene& scene, double sigma, unsigned seed = 11) {
  Random random(seed);
  for (Vec2d& pixel : scene.bundle.pixels) {
    pixel += Vec2d{sigma * random.normal(), sigma * random.normal()};
  }
}

inline Camera pinhole() {
  return Camera::fromParameters("pinhole", 640, 480, {500, 505, 320, 240});
}
inline Camera radtan() {
  return Camera::fromParameters("radtan", 640, 480, {450, 460, 322, 238, -0.1, 0.02, 1e-3, -5e-4});
}

/// Gives right_u to all observations.
inline void addStereo(Scene& scene, double baseline) {
  const Bundle& b = scene.truth;
  scene.baseline.assign(b.cameras.size(), baseline);
  for (std::size_t i = 0; i < b.pixels.size(); ++i) {
    const std::uint32_t c = b.observation_camera[i];
    const SE3d T_world_camera = b.T_world_body[b.observation_pose[i]] * b.T_body_camera[c];
    const Vec3d p = T_world_camera.inverse() * b.points[b.observation_point[i]];
    Vec2d right{};
    (void)b.cameras[c].project({p[0] - baseline, p[1], p[2]}, right);
    scene.right_u.push_back(right[0]);
  }
}

/// All that a problem can have at once.
inline Scene makeEverything() {
  Scene scene = makeScene(5, 14, {radtan(), pinhole()}, true);
  Random random(3);
  addStereo(scene, 0.3);
  scene.right_u[3] = std::numeric_limits<double>::quiet_NaN();
  scene.bundle.pose_fixed = {1, 0, 0, 0, 0};
  scene.bundle.point_fixed.assign(14, 0);
  scene.bundle.point_fixed[5] = 1;
  scene.bundle.camera_freedom = {{0xffu, true}, {0x5u, false}};
  scene.T_body_camera_free = {0, 1};
  scene.point_anchor.assign(14, BundleProblem::kNoAnchor);
  scene.point_anchor[2] = 1;
  scene.point_anchor[7] = 0;
  scene.point_anchor[8] = 4;
  for (std::size_t i = 0; i < scene.bundle.pixels.size(); ++i) {
    scene.bundle.information.push_back({1.5 + random.uniform(), 0.3 * random.uniform(), 1.2});
  }
  const std::vector<SE3d>& truth = scene.truth.T_world_body;
  scene.position_priors.push_back(
      {2, truth[2].translation() + 0.1 * random.vector(), 4 * Mat3d::identity()});
  const auto near = [&random](const SE3d& pose) {
    return pose * SE3d::exp(random.tangent(0.2, 0.1));
  };
  scene.pose_priors.push_back({3, near(truth[3]), random.information()});
  scene.relative_priors.push_back(
      {1, 2, near(truth[1].inverse() * truth[2]), random.information()});
  scene.relative_priors.push_back(
      {4, 0, near(truth[4].inverse() * truth[0]), random.information()});
  gslam::WindowPrior window;
  window.poses = {4, 2};
  window.T_linear = {near(truth[4]), near(truth[2])};
  const Mat<double, 6, 6> a = random.information(), b = random.information();
  window.information.assign(144, 0);
  for (std::size_t i = 0; i < 36; ++i) {
    window.information[i / 6 * 12 + i % 6] = a.values[i];
    window.information[(6 + i / 6) * 12 + 6 + i % 6] = b.values[i];
  }
  window.information[3 * 12 + 8] = window.information[8 * 12 + 3] = 0.2;
  for (int i = 0; i < 12; ++i) window.gradient.push_back(random.uniform());
  scene.window_priors.push_back(window);
  disturb(scene, 0.03, 0.05);
  addNoise(scene, 1);
  return scene;
}

}  // namespace bundle_scene

#endif  // GSLAM_OPTIMIZER_TESTS_BUNDLE_SCENE_H
