#ifndef GSLAM_OPTIMIZER_POSE_GRAPH_PROBLEM_H
#define GSLAM_OPTIMIZER_POSE_GRAPH_PROBLEM_H

#include <gslam/base/span.h>
#include <gslam/geometry/se2.h>
#include <gslam/geometry/se3.h>
#include <gslam/geometry/sim3.h>
#include <gslam/optimizer/summary.h>

#include <cstdint>

/// @file
/// Pose graphs: poses from measured relative poses.

namespace gslam {
inline namespace v1 {

/// How far a pose is from a measured one. T_error = T_from_to^-1 T_from^-1 T_to.
enum class PoseGraphResidual {
  Logarithm,   ///< log(T_error), with the whole information
  Quaternion,  ///< G: translation of T_error, 2 times the vector part of its quaternion (w >= 0),
               ///< and the log of its scale: what g2o minimises. In the plane the angle.
  /// F: sqrt(kappa) (R_to - R_from R_from_to) in the Frobenius norm and sqrt(tau) (t_to - t_from -
  /// R_from t_from_to), with one weight for each, made of the information (Rosen et al.,
  /// "SE-Sync", IJRR 38(2-3), 2019): tau = d / tr(information of translation^-1), and in space
  /// kappa = 6 / tr(information of rotation^-1), in the plane the information of the angle. SE-Sync
  /// takes what a g2o file says of vec(q), four times the information of angles: so does this, and
  /// its published optima are twice our costs. Not for SIM3.
  Chordal
};

/// Poses and measured relative poses: structure of arrays, views of memory that somebody else owns
/// (see PoseGraph). The poses are written in place.
/// @tparam Group  SE2d, SE3d or SIM3d
template <class Group>
struct PoseGraphProblem {
  Span<Group> T_world_body;             ///< variables
  Span<const std::uint8_t> pose_fixed;  ///< 1 for each that is an anchor; empty: none. Where there
                                        ///< is neither an anchor nor a prior, the first is one
  Span<const std::uint32_t> from;       ///< n indices of poses
  Span<const std::uint32_t> to;         ///< n indices of poses
  Span<const Group> T_from_to;          ///< n, as measured
  /// n, of the tangent (translation, rotation[, log scale]) of T_error on the right; empty: the
  /// identity.
  Span<const typename Group::Jacobian> information;
  /// 1 for each edge that OptimizerOptions::loss applies to, such as a loop; empty: all.
  Span<const std::uint8_t> is_robust;
  PoseGraphResidual residual = PoseGraphResidual::Logarithm;  ///< what is minimised
  Span<const std::uint32_t> prior_pose;  ///< m poses of which something is known; residuals as of
                                         ///< an edge from the world, without a loss
  Span<const Group> prior_T_world_body;  ///< m
  Span<const typename Group::Jacobian> prior_information;  ///< m
};

/// @{
/// The poses that explain the measured ones best, near those given, which are the start and are
/// overwritten. From odometry the search may end in a poor place: see initializePoses().
/// @param problem  variables and edges
/// @param options  loss, tolerances, iterations, linear solver, back end
/// @return how it went
/// @throws ArgumentError for what checkPoseGraph() calls an error, and when no back end can do it
GSLAM_OPTIMIZER_EXPORT OptimizerSummary optimizePoseGraph(const PoseGraphProblem<SE2d>& problem,
                                                          const OptimizerOptions& options = {});
GSLAM_OPTIMIZER_EXPORT OptimizerSummary optimizePoseGraph(const PoseGraphProblem<SE3d>& problem,
                                                          const OptimizerOptions& options = {});
GSLAM_OPTIMIZER_EXPORT OptimizerSummary optimizePoseGraph(const PoseGraphProblem<SIM3d>& problem,
                                                          const OptimizerOptions& options = {});
/// @}

/// @{
/// Half the sum of rho over all residuals, by the plain formulas: the reference of all back ends.
/// @param problem  as it is now
/// @param loss     of robust edges
/// @return the cost
/// @throws ArgumentError as optimizePoseGraph()
GSLAM_OPTIMIZER_EXPORT double poseGraphCost(const PoseGraphProblem<SE2d>& problem,
                                            const RobustLoss& loss = {});
GSLAM_OPTIMIZER_EXPORT double poseGraphCost(const PoseGraphProblem<SE3d>& problem,
                                            const RobustLoss& loss = {});
GSLAM_OPTIMIZER_EXPORT double poseGraphCost(const PoseGraphProblem<SIM3d>& problem,
                                            const RobustLoss& loss = {});
/// @}

}  // namespace v1
}  // namespace gslam

#endif  // GSLAM_OPTIMIZER_POSE_GRAPH_PROBLEM_H
