// Random scenes and comparisons for the tests of the closed-form solvers.
#ifndef GSLAM_ESTIMATOR_TESTS_CLOSED_FORM_HELPERS_H
#define GSLAM_ESTIMATOR_TESTS_CLOSED_FORM_HELPERS_H

#include <gslam/geometry/mat.h>
#include <gslam/geometry/random.h>
#include <gslam/geometry/se3.h>
#include <gslam/geometry/vec.h>

#include <cmath>
#include <cstddef>
#include <limits>
#include <random>
#include <vector>

namespace solver_test {

using gslam::Mat;
using gslam::Mat3d;
using gslam::SE3d;
using gslam::SO3d;
using gslam::Vec;
using gslam::Vec2d;
using gslam::Vec3d;

constexpr double kNan = std::numeric_limits<double>::quiet_NaN();
constexpr double kInf = std::numeric_limits<double>::infinity();

template <class T, std::size_t N>
bool isFinite(const Vec<T, N>& v) {
  for (const T value : v.values) {
    if (!std::isfinite(value)) return false;
  }
  return true;
}
template <std::size_t R, std::size_t C>
bool isFinite(const Mat<double, R, C>& m) {
  for (const double value : m.values) {
    if (!std::isfinite(value)) return false;
  }
  return true;
}
inline bool isFinite(const SE3d& t) {
  return isFinite(t.rotation().quaternion()) && isFinite(t.translation());
}

inline double poseError(const SE3d& a, const SE3d& b) {
  return (a.rotation().inverse() * b.rotation()).angle() +
         (a.translation() - b.translation()).norm();
}

template <std::size_t R, std::size_t C>
double frobenius(const Mat<double, R, C>& m) {
  double sum = 0;
  for (const double value : m.values) sum += value * value;
  return std::sqrt(sum);
}

inline double determinant(const Mat3d& m) {
  return m.row(0).dot(m.row(1).cross(m.row(2)));
}

template <std::size_t N, class Generator>
std::vector<Vec<double, N>> randomPoints(Generator& generator, std::size_t count, double reach) {
  std::vector<Vec<double, N>> points(count);
  for (auto& p : points) {
    for (std::size_t i = 0; i < N; ++i) {
      p[i] = gslam::randomUniform<double>(generator, -reach, reach);
    }
  }
  return points;
}

// Values that no camera gives, to be put anywhere.
inline std::vector<double> absurdValues() {
  return {kNan, kInf, -kInf, 0, 1e308, -1e308, 1e160, 1e-160, 1e-308, 5e-324};
}

// Two views of a plane n.x = d of the first camera, all of it in front of both.
struct PlaneScene {
  SE3d T_second_first;
  Vec3d normal;               // n, towards the plane
  double distance;            // d > 0
  std::vector<Vec3d> points;  // in the first camera
  Mat3d H() const {
    Mat3d h = T_second_first.rotation().matrix();
    h += gslam::outer((1 / distance) * T_second_first.translation(), normal);
    return h;
  }
  std::vector<Vec3d> bearings(const SE3d& T) const {
    std::vector<Vec3d> result;
    for (const Vec3d& p : points) result.push_back((T * p).normalized());
    return result;
  }
  std::vector<Vec2d> image(const SE3d& T, double focal = 1, double centre = 0) const {
    std::vector<Vec2d> result;
    for (const Vec3d& p : points) {
      const Vec3d q = T * p;
      result.push_back({{focal * q[0] / q[2] + centre, focal * q[1] / q[2] + centre}});
    }
    return result;
  }
};

// A camera that looks along z at a plane 1 to 5 away, and another beside it, turned by up to 0.3.
template <class Generator>
PlaneScene randomPlaneScene(Generator& generator, std::size_t count, double baseline = 0.5) {
  using gslam::randomUniform;
  for (;;) {
    PlaneScene s;
    s.normal = (Vec3d{{0, 0, 1}} + 0.6 * gslam::randomDirection<double>(generator)).normalized();
    s.distance = randomUniform<double>(generator, 1, 5);
    const Vec3d turn =
        randomUniform<double>(generator, 0, 0.3) * gslam::randomDirection<double>(generator);
    s.T_second_first = SE3d(SO3d::exp(turn), baseline * gslam::randomDirection<double>(generator));
    bool is_seen = true;
    for (std::size_t i = 0; i < count && is_seen; ++i) {
      const Vec3d ray = {{randomUniform<double>(generator, -0.7, 0.7),
                          randomUniform<double>(generator, -0.7, 0.7), 1}};
      const double depth = s.distance / s.normal.dot(ray);
      s.points.push_back(depth * ray);
      is_seen = depth > 0.1 && depth < 100 && (s.T_second_first * s.points.back())[2] > 0.1;
    }
    if (is_seen) return s;
  }
}

// A quadrilateral with triangles of at least `least` of the square of its extent.
inline double leastTriangle(const std::vector<Vec2d>& p) {
  double least = kInf;
  double extent = 0;
  for (std::size_t leave = 0; leave < 4; ++leave) {
    const Vec2d& a = p[(leave + 1) % 4];
    const Vec2d u = p[(leave + 2) % 4] - a;
    const Vec2d v = p[(leave + 3) % 4] - a;
    least = std::fmin(least, std::fabs(u[0] * v[1] - u[1] * v[0]));
    extent = std::fmax(extent, u.squaredNorm());
  }
  return least / extent;
}

}  // namespace solver_test

#endif  // GSLAM_ESTIMATOR_TESTS_CLOSED_FORM_HELPERS_H
