#ifndef GSLAM_OPTIMIZER_PBA_SRC_BUNDLE_FAST_SOLVE_H
#define GSLAM_OPTIMIZER_PBA_SRC_BUNDLE_FAST_SOLVE_H

#include <gslam/optimizer/options.h>

#include <cstddef>
#include <memory>
#include <vector>

#include "bundle/fast_schur.h"

// The reduced system: A step = right side.

namespace gslam {
inline namespace v1 {
namespace detail {
namespace pba {

// Cholesky's method in double. It keeps its memory and the order of elimination.
template <class T>
class FastDirect {
 public:
  explicit FastDirect(bool is_dense);
  ~FastDirect();
  // False where the matrix is not positive definite.
  bool solve(const FastSchur<T>& schur, std::vector<double>& step);

 private:
  struct Memory;
  std::unique_ptr<Memory> memory_;
};

// Preconditioned conjugate gradients. The matrix is multiplied in T, the rest is double.
template <class T>
class FastGradients {
 public:
  explicit FastGradients(PreconditionerKind kind) : kind_(kind) {}
  // False where there is no step; else `iterations` is how many were made.
  bool solve(FastSchur<T>& schur, const OptimizerOptions& options, std::vector<double>& step,
             std::size_t& iterations);

 private:
  bool prepare(const FastSchur<T>& schur);
  void precondition(FastSchur<T>& schur, const std::vector<double>& r, std::vector<double>& z);
  void applyInverses(const FastSchur<T>& schur, const std::vector<double>& r,
                     std::vector<double>& z) const;

  PreconditionerKind kind_;
  std::vector<double> inverses_;  // of diagonal blocks, freedom x freedom
  std::vector<double> r_, z_, p_, q_, term_, product_;
};

}  // namespace pba
}  // namespace detail
}  // namespace v1
}  // namespace gslam

#endif  // GSLAM_OPTIMIZER_PBA_SRC_BUNDLE_FAST_SOLVE_H
