#ifndef GSLAM_GEOMETRY_DETAIL_STUMPFF_H
#define GSLAM_GEOMETRY_DETAIL_STUMPFF_H

#include <gslam/base/platform.h>
#include <gslam/geometry/detail/pair.h>

#include <cmath>

/// @file
/// Stumpff's functions, of which exp of all groups and their Jacobians are made:
///
///     c_n(x) = sum of (-x)^k / (2k + n)!,  k = 0, 1, ...
///     c0 = cos t   c1 = sin t / t   c2 = (1 - cos t) / t^2   c3 = (t - sin t) / t^3   with x = t^2
///     c_n = 1 / n! - x c_(n+2)
///
/// They are entire functions of the squared angle: as polynomials they have no 0 / 0, no quotient
/// and no branch at small angles, where x may underflow to 0 and the constant alone is exact.
/// Source: K. Stumpff, "Himmelsmechanik" I, 1959; J. Danby, "Fundamentals of Celestial Mechanics",
/// section 6.9. The coefficients and their error bounds come from tools/polynomials.py.

namespace gslam {
inline namespace v1 {
namespace detail {

/// The polynomials below hold up to this squared angle, a little more than half a turn.
template <class T>
constexpr T nearSquare() noexcept {
  return T(10);
}

/// Coefficients of (c1, c0) for 0 <= h <= 2.5, to 4e-17, highest power first. (The argument of the
/// tables only says for which type; batch_formulas.h reads them, too.)
inline auto stumpff10Table(double) noexcept -> const double (&)[9][2] {
  static constexpr double coefficients[][2] = {{2.730402537561207e-15, 4.625701609891324e-14},
                                               {-7.643886158204389e-13, -1.146453049361302e-11},
                                               {1.605897465969838e-10, 2.0876625841954573e-09},
                                               {-2.505210757580932e-08, -2.755731768929377e-07},
                                               {2.7557319218837673e-06, 2.4801587291829438e-05},
                                               {-0.0001984126984125376, -0.001388888888885841},
                                               {0.008333333333333314, 0.041666666666666304},
                                               {-0.16666666666666666, -0.5},
                                               {1.0, 1.0}};
  return coefficients;
}
/// The same for float, to 1.2e-8.
inline auto stumpff10Table(float) noexcept -> const float (&)[6][2] {
  static constexpr float coefficients[][2] = {{-2.40675959e-08f, -2.62812421e-07f},
                                              {2.75359162e-06f, 2.47738717e-05f},
                                              {-0.000198410795f, -0.00138886424f},
                                              {0.00833333284f, 0.0416666605f},
                                              {-0.166666672f, -0.5f},
                                              {1.0f, 1.0f}};
  return coefficients;
}
/// (c1, c0): sine and cosine of half an angle below sqrt(10), where h is the square of the half
/// angle.
template <class T>
Pair<T> stumpff10(T h) noexcept {
  return polynomials(stumpff10Table(h), h);
}

/// Coefficients of c3 for 0 <= x <= 10, to 9e-17 of its value at 0, those of the even and of the
/// odd powers.
inline auto stumpff3Table(double) noexcept -> const double (&)[5][2] {
  static constexpr double even_odd[][2] = {{8.189835826603783e-18, -1.790628581579503e-20},
                                           {7.647145584959563e-13, -2.8111480432339206e-15},
                                           {2.505210837327857e-08, -1.6059043210264797e-10},
                                           {0.00019841269841269397, -2.7557319223867537e-06},
                                           {0.16666666666666666, -0.008333333333333333}};
  return even_odd;
}
/// The same for float, to 6e-8.
inline auto stumpff3Table(float) noexcept -> const float (&)[3][2] {
  static constexpr float even_odd[][2] = {{2.48974441e-08f, -1.42570997e-10f},
                                          {0.000198412017f, -2.75518437e-06f},
                                          {0.166666672f, -0.00833333284f}};
  return even_odd;
}
/// c3.
template <class T>
T stumpff3(T x) noexcept {
  const Pair<T> sum = polynomials(stumpff3Table(x), x * x);
  return sum.first() + x * sum.second();
}

/// (c5, c4) for 0 <= x <= 10, to 8e-17 of their value at 0.
inline Pair<double> stumpff54(double x) noexcept {
  static constexpr double coefficients[][2] = {{-3.588642229836847e-23, -8.200036777964598e-22},
                                               {1.9521174819221613e-20, 4.0974272176313653e-19},
                                               {-8.220114995418031e-18, -1.5617912117854694e-16},
                                               {2.8114541992741533e-15, 4.779469730789189e-14},
                                               {-7.647163626297648e-13, -1.147074533521693e-11},
                                               {1.6059043834772653e-10, 2.0876756982771373e-09},
                                               {-2.505210838542178e-08, -2.7557319223936294e-07},
                                               {2.7557319223985816e-06, 2.4801587301587115e-05},
                                               {-0.0001984126984126984, -0.001388888888888889},
                                               {0.008333333333333333, 0.041666666666666664}};
  return polynomials(coefficients, x);
}
/// The same for float, to 6e-8.
inline Pair<float> stumpff54(float x) noexcept {
  static constexpr float coefficients[][2] = {
      {-6.9766507e-13f, -1.03371391e-11f}, {1.60012628e-10f, 2.07792472e-09f},
      {-2.5050058e-08f, -2.75538639e-07f}, {2.75572938e-06f, 2.4801544e-05f},
      {-0.000198412701f, -0.00138888892f}, {0.00833333377f, 0.0416666679f}};
  return polynomials(coefficients, x);
}

/// c2 to c5 at one x.
template <class T>
struct Stumpff {
  T c2, c3, c4, c5;

  /// For a rotation of any angle; x >= 0.
  static GSLAM_ALWAYS_INLINE Stumpff at(T x) noexcept {
    return x <= nearSquare<T>() ? near(x) : far(x);
  }

 private:
  static GSLAM_ALWAYS_INLINE Stumpff near(T x) noexcept {
    const Pair<T> c54 = stumpff54(x);
    const T c4 = c54.second();
    const T c5 = c54.first();
    return {T(0.5) - x * c4, T(1.0 / 6) - x * c5, c4, c5};
  }
  // The recurrence the other way: from 3 radians on nothing cancels.
  GSLAM_COLD static Stumpff far(T x) noexcept {
    const T angle = std::sqrt(x);
    const T c2 = (1 - std::cos(angle)) / x;
    const T c3 = (1 - std::sin(angle) / angle) / x;
    return {c2, c3, (T(0.5) - c2) / x, (T(1.0 / 6) - c3) / x};
  }
};

}  // namespace detail
}  // namespace v1
}  // namespace gslam

#endif  // GSLAM_GEOMETRY_DETAIL_STUMPFF_H
