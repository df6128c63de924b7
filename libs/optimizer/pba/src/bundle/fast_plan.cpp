#include "bundle/fast_plan.h"

#include <gslam/base/parallel.h>

#include <algorithm>

namespace gslam {
inline namespace v1 {
namespace detail {
namespace pba {
namespace {

constexpr std::size_t kObservationsOfThread = 6000;  // fewer are not worth a thread
// Measured with 20 to 600 cameras, in sequences and where all see each other alike: up to 270
// variables Cholesky's method takes less time in all than conjugate gradients, from 390 on more.
constexpr std::size_t kDenseSize = 300;

}  // namespace

unsigned fastThreads(std::size_t observations, const OptimizerOptions& options) {
  const std::size_t most = 1 + observations / kObservationsOfThread;
  const std::size_t wanted = options.threads != 0 ? options.threads : defaultThreadCount();
  return static_cast<unsigned>(std::min(most, wanted));
}

FastPlan makeFastPlan(const FastStructure& structure, const FastPattern& pattern,
                      const OptimizerOptions& options, unsigned threads) {
  FastPlan plan;
  plan.threads = threads;
  plan.is_mixed = options.precision != PrecisionKind::Double;
  plan.linear_solver = options.linear_solver;
  const std::size_t size = structure.blocks.size() * structure.freedom;
  if (plan.linear_solver == LinearSolverKind::Automatic) {
    const bool is_small = size <= kDenseSize && options.schur != SchurKind::Implicit;
    plan.linear_solver = is_small ? LinearSolverKind::Dense : LinearSolverKind::Iterative;
  }
  if (options.preconditioner != PreconditionerKind::Automatic) {
    plan.preconditioner = options.preconditioner;
  }
  // Direct solvers need the matrix.
  if (plan.linear_solver != LinearSolverKind::Iterative) return plan;
  plan.is_explicit = options.schur != SchurKind::Implicit;
  if (options.schur == SchurKind::Automatic) {
    plan.is_explicit = isWorthForming(plan.is_mixed ? sizesOf<float>(structure, pattern)
                                                    : sizesOf<double>(structure, pattern));
  }
  return plan;
}

std::string nameOf(const FastPlan& plan) {
  std::string name = plan.is_explicit ? "explicit Schur, " : "implicit Schur, ";
  name += plan.is_mixed ? "float" : "double";
  if (plan.linear_solver == LinearSolverKind::Dense) return name + ", dense Cholesky";
  if (plan.linear_solver == LinearSolverKind::Sparse) return name + ", sparse Cholesky";
  if (plan.preconditioner == PreconditionerKind::BlockJacobi) return name + ", PCG block Jacobi";
  if (plan.preconditioner == PreconditionerKind::PowerSeries) return name + ", PCG power series";
  return name + ", PCG Schur-Jacobi";
}

}  // namespace pba
}  // namespace detail
}  // namespace v1
}  // namespace gslam
