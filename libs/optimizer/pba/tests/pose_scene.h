// Points before a camera or a rig, and where they are seen.
#ifndef GSLAM_OPTIMIZER_PBA_TESTS_POSE_SCENE_H
#define GSLAM_OPTIMIZER_PBA_TESTS_POSE_SCENE_H

#include <gslam/geometry/random.h>
#include <gslam/optimizer/pose_problem.h>
#include <gtest/gtest.h>

#include <cstddef>
#include <cstdint>
#include <limits>
#include <map>
#include <random>
#include <string>
#include <vector>

namespace pose_scene {

using gslam::Camera;
using gslam::SE3d;
using gslam::Vec2d;
using gslam::Vec3d;

struct PoseScene {
  SE3d truth;
  SE3d start;
  std::vector<Vec3d> points;
  std::vector<Vec2d> pixels;
  std::vector<double> information, right_u;
  std::vector<Camera> cameras;
  std::vector<SE3d> T_body_camera;
  std::vector<std::uint32_t> camera_of;
  std::vector<std::uint8_t> inliers;
  double baseline = 0;

  gslam::PoseProblem problem() {
    gslam::PoseProblem p;
    p.points = points;
    p.pixels = pixels;
    p.information = information;
    p.right_u = right_u;
    p.baseline = baseline;
    p.cameras = cameras;
    p.T_body_camera = T_body_camera;
    p.camera_of = camera_of;
    p.inliers = inliers;
    return p;
  }
};

inline Camera pinhole() {
  return Camera::fromParameters("pinhole", 640, 480, {500, 510, 320, 240});
}

inline Camera radtan(std::size_t coefficients) {
  const std::vector<double> all = {400,  410,  320,  240,  -0.2, 0.03, 1e-3,  -2e-3, 5e-3,
                                   0.01, 2e-3, 1e-3, 2e-3, 1e-3, 3e-3, -1e-3, 0.03,  -0.02};
  return Camera::fromParameters(
      "radtan", 640, 480,
      std::vector<double>(all.begin(),
                          all.begin() + static_cast<std::ptrdiff_t>(4 + coefficients)));
}

/// A camera of each model, radtan of each size.
inline std::vector<Camera> camerasOfAllModels() {
  std::map<std::string, std::vector<double>> values = {
      {"kannala_brandt", {200, 210, 320, 240, 0.01, -0.02, 3e-3, -1e-3}},
      {"ocam", {320, 240, 1.01, 0.01, -0.02, -250, 0.02, 8e-4, -1e-7, 1e-10}},
      {"fov", {200, 210, 320, 240, 0.9}},
      {"double_sphere", {200, 210, 320, 240, -0.2, 0.6}},
      {"eucm", {200, 210, 320, 240, 0.6, 1.1}},
      {"ucm", {200, 210, 320, 240, 0.6}},
      {"mei", {400, 410, 320, 240, 0.9, -0.1, 0.02, 1e-3, -1e-3}},
      {"equirectangular", {}},
      {"orthographic", {200, 210, 320, 240}},
  };
  std::vector<Camera> cameras = {pinhole(), radtan(4),  radtan(5),
                                 radtan(8), radtan(12), radtan(14)};
  for (const std::string& name : Camera::modelNames()) {
    if (values.count(name) != 0) {
      cameras.push_back(Camera::fromParameters(name, 640, 480, values[name]));
    } else if (name != "radtan" && name != "pinhole") {
      ADD_FAILURE() << "no camera to test the model " << name << " with";
    }
  }
  return cameras;
}

/// n points 2 to 10 m before one camera, or before each of a rig in turn, with `noise` pixels of
/// standard deviation, and a start 5 cm and 2 degrees away; `outliers` of them are anywhere.
inline PoseScene makeScene(const std::vector<Camera>& cameras, std::size_t n, double noise,
                           double outliers = 0, unsigned seed = 1) {
  std::mt19937_64 generator(seed + 1000 * n);
  PoseScene s;
  s.cameras = cameras;
  s.truth = SE3d(gslam::SO3d::exp({0.4, -0.3, 0.2}), {1, -2, 0.5});
  if (cameras.size() > 1) {
    for (std::size_t c = 0; c < cameras.size(); ++c) {
      s.T_body_camera.push_back(
          SE3d(gslam::SO3d::exp({0.1, 1.5 * static_cast<double>(c), -0.05}), {0.1, 0.2, 0.05}));
    }
  }
  while (s.points.size() < n) {
    const std::size_t c = s.points.size() % cameras.size();
    const Vec2d pixel = {gslam::randomUniform(generator, 30.0, cameras[c].width() - 31.0),
                         gslam::randomUniform(generator, 30.0, cameras[c].height() - 31.0)};
    Vec3d bearing{};
    Vec2d seen{};
    if (!cameras[c].unproject(pixel, bearing)) continue;
    const Vec3d in_camera = gslam::randomUniform(generator, 2.0, 10.0) * bearing;
    if (!cameras[c].project(in_camera, seen)) continue;
    const SE3d T_world_camera = s.T_body_camera.empty() ? s.truth : s.truth * s.T_body_camera[c];
    s.points.push_back(T_world_camera * in_camera);
    s.pixels.push_back(seen + noise * gslam::randomNormal<double, 2>(generator));
    if (gslam::randomUniform(generator, 0.0, 1.0) < outliers) {
      s.pixels.back() = {gslam::randomUniform(generator, 0.0, 640.0),
                         gslam::randomUniform(generator, 0.0, 480.0)};
    }
    if (cameras.size() > 1) s.camera_of.push_back(static_cast<std::uint32_t>(c));
  }
  s.start = s.truth * SE3d::exp({0.03, -0.02, 0.035, 0.02, -0.025, 0.015});
  s.inliers.resize(n);
  return s;
}

/// u in the right image for every second point.
inline void addRight(PoseScene& s, double noise) {
  std::mt19937_64 generator(5);
  s.baseline = 0.2;
  for (std::size_t i = 0; i < s.points.size(); ++i) {
    const std::size_t c = s.camera_of.empty() ? 0 : s.camera_of[i];
    const SE3d T = s.T_body_camera.empty() ? s.truth : s.truth * s.T_body_camera[c];
    const Vec3d p = T.inverse() * s.points[i] - Vec3d{s.baseline, 0, 0};
    Vec2d pixel{};
    const bool is_seen = i % 2 == 0 && s.cameras[c].project(p, pixel);
    s.right_u.push_back(is_seen ? pixel[0] + noise * gslam::randomNormal<double, 1>(generator)[0]
                                : std::numeric_limits<double>::quiet_NaN());
  }
}

inline void addInformation(PoseScene& s) {
  std::mt19937_64 generator(6);
  for (std::size_t i = 0; i < s.points.size(); ++i) {
    s.information.push_back(gslam::randomUniform(generator, 0.2, 2.0));
  }
}

}  // namespace pose_scene

#endif  // GSLAM_OPTIMIZER_PBA_TESTS_POSE_SCENE_H
