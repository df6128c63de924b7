#include "solve.h"

#include <ceres/iteration_callback.h>
#include <ceres/ordered_groups.h>
#include <ceres/types.h>
#include <gslam/base/error.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <memory>
#include <thread>

#include "silence.h"

namespace gslam {
inline namespace v1 {
namespace detail {
namespace by_ceres {
namespace {

// Up to these sizes dense and sparse factorisations are the faster ones, as measured: streets of
// cameras and rings of poses (see the README).
constexpr std::size_t kMostDenseSchur = 800;
constexpr std::size_t kMostSparseSchur = 10000;
constexpr std::size_t kMostDense = 30;

constexpr double kLeastRadius = 1e-32;
constexpr double kLeastTolerance = 1e-15;  // Ceres wants more than 0
constexpr unsigned kMostThreads = 64;      // or as many as the machine has

class ProgressCallback : public ceres::IterationCallback {
 public:
  ProgressCallback(const OptimizerOptions& options, const SearchPlan& plan, SearchResult& result)
      : options_(options), plan_(plan), result_(result) {}

  ceres::CallbackReturnType operator()(const ceres::IterationSummary& step) override {
    std::vector<OptimizerIteration>& iterations = result_.summary.iterations;
    OptimizerIteration iteration;
    iteration.number = static_cast<std::size_t>(step.iteration);
    iteration.is_successful = step.iteration == 0 || step.step_is_successful;
    const bool is_new = iterations.empty() || iteration.is_successful;
    iteration.cost = is_new ? step.cost + plan_.constant_cost : iterations.back().cost;
    iteration.cost_change = step.cost_change;
    iteration.gradient_max = step.gradient_max_norm;
    iteration.step_norm = step.step_norm;
    iteration.damping = 1 / step.trust_region_radius;
    iteration.linear_iterations =
        is_iterative ? static_cast<std::size_t>(std::max(step.linear_solver_iterations, 0)) : 0;
    iteration.seconds = secondsSince(plan_.start);
    iterations.push_back(iteration);
    return isToContinue(iteration) ? ceres::SOLVER_CONTINUE : ceres::SOLVER_TERMINATE_SUCCESSFULLY;
  }

  bool is_iterative = false;

 private:
  // Exceptions must not pass through Ceres, which would leave its threads and state behind.
  bool isToContinue(const OptimizerIteration& iteration) {
    if (!options_.progress) return true;
    try {
      return options_.progress(iteration);
    } catch (...) {
      result_.thrown = std::current_exception();
      return false;
    }
  }

  const OptimizerOptions& options_;
  const SearchPlan& plan_;
  SearchResult& result_;
};

ceres::LinearSolverType solverWithPoints(const OptimizerOptions& options, std::size_t size) {
  switch (options.linear_solver) {
    case LinearSolverKind::Dense:
      return ceres::DENSE_SCHUR;
    case LinearSolverKind::Sparse:
      return ceres::SPARSE_SCHUR;
    case LinearSolverKind::Iterative:
      return ceres::ITERATIVE_SCHUR;
    case LinearSolverKind::Automatic:
      break;
  }
  if (options.schur == SchurKind::Implicit) return ceres::ITERATIVE_SCHUR;
  if (size <= kMostDenseSchur) return ceres::DENSE_SCHUR;
  return size <= kMostSparseSchur ? ceres::SPARSE_SCHUR : ceres::ITERATIVE_SCHUR;
}

ceres::LinearSolverType solverWithoutPoints(const OptimizerOptions& options, std::size_t size) {
  switch (options.linear_solver) {
    case LinearSolverKind::Dense:
      return ceres::DENSE_NORMAL_CHOLESKY;
    case LinearSolverKind::Sparse:
      return ceres::SPARSE_NORMAL_CHOLESKY;
    case LinearSolverKind::Iterative:
      return ceres::CGNR;
    case LinearSolverKind::Automatic:
      break;
  }
  return size <= kMostDense ? ceres::DENSE_NORMAL_CHOLESKY : ceres::SPARSE_NORMAL_CHOLESKY;
}

std::string nameOfSolver(const ceres::Solver::Options& to) {
  const bool is_block_jacobi = to.preconditioner_type == ceres::JACOBI;
  switch (to.linear_solver_type) {
    case ceres::DENSE_SCHUR:
      return "explicit Schur, double, dense Cholesky";
    case ceres::SPARSE_SCHUR:
      return "explicit Schur, double, sparse Cholesky";
    case ceres::ITERATIVE_SCHUR:
      return std::string(to.use_explicit_schur_complement ? "explicit" : "implicit") +
             " Schur, double, PCG " + (is_block_jacobi ? "block Jacobi" : "Schur-Jacobi");
    case ceres::DENSE_NORMAL_CHOLESKY:
      return "double, dense Cholesky";
    case ceres::SPARSE_NORMAL_CHOLESKY:
      return "double, sparse Cholesky";
    default:
      return "double, PCG block Jacobi";
  }
}

void setLinearSolver(const OptimizerOptions& from, const SearchPlan& plan,
                     ceres::Solver::Options& to) {
  const bool has_points = !plan.eliminated.empty();
  to.linear_solver_type = has_points ? solverWithPoints(from, plan.reduced_size)
                                     : solverWithoutPoints(from, plan.reduced_size);
  const bool is_block_jacobi =
      !has_points || from.preconditioner == PreconditionerKind::BlockJacobi;
  to.preconditioner_type = is_block_jacobi ? ceres::JACOBI : ceres::SCHUR_JACOBI;
  to.use_explicit_schur_complement =
      to.linear_solver_type == ceres::ITERATIVE_SCHUR && from.schur == SchurKind::Explicit;
  to.max_linear_solver_iterations = static_cast<int>(
      std::min<std::size_t>(from.max_linear_iterations, std::numeric_limits<int>::max()));
  to.eta = std::max(from.linear_tolerance, kLeastTolerance);
}

void setLimits(const OptimizerOptions& from, ceres::Solver::Options& to) {
  to.max_num_iterations =
      static_cast<int>(std::min<std::size_t>(from.max_iterations, std::numeric_limits<int>::max()));
  to.function_tolerance = from.function_tolerance;
  to.gradient_tolerance = from.gradient_tolerance;
  to.parameter_tolerance = from.parameter_tolerance;
  if (from.max_seconds > 0) to.max_solver_time_in_seconds = from.max_seconds;
  if (from.initial_damping > 0) {
    to.initial_trust_region_radius =
        std::min(std::max(1 / from.initial_damping, 10 * kLeastRadius), to.max_trust_region_radius);
  }
  to.min_trust_region_radius = kLeastRadius;
  // Steps that cannot be evaluated make the region smaller, until that ends the search.
  to.max_num_consecutive_invalid_steps = 100;
  const unsigned there = std::max(std::thread::hardware_concurrency(), 1U);
  const unsigned wanted = from.threads == 0 ? there : from.threads;
  to.num_threads = static_cast<int>(std::min(wanted, std::max(there, kMostThreads)));
  to.minimizer_progress_to_stdout = false;
  to.logging_type = ceres::SILENT;
}

void setOrdering(const SearchPlan& plan, const ceres::Problem& problem,
                 ceres::Solver::Options& to) {
  if (plan.eliminated.empty()) return;
  const auto ordering = std::make_shared<ceres::ParameterBlockOrdering>();
  std::vector<double*> blocks;
  problem.GetParameterBlocks(&blocks);
  std::vector<double*> first = plan.eliminated;
  std::sort(first.begin(), first.end());
  for (double* const block : blocks) {
    const bool is_first = std::binary_search(first.begin(), first.end(), block);
    ordering->AddElementToGroup(block, is_first ? 0 : 1);
  }
  to.linear_solver_ordering = ordering;
}

// Where residuals have no value at the start, Ceres says -1.
double initialCost(const ceres::Solver::Summary& from) {
  const bool has_value = !from.iterations.empty() && std::isfinite(from.initial_cost);
  return has_value ? from.initial_cost : std::numeric_limits<double>::infinity();
}

OptimizerStatus statusOf(const ceres::Solver::Summary& from, const OptimizerOptions& options) {
  const std::size_t tried = from.iterations.empty() ? 0 : from.iterations.size() - 1;
  if (!std::isfinite(initialCost(from))) return OptimizerStatus::Failed;
  switch (from.termination_type) {
    case ceres::CONVERGENCE: {
      const bool is_small =
          !from.iterations.empty() && from.iterations.back().trust_region_radius <= kLeastRadius;
      return is_small ? OptimizerStatus::Stalled : OptimizerStatus::Converged;
    }
    case ceres::NO_CONVERGENCE:
      return tried >= options.max_iterations ? OptimizerStatus::MaxIterations
                                             : OptimizerStatus::MaxTime;
    case ceres::USER_SUCCESS:
      return OptimizerStatus::Cancelled;
    default:
      return tried > 0 ? OptimizerStatus::Stalled : OptimizerStatus::Failed;
  }
}

std::string messageOf(OptimizerStatus status, const ceres::Solver::Summary& from) {
  switch (status) {
    case OptimizerStatus::MaxIterations:
      return "The last iteration that was allowed reached no tolerance; more of them may.";
    case OptimizerStatus::MaxTime:
      return "The time was over before a tolerance was reached.";
    case OptimizerStatus::Cancelled:
      return "The progress function ended the search.";
    case OptimizerStatus::Stalled:
      return "No step lowers the cost, however short: " + from.message;
    case OptimizerStatus::Failed:
      return "The search could not begin: " + from.message;
    case OptimizerStatus::Converged:
      break;
  }
  return from.message;
}

void fillSummary(const ceres::Solver::Summary& from, const OptimizerOptions& options,
                 const SearchPlan& plan, OptimizerSummary& to) {
  to.status = statusOf(from, options);
  to.message = messageOf(to.status, from);
  to.is_usable = from.IsSolutionUsable() && std::isfinite(from.final_cost) &&
                 from.final_cost <= from.initial_cost;
  to.initial_cost = initialCost(from) + plan.constant_cost;
  to.final_cost = to.is_usable ? from.final_cost + plan.constant_cost : to.initial_cost;
  // Ceres says -1 of what it did not come to.
  to.times.linearize = std::max(from.jacobian_evaluation_time_in_seconds, 0.0);
  to.times.solve = std::max(from.linear_solver_time_in_seconds, 0.0);
  to.times.evaluate = std::max(from.residual_evaluation_time_in_seconds, 0.0);
}

// No residual depends on a variable.
void searchNothing(const SearchPlan& plan, ProgressCallback& callback, OptimizerSummary& summary) {
  summary.initial_cost = summary.final_cost = plan.constant_cost;
  summary.linear_solver = "none";
  summary.times.setup = secondsSince(plan.start);
  if (!std::isfinite(plan.constant_cost)) {
    summary.message = "The cost has no finite value.";
    return;
  }
  summary.is_usable = true;
  ceres::IterationSummary start;
  start.trust_region_radius = std::numeric_limits<double>::infinity();
  if (callback(start) == ceres::SOLVER_CONTINUE) {
    summary.status = OptimizerStatus::Converged;
    summary.message = "No residual depends on a variable.";
  } else {
    summary.status = OptimizerStatus::Cancelled;
    summary.message = "The progress function ended the search.";
  }
}

}  // namespace

ceres::Problem::Options problemOptions(ceres::EvaluationCallback* callback) {
  ceres::Problem::Options options;
  options.cost_function_ownership = ceres::DO_NOT_TAKE_OWNERSHIP;
  options.loss_function_ownership = ceres::DO_NOT_TAKE_OWNERSHIP;
  options.manifold_ownership = ceres::DO_NOT_TAKE_OWNERSHIP;
  options.disable_all_safety_checks = true;
  options.evaluation_callback = callback;
  return options;
}

void checkSolverOptions(const OptimizerOptions& options, bool has_points) {
  if (options.preconditioner == PreconditionerKind::PowerSeries) {
    throw ArgumentError("options.preconditioner", "is PowerSeries, which ceres does not have");
  }
  if (options.precision == PrecisionKind::Mixed) {
    throw ArgumentError("options.precision", "is Mixed, but ceres computes in double throughout");
  }
  const bool is_direct = options.linear_solver == LinearSolverKind::Dense ||
                         options.linear_solver == LinearSolverKind::Sparse;
  if (is_direct && has_points && options.schur == SchurKind::Implicit) {
    throw ArgumentError("options.schur",
                        "is Implicit, but ceres forms the reduced matrix to factor it");
  }
  const bool is_block_jacobi = options.preconditioner == PreconditionerKind::BlockJacobi;
  if (!is_direct && has_points && is_block_jacobi && options.schur == SchurKind::Explicit) {
    throw ArgumentError("options.preconditioner",
                        "is BlockJacobi, but ceres has only SchurJacobi for an explicit Schur "
                        "complement");
  }
  const bool is_schur_jacobi = options.preconditioner == PreconditionerKind::SchurJacobi;
  if (options.linear_solver == LinearSolverKind::Iterative && !has_points && is_schur_jacobi) {
    throw ArgumentError("options.preconditioner",
                        "is SchurJacobi, but there are no points to eliminate");
  }
}

SearchResult search(ceres::Problem& problem, const SearchPlan& plan,
                    const OptimizerOptions& options) {
  SearchResult result;
  OptimizerSummary& summary = result.summary;
  summary.backend = "ceres";
  ProgressCallback callback(options, plan, result);
  if (problem.NumResidualBlocks() == 0) {
    searchNothing(plan, callback, summary);
    return result;
  }
  ceres::Solver::Options to;
  setLinearSolver(options, plan, to);
  setLimits(options, to);
  setOrdering(plan, problem, to);
  summary.linear_solver = nameOfSolver(to);
  callback.is_iterative =
      to.linear_solver_type == ceres::ITERATIVE_SCHUR || to.linear_solver_type == ceres::CGNR;
  to.callbacks.push_back(&callback);

  ceres::Solver::Summary from;
  const double before = secondsSince(plan.start);
  {
    const SilentGlog silence;
    ceres::Solve(to, &problem, &from);
  }
  fillSummary(from, options, plan, summary);
  summary.times.setup = before + std::max(from.preprocessor_time_in_seconds, 0.0);
  summary.times.total = secondsSince(plan.start);
  return result;
}

}  // namespace by_ceres
}  // namespace detail
}  // namespace v1
}  // namespace gslam
