// Two directions beside a third.
#ifndef GSLAM_ESTIMATOR_MATH_TANGENTS_H
#define GSLAM_ESTIMATOR_MATH_TANGENTS_H

#include <gslam/geometry/vec.h>

#include <cmath>

namespace gslam {
inline namespace v1 {
namespace detail {

// Two unit vectors at right angles to a unit vector and to each other, u x v = n (T. Duff et al.,
// "Building an orthonormal basis, revisited", JCGT 6(1), 2017).
inline void tangentsOf(const Vec3d& n, Vec3d& u, Vec3d& v) noexcept {
  const double sign = std::copysign(1.0, n[2]);
  const double a = -1 / (sign + n[2]);
  const double b = n[0] * n[1] * a;
  u = {{1 + sign * n[0] * n[0] * a, sign * b, -sign * n[0]}};
  v = {{b, sign + n[1] * n[1] * a, -n[1]}};
}

}  // namespace detail
}  // namespace v1
}  // namespace gslam

#endif  // GSLAM_ESTIMATOR_MATH_TANGENTS_H
