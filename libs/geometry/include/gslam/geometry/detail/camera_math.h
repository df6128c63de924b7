// What the camera models share: checks, derivatives of common shapes, a safe Newton iteration.
#ifndef GSLAM_GEOMETRY_DETAIL_CAMERA_MATH_H
#define GSLAM_GEOMETRY_DETAIL_CAMERA_MATH_H

#include <gslam/base/error.h>
#include <gslam/geometry/mat.h>
#include <gslam/geometry/vec.h>

#include <cmath>
#include <cstddef>
#include <limits>
#include <sstream>
#include <string>

namespace gslam {
inline namespace v1 {
namespace detail {

// Derivatives of a projection to the plane of unit focal length: by the point, and by the K
// parameters of the projection.
template <class T, std::size_t K>
struct ProjectionJacobians {
  Mat<T, 2, 3> point;
  T parameters[2][K == 0 ? 1 : K];

  bool isFinite() const noexcept {
    bool all = true;
    for (const T value : point.values) all = all && std::isfinite(value);
    for (const T(&row)[K == 0 ? 1 : K] : parameters) {
      for (std::size_t i = 0; i < K; ++i) all = all && std::isfinite(row[i]);
    }
    return all;
  }
};

template <class T>
bool isFinite(const Vec<T, 2>& v) noexcept {
  return std::fabs(v[0]) <= std::numeric_limits<T>::max() &&
         std::fabs(v[1]) <= std::numeric_limits<T>::max();
}

// A camera whose pinhole is alpha / (1 - alpha) behind the centre of the unit sphere sees points of
// the sphere with z > -this: those whose rays to the pinhole do not touch it, or reach the plane.
template <class T>
T unifiedLimit(T alpha) noexcept {
  return alpha > T(0.5) ? (1 - alpha) / alpha : alpha / (1 - alpha);
}

// m = (x, y) / n, where n has the given gradient by the point.
template <class T>
void setQuotientJacobian(const Vec<T, 2>& m, T n, const Vec<T, 3>& gradient,
                         Mat<T, 2, 3>& jacobian) noexcept {
  const T inverse = T(1) / n;
  for (std::size_t row = 0; row < 2; ++row) {
    for (std::size_t c = 0; c < 3; ++c) jacobian(row, c) = -m[row] * inverse * gradient[c];
    jacobian(row, row) += inverse;
  }
}

// m = phi(r, z) (x, y) / r with r = |(x, y)|; scale is phi / r, or its limit where r is 0. The
// difference is divided by nothing, so that nothing is lost beside the axis.
template <class T>
void setRadialJacobian(const Vec<T, 3>& point, T r, T scale, T phi_by_r, T phi_by_z,
                       Mat<T, 2, 3>& jacobian) noexcept {
  const Vec<T, 2> direction =
      r > 0 ? Vec<T, 2>{{point[0] / r, point[1] / r}} : Vec<T, 2>{{T(0), T(0)}};
  for (std::size_t row = 0; row < 2; ++row) {
    for (std::size_t c = 0; c < 2; ++c) {
      jacobian(row, c) = (phi_by_r - scale) * direction[row] * direction[c];
    }
    jacobian(row, row) += scale;
    jacobian(row, 2) = phi_by_z * direction[row];
  }
}

// How a bearing b changes with pixel and parameters. project() does not change along b, so of all
// right inverses of its Jacobian J the shortest, J^T (J J^T)^-1, is the one that keeps |b| = 1; and
// project(b(pixel, parameters), parameters) = pixel holds for all parameters.
template <class Camera, class T, std::size_t N>
bool unprojectJacobians(const Camera& camera, const Vec<T, 3>& bearing, Mat<T, 3, 2>* by_pixel,
                        Mat<T, 3, N>* by_parameters) noexcept {
  Vec<T, 2> pixel{};
  Mat<T, 2, 3> j;
  Mat<T, 2, N> k;
  if (!camera.project(bearing, pixel, &j, &k)) return false;
  const Mat<T, 3, 2> transposed = j.transpose();
  const Mat<T, 2, 2> s = j * transposed;
  const T determinant = s(0, 0) * s(1, 1) - s(0, 1) * s(1, 0);
  if (!isSafeSquare(determinant)) return false;
  const Mat<T, 2, 2> inverse = {{s(1, 1) / determinant, -s(0, 1) / determinant,
                                 -s(1, 0) / determinant, s(0, 0) / determinant}};
  const Mat<T, 3, 2> result = transposed * inverse;
  if (by_pixel != nullptr) *by_pixel = result;
  if (by_parameters != nullptr) {
    *by_parameters = result * k;
    for (T& value : by_parameters->values) value = -value;
  }
  return true;
}

// The root between low and high of f, which is negative below it and positive above it. Newton's
// steps, and halving where they would leave what is known to hold the root.
// @param f  called as f(x, slope): value and slope at x
template <class T, class Function>
bool solveBracketed(const Function& f, T low, T high, T start, T& root) noexcept {
  T x = start > low && start < high ? start : (low + high) / 2;
  for (int i = 0; i < 200; ++i) {
    T slope;
    const T value = f(x, slope);
    if (value < 0) {
      low = x;
    } else {
      high = x;
    }
    T next = x - value / slope;
    const bool is_there = std::fabs(next - x) <= 2 * std::numeric_limits<T>::epsilon() * x;
    if (!(next >= low && next <= high)) next = (low + high) / 2;
    if (is_there || next == x) {
      root = next;
      return true;
    }
    x = next;
  }
  return false;
}

template <class T>
std::string cameraText(T value) {
  std::ostringstream out;
  out.precision(std::numeric_limits<T>::digits10);
  out << value;
  return out.str();
}

template <class T>
void checkParameter(bool is_right, const char* name, T value, const char* expected) {
  if (is_right) return;
  throw ArgumentError(name, "is " + cameraText(value) + ", expected " + expected);
}

template <class T>
void checkFinite(const char* name, T value) {
  checkParameter(std::fabs(value) <= std::numeric_limits<T>::max(), name, value, "a finite number");
}

}  // namespace detail
}  // namespace v1
}  // namespace gslam

#endif  // GSLAM_GEOMETRY_DETAIL_CAMERA_MATH_H
