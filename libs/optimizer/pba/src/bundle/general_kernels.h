#ifndef GSLAM_OPTIMIZER_PBA_SRC_BUNDLE_GENERAL_KERNELS_H
#define GSLAM_OPTIMIZER_PBA_SRC_BUNDLE_GENERAL_KERNELS_H

#include <gslam/geometry/mat.h>
#include <gslam/geometry/vec.h>

#include <algorithm>
#include <cstddef>

#include "bundle/general_structure.h"

// Products of small blocks. All are stored row by row.

namespace gslam {
inline namespace v1 {
namespace detail {
namespace pba {

// Place of the diagonal one among the pairs a <= b of n entries.
inline std::size_t pairRow(std::size_t a, std::size_t n) {
  return a * n - a * (a + 1) / 2 + a;
}

template <std::size_t M, std::size_t N>
inline void addProductOf(const double* a, const double* b, std::size_t rows, double weight,
                         double* sum) {
  double local[M * N];
  std::copy(sum, sum + M * N, local);
  for (std::size_t r = 0; r < rows; ++r) {
    for (std::size_t i = 0; i < M; ++i) {
      const double factor = weight * a[r * M + i];
      for (std::size_t j = 0; j < N; ++j) local[i * N + j] += factor * b[r * N + j];
    }
  }
  std::copy(local, local + M * N, sum);
}

// sum += weight A^T B, with A of m columns and B of n.
inline void addProduct(const double* a, std::size_t m, const double* b, std::size_t n,
                       std::size_t rows, double weight, double* sum) {
  if (m == 6 && n == 6) return addProductOf<6, 6>(a, b, rows, weight, sum);
  if (m == 6 && n == 3) return addProductOf<6, 3>(a, b, rows, weight, sum);
  if (m == 3 && n == 6) return addProductOf<3, 6>(a, b, rows, weight, sum);
  if (m == 3 && n == 3) return addProductOf<3, 3>(a, b, rows, weight, sum);
  if (m == 6 && n == 1) return addProductOf<6, 1>(a, b, rows, weight, sum);
  for (std::size_t r = 0; r < rows; ++r) {
    for (std::size_t i = 0; i < m; ++i) {
      const double factor = weight * a[r * m + i];
      for (std::size_t j = 0; j < n; ++j) sum[i * n + j] += factor * b[r * n + j];
    }
  }
}

// scaled = - V^-1 W
inline void multiplyPoint(const Mat3d& inverse, const double* coupling, std::size_t size,
                          double* scaled) {
  for (std::size_t r = 0; r < 3; ++r) {
    for (std::size_t c = 0; c < size; ++c) {
      scaled[r * size + c] = -(inverse(r, 0) * coupling[c] + inverse(r, 1) * coupling[size + c] +
                               inverse(r, 2) * coupling[2 * size + c]);
    }
  }
}

// right -= scaled^T h
inline void subtractFromRight(const double* scaled, const Vec3d& gradient, std::size_t size,
                              double* right) {
  for (std::size_t c = 0; c < size; ++c) {
    right[c] -= scaled[c] * gradient[0] + scaled[size + c] * gradient[1] +
                scaled[2 * size + c] * gradient[2];
  }
}

// sum += W x
inline void addRows(const double* coupling, std::size_t size, const double* x, Vec3d& sum) {
  for (std::size_t r = 0; r < 3; ++r) {
    for (std::size_t c = 0; c < size; ++c) sum[r] += coupling[r * size + c] * x[c];
  }
}

// y += A x, with A of some rows of blocks of the upper triangle, and of as many columns below it.
inline void addPatternProduct(const BundleBlocks& blocks, const GeneralPattern& pattern,
                              const double* values, std::size_t first_row, std::size_t last_row,
                              const double* x, double* y) {
  for (std::size_t row = first_row; row < last_row; ++row) {
    const std::size_t m = blocks.size(row), top = blocks.offset[row];
    for (std::size_t p = pattern.first[row]; p < pattern.first[row + 1]; ++p) {
      const std::size_t n = blocks.size(pattern.column[p]), left = blocks.offset[pattern.column[p]];
      const double* const block = values + pattern.offset[p];
      const bool is_diagonal = pattern.column[p] == row;
      for (std::size_t i = 0; i < m; ++i) {
        double sum = 0;
        for (std::size_t j = 0; j < n; ++j) {
          sum += block[i * n + j] * x[left + j];
          if (!is_diagonal) y[left + j] += block[i * n + j] * x[top + i];
        }
        y[top + i] += sum;
      }
    }
  }
}

}  // namespace pba
}  // namespace detail
}  // namespace v1
}  // namespace gslam

#endif  // GSLAM_OPTIMIZER_PBA_SRC_BUNDLE_GENERAL_KERNELS_H
