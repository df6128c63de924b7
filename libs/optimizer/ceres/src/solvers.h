#ifndef GSLAM_OPTIMIZER_CERES_SRC_SOLVERS_H
#define GSLAM_OPTIMIZER_CERES_SRC_SOLVERS_H

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
namespace by_ceres {

OptimizedPose solvePose(const PoseProblem& problem, const SE3d& T_world_body,
                        const OptimizerOptions& options);
// Instantiated for SE3d, SIM3d.
template <class Group>
OptimizedAlignment<Group> solveAlignment(const AlignmentProblem& problem, const Group& T_a_b,
                                         const OptimizerOptions& options);
OptimizedTwoView solveTwoView(const TwoViewProblem& problem, const SE3d& T_first_second,
                              const OptimizerOptions& options);
OptimizerSummary solveBundle(const BundleProblem& problem, const OptimizerOptions& options);
BundleCovariance solveBundleCovariance(const BundleProblem& problem,
                                       Span<const std::uint32_t> poses,
                                       Span<const std::uint32_t> points,
                                       Span<const std::uint32_t> cameras,
                                       const OptimizerOptions& options);
// Instantiated for SE2d, SE3d, SIM3d.
template <class Group>
OptimizerSummary solvePoseGraph(const PoseGraphProblem<Group>& problem,
                                const OptimizerOptions& options);
template <class Group>
PoseGraphCovariance<Group> solvePoseGraphCovariance(const PoseGraphProblem<Group>& problem,
                                                    Span<const std::uint32_t> poses,
                                                    const OptimizerOptions& options);

}  // namespace by_ceres
}  // namespace detail
}  // namespace v1
}  // namespace gslam

#endif  // GSLAM_OPTIMIZER_CERES_SRC_SOLVERS_H
