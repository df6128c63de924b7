#ifndef GSLAM_OPTIMIZER_CERES_SRC_BLOCK_COVARIANCE_H
#define GSLAM_OPTIMIZER_CERES_SRC_BLOCK_COVARIANCE_H

#include <ceres/problem.h>

#include <cstddef>
#include <string>
#include <vector>

// Blocks of the inverse of the normal equations.

namespace gslam {
inline namespace v1 {
namespace detail {
namespace by_ceres {

// ceres::Covariance is not used: it writes what it finds singular to glog, whatever it is told, and
// takes columns of small numbers for dependent ones. This takes Ceres' Jacobian, with the weights
// of the losses, scales its columns, and factors by Cholesky.
struct BlockCovariances {
  bool is_valid = false;
  std::string message;                      // why not
  std::vector<std::vector<double>> blocks;  // (tangent x tangent) row by row, as asked for
};

// free: blocks that are variables, all of them. wanted: some of these.
BlockCovariances blockCovariances(ceres::Problem& problem, const std::vector<double*>& free,
                                  const std::vector<double*>& wanted);

}  // namespace by_ceres
}  // namespace detail
}  // namespace v1
}  // namespace gslam

#endif  // GSLAM_OPTIMIZER_CERES_SRC_BLOCK_COVARIANCE_H
