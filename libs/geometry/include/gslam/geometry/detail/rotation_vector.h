#ifndef GSLAM_GEOMETRY_DETAIL_ROTATION_VECTOR_H
#define GSLAM_GEOMETRY_DETAIL_ROTATION_VECTOR_H

#include <gslam/base/error.h>
#include <gslam/geometry/vec.h>

#include <cmath>
#include <cstddef>
#include <limits>
#include <type_traits>

/// @file
/// Rotation vector to unit quaternion and back, to the last bits at every angle.

namespace gslam {
inline namespace v1 {
namespace detail {

// exp for an angle up to sqrt(10) = 3.16, that is, all of the ball of radius pi.
//
// The quaternion of the rotation vector a, with t = |a| and h = (t/2)^2, is
//     vector part  a sin(t/2) / t = a/2 S(h),   S(h) = sum of (-h)^k / (2k+1)!
//     scalar part  cos(t/2)       =     C(h),   C(h) = sum of (-h)^k / (2k)!
// S and C are entire functions of h: no square root, no quotient, nothing that changes at small
// angles, where h may underflow to 0 and S = 1 is then exact. The terms alternate and shrink from
// k = 1 on (h <= 2.5), so what is left out is less than the first term left out:
//     12 terms (double)  S: 2.5^12 / 25! < 4e-21    C: 2.5^12 / 24! < 1e-19
//      8 terms (float)   S: 2.5^8  / 17! < 5e-12    C: 2.5^8  / 16! < 8e-11
template <class T>
Vec<T, 4> quaternionOfNearVector(const Vec<T, 3>& a, T squared_norm) noexcept {
  static const T inverse_factorial[] = {
      T(1.0 / 1),  // 0!
      T(1.0 / 1),  // 1!
      T(1.0 / 2),  // 2!, and so on
      T(1.0 / 6),
      T(1.0 / 24),
      T(1.0 / 120),
      T(1.0 / 720),
      T(1.0 / 5040),
      T(1.0 / 40320),
      T(1.0 / 362880),
      T(1.0 / 3628800),
      T(1.0 / 39916800),
      T(1.0 / 479001600),
      T(1.0 / 6227020800.0),
      T(1.0 / 87178291200.0),
      T(1.0 / 1307674368000.0),
      T(1.0 / 20922789888000.0),
      T(1.0 / 355687428096000.0),
      T(1.0 / 6402373705728000.0),
      T(1.0 / 121645100408832000.0),
      T(1.0 / 2432902008176640000.0),
      T(1.0 / 51090942171709440000.0),
      T(1.0 / 1124000727777607680000.0),
      T(1.0 / 25852016738884976640000.0)  // 23!
  };
  constexpr std::size_t terms = std::is_same<T, float>::value ? 8 : 12;
  const T minus_h = T(-0.25) * squared_norm;
  T sine = inverse_factorial[2 * terms - 1];
  T cosine = inverse_factorial[2 * terms - 2];
  for (std::size_t k = terms - 1; k-- > 0;) {
    sine = sine * minus_h + inverse_factorial[2 * k + 1];
    cosine = cosine * minus_h + inverse_factorial[2 * k];
  }
  const T half_sine = T(0.5) * sine;
  return {{half_sine * a[0], half_sine * a[1], half_sine * a[2], cosine}};
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
Vec<T, 4> quaternionOfFarVector(const Vec<T, 3>& a) {
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
  const T squared_norm = a.squaredNorm();
  return squared_norm <= T(10) ? quaternionOfNearVector(a, squared_norm) : quaternionOfFarVector(a);
}

// log: the rotation vector, of norm 0 to pi, of a unit quaternion (x y z w).
//
// With v = (x, y, z) the half angle is atan2(|v|, w), which is accurate at every angle (acos(w) is
// not near 0, asin(|v|) is not near pi), and the axis is v / |v|. q and -q are the same rotation;
// the one with w >= 0 has the half angle in [0, pi/2]. Where |v| < epsilon,
//     atan2(|v|, w) / |v| = (1 / w) (1 - |v|^2 / (3 w^2) + ...) = 1 / w,
// with a relative error below epsilon^2, and |v|^2, which may underflow, is not needed.
// A norm of q that is off by a rounding cancels in both cases.
template <class T>
Vec<T, 3> vectorOfQuaternion(const Vec<T, 4>& q) noexcept {
  const Vec<T, 3> v = {{q[0], q[1], q[2]}};
  const T squared = v.squaredNorm();
  constexpr T epsilon = std::numeric_limits<T>::epsilon();
  if (squared < epsilon * epsilon) return v * (2 / q[3]);
  const T norm = std::sqrt(squared);
  const T angle = 2 * std::atan2(norm, std::fabs(q[3]));
  return v * ((q[3] < 0 ? -angle : angle) / norm);
}

}  // namespace detail
}  // namespace v1
}  // namespace gslam

#endif  // GSLAM_GEOMETRY_DETAIL_ROTATION_VECTOR_H
