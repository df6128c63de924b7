// From normal equations by the elements of a matrix to those by its parameters.
#ifndef GSLAM_ESTIMATOR_ROBUST_PROJECT_SUMS_H
#define GSLAM_ESTIMATOR_ROBUST_PROJECT_SUMS_H

#include <gslam/geometry/mat.h>

#include <cstddef>

#include "robust/kernels.h"
#include "robust/problem.h"

namespace gslam {
inline namespace v1 {
namespace detail {

// Adds D^T H D, D^T g.
template <std::size_t size>
void projectSums(const EpipolarSums& from, const Mat<double, 9, size>& derivative,
                 NormalEquations& to) {
  double half[9][size] = {};
  for (std::size_t r = 0; r < 9; ++r) {
    for (std::size_t c = 0; c < 9; ++c) {
      const double h = r <= c ? from.hessian[r * 9 + c] : from.hessian[c * 9 + r];
      for (std::size_t k = 0; k < size; ++k) half[r][k] += h * derivative(c, k);
    }
  }
  for (std::size_t a = 0; a < size; ++a) {
    for (std::size_t r = 0; r < 9; ++r) {
      for (std::size_t b = a; b < size; ++b) {
        to.hessian[a * kMaxDof + b] += derivative(r, a) * half[r][b];
      }
      to.gradient[a] += derivative(r, a) * from.gradient[r];
    }
  }
  to.cost += from.cost;
}

}  // namespace detail
}  // namespace v1
}  // namespace gslam

#endif  // GSLAM_ESTIMATOR_ROBUST_PROJECT_SUMS_H
