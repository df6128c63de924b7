#ifndef GSLAM_ESTIMATOR_ESTIMATE_RIG_POSE_H
#define GSLAM_ESTIMATOR_ESTIMATE_RIG_POSE_H

#include <gslam/base/span.h>
#include <gslam/estimator/estimate.h>
#include <gslam/estimator/estimate_absolute_pose.h>
#include <gslam/estimator/export.h>
#include <gslam/estimator/options.h>
#include <gslam/geometry/camera.h>
#include <gslam/geometry/se3.h>
#include <gslam/geometry/vec.h>

#include <cstdint>

/// @file
/// The pose of a rig of cameras that see known points.

namespace gslam {
inline namespace v1 {

/// T_world_rig. The covariance is of its right tangent (translation, rotation).
using RigPoseEstimate = Estimate<SE3d, 6>;

/// A camera and where it is mounted.
struct RigCamera {
  Camera camera;      ///< of any model
  SE3d T_rig_camera;  ///< takes its coordinates to those of the rig
};

/// The pose of a rig from rays to known points, among outliers; the rays need not meet (a
/// generalised camera). All as estimateAbsolutePose(): residuals, thresholds, degeneracies.
///
/// Samples of three. Those from one place, and rigs whose rays all meet, are solved as one camera.
///
/// Thread-safety: reentrant.
/// @param origins   where rays start, rig coordinates, metres
/// @param bearings  directions of the rays, rig coordinates, of any length but zero, as many
/// @param points    world coordinates, metres, as many
/// @param options   threshold: the largest angle, radians (0.003)
/// @return as estimateAbsolutePose()
GSLAM_ESTIMATOR_EXPORT RigPoseEstimate estimateRigPose(Span<const Vec3d> origins,
                                                       Span<const Vec3d> bearings,
                                                       Span<const Vec3d> points,
                                                       const EstimateOptions& options = {});

/// The same of pixels of several cameras.
/// @param cameras           of the rig
/// @param camera_of_point   which of them saw each point
/// @param pixels            where, as it is in its image, as many
/// @param points            world coordinates, metres, as many
/// @param options           threshold: the largest reprojection error, pixels (3)
/// @return as estimateAbsolutePose(); status InvalidInput for a number that is no camera's, too
GSLAM_ESTIMATOR_EXPORT RigPoseEstimate estimateRigPose(Span<const RigCamera> cameras,
                                                       Span<const std::uint32_t> camera_of_point,
                                                       Span<const Vec2d> pixels,
                                                       Span<const Vec3d> points,
                                                       const EstimateOptions& options = {});

}  // namespace v1
}  // namespace gslam

#endif  // GSLAM_ESTIMATOR_ESTIMATE_RIG_POSE_H
