// Two views of random points, and what must hold for the matrices between them.
#ifndef GSLAM_ESTIMATOR_TESTS_TWO_VIEWS_H
#define GSLAM_ESTIMATOR_TESTS_TWO_VIEWS_H

#include <gslam/geometry/random.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <limits>
#include <random>
#include <string>
#include <vector>

#include "closed_form_helpers.h"

namespace solver_test {

using gslam::Mat3d;
using gslam::SE3d;
using gslam::SO3d;
using gslam::Vec2d;
using gslam::Vec3d;

struct TwoViews {
  SE3d T_second_first;
  std::vector<Vec3d> points;  // in the first view
  std::vector<Vec3d> first;   // bearings
  std::vector<Vec3d> second;

  Mat3d essential() const {
    return SO3d::hat(T_second_first.translation()) * T_second_first.rotation().matrix();
  }
  void project() {
    first.clear();
    second.clear();
    for (const Vec3d& p : points) {
      first.push_back(p.normalized());
      second.push_back((T_second_first * p).normalized());
    }
  }
};

/// Any rotation, |t| = 1, depths from 0.1 to 10 in a field of view of 70 degrees of the first view;
/// the second may have the points in every direction.
inline TwoViews anyTwoViews(std::mt19937& generator, std::size_t count) {
  TwoViews views;
  views.T_second_first =
      SE3d(gslam::randomOf<SO3d>(generator), gslam::randomDirection<double>(generator));
  for (std::size_t i = 0; i < count; ++i) {
    const Vec3d ray = {{gslam::randomUniform(generator, -0.7, 0.7),
                        gslam::randomUniform(generator, -0.7, 0.7), 1}};
    views.points.push_back(gslam::randomUniform(generator, 0.1, 10.0) * ray.normalized());
  }
  views.project();
  return views;
}

/// Cameras of 4000 x 3000 pixels that look at the same place from about its distance.
inline TwoViews facingTwoViews(std::mt19937& generator, std::size_t count) {
  TwoViews views;
  const Vec3d angles = 0.3 * gslam::randomDirection<double>(generator);
  const SO3d rotation = SO3d::exp(angles);
  const Vec3d centre = {{gslam::randomUniform(generator, -1.0, 1.0),
                         gslam::randomUniform(generator, -1.0, 1.0),
                         gslam::randomUniform(generator, -0.5, 0.5)}};
  views.T_second_first = SE3d(rotation, -(rotation * centre.normalized()));
  for (std::size_t i = 0; i < count; ++i) {
    const double depth = gslam::randomUniform(generator, 3.0, 9.0);
    views.points.push_back({{depth * gslam::randomUniform(generator, -0.6, 0.6),
                             depth * gslam::randomUniform(generator, -0.5, 0.5), depth}});
  }
  views.project();
  return views;
}

/// Motions of every day between which a minimal problem is nearly singular: its roots lie close.
struct HardScene {
  const char* name;
  double half_view;  // radians, of a round field of view
  double baseline;   // metres
  bool forwards;
  double nearest, farthest;  // metres; a plane across the view where they are equal
  double lost_default;       // parts that essential5pt() and essential5ptNister() may miss by 1e-4
  double lost_nister;
};

inline const std::vector<HardScene>& hardScenes() {
  static const std::vector<HardScene> scenes = {
      {"forwards", 0.5236, 0.1, true, 2, 10, 0.002, 0.1},
      {"car", 0.7854, 1, true, 5, 100, 0.002, 0.1},
      {"tiny baseline", 0.5236, 5e-3, false, 2, 10, 0.005, 0.6},
      {"narrow and forwards", 0.0873, 5e-3, true, 2, 10, 0.035, 0.6},
      {"plane, tiny baseline", 0.5236, 5e-3, false, 5, 5, 0.025, 0.99}};
  return scenes;
}

inline TwoViews hardTwoViews(std::mt19937& generator, const HardScene& scene, std::size_t count) {
  const auto uniform = [&](double low, double high) {
    return gslam::randomUniform(generator, low, high);
  };
  TwoViews views;
  const double side = scene.forwards ? 0.02 : 1;
  const Vec3d t = {
      {uniform(-side, side), uniform(-side, side), scene.forwards ? -1.0 : uniform(-0.2, 0.2)}};
  const Vec3d turn = {{uniform(-0.05, 0.05), uniform(-0.05, 0.05), uniform(-0.05, 0.05)}};
  views.T_second_first = SE3d(SO3d::exp(turn), scene.baseline * t.normalized());
  const Vec3d normal = Vec3d{{uniform(-0.3, 0.3), uniform(-0.3, 0.3), 1}}.normalized();
  while (views.points.size() < count) {
    const double off = scene.half_view * std::sqrt(uniform(0, 1)),
                 around = uniform(-3.1416, 3.1416);
    const Vec3d ray = {
        {std::sin(off) * std::cos(around), std::sin(off) * std::sin(around), std::cos(off)}};
    double depth = uniform(scene.nearest, scene.farthest);
    if (!(scene.nearest < scene.farthest)) depth = scene.nearest / ray.dot(normal);
    const Vec3d point = depth * ray;
    if ((views.T_second_first * point)[2] > 0.01) views.points.push_back(point);
  }
  views.project();
  return views;
}

inline Mat3d cameraMatrix() {
  return {{3000, 0, 2000, 0, 3000, 1500, 0, 0, 1}};
}

inline std::vector<Vec2d> pixels(const std::vector<Vec3d>& bearings) {
  std::vector<Vec2d> result;
  for (const Vec3d& b : bearings) {
    result.push_back({{3000 * b[0] / b[2] + 2000, 3000 * b[1] / b[2] + 1500}});
  }
  return result;
}

/// The essential matrix of a fundamental matrix for pixels of cameraMatrix().
inline Mat3d essentialOfPixels(const Mat3d& f) {
  return cameraMatrix().transpose() * f * cameraMatrix();
}

inline double norm(const Mat3d& m) {
  double squared = 0;
  for (const double value : m.values) squared += value * value;
  return std::sqrt(squared);
}

/// Of matrices that count up to scale and sign, both at norm 1.
inline double distance(const Mat3d& a, const Mat3d& b) {
  const Mat3d x = a * (1 / norm(a)), y = b * (1 / norm(b));
  return std::min(norm(x - y), norm(x + y));
}

/// The least distance to the truth.
template <std::size_t N>
double distanceToNearest(const std::array<Mat3d, N>& found, std::size_t count, const Mat3d& truth) {
  double least = std::numeric_limits<double>::infinity();
  for (std::size_t i = 0; i < count; ++i) least = std::min(least, distance(found[i], truth));
  return least;
}

template <std::size_t N>
bool areDistinct(const std::array<Mat3d, N>& found, std::size_t count) {
  for (std::size_t i = 0; i < count; ++i) {
    for (std::size_t k = 0; k < i; ++k) {
      if (!(distance(found[i], found[k]) > 1e-11)) return false;
    }
  }
  return true;
}

/// The largest |second^T M first|.
inline double epipolarError(const Mat3d& m, const std::vector<Vec3d>& first,
                            const std::vector<Vec3d>& second) {
  double largest = 0;
  for (std::size_t i = 0; i < first.size(); ++i) {
    const double error = std::fabs(second[i].dot(m * first[i]));
    largest = error <= largest ? largest : error;  // NaN stays
  }
  return largest;
}

/// |2 E E^T E - trace(E E^T) E|
inline double essentialError(const Mat3d& e) {
  const Mat3d square = e * e.transpose();
  const double trace = square(0, 0) + square(1, 1) + square(2, 2);
  return norm(2.0 * (square * e) - trace * e);
}

/// Scenes that are hard, or have no only solution.
inline std::vector<std::pair<std::string, TwoViews>> oddTwoViews(std::mt19937& generator,
                                                                 std::size_t count) {
  std::vector<std::pair<std::string, TwoViews>> result;
  const auto take = [&](const char* name, TwoViews views) {
    views.project();
    result.emplace_back(name, views);
  };
  const TwoViews usual = anyTwoViews(generator, count);
  TwoViews v = usual;
  for (Vec3d& p : v.points) p[2] = 2 + 0.3 * p[0] - 0.2 * p[1];
  take("plane", v);
  v = usual;
  for (Vec3d& p : v.points) {
    p = Vec3d{{0.1, 0.2, 2}} + gslam::randomUniform(generator, -1.0, 1.0) * Vec3d{{1, 0.5, 0.3}} +
        1e-4 * gslam::randomDirection<double>(generator);
  }
  take("almost a line", v);
  v = usual;
  for (Vec3d& p : v.points) p = Vec3d{{0, 0, 1e4}} + p;
  take("far cluster", v);
  for (const double baseline : {1e-2, 1e-4, 1e-9}) {
    v = usual;
    v.T_second_first.setTranslation(baseline * usual.T_second_first.translation());
    take("small baseline", v);
  }
  v = usual;
  v.T_second_first = SE3d(SO3d(), {{0, 0, -1}});
  take("forwards", v);
  v = usual;
  v.T_second_first = SE3d(SO3d(), {{1, 0, 0}});
  take("sideways", v);
  v = usual;
  for (Vec3d& p : v.points) p = 1e9 * p;
  take("at infinity", v);
  v = usual;
  v.T_second_first.setTranslation({{0, 0, 0}});
  take("rotation only", v);
  v = usual;
  v.T_second_first = SE3d();
  take("no motion", v);
  v = usual;
  for (Vec3d& p : v.points) p = usual.points[0];
  take("one point", v);
  v = usual;
  for (std::size_t i = 0; i < count; ++i) v.points[i] = usual.points[i / 2];
  take("pairs", v);
  v = usual;
  const Vec3d corners[] = {{{1, 0, 0}}, {{0, 1, 0}}, {{0, 0, 1}}, {{1, 1, 0}},
                           {{0, 1, 1}}, {{1, 0, 1}}, {{1, 1, 1}}, {{-1, 1, 0}}};
  for (std::size_t i = 0; i < count; ++i) v.points[i] = corners[i % 8];
  v.T_second_first = SE3d(SO3d(), {{0, 0, 1}});
  for (Vec3d& p : v.points) p[2] += p[2] == 0 ? 0 : 1;
  take("zeros", v);
  return result;
}

/// Numbers that are none, or absurd.
inline const std::vector<double>& absurdNumbers() {
  static const std::vector<double> numbers = {std::numeric_limits<double>::quiet_NaN(),
                                              std::numeric_limits<double>::infinity(),
                                              -std::numeric_limits<double>::infinity(),
                                              1e308,
                                              -1e200,
                                              1e-300,
                                              0};
  return numbers;
}

}  // namespace solver_test

#endif  // GSLAM_ESTIMATOR_TESTS_TWO_VIEWS_H
