#ifndef GSLAM_OPTIMIZER_PBA_SRC_SOLVERS_H
#define GSLAM_OPTIMIZER_PBA_SRC_SOLVERS_H

#include <gslam/optimizer/alignment_problem.h>
#include <gslam/optimizer/bundle_problem.h>
#include <gslam/optimizer/covariance.h>
#include <gslam/optimizer/pose_graph_problem.h>
#include <gslam/optimizer/pose_problem.h>
#include <gslam/optimizer/two_view_problem.h>

// What the back end can do: a solver a problem. Problems and options were checked.

namespace gslam {
inline namespace v1 {
namespace detail {
namespace pba {

// small/
OptimizedPose solvePose(const PoseProblem& problem, const SE3d& T_world_body,
                        const OptimizerOptions& options);
OptimizedAlignment<SE3d> solveAlignment(const AlignmentProblem& problem, const SE3d& T_a_b,
                                        const OptimizerOptions& options);
OptimizedAlignment<SIM3d> solveAlignment(const AlignmentProblem& problem, const SIM3d& T_a_b,
                                         const OptimizerOptions& options);
OptimizedTwoView solveTwoView(const TwoViewProblem& problem, const SE3d& T_first_second,
                              const OptimizerOptions& options);

// bundle/: the fast one where one block of variables stands behind each observation besides its
// point, the general one everywhere.
bool isFastBundle(const BundleProblem& problem, const OptimizerOptions& options);
OptimizerSummary solveFastBundle(const BundleProblem& problem, const OptimizerOptions& options);
OptimizerSummary solveGeneralBundle(const BundleProblem& problem, const OptimizerOptions& options);
BundleCovariance solveBundleCovariance(const BundleProblem& problem,
                                       Span<const std::uint32_t> poses,
                                       Span<const std::uint32_t> points,
                                       Span<const std::uint32_t> cameras,
                                       const OptimizerOptions& options);

// graph/: instantiated for SE2d, SE3d, SIM3d.
template <class Group>
OptimizerSummary solvePoseGraph(const PoseGraphProblem<Group>& problem,
                                const OptimizerOptions& options);
template <class Group>
PoseGraphCovariance<Group> solvePoseGraphCovariance(const PoseGraphProblem<Group>& problem,
                                                    Span<const std::uint32_t> poses,
                                                    const OptimizerOptions& options);

}  // namespace pba
}  // namespace detail
}  // namespace v1
}  // namespace gslam

#endif  // GSLAM_OPTIMIZER_PBA_SRC_SOLVERS_H
