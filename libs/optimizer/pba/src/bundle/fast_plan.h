#ifndef GSLAM_OPTIMIZER_PBA_SRC_BUNDLE_FAST_PLAN_H
#define GSLAM_OPTIMIZER_PBA_SRC_BUNDLE_FAST_PLAN_H

#include <gslam/optimizer/options.h>

#include <cstddef>
#include <string>

#include "bundle/fast_pattern.h"
#include "bundle/fast_structure.h"

// How the equations of a bundle are solved.

namespace gslam {
inline namespace v1 {
namespace detail {
namespace pba {

struct FastPlan {
  LinearSolverKind linear_solver = LinearSolverKind::Iterative;
  PreconditionerKind preconditioner = PreconditionerKind::SchurJacobi;
  bool is_explicit = true;
  bool is_mixed = true;
  unsigned threads = 1;
};

// Threads for a bundle with so many observations.
unsigned fastThreads(std::size_t observations, const OptimizerOptions& options);
// `pattern`: that of the structure.
FastPlan makeFastPlan(const FastStructure& structure, const FastPattern& pattern,
                      const OptimizerOptions& options, unsigned threads);
std::string nameOf(const FastPlan& plan);

}  // namespace pba
}  // namespace detail
}  // namespace v1
}  // namespace gslam

#endif  // GSLAM_OPTIMIZER_PBA_SRC_BUNDLE_FAST_PLAN_H
