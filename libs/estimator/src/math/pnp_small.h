// Arithmetic of three numbers and of small symmetric systems, on plain arrays.
#ifndef GSLAM_ESTIMATOR_MATH_PNP_SMALL_H
#define GSLAM_ESTIMATOR_MATH_PNP_SMALL_H

namespace gslam {
inline namespace v1 {
namespace detail {
namespace pnp {

inline double dot3(const double* a, const double* b) noexcept {
  return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}

inline void cross3(const double* a, const double* b, double* c) noexcept {
  c[0] = a[1] * b[2] - a[2] * b[1];
  c[1] = a[2] * b[0] - a[0] * b[2];
  c[2] = a[0] * b[1] - a[1] * b[0];
}

// Solves the symmetric system m x = b of N unknowns for K right sides, in rows of N. A pivot that
// is not above `least` counts as infinite, which leaves its unknown at zero. Gives false where
// there was such a one.
template <int N, int K>
bool solveSymmetric(const double (&m)[N][N], double least, double (&b)[K][N]) noexcept {
  double l[N][N];
  double inverse[N];
  bool is_regular = true;
  for (int j = 0; j < N; ++j) {
    double pivot = m[j][j];
    for (int k = 0; k < j; ++k) pivot -= l[j][k] * l[k][j];
    is_regular = is_regular && pivot > least;
    inverse[j] = pivot > least ? 1 / pivot : 0;
    for (int i = j + 1; i < N; ++i) {
      double value = m[i][j];
      for (int k = 0; k < j; ++k) value -= l[i][k] * l[k][j];
      l[j][i] = value;  // times the pivot
      l[i][j] = value * inverse[j];
    }
  }
  for (int c = 0; c < K; ++c) {
    double* const x = b[c];
    for (int i = 1; i < N; ++i) {
      for (int k = 0; k < i; ++k) x[i] -= l[i][k] * x[k];
    }
    for (int i = N - 1; i >= 0; --i) {
      x[i] *= inverse[i];
      for (int k = i + 1; k < N; ++k) x[i] -= l[k][i] * x[k];
    }
  }
  return is_regular;
}

}  // namespace pnp
}  // namespace detail
}  // namespace v1
}  // namespace gslam

#endif  // GSLAM_ESTIMATOR_MATH_PNP_SMALL_H
