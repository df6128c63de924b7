// Scenes with outliers for tests of the robust functions.
#ifndef GSLAM_ESTIMATOR_TESTS_ROBUST_SCENES_H
#define GSLAM_ESTIMATOR_TESTS_ROBUST_SCENES_H

#include <gslam/geometry/camera.h>
#include <gslam/geometry/random.h>
#include <gslam/geometry/se3.h>

#include <cmath>
#include <cstdint>
#include <random>
#include <vector>

#include "instances.h"

namespace robust_test {

using gslam::Camera;
using gslam::SE3d;
using gslam::SO3d;
using gslam::Vec2d;
using gslam::Vec3d;

using Generator = std::mt19937;

constexpr double kDegree = 3.14159265358979323846 / 180;

// Trials of the daily tier, or ten times as many.
inline int trials(int daily) {
  return static_cast<int>(solver_test::instances(10)) / 10 * daily;
}

inline Camera pinhole() {
  return Camera::fromParameters("pinhole", 640, 480, {500, 500, 319.5, 239.5});
}
inline Camera unequalPinhole() {
  return Camera::fromParameters("pinhole", 1280, 720, {900, 880, 650, 350});
}
inline Camera radtan() {
  return Camera::fromParameters("radtan", 752, 480,
                                {458, 457, 367, 248, -0.283, 0.074, 0.00019, 1.8e-5});
}
inline Camera fisheye() {  // 180 degrees and a little more
  return Camera::fromParameters("kannala_brandt", 600, 600,
                                {190, 190, 299.5, 299.5, 0.01, -0.005, 0.002, -0.0003});
}
inline Camera panorama() {
  return Camera::fromParameters("equirectangular", 1024, 512, {});
}

inline Vec2d uniformPixel(Generator& generator, const Camera& camera) {
  return {gslam::randomUniform<double>(generator, 0, camera.width() - 1),
          gslam::randomUniform<double>(generator, 0, camera.height() - 1)};
}

inline Vec2d noise(Generator& generator, double sigma) {
  return sigma * gslam::randomNormal<double, 2>(generator);
}

// A pixel that has a bearing and its bearing.
inline Vec2d seenPixel(Generator& generator, const Camera& camera, Vec3d& bearing) {
  while (true) {
    const Vec2d pixel = uniformPixel(generator, camera);
    if (camera.unproject(pixel, bearing)) return pixel;
  }
}

struct SceneRecipe {
  std::size_t count = 200;
  double outliers = 0.5;
  double sigma = 1;       // pixels
  double planar = 0;      // part of the true matches on one plane
  double baseline = 1;    // metres, of points 4 to 12 metres away; 0: a turn only
  double rotation = 0.2;  // radians, about
  double nearest = 4, farthest = 12;
};

struct MatchedPixels {
  SE3d T_second_first;
  std::vector<Vec2d> first, second;
  std::vector<std::uint8_t> is_true;
};

inline MatchedPixels makeMatchedPixels(Generator& generator, const Camera& first_camera,
                                       const Camera& second_camera, const SceneRecipe& scene) {
  MatchedPixels views;
  const Vec3d turn = scene.rotation * gslam::randomDirection<double>(generator);
  const Vec3d direction = gslam::randomDirection<double>(generator);
  views.T_second_first = SE3d(SO3d::exp(turn), scene.baseline * direction);
  Vec3d normal = gslam::randomDirection<double>(generator) + Vec3d{0, 0, -2};
  normal = normal.normalized();
  const auto true_count =
      static_cast<std::size_t>(std::lround(double(scene.count) * (1 - scene.outliers)));
  const auto planar_count =
      static_cast<std::size_t>(std::lround(double(true_count) * scene.planar));
  while (views.first.size() < true_count) {
    Vec3d bearing;
    const Vec2d pixel = seenPixel(generator, first_camera, bearing);
    double depth = gslam::randomUniform<double>(generator, scene.nearest, scene.farthest);
    if (views.first.size() < planar_count) {  // n X = -n_z 8
      depth = 8 * normal[2] / normal.dot(bearing);
      if (!(depth > 0.5 && depth < 60)) continue;
    }
    Vec2d other;
    if (!second_camera.project(views.T_second_first * (depth * bearing), other) ||
        !second_camera.isInImage(other)) {
      continue;
    }
    views.first.push_back(pixel + noise(generator, scene.sigma));
    views.second.push_back(other + noise(generator, scene.sigma));
    views.is_true.push_back(1);
  }
  Vec3d unused;
  while (views.first.size() < scene.count) {
    views.first.push_back(seenPixel(generator, first_camera, unused));
    views.second.push_back(seenPixel(generator, second_camera, unused));
    views.is_true.push_back(0);
  }
  return views;
}

struct PosedPoints {
  SE3d T_world_camera;
  std::vector<Vec2d> pixels;
  std::vector<Vec3d> points;
  std::vector<std::uint8_t> is_true;
};

inline PosedPoints makePosedPoints(Generator& generator, const Camera& camera,
                                   const SceneRecipe& scene, const Vec3d& origin = {0, 0, 0}) {
  PosedPoints posed;
  posed.T_world_camera = gslam::randomOf<SE3d>(generator, 5.0);
  posed.T_world_camera.setTranslation(posed.T_world_camera.translation() + origin);
  const auto true_count =
      static_cast<std::size_t>(std::lround(double(scene.count) * (1 - scene.outliers)));
  Vec3d normal = gslam::randomDirection<double>(generator) + Vec3d{0, 0, -2};
  const auto planar_count =
      static_cast<std::size_t>(std::lround(double(true_count) * scene.planar));
  while (posed.points.size() < scene.count) {
    Vec3d bearing;
    Vec2d pixel = seenPixel(generator, camera, bearing);
    double depth = gslam::randomUniform<double>(generator, scene.nearest, scene.farthest);
    if (posed.points.size() < planar_count) {
      depth = 8 * normal[2] / normal.dot(bearing);
      if (!(depth > 0.5 && depth < 60)) continue;
    }
    const bool is_true = posed.points.size() < true_count;
    posed.points.push_back(posed.T_world_camera * (depth * bearing));
    Vec3d unused;
    pixel = is_true ? pixel + noise(generator, scene.sigma) : seenPixel(generator, camera, unused);
    posed.pixels.push_back(pixel);
    posed.is_true.push_back(is_true ? 1 : 0);
  }
  return posed;
}

inline std::vector<Vec3d> bearingsOf(const Camera& camera, const std::vector<Vec2d>& pixels) {
  std::vector<Vec3d> bearings(pixels.size());
  for (std::size_t i = 0; i < pixels.size(); ++i) {
    if (!camera.unproject(pixels[i], bearings[i])) bearings[i] = {0, 0, 1};
  }
  return bearings;
}

inline double rotationError(const SE3d& a, const SE3d& b) {
  return (a.rotation().inverse() * b.rotation()).angle();
}
// Angle between the translations, radians.
inline double directionError(const SE3d& a, const SE3d& b) {
  const Vec3d &s = a.translation(), &t = b.translation();
  return std::atan2(s.cross(t).norm(), s.dot(t));
}

}  // namespace robust_test

#endif  // GSLAM_ESTIMATOR_TESTS_ROBUST_SCENES_H
