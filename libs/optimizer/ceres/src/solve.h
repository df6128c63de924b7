#ifndef GSLAM_OPTIMIZER_CERES_SRC_SOLVE_H
#define GSLAM_OPTIMIZER_CERES_SRC_SOLVE_H

#include <ceres/problem.h>
#include <ceres/solver.h>
#include <gslam/optimizer/options.h>
#include <gslam/optimizer/summary.h>

#include <chrono>
#include <cstddef>
#include <exception>
#include <string>
#include <vector>

// Ceres' options from ours, its summary to ours.

namespace gslam {
inline namespace v1 {
namespace detail {
namespace by_ceres {

using Clock = std::chrono::steady_clock;

inline double secondsSince(Clock::time_point start) {
  return std::chrono::duration<double>(Clock::now() - start).count();
}

// Nothing is owned by the problem: cost functions and the like lie in arrays of the callers. Their
// inputs were checked.
ceres::Problem::Options problemOptions(ceres::EvaluationCallback* callback = nullptr);

// What a search is about besides the problem itself.
struct SearchPlan {
  std::vector<double*> eliminated;  // blocks that no residual has two of, to be eliminated first
  std::size_t reduced_size = 0;     // degrees of freedom of all others
  double constant_cost = 0;         // what is added to all costs: that of residuals that are fixed
  Clock::time_point start;          // when the caller was called
};

// Throws ArgumentError, with what this back end cannot do. has_points: something is eliminated.
void checkSolverOptions(const OptimizerOptions& options, bool has_points);

struct SearchResult {
  // status, message, backend, linear_solver, is_usable, costs, iterations and times.
  OptimizerSummary summary;
  std::exception_ptr thrown;  // by progress(); to be thrown again once all is put in place
};

// Runs Ceres. Where the summary is usable, also where progress() has thrown, the blocks hold the
// result. Else they may hold anything.
SearchResult search(ceres::Problem& problem, const SearchPlan& plan,
                    const OptimizerOptions& options);

}  // namespace by_ceres
}  // namespace detail
}  // namespace v1
}  // namespace gslam

#endif  // GSLAM_OPTIMIZER_CERES_SRC_SOLVE_H
