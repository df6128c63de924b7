#ifndef GSLAM_OPTIMIZER_ALIGN_TRAJECTORIES_H
#define GSLAM_OPTIMIZER_ALIGN_TRAJECTORIES_H

#include <gslam/base/span.h>
#include <gslam/geometry/mat.h>
#include <gslam/geometry/se3.h>
#include <gslam/geometry/sim3.h>
#include <gslam/optimizer/alignment_problem.h>
#include <gslam/optimizer/export.h>
#include <gslam/optimizer/options.h>

/// @file
/// The fit of one trajectory onto another, as before their errors are measured.

namespace gslam {
inline namespace v1 {

/// The same body at the same times in two frames, such as an estimate in `b` and ground truth in
/// `a`. Views of arrays that somebody else owns.
struct TrajectoryPair {
  Span<const SE3d> T_a_body;  ///< n poses
  Span<const SE3d> T_b_body;  ///< n poses, at the same times
  /// n, of the position of the body in a, per square metre; none: 1. Not with uses_orientations.
  Span<const Mat3d> position_information;
  /// n, of the tangent (translation, rotation) on the right; none: the identity. Only with
  /// uses_orientations.
  Span<const Mat<double, 6, 6>> pose_information;
  bool uses_orientations = false;  ///< whether orientations count too, not positions alone
};

/// The transform T_a_b that brings trajectory b onto a best.
///
/// Positions alone, without information and without a robust loss, are fit in closed form: with
/// the least sum of squared distances (S. Umeyama, "Least-squares estimation of transformation
/// parameters between two point patterns", PAMI 13(4), 1991). All else starts from there and is
/// refined by optimizeAlignment(), which needs a back end: of positions as its points, of poses as
/// its poses. Where positions lie on a line, orientations give the start of the rotation.
/// @tparam Group   SE3d, or SIM3d for a trajectory without a scale
/// @param pair     the trajectories
/// @param options  loss and tolerances of the refinement, its back end
/// @return as optimizeAlignment(). Not usable where positions alone are to determine what they do
///   not: a rotation where they lie on a line, a scale where those of b are one place.
/// @throws ArgumentError for sizes that differ, no poses, a number that is not finite, an
///   information that does not belong to what is fit, and as optimizeAlignment()
template <class Group>
OptimizedAlignment<Group> alignTrajectories(const TrajectoryPair& pair,
                                            const OptimizerOptions& options = {});
/// @{
/// There are these two.
template <>
GSLAM_OPTIMIZER_EXPORT OptimizedAlignment<SE3d> alignTrajectories<SE3d>(
    const TrajectoryPair& pair, const OptimizerOptions& options);
template <>
GSLAM_OPTIMIZER_EXPORT OptimizedAlignment<SIM3d> alignTrajectories<SIM3d>(
    const TrajectoryPair& pair, const OptimizerOptions& options);
/// @}

}  // namespace v1
}  // namespace gslam

#endif  // GSLAM_OPTIMIZER_ALIGN_TRAJECTORIES_H
