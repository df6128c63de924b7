#ifndef GSLAM_GEOMETRY_DETAIL_EXPONENTIAL_H
#define GSLAM_GEOMETRY_DETAIL_EXPONENTIAL_H

#include <gslam/base/platform.h>
#include <gslam/geometry/detail/pair.h>

#include <cmath>

/// @file
/// What the scale of a similarity contributes to its exp and log.

namespace gslam {
inline namespace v1 {
namespace detail {

/// (e^s - 1 - s - s^2/2) / s^3 for |s| <= 1, to 3e-16: sum of s^k / (k + 3)!
/// The even and the odd powers are the pair. Coefficients from tools/polynomials.py.
inline double exponentialTail(double s) noexcept {
  static constexpr double even_odd[][2] = {{7.731971528284342e-13, 0.0},
                                           {1.6058088057453566e-10, 1.1615012001988682e-11},
                                           {2.505211334544827e-08, 2.087513077486537e-09},
                                           {2.755731921235583e-06, 2.755732766402235e-07},
                                           {0.00019841269841279813, 2.480158728179637e-05},
                                           {0.008333333333333331, 0.0013888888888905857},
                                           {0.16666666666666666, 0.041666666666666644}};
  const Pair<double> sum = polynomials(even_odd, s * s);
  return sum.first() + s * sum.second();
}
/// The same to 8e-8.
inline float exponentialTail(float s) noexcept {
  static constexpr float even_odd[][2] = {{2.79358233e-06f, 0.0f},
                                          {0.000198398469f, 2.52184891e-05f},
                                          {0.00833333377f, 0.00138873223f},
                                          {0.166666672f, 0.0416666754f}};
  const Pair<float> sum = polynomials(even_odd, s * s);
  return sum.first() + s * sum.second();
}

/// e^s and the integrals m_n = integral of u^n / n! e^(s u) over u from 0 to 1.
///
/// From parts, s m_n = e^s / n! - m_(n-1), with m_(-1) = 1. For |s| <= 1 this is written out in the
/// tail above, with the divisions done on paper, so that nothing cancels; beyond, it is used as it
/// stands. For s so large that e^s overflows it is infinite, as are all.
template <class T>
struct ExponentialIntegrals {
  T e, m0, m1, m2;

  static GSLAM_ALWAYS_INLINE ExponentialIntegrals at(T s) noexcept {
    return std::fabs(s) <= 1 ? near(s) : far(s);
  }

  /// For |s| <= 1.
  static GSLAM_ALWAYS_INLINE ExponentialIntegrals near(T s) noexcept {
    const T tail = exponentialTail(s);
    const T square = s * s;
    const T m0 = 1 + s * (T(0.5) + s * tail);
    return {1 + s * m0, m0, T(0.5) + s * (T(0.5) - tail) + square * tail,
            tail + s * (T(0.25) - tail) + T(0.5) * square * tail};
  }

 private:
  GSLAM_COLD static ExponentialIntegrals far(T s) noexcept {
    const T e = std::exp(s);
    const T m0 = (e - 1) / s;
    const T m1 = (e - m0) / s;
    return {e, m0, m1, (T(0.5) * e - m1) / s};
  }
};

}  // namespace detail
}  // namespace v1
}  // namespace gslam

#endif  // GSLAM_GEOMETRY_DETAIL_EXPONENTIAL_H
