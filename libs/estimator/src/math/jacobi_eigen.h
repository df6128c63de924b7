// Eigenvalues and eigenvectors of small symmetric matrices, as exactly as a first guess needs.
#ifndef GSLAM_ESTIMATOR_MATH_JACOBI_EIGEN_H
#define GSLAM_ESTIMATOR_MATH_JACOBI_EIGEN_H

#include <cmath>
#include <cstddef>

namespace gslam {
inline namespace v1 {
namespace detail {
namespace pnp {

// Cyclic Jacobi rotations of a positive semidefinite matrix, until no element beside the diagonal
// is above 1e-6 of the geometric mean of its two on the diagonal: the eigenvectors are then right
// to about 1e-6, those of small eigenvalues too, and the eigenvalues to 1e-12 of themselves. About
// half the price of the full digits.
template <std::size_t N>
struct JacobiEigen {
  double values[N];      // from the least to the greatest
  double vectors[N][N];  // in rows, of length 1

  // The matrix in rows, of which both triangles must be there; it is overwritten.
  explicit JacobiEigen(double (&m)[N][N]) noexcept {
    double rows[N][N];
    for (std::size_t i = 0; i < N; ++i) {
      for (std::size_t j = 0; j < N; ++j) rows[i][j] = i == j ? 1 : 0;
    }
    double trace = 0;
    for (std::size_t i = 0; i < N; ++i) trace += m[i][i];
    const double rounding = 1e-17 * trace;
    for (int sweep = 0; sweep < kMostSweeps; ++sweep) {
      bool is_done = true;
      for (std::size_t p = 0; p + 1 < N; ++p) {
        for (std::size_t q = p + 1; q < N; ++q) {
          const double small = std::fabs(m[p][p] * m[q][q]) * 1e-12 + rounding * rounding;
          if (!(m[p][q] * m[p][q] > small)) continue;
          annihilate(m, rows, p, q);
          is_done = false;
        }
      }
      if (is_done) break;
    }
    sort(m, rows);
  }

 private:
  static constexpr int kMostSweeps = 20;  // 4 to 6 are usual

  static void annihilate(double (&m)[N][N], double (&rows)[N][N], std::size_t p,
                         std::size_t q) noexcept {
    const double apq = m[p][q];
    const double difference = m[q][q] - m[p][p];
    const double root = std::sqrt(difference * difference + 4 * apq * apq);
    const double tangent = 2 * apq / (difference + std::copysign(root, difference));
    const double cosine = 1 / std::sqrt(1 + tangent * tangent);
    const double sine = tangent * cosine;
    const double app = m[p][p] - tangent * apq;
    const double aqq = m[q][q] + tangent * apq;
    // Rows only, which lie side by side; the columns are copied from them.
    for (std::size_t i = 0; i < N; ++i) {
      const double a = m[p][i], b = m[q][i];
      m[p][i] = cosine * a - sine * b;
      m[q][i] = sine * a + cosine * b;
      const double v = rows[p][i], w = rows[q][i];
      rows[p][i] = cosine * v - sine * w;
      rows[q][i] = sine * v + cosine * w;
    }
    m[p][p] = app;
    m[q][q] = aqq;
    m[p][q] = m[q][p] = 0;
    for (std::size_t i = 0; i < N; ++i) {
      m[i][p] = m[p][i];
      m[i][q] = m[q][i];
    }
  }

  void sort(const double (&m)[N][N], const double (&rows)[N][N]) noexcept {
    bool is_taken[N] = {};
    for (std::size_t k = 0; k < N; ++k) {
      std::size_t least = N;
      for (std::size_t i = 0; i < N; ++i) {
        if (!is_taken[i] && (least == N || m[i][i] < m[least][least])) least = i;
      }
      is_taken[least] = true;
      values[k] = m[least][least];
      for (std::size_t i = 0; i < N; ++i) vectors[k][i] = rows[least][i];
    }
  }
};

}  // namespace pnp
}  // namespace detail
}  // namespace v1
}  // namespace gslam

#endif  // GSLAM_ESTIMATOR_MATH_JACOBI_EIGEN_H
