#ifndef GSLAM_GEOMETRY_DETAIL_SYMMETRIC_EIGEN_H
#define GSLAM_GEOMETRY_DETAIL_SYMMETRIC_EIGEN_H

#include <gslam/geometry/mat.h>
#include <gslam/geometry/vec.h>

#include <cmath>
#include <cstddef>
#include <limits>

/// @file
/// Eigenvalues and eigenvectors of small symmetric matrices.

namespace gslam {
inline namespace v1 {
namespace detail {

/// Jacobi's method: rotations in the planes of two axes make the largest elements beside the
/// diagonal zero until none is left that counts. Slow and sure: it always converges, quadratically
/// at the end, and the eigenvectors are orthogonal to the last bits. (G. Golub, C. Van Loan,
/// "Matrix Computations", section 8.5)
template <class T, std::size_t N>
struct SymmetricEigen {
  Vec<T, N> values;      // from the largest to the smallest
  Mat<T, N, N> vectors;  // in its columns

  /// Only the upper triangle of `m` is used; its elements must be finite, and their squares, too.
  explicit SymmetricEigen(Mat<T, N, N> m) noexcept : vectors(Mat<T, N, N>::identity()) {
    for (int sweep = 0; sweep < kMostSweeps && !isDiagonal(m); ++sweep) {
      for (std::size_t p = 0; p + 1 < N; ++p) {
        for (std::size_t q = p + 1; q < N; ++q) annihilate(m, p, q);
      }
    }
    for (std::size_t i = 0; i < N; ++i) values[i] = m(i, i);
    sort();
  }

 private:
  static constexpr int kMostSweeps = 30;  // 6 to 8 are usual

  static bool isDiagonal(const Mat<T, N, N>& m) noexcept {
    T beside = 0;
    T on = 0;
    for (std::size_t p = 0; p < N; ++p) {
      on += m(p, p) * m(p, p);
      for (std::size_t q = p + 1; q < N; ++q) beside += m(p, q) * m(p, q);
    }
    const T small = T(0.01) * std::numeric_limits<T>::epsilon();
    return beside <= small * small * on;
  }

  void annihilate(Mat<T, N, N>& m, std::size_t p, std::size_t q) noexcept {
    if (m(p, q) == 0) return;
    const T ratio = (m(q, q) - m(p, p)) / (2 * m(p, q));
    const T tangent = std::copysign(T(1), ratio) / (std::fabs(ratio) + std::hypot(T(1), ratio));
    const T cosine = 1 / std::sqrt(1 + tangent * tangent);
    const T sine = tangent * cosine;
    m(p, p) -= tangent * m(p, q);
    m(q, q) += tangent * m(p, q);
    m(p, q) = 0;
    const auto turn = [cosine, sine](T& a, T& b) {
      const T old = a;
      a = cosine * old - sine * b;
      b = sine * old + cosine * b;
    };
    for (std::size_t i = 0; i < p; ++i) turn(m(i, p), m(i, q));
    for (std::size_t i = p + 1; i < q; ++i) turn(m(p, i), m(i, q));
    for (std::size_t i = q + 1; i < N; ++i) turn(m(p, i), m(q, i));
    for (std::size_t i = 0; i < N; ++i) turn(vectors(i, p), vectors(i, q));
  }

  void sort() noexcept {
    for (std::size_t i = 0; i + 1 < N; ++i) {
      std::size_t largest = i;
      for (std::size_t j = i + 1; j < N; ++j) {
        if (values[j] > values[largest]) largest = j;
      }
      swap(values[i], values[largest]);
      for (std::size_t r = 0; r < N; ++r) swap(vectors(r, i), vectors(r, largest));
    }
  }
  static void swap(T& a, T& b) noexcept {
    const T old = a;
    a = b;
    b = old;
  }
};

}  // namespace detail
}  // namespace v1
}  // namespace gslam

#endif  // GSLAM_GEOMETRY_DETAIL_SYMMETRIC_EIGEN_H
