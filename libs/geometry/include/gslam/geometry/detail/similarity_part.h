#ifndef GSLAM_GEOMETRY_DETAIL_SIMILARITY_PART_H
#define GSLAM_GEOMETRY_DETAIL_SIMILARITY_PART_H

#include <gslam/base/platform.h>
#include <gslam/geometry/detail/exponential.h>
#include <gslam/geometry/detail/stumpff.h>
#include <gslam/geometry/detail/translation_part.h>
#include <gslam/geometry/vec.h>

#include <cmath>
#include <cstddef>

/// @file
/// The translation of exp of SIM3, and its derivatives.

namespace gslam {
inline namespace v1 {
namespace detail {

/// W = a I + b hat(v) + c hat(v)^2, the integral of e^(s u) exp(u hat(v)) over u from 0 to 1, with
/// which exp of SIM3 has the translation W r:
///     a = m0,    b = integral of e^(s u) sin(t u) / t,    c = integral of e^(s u) (1 - cos(t u)) /
///     t^2
/// with t = |v|. The closed forms divide by s^2 + t^2, where everything cancels. Taking out of the
/// numerators what belongs to s alone leaves means, with the weights s^2 and t^2, of positive
/// numbers:
///     b = (s^2 m1 + t^2 e^s (c2 - s c3)) / (s^2 + t^2)
///     c = (s^2 m2 + t^2 e^s (c3 - s c4)) / (s^2 + t^2)
/// where m_n are those of ExponentialIntegrals and c_n Stumpff's functions of t^2. At s = t = 0
/// both terms are the same, whatever the weights.
template <class T>
struct SimilarityPart {
  T a, b, c;

  static GSLAM_ALWAYS_INLINE SimilarityPart at(T s, T x, const ExponentialIntegrals<T>& m, T c2,
                                               T c3, T c4) noexcept {
    const T sum = s * s + x;
    const T weight = sum > 0 ? x / sum : T(0);
    const T rotating = weight * m.e;
    const T scaling = 1 - weight;
    return {m.m0, scaling * m.m1 + rotating * (c2 - s * c3),
            scaling * m.m2 + rotating * (c3 - s * c4)};
  }
  static GSLAM_ALWAYS_INLINE SimilarityPart at(T s, T x,
                                               const ExponentialIntegrals<T>& m) noexcept {
    const Stumpff<T> c = Stumpff<T>::at(x);
    return at(s, x, m, c.c2, c.c3, c.c4);
  }

  /// W r.
  GSLAM_ALWAYS_INLINE Vec<T, 3> operator()(const Vec<T, 3>& v, const Vec<T, 3>& r) const noexcept {
    return mixed(a, b, c, v, r);
  }

  /// W^-1 t. In the plane across v, W is the complex number (a - c x) + i b |v|, along v it is a;
  /// what inverts both is again of the form of W.
  GSLAM_ALWAYS_INLINE Vec<T, 3> solve(const Vec<T, 3>& v, const Vec<T, 3>& t, T x) const noexcept {
    const T inverse = 1 / a;  // first, so that scales near the ends of T's range do not overflow
    const T bb = b * inverse;
    const T cc = c * inverse;
    const T across = 1 - cc * x;
    const T factor = 1 / (across * across + bb * bb * x);
    return inverse * mixed(-bb * factor, (bb * bb - cc * across) * factor, v, t);
  }
};

/// The derivatives of a, b and c by s, and twice those of b and c by x = |v|^2. They are integrals
/// of entire functions over u from 0 to 1,
///     da/ds: u e   db/ds: u^2 e c1   dc/ds: u^3 e c2   2 db/dx: u^3 e (c3 - c2)   2 dc/dx: u^4 e
///     (2 c4 - c3)
/// with e = e^(s u) and c_n at u^2 x. Their closed forms divide by the square of s^2 + x; Gauss'
/// rule with 10 points gives all digits where neither s nor the angle is above 3, and as many
/// pieces of [0, 1] as that takes are summed.
template <class T>
struct SimilarityDerivatives {
  T a_s, b_s, c_s, b_x, c_x;

  static SimilarityDerivatives at(T s, T x) noexcept {
    const T size = std::fmax(std::fabs(s), std::sqrt(x)) / T(3.2);
    const int pieces =
        size <= 1 ? 1 : (size < kMostPieces ? static_cast<int>(size) + 1 : kMostPieces);
    SimilarityDerivatives sum = {0, 0, 0, 0, 0};
    for (int i = 0; i < pieces; ++i) sum.addPiece(s, x, T(i), 1 / static_cast<T>(pieces));
    return sum;
  }

 private:
  static constexpr int kMostPieces =
      1000;  // an angle of 3200 radians, beyond which digits are lost

  void addPiece(T s, T x, T first, T width) noexcept {
    static constexpr double points[5][2] = {{0.9739065285171717, 0.06667134430868814},
                                            {0.8650633666889845, 0.1494513491505806},
                                            {0.6794095682990244, 0.21908636251598204},
                                            {0.4333953941292472, 0.26926671930999635},
                                            {0.14887433898163122, 0.29552422471475287}};
    for (std::size_t i = 0; i < 5; ++i) {
      const T half = static_cast<T>(points[i][0]) / 2;
      const T weight = width * static_cast<T>(points[i][1]) / 2;
      addPoint(s, x, width * (first + (T(0.5) - half)), weight);
      addPoint(s, x, width * (first + (T(0.5) + half)), weight);
    }
  }

  void addPoint(T s, T x, T u, T weight) noexcept {
    const Stumpff<T> c = Stumpff<T>::at(u * u * x);
    const T c1 = 1 - u * u * x * c.c3;
    const T u1 = weight * std::exp(s * u) * u;
    const T u2 = u1 * u;
    const T u3 = u2 * u;
    a_s += u1;
    b_s += u2 * c1;
    c_s += u3 * c.c2;
    b_x += u3 * (c.c3 - c.c2);
    c_x += u3 * u * (2 * c.c4 - c.c3);
  }
};

}  // namespace detail
}  // namespace v1
}  // namespace gslam

#endif  // GSLAM_GEOMETRY_DETAIL_SIMILARITY_PART_H
