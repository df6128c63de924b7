#ifndef GSLAM_GEOMETRY_DETAIL_ARCTANGENT_H
#define GSLAM_GEOMETRY_DETAIL_ARCTANGENT_H

#include <gslam/geometry/detail/pair.h>

/// @file
/// The arctangent as a function of the square, of which log of all groups is made.

namespace gslam {
inline namespace v1 {
namespace detail {

/// Coefficients of (p, q) with 1 + x p / q = atan(sqrt(x)) / sqrt(x) for 0 <= x <= 1, to 1.1e-17,
/// highest power first. They and their error bounds come from tools/polynomials.py. (The argument
/// only says for which type.)
inline auto arctangentTable(double) noexcept -> const double (&)[7][2] {
  static constexpr double coefficients[][2] = {{-2.2297678139686485e-06, 0.002445452808893491},
                                               {-0.002104387312970023, 0.06453295925870225},
                                               {-0.0432511382841561, 0.5368820963772862},
                                               {-0.2725778671008127, 1.9680296155712274},
                                               {-0.7123414383945195, 3.5294070829658954},
                                               {-0.8116412201960678, 3.034923660588189},
                                               {-0.3333333333333333, 1.0}};
  return coefficients;
}
/// The same for float, to 5e-8.
inline auto arctangentTable(float) noexcept -> const float (&)[3][2] {
  static constexpr float coefficients[][2] = {
      {-0.00310535752f, 0.282365322f}, {-0.189529672f, 1.16853595f}, {-0.333332986f, 1.0f}};
  return coefficients;
}
/// (p, q). The function that they make is analytic but for x <= -1, far from the interval: no
/// branch, and exact at small x.
template <class T>
Pair<T> arctangentQuotient(T x) noexcept {
  return polynomials(arctangentTable(x), x);
}

}  // namespace detail
}  // namespace v1
}  // namespace gslam

#endif  // GSLAM_GEOMETRY_DETAIL_ARCTANGENT_H
