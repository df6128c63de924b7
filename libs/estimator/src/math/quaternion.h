// Quaternions on plain numbers, where SO3d's checks would cost as much as the rest of a solver.
#ifndef GSLAM_ESTIMATOR_MATH_QUATERNION_H
#define GSLAM_ESTIMATOR_MATH_QUATERNION_H

#include <gslam/base/platform.h>
#include <gslam/geometry/se3.h>
#include <gslam/geometry/vec.h>

#include <cmath>
#include <cstddef>
#include <cstring>
#include <type_traits>

namespace gslam {
inline namespace v1 {
namespace detail {

using Quaternion = double[4];  // x y z w

// c = a b, which must be another one.
inline void multiply(const Quaternion& a, const Quaternion& b, Quaternion& c) noexcept {
  c[0] = a[3] * b[0] + b[3] * a[0] + a[1] * b[2] - a[2] * b[1];
  c[1] = a[3] * b[1] + b[3] * a[1] + a[2] * b[0] - a[0] * b[2];
  c[2] = a[3] * b[2] + b[3] * a[2] + a[0] * b[1] - a[1] * b[0];
  c[3] = a[3] * b[3] - a[0] * b[0] - a[1] * b[1] - a[2] * b[2];
}

// To length 1. False where it has none.
inline bool normalize(Quaternion& q) noexcept {
  const double squared = (q[0] * q[0] + q[1] * q[1]) + (q[2] * q[2] + q[3] * q[3]);
  if (!(squared > 1e-200 && squared < 1e200)) return false;
  const double scale = 1 / std::sqrt(squared);
  for (double& value : q) value *= scale;
  return true;
}

// Turns q by the vector w, on its left: exp(w) q to the second order. Leaves it at length 1; false
// where w is not finite.
inline bool turnBy(const Vec3d& w, Quaternion& q) noexcept {
  const Quaternion step = {0.5 * w[0], 0.5 * w[1], 0.5 * w[2], 1};
  Quaternion next;
  multiply(step, q, next);
  if (!normalize(next)) return false;
  for (std::size_t i = 0; i < 4; ++i) q[i] = next[i];
  return true;
}

// A pose of a quaternion that is normalised already. SO3d::fromQuaternion() would check and
// normalise it anew, which costs as much as a third of a solver; the layout of SE3d is documented.
inline SE3d poseOf(const Quaternion& unit_q, const Vec3d& t) {
  static_assert(sizeof(SE3d) == 7 * sizeof(double), "SE3d is qx qy qz qw tx ty tz");
  static_assert(std::is_trivially_copyable<SE3d>::value, "SE3d may be copied as bytes");
  const double numbers[7] = {unit_q[0], unit_q[1], unit_q[2], unit_q[3], t[0], t[1], t[2]};
  SE3d pose;
  std::memcpy(static_cast<void*>(&pose), numbers, sizeof(pose));
  return pose;
}

// R(q) v; T is a number or several side by side, and V Vec3d or T[3].
template <class T, class V>
void turn(const T (&q)[4], const V& v, T (&turned)[3]) {
  const T x = T(2) * (q[1] * v[2] - q[2] * v[1]);
  const T y = T(2) * (q[2] * v[0] - q[0] * v[2]);
  const T z = T(2) * (q[0] * v[1] - q[1] * v[0]);
  turned[0] = v[0] + (q[3] * x + (q[1] * z - q[2] * y));
  turned[1] = v[1] + (q[3] * y + (q[2] * x - q[0] * z));
  turned[2] = v[2] + (q[3] * z + (q[0] * y - q[1] * x));
}
inline Vec3d turned(const Quaternion& q, const Vec3d& v) {
  double result[3];
  turn(q, v, result);
  return {{result[0], result[1], result[2]}};
}

// v at length 1. False where it has no direction.
inline bool setUnit(const Vec3d& v, Vec3d& unit) noexcept {
  const double squared = v.squaredNorm();
  if (!(squared > 1e-280 && squared < 1e280)) return false;
  unit = v / std::sqrt(squared);
  return true;
}

// The shortest rotation that takes a unit vector to z; half a turn about x where it is opposite.
GSLAM_ALWAYS_INLINE void shortestToZ(const Vec3d& n, Quaternion& q) noexcept {
  // (n x z, 1 + n z); below, 1 + n_z would cancel.
  const double beside = n[0] * n[0] + n[1] * n[1];
  const double w = n[2] >= 0 ? 1 + n[2] : beside / (1 - n[2]);
  const double squared = beside + w * w;
  q[0] = 1;
  q[1] = q[2] = q[3] = 0;
  if (!(squared > 1e-280)) return;
  const double scale = 1 / std::sqrt(squared);
  q[0] = scale * n[1];
  q[1] = -scale * n[0];
  q[3] = scale * w;
}

}  // namespace detail
}  // namespace v1
}  // namespace gslam

#endif  // GSLAM_ESTIMATOR_MATH_QUATERNION_H
