#ifndef GSLAM_GEOMETRY_DETAIL_TRANSLATION_PART_H
#define GSLAM_GEOMETRY_DETAIL_TRANSLATION_PART_H

#include <gslam/base/error.h>
#include <gslam/base/platform.h>
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
GSLAM_ALWAYS_INLINE Vec<T, 3> mixed(T a, T b, T c, const Vec<T, 3>& v,
                                    const Vec<T, 3>& r) noexcept {
  const Vec<T, 3> once = v.cross(r);
  return a * r + b * once + c * v.cross(once);
}
/// The same with a = 1.
template <class T>
GSLAM_ALWAYS_INLINE Vec<T, 3> mixed(T b, T c, const Vec<T, 3>& v, const Vec<T, 3>& r) noexcept {
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
GSLAM_ALWAYS_INLINE Mat<T, 3, 3> leftTranslationBlock(const Vec<T, 3>& v, const Vec<T, 3>& r, T a,
                                                      T b, T c, T db, T dc,
                                                      const Stumpff<T>& s) noexcept {
  const Vec<T, 3> once = v.cross(r);
  const Vec<T, 3> twice = v.cross(once);
  const Vec<T, 3> t = a * r + b * once + c * twice;
  // All that stands before v^T, and before r^T and t^T.
  const Vec<T, 3> w = db * once + dc * twice + s.c3 * t.cross(v) - (2 * c) * r;
  const Vec<T, 3> y = c * r + s.c2 * t;
  const T one = c * v.dot(r) - s.c2 * v.dot(t);
  const Vec<T, 3> k = (1 - v.squaredNorm() * s.c3) * t - b * r;
  return {{one + w[0] * v[0] + v[0] * y[0], w[0] * v[1] + v[0] * y[1] - k[2],
           w[0] * v[2] + v[0] * y[2] + k[1],  //
           w[1] * v[0] + v[1] * y[0] + k[2], one + w[1] * v[1] + v[1] * y[1],
           w[1] * v[2] + v[1] * y[2] - k[0],  //
           w[2] * v[0] + v[2] * y[0] - k[1], w[2] * v[1] + v[2] * y[1] + k[0],
           one + w[2] * v[2] + v[2] * y[2]}};
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
