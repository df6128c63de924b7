#include <algorithm>
#include <cmath>
#include <limits>
#include <memory>
#include <utility>

#include "bundle/fast_plan.h"
#include "bundle/fast_schur.h"
#include "bundle/fast_solve.h"
#include "bundle/fast_state.h"
#include "bundle/fast_structure.h"
#include "bundle/fast_sweep.h"
#include "solvers.h"
#include "trust_region.h"

namespace gslam {
inline namespace v1 {
namespace detail {
namespace pba {
namespace {

constexpr double kFastDamping = 1e-4;
bool isDirect(const OptimizerOptions& options) {
  return options.linear_solver == LinearSolverKind::Dense ||
         options.linear_solver == LinearSolverKind::Sparse;
}

// Whether the preconditioner is made of blocks before points are eliminated.
bool wantsWhole(const FastPlan& plan) {
  return plan.linear_solver == LinearSolverKind::Iterative &&
         (plan.preconditioner == PreconditionerKind::BlockJacobi ||
          plan.preconditioner == PreconditionerKind::PowerSeries);
}

template <class T>
class FastProblem : public TrustRegionProblem {
 public:
  FastProblem(const BundleProblem& problem, const FastStructure& structure, FastPattern pattern,
              const OptimizerOptions& options, const FastPlan& plan)
      : problem_(problem),
        structure_(structure),
        options_(options),
        plan_(plan),
        sweep_(problem, structure, options.loss),
        schur_(structure, std::move(pattern), sweep_, plan.is_explicit, wantsWhole(plan),
               plan.threads),
        state_(makeFastState(problem, structure, plan.threads)),
        moved_(stateWithoutPoints(state_)),
        direct_(plan.linear_solver != LinearSolverKind::Sparse),
        gradients_(plan.preconditioner),
        step_(schur_.size(), 0.0) {}

  double linearize() override {
    built_damping_ = expected_damping_;
    return schur_.build(state_, built_damping_);
  }

  double gradientMax() const override { return schur_.gradientMax(); }

  LinearStep solve(double damping) override {
    if (damping != built_damping_) (void)schur_.build(state_, damping);
    built_damping_ = damping;
    LinearStep step;
    step.is_solved = solveBlocks(step.linear_iterations);
    step.is_solved = step.is_solved && moveBlocks(problem_, structure_, state_, step_, moved_);
    if (!step.is_solved) return step;
    const FastPointStep points = schur_.movePoints(state_, step_, moved_);
    moved_cost_ = points.cost;
    step.model_decrease = points.model_decrease;
    double squared = points.squared_step;
    for (const double d : step_) squared += d * d;
    step.step_norm = std::sqrt(squared);
    step.variable_norm = std::sqrt(points.squared_points + squaredBlocks());
    step.is_solved = std::isfinite(squared) && std::isfinite(step.model_decrease);
    return step;
  }

  double evaluateStep() override { return moved_cost_; }

  void acceptStep() override { std::swap(state_, moved_); }

  void expectDamping(double damping) override { expected_damping_ = damping; }
  const FastState& state() const { return state_; }
  std::size_t countInliers() { return schur_.countInliers(state_); }

 private:
  bool solveBlocks(std::size_t& iterations) {
    if (step_.empty()) return true;  // all poses are fixed
    return plan_.linear_solver == LinearSolverKind::Iterative
               ? gradients_.solve(schur_, options_, step_, iterations)
               : direct_.solve(schur_, step_);
  }

  double squaredBlocks() const {
    double sum = 0;
    for (std::size_t i = 0; i < structure_.blocks.size(); ++i) {
      sum += state_.poses[i].translation().squaredNorm();
      if (structure_.blocks[i].camera == kNoBlock) continue;
      for (const double x : state_.intrinsics[i]) sum += x * x;
    }
    return sum;
  }

  const BundleProblem& problem_;
  const FastStructure& structure_;
  const OptimizerOptions& options_;
  const FastPlan plan_;
  const FastSweep sweep_;
  FastSchur<T> schur_;
  FastState state_;
  FastState moved_;
  FastDirect<T> direct_;
  FastGradients<T> gradients_;
  std::vector<double> step_;
  double expected_damping_ = kFastDamping;
  double built_damping_ = 0;
  double moved_cost_ = std::numeric_limits<double>::quiet_NaN();
};

std::size_t countParameters(const BundleProblem& problem, const FastStructure& structure) {
  std::size_t count = 0;
  for (const FastBlock& block : structure.blocks) {
    count += (block.is_pose_free ? 6U : 0U) + (block.camera != kNoBlock ? 3U : 0U);
  }
  for (const std::uint32_t point : structure.points) {
    count += !problem.point_fixed.empty() && problem.point_fixed[point] != 0 ? 0U : 3U;
  }
  return count;
}

template <class T>
void run(const BundleProblem& problem, const FastStructure& structure, FastPattern pattern,
         const OptimizerOptions& options, const FastPlan& plan, Clock::time_point start,
         OptimizerSummary& summary) {
  FastProblem<T> fast(problem, structure, std::move(pattern), options, plan);
  const auto write = [&] { writeFastState(structure, fast.state(), problem); };
  try {
    runTrustRegion(fast, options, kFastDamping, start, summary);
  } catch (...) {
    write();
    throw;
  }
  if (!summary.is_usable) return;
  write();
  summary.inliers = fast.countInliers();
}

}  // namespace

OptimizerSummary solveFastBundle(const BundleProblem& problem, const OptimizerOptions& options) {
  const Clock::time_point start = Clock::now();
  OptimizerSummary summary;
  const unsigned threads = fastThreads(problem.pixels.size(), options);
  const FastStructure structure = makeFastStructure(problem, threads);
  FastPattern pattern;
  if (options.schur != SchurKind::Implicit || isDirect(options)) {
    pattern = makeFastPattern(structure, threads);
  }
  const FastPlan plan = makeFastPlan(structure, pattern, options, threads);
  if (!plan.is_explicit) pattern = FastPattern();
  summary.linear_solver = nameOf(plan);
  summary.observations = structure.observationCount();
  summary.left_out = structure.left_out;
  summary.residuals = 2 * summary.observations;
  summary.parameters = countParameters(problem, structure);
  const auto solve = plan.is_mixed ? &run<float> : &run<double>;
  solve(problem, structure, std::move(pattern), options, plan, start, summary);
  summary.times.total = secondsSince(start);
  return summary;
}

}  // namespace pba
}  // namespace detail
}  // namespace v1
}  // namespace gslam
