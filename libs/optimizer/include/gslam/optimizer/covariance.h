#ifndef GSLAM_OPTIMIZER_COVARIANCE_H
#define GSLAM_OPTIMIZER_COVARIANCE_H

#include <gslam/geometry/mat.h>
#include <gslam/optimizer/bundle_problem.h>
#include <gslam/optimizer/pose_graph_problem.h>

#include <cstdint>
#include <string>
#include <vector>

/// @file
/// How uncertain chosen variables are.

namespace gslam {
inline namespace v1 {

/// Covariances of chosen variables of a bundle, in the order in which they were asked for: blocks
/// of the inverse of the normal equations. Zero for what is fixed.
struct BundleCovariance {
  bool is_valid = false;  ///< whether the equations have an inverse: something must fix the whole
  std::string message;    ///< why not
  std::vector<Mat<double, 6, 6>> poses;  ///< of the tangents (translation, rotation) on the right
  std::vector<Mat3d> points;             ///< of x, y, z, given the anchors where there are some
  std::vector<std::vector<double>> cameras;  ///< of the free parameters, (k x k) row by row
};

/// The covariance at the present values, with the weights of the loss.
/// @param problem  at its optimum
/// @param poses    which ones
/// @param points   which ones
/// @param cameras  which ones
/// @param options  loss, back end
/// @return the covariances, in the order of what was asked for
/// @throws ArgumentError as optimizeBundle(), and for an index that is not there
GSLAM_OPTIMIZER_EXPORT BundleCovariance bundleCovariance(const BundleProblem& problem,
                                                         Span<const std::uint32_t> poses,
                                                         Span<const std::uint32_t> points,
                                                         Span<const std::uint32_t> cameras,
                                                         const OptimizerOptions& options = {});

/// Covariances of chosen poses of a graph: blocks of the inverse of the normal equations. Zero for
/// what is fixed.
/// @tparam Group  SE2d, SE3d or SIM3d
template <class Group>
struct PoseGraphCovariance {
  bool is_valid = false;  ///< whether the equations have an inverse, and edges connect all that was
                          ///< asked for to an anchor
  std::string message;    ///< why not
  std::vector<typename Group::Jacobian> poses;  ///< of the tangents on the right, as asked for
};

/// @{
/// The covariance at the present values, with the weights of the loss.
/// @param problem  at its optimum
/// @param poses    which ones
/// @param options  loss, back end
/// @return the covariances, in the order of what was asked for
/// @throws ArgumentError as optimizePoseGraph(), and for an index that is not there
GSLAM_OPTIMIZER_EXPORT PoseGraphCovariance<SE2d> poseGraphCovariance(
    const PoseGraphProblem<SE2d>& problem, Span<const std::uint32_t> poses,
    const OptimizerOptions& options = {});
GSLAM_OPTIMIZER_EXPORT PoseGraphCovariance<SE3d> poseGraphCovariance(
    const PoseGraphProblem<SE3d>& problem, Span<const std::uint32_t> poses,
    const OptimizerOptions& options = {});
GSLAM_OPTIMIZER_EXPORT PoseGraphCovariance<SIM3d> poseGraphCovariance(
    const PoseGraphProblem<SIM3d>& problem, Span<const std::uint32_t> poses,
    const OptimizerOptions& options = {});
/// @}

}  // namespace v1
}  // namespace gslam

#endif  // GSLAM_OPTIMIZER_COVARIANCE_H
