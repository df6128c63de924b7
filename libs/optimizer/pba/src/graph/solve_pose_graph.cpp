#include <cmath>
#include <cstdint>

#include "graph/graph_problem.h"
#include "solvers.h"

namespace gslam {
inline namespace v1 {
namespace detail {
namespace pba {
namespace {

constexpr double kGraphDamping = 1e-10;  // nearly the step of Gauss and Newton

template <class Group>
GraphLayout layoutOf(const PoseGraphProblem<Group>& problem) {
  return layOutGraph(problem.T_world_body.size(), problem.pose_fixed, problem.from, problem.to,
                     problem.prior_pose);
}

template <class Group>
void writePoses(const GraphLayout& layout, const std::vector<Group>& poses,
                const PoseGraphProblem<Group>& problem) {
  for (const std::uint32_t pose : layout.pose) problem.T_world_body[pose] = poses[pose];
}

// What was asked for and is not done.
void warnOfSolver(const OptimizerOptions& options, OptimizerSummary& summary) {
  if (options.linear_solver == LinearSolverKind::Dense) {
    summary.warnings.push_back(
        "pose graphs have no dense solver: the sparse one was used, which is as exact");
  }
  if (options.linear_solver == LinearSolverKind::Iterative &&
      options.preconditioner != PreconditionerKind::Automatic &&
      options.preconditioner != PreconditionerKind::BlockJacobi) {
    summary.warnings.push_back(
        "pose graphs have the preconditioner block Jacobi alone: it was used instead");
  }
}

}  // namespace

template <class Group>
OptimizerSummary solvePoseGraph(const PoseGraphProblem<Group>& problem,
                                const OptimizerOptions& options) {
  const Clock::time_point start = Clock::now();
  const GraphLayout layout = layoutOf(problem);
  GraphProblem<Group> graph(problem, layout, options);
  OptimizerSummary summary;
  summary.backend = "pba";
  summary.linear_solver = options.linear_solver == LinearSolverKind::Iterative
                              ? "PCG block Jacobi, double"
                              : "sparse block Cholesky, double";
  summary.observations = problem.from.size();
  summary.residuals = layout.terms.size() * GraphEquations<Group>::rows(problem.residual);
  summary.parameters = layout.pose.size() * Group::kFreedom;
  warnOfSolver(options, summary);
  try {
    runTrustRegion(graph, options, kGraphDamping, start, summary);
  } catch (...) {  // from progress(): what was found is kept
    writePoses(layout, graph.poses(), problem);
    throw;
  }
  if (summary.is_usable) {
    writePoses(layout, graph.poses(), problem);
    summary.inliers = graph.equations().inliers(graph.poses());
  }
  summary.times.total = secondsSince(start);
  return summary;
}

template <class Group>
PoseGraphCovariance<Group> solvePoseGraphCovariance(const PoseGraphProblem<Group>& problem,
                                                    Span<const std::uint32_t> poses,
                                                    const OptimizerOptions& options) {
  const GraphLayout layout = layoutOf(problem);
  OptimizerOptions direct = options;
  direct.linear_solver = LinearSolverKind::Sparse;
  GraphProblem<Group> graph(problem, layout, direct);
  PoseGraphCovariance<Group> result;
  if (!std::isfinite(graph.linearize())) {
    result.message = "the cost has no finite value";
    return result;
  }
  if (!graph.decompose()) {
    result.message =
        "the normal equations have no inverse: nothing fixes some of the poses, or some of their "
        "freedoms";
    return result;
  }
  result.is_valid = true;
  result.poses.resize(poses.size());
  ParallelOptions parallel;
  parallel.threads = options.threads;
  parallel.grain = 4;
  parallelFor(
      0, poses.size(),
      [&](std::size_t i) {
        const BlockIndex variable = layout.variable[poses[i]];
        result.poses[i] = typename Group::Jacobian{};
        if (variable != kNoBlock) graph.inverseBlock(variable, result.poses[i]);
      },
      parallel);
  return result;
}

template OptimizerSummary solvePoseGraph(const PoseGraphProblem<SE2d>&, const OptimizerOptions&);
template OptimizerSummary solvePoseGraph(const PoseGraphProblem<SE3d>&, const OptimizerOptions&);
template OptimizerSummary solvePoseGraph(const PoseGraphProblem<SIM3d>&, const OptimizerOptions&);
template PoseGraphCovariance<SE2d> solvePoseGraphCovariance(const PoseGraphProblem<SE2d>&,
                                                            Span<const std::uint32_t>,
                                                            const OptimizerOptions&);
template PoseGraphCovariance<SE3d> solvePoseGraphCovariance(const PoseGraphProblem<SE3d>&,
                                                            Span<const std::uint32_t>,
                                                            const OptimizerOptions&);
template PoseGraphCovariance<SIM3d> solvePoseGraphCovariance(const PoseGraphProblem<SIM3d>&,
                                                             Span<const std::uint32_t>,
                                                             const OptimizerOptions&);

}  // namespace pba
}  // namespace detail
}  // namespace v1
}  // namespace gslam
