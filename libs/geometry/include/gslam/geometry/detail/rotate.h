#ifndef GSLAM_GEOMETRY_DETAIL_ROTATE_H
#define GSLAM_GEOMETRY_DETAIL_ROTATE_H

#include <gslam/base/platform.h>
#include <gslam/geometry/detail/pair.h>
#include <gslam/geometry/vec.h>

/// @file
/// Turning vectors by unit quaternions: v + 2 w (u x v) + 2 u x (u x v) with u = (x, y, z).
///
/// Written out, because a pose times a point is so little work that a call of a small function that
/// was not inlined, or a vector that went through memory, shows.

namespace gslam {
inline namespace v1 {
namespace detail {

/// The vector v turned by the quaternion q, x y z w. Each coordinate alone: of this compilers make
/// loops over many points that use the full width of registers.
template <class T>
GSLAM_ALWAYS_INLINE Vec<T, 3> rotated(const T* q, const Vec<T, 3>& v) noexcept {
  const T tx = q[1] * v[2] - q[2] * v[1];
  const T ty = q[2] * v[0] - q[0] * v[2];
  const T tz = q[0] * v[1] - q[1] * v[0];
  const T dx = tx + tx, dy = ty + ty, dz = tz + tz;
  return {{multiplyAdd(q[3], dx, v[0]) + (q[1] * dz - q[2] * dy),
           multiplyAdd(q[3], dy, v[1]) + (q[2] * dx - q[0] * dz),
           multiplyAdd(q[3], dz, v[2]) + (q[0] * dy - q[1] * dx)}};
}

/// The opposite of v turned back, with the signs put where they cost nothing: what the translation
/// of a pose becomes in its inverse.
template <class T>
GSLAM_ALWAYS_INLINE Vec<T, 3> oppositeRotatedBack(const T* q, const Vec<T, 3>& v) noexcept {
  const T tx = q[2] * v[1] - q[1] * v[2];
  const T ty = q[0] * v[2] - q[2] * v[0];
  const T tz = q[1] * v[0] - q[0] * v[1];
  const T dx = tx + tx, dy = ty + ty, dz = tz + tz;
  return {{(q[1] * dz - q[2] * dy) - multiplyAdd(q[3], dx, v[0]),
           (q[2] * dx - q[0] * dz) - multiplyAdd(q[3], dy, v[1]),
           (q[0] * dy - q[1] * dx) - multiplyAdd(q[3], dz, v[2])}};
}

}  // namespace detail
}  // namespace v1
}  // namespace gslam

#endif  // GSLAM_GEOMETRY_DETAIL_ROTATE_H
