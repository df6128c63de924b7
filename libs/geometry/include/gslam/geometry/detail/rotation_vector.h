#ifndef GSLAM_GEOMETRY_DETAIL_ROTATION_VECTOR_H
#define GSLAM_GEOMETRY_DETAIL_ROTATION_VECTOR_H

#include <gslam/base/error.h>
#include <gslam/base/platform.h>
#include <gslam/geometry/detail/arctangent.h>
#include <gslam/geometry/detail/pair.h>
#include <gslam/geometry/detail/stumpff.h>
#include <gslam/geometry/vec.h>

#include <cmath>
#include <cstddef>

/// @file
/// Rotation vector to unit quaternion and back, to the last bits at every angle.

namespace gslam {
inline namespace v1 {
namespace detail {

// exp for an angle up to sqrt(10) = 3.16, that is, all of the ball of radius pi.
//
// The quaternion of the rotation vector a, with t = |a| and h = (t/2)^2, is
//     vector part  a sin(t/2) / t = a/2 c1(h)
//     scalar part  cos(t/2)       =     c0(h)
template <class T>
GSLAM_ALWAYS_INLINE Vec<T, 4> quaternionOfNearVector(const Vec<T, 3>& a, Pair<T> c10) noexcept {
  const T half_sine = T(0.5) * c10.first();
  Vec<T, 4> q;  // filled in the pieces in which it will be copied
  (Pair<T>::both(half_sine) * Pair<T>(a[0], a[1])).store(q.values);
  Pair<T>(half_sine * a[2], c10.second()).store(q.values + 2);
  return q;
}

// exp for any angle; meant for the ones beyond sqrt(10), which are rare.
//
// Here a rounding of the angle would be multiplied by its size. So the norm is computed with twice
// the digits, as high + low: std::fma gives the rounding error of each square (a product is exactly
// p + fma(a, b, -p)), the rounding error of each sum follows from Knuth's two-sum, and one Newton
// step on the square root gathers them in `low`. The error of the half angle is then below
// t * epsilon^2 times a small number: nothing to see up to angles of 0.01 / epsilon.
// Scaling by a power of two keeps the squares in range and is exact.
template <class T>
GSLAM_COLD Vec<T, 4> quaternionOfFarVector(const Vec<T, 3>& a) {
  int exponent = 0;
  Vec<T, 3> scaled;
  T square = 0;
  T square_low = 0;
  (void)std::frexp(std::fmax(std::fabs(a[0]), std::fmax(std::fabs(a[1]), std::fabs(a[2]))),
                   &exponent);
  for (std::size_t i = 0; i < 3; ++i) {
    if (!std::isfinite(a[i])) {
      throw ArgumentError("rotation vector", "has an element that is not finite");
    }
    scaled[i] = std::ldexp(a[i], -exponent);
    const T term = scaled[i] * scaled[i];
    const T sum = square + term;
    const T term_in_sum = sum - square;
    square_low += (square - (sum - term_in_sum)) + (term - term_in_sum);
    square_low += std::fma(scaled[i], scaled[i], -term);
    square = sum;
  }
  const T root = std::sqrt(square);
  const T root_low = (std::fma(-root, root, square) + square_low) / (2 * root);
  const T half = std::ldexp(root, exponent - 1);
  const T half_low = std::ldexp(root_low, exponent - 1);
  const T sine = std::sin(half) * std::cos(half_low) + std::cos(half) * std::sin(half_low);
  const T cosine = std::cos(half) * std::cos(half_low) - std::sin(half) * std::sin(half_low);
  const T sine_over_root = sine / root;
  return {
      {sine_over_root * scaled[0], sine_over_root * scaled[1], sine_over_root * scaled[2], cosine}};
}

// exp: the unit quaternion (x y z w) of a rotation vector in radians.
template <class T>
Vec<T, 4> quaternionOfVector(const Vec<T, 3>& a) {
  const T squared = a.squaredNorm();
  return squared <= nearSquare<T>() ? quaternionOfNearVector(a, stumpff10(T(0.25) * squared))
                                    : quaternionOfFarVector(a);
}

// What log needs of a unit quaternion q = (v, w), of which q and -q are the same rotation.
//
// For w >= 0 a quarter of the angle t has the tangent |v| / (1 + w), at most 1, so with
// x = |v|^2 / (1 + w)^2 and A(x) = atan(sqrt(x)) / sqrt(x) the rotation vector is
//     t / |v| v = 4 A / (1 + w) v.
// Nothing in it is singular: not at 0, where |v|^2 may underflow, and not at half a turn. Without
// the square root and the branch of the usual atan2(|v|, w) / |v|.
//
// The inverse of SE3's V takes b to b - k v x b + d v x (v x b), where k = t / (2 |v|) and
//     d = (1 - t/2 cot(t/2)) / |v|^2,    t/2 cot(t/2) = A (1 - x),    A = 1 + x R,
// so d = (A - R) / (1 + w)^2: again nothing cancels.
template <class T>
struct RotationLog {
  Vec<T, 3> v;  // of the one of q and -q that has w >= 0
  T factor;     // the rotation vector is factor * v
  T d;

  static GSLAM_ALWAYS_INLINE RotationLog of(const Vec<T, 4>& q) noexcept {
    const T sign = std::copysign(T(1), q[3]);
    const Vec<T, 3> v = {{sign * q[0], sign * q[1], sign * q[2]}};
    const T inverse = 1 / (1 + std::fabs(q[3]));
    const T square = inverse * inverse;
    const T x = v.squaredNorm() * square;
    const Pair<T> quotient = arctangentQuotient(x);
    const T r = quotient.first() / quotient.second();
    const T a = 1 + x * r;
    return {v, 4 * a * inverse, (a - r) * square};
  }
};

// log: the rotation vector, of norm 0 to pi, of a unit quaternion (x y z w).
template <class T>
Vec<T, 3> vectorOfQuaternion(const Vec<T, 4>& q) noexcept {
  const RotationLog<T> log = RotationLog<T>::of(q);
  return log.factor * log.v;
}

}  // namespace detail
}  // namespace v1
}  // namespace gslam

#endif  // GSLAM_GEOMETRY_DETAIL_ROTATION_VECTOR_H
