#ifndef GSLAM_GEOMETRY_DETAIL_TRANSLATION_PART_H
#define GSLAM_GEOMETRY_DETAIL_TRANSLATION_PART_H

#include <gslam/base/error.h>
#include <gslam/geometry/detail/stumpff.h>
#include <gslam/geometry/mat.h>
#include <gslam/geometry/vec.h>

#include <limits>

/// @file
/// What a rotation does to the translation of exp, in SE3 and SIM3.

namespace gslam {
inline namespace v1 {
namespace detail {

/// The matrix a I + b hat(v) + c hat(v)^2 times r.
template <class T>
Vec<T, 3> mixed(T a, T b, T c, const Vec<T, 3>& v, const Vec<T, 3>& r) noexcept {
  const Vec<T, 3> once = v.cross(r);
  return a * r + b * once + c * v.cross(once);
}
/// The same with a = 1.
template <class T>
Vec<T, 3> mixed(T b, T c, const Vec<T, 3>& v, const Vec<T, 3>& r) noexcept {
  const Vec<T, 3> once = v.cross(r);
  return r + b * once + c * v.cross(once);
}

/// The block Q of the left Jacobian: how the translation part of a perturbation from the left
/// answers to one of the rotation vector v.
///
/// exp's translation is t = W r with W = a I + b hat(v) + c hat(v)^2, where b and c are functions
/// of |v|^2. exp(xi + d) = exp(J d) exp(xi) moves it by Q d + (J_rotation d) x t, so that
///     Q = dt/dv + hat(t) J_rotation,    J_rotation = c1 I + c2 hat(v) + c3 v v^T.
/// It is what T. Barfoot, "State Estimation for Robotics", gives for SE3 as (7.86).
/// @param db, dc  twice the derivatives of b and c by |v|^2
template <class T>
Mat<T, 3, 3> leftTranslationBlock(const Vec<T, 3>& v, const Vec<T, 3>& r, const Vec<T, 3>& t, T b,
                                  T c, T db, T dc, const Stumpff<T>& s) noexcept {
  const T x = v.squaredNorm();
  const Vec<T, 3> once = v.cross(r);
  const Vec<T, 3> twice = v.cross(once);
  // All that stands before v^T, and before r^T and t^T.
  const Vec<T, 3> w = db * once + dc * twice + s.c3 * t.cross(v) - (2 * c) * r;
  const Vec<T, 3> y = c * r + s.c2 * t;
  const T one = c * v.dot(r) - s.c2 * v.dot(t);
  const Vec<T, 3> skew = (1 - x * s.c3) * t - b * r;
  Mat<T, 3, 3> q;
  for (std::size_t i = 0; i < 3; ++i) {
    for (std::size_t j = 0; j < 3; ++j) q(i, j) = w[i] * v[j] + v[i] * y[j];
    q(i, i) += one;
  }
  q(0, 1) -= skew[2];
  q(0, 2) += skew[1];
  q(1, 0) += skew[2];
  q(1, 2) -= skew[0];
  q(2, 0) -= skew[1];
  q(2, 1) += skew[0];
  return q;
}

/// For what exp of SE3 and SIM3 need beside the rotation.
template <class T>
void checkAngle(T squared_norm) {
  if (squared_norm <= std::numeric_limits<T>::max()) return;
  throw ArgumentError("rotation vector",
                      "has an element that is not finite, or is too long to be an angle");
}

}  // namespace detail
}  // namespace v1
}  // namespace gslam

#endif  // GSLAM_GEOMETRY_DETAIL_TRANSLATION_PART_H
