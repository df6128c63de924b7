// Small systems of linear equations.
#ifndef GSLAM_ESTIMATOR_MATH_SOLVE_LINEAR_H
#define GSLAM_ESTIMATOR_MATH_SOLVE_LINEAR_H

#include <cmath>
#include <cstddef>
#include <utility>

namespace gslam {
inline namespace v1 {
namespace detail {

// Solves N equations, rows (a0 a1 ... | b) that are overwritten, by elimination with the choice of
// a row. False where a pivot is zero or not finite.
template <std::size_t N>
bool solveLinear(double (&m)[N][N + 1], double (&x)[N]) noexcept {
  for (std::size_t c = 0; c < N; ++c) {
    std::size_t pivot = c;
    for (std::size_t r = c + 1; r < N; ++r) {
      if (std::fabs(m[r][c]) > std::fabs(m[pivot][c])) pivot = r;
    }
    if (!(std::fabs(m[pivot][c]) > 1e-300)) return false;
    if (pivot != c) {
      for (std::size_t k = c; k <= N; ++k) std::swap(m[c][k], m[pivot][k]);
    }
    const double inverse = 1 / m[c][c];
    for (std::size_t r = c + 1; r < N; ++r) {
      const double factor = m[r][c] * inverse;
      for (std::size_t k = c + 1; k <= N; ++k) m[r][k] -= factor * m[c][k];
    }
  }
  for (std::size_t c = N; c-- > 0;) {
    double sum = m[c][N];
    for (std::size_t k = c + 1; k < N; ++k) sum -= m[c][k] * x[k];
    x[c] = sum / m[c][c];
  }
  return true;
}

}  // namespace detail
}  // namespace v1
}  // namespace gslam

#endif  // GSLAM_ESTIMATOR_MATH_SOLVE_LINEAR_H
