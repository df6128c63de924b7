#ifndef GSLAM_ESTIMATOR_ESTIMATE_ABSOLUTE_POSE_H
#define GSLAM_ESTIMATOR_ESTIMATE_ABSOLUTE_POSE_H

#include <gslam/base/span.h>
#include <gslam/estimator/estimate.h>
#include <gslam/estimator/export.h>
#include <gslam/estimator/options.h>
#include <gslam/geometry/camera.h>
#include <gslam/geometry/se3.h>
#include <gslam/geometry/vec.h>

/// @file
/// The pose of a camera that sees known points.

namespace gslam {
inline namespace v1 {

/// T_world_camera: the camera's place and attitude in the world. The covariance is of its right
/// tangent (translation, rotation), `T * exp(delta)`: the camera's, in its own axes.
using AbsolutePoseEstimate = Estimate<SE3d, 6>;

/// Thresholds of estimateAbsolutePose() and estimateRigPose() where the options have none.
constexpr double kAbsolutePosePixelThreshold = 3;       ///< pixels
constexpr double kAbsolutePoseRadianThreshold = 0.003;  ///< radians

/// The pose of a camera from bearings to known points, among outliers; bearings may look backwards.
///
/// Samples of three. Residuals are angles between the bearing and the direction of the point,
/// radians; refinement minimises the squares of their tangents. Points on one plane are as good as
/// others, but for a small plane seen from afar, which looks alike from two poses: where the sums
/// of squared residuals, cut off at the threshold, differ by no more than 12 variances, the better
/// one is the model, the other one the alternative, and degeneracy is Planar while status is Ok
/// (not for rigs whose rays do not meet). World coordinates may be as large as they are (UTM): all
/// is done about the points' mean.
///
/// Degenerate: Degeneracy::Collinear where the inliers' points, but for what chance explains, are
/// seen on the line of two of them from whichever side within the threshold;
/// Degeneracy::Coincident where all are at one place; Degeneracy::None where the standard deviation
/// of the rotation is above 0.1 radians, or that of the place above 0.3 times the mean distance of
/// the inliers.
///
/// Thread-safety: reentrant.
/// @param bearings  camera coordinates, of any length but zero
/// @param points    world coordinates, metres, as many
/// @param options   threshold: the largest residual, radians (0.003)
/// @return the estimate; status InvalidInput where sizes differ, a number is not finite, a bearing
///   has no direction or an option is out of range, TooFewPoints for fewer than 3 points
GSLAM_ESTIMATOR_EXPORT AbsolutePoseEstimate estimateAbsolutePose(
    Span<const Vec3d> bearings, Span<const Vec3d> points, const EstimateOptions& options = {});

/// The same of pixels of a camera of any model. Residuals are reprojection errors in the distorted
/// image, pixels. Scoring and refinement take them to first order about the observed pixel;
/// the mask is made with Camera::project(), and points that it does not see are outliers, as are
/// pixels without a bearing. Images of equirectangular cameras go on beyond their edge.
/// @param pixels   as they are in the image
/// @param camera   that took it
/// @param points   world coordinates, metres, as many
/// @param options  threshold: the largest residual, pixels (3)
/// @return as above; status InvalidInput where the camera is none, too
GSLAM_ESTIMATOR_EXPORT AbsolutePoseEstimate
estimateAbsolutePose(Span<const Vec2d> pixels, const Camera& camera, Span<const Vec3d> points,
                     const EstimateOptions& options = {});

}  // namespace v1
}  // namespace gslam

#endif  // GSLAM_ESTIMATOR_ESTIMATE_ABSOLUTE_POSE_H
