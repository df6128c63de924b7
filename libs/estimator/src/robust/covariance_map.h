// From the covariance of a problem's delta to that of what callers know.
#ifndef GSLAM_ESTIMATOR_ROBUST_COVARIANCE_MAP_H
#define GSLAM_ESTIMATOR_ROBUST_COVARIANCE_MAP_H

#include <gslam/geometry/mat.h>

#include <array>
#include <cstddef>

#include "robust/problem.h"

namespace gslam {
inline namespace v1 {
namespace detail {

// D C D^T.
template <std::size_t R, std::size_t C>
Mat<double, R, R> mappedCovariance(const Mat<double, R, C>& by_delta,
                                   const std::array<double, kMaxDof * kMaxDof>& covariance) {
  Mat<double, C, C> inner;
  for (std::size_t r = 0; r < C; ++r) {
    for (std::size_t c = 0; c < C; ++c) inner(r, c) = covariance[r * kMaxDof + c];
  }
  return by_delta * inner * by_delta.transpose();
}

}  // namespace detail
}  // namespace v1
}  // namespace gslam

#endif  // GSLAM_ESTIMATOR_ROBUST_COVARIANCE_MAP_H
