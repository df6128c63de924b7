#ifndef GSLAM_ESTIMATOR_ESTIMATE_RELATIVE_POSE_H
#define GSLAM_ESTIMATOR_ESTIMATE_RELATIVE_POSE_H

#include <gslam/base/span.h>
#include <gslam/estimator/estimate.h>
#include <gslam/estimator/export.h>
#include <gslam/estimator/options.h>
#include <gslam/geometry/camera.h>
#include <gslam/geometry/se3.h>
#include <gslam/geometry/vec.h>

/// @file
/// The relative pose of two calibrated views.

namespace gslam {
inline namespace v1 {

/// T_second_first, whose translation has the length 1, as two views do not tell its length. The
/// covariance is of the right tangent (translation, rotation): `T * exp(delta)`; its rank is 5.
using RelativePoseEstimate = Estimate<SE3d, 6>;

/// Thresholds of estimateRelativePose() and estimateEssential() where the options have none.
constexpr double kRelativePosePixelThreshold = 2;       ///< pixels
constexpr double kRelativePoseRadianThreshold = 0.003;  ///< radians

/// The relative pose of bearings matched among outliers, whatever camera they are from; they may
/// look backwards.
///
/// Samples of five. Residuals are Sampson's: how far both bearings together would have to turn to
/// fit, to first order, e / sqrt(|b1 x E^T b2|^2 + |b2 x E b1|^2) for e = b2^T E b1, radians;
/// refinement minimises their squares over the five degrees of freedom. Inliers are within the
/// threshold and in front of both cameras, or so far away that a turn alone moves them there within
/// twice the threshold: noise decides on which side of infinity such a point is.
///
/// Degeneracy::PureRotation, Degenerate: the camera turned without moving, or too little for these
/// matches. All inliers but for what chance explains are where a rotation alone takes them, within
/// twice the threshold, and of all matches there, n times the ratio of squared parallax to squared
/// noise is at most 250 + 8 sqrt(n). The rotation of the model is right, the translation means
/// nothing.
/// Degeneracy::Planar: all inliers but for what chance explains lie on one plane of the scene,
/// within twice the threshold and with no relief above the noise. The plane is refined with the
/// pose on both components of the errors, and so is the second pose from which it looks alike; the
/// better one is the model. Where the other one is as good, it is the alternative, and something
/// else has to choose: where the sums of squared residuals, cut off at the threshold, differ by at
/// most 12 + 8 sqrt(n) variances of a residual, n matches on the plane. (Each pose sees their noise
/// across other epipolar lines. Points off the plane, or behind a camera, tell the poses apart.)
/// The covariance is that of epipolar lines, larger than that of a plane. Also Degenerate, with
/// Degeneracy::None or Planar: the standard deviation of the rotation is above 0.1 radians, or that
/// of the translation's direction above 0.07 (4 degrees); or another direction of translation, more
/// than 11 degrees off, explains the matches nearly as well (12 variances), and is the alternative.
///
/// In the end, matches that move more than most, of which no more fit than chance explains, are
/// left aside: of a short translation, one of them on its line by chance says more than all others.
/// The pose is refined on the rest, from directions of translation all around. The covariance is
/// theirs; it counts what the threshold cuts off, and how noise in the place of parallax draws the
/// translation. The search wants two samples without an outlier, since five noisy matches may say
/// little.
///
/// Thread-safety: reentrant.
/// @param first    bearings in the first view, of any length but zero
/// @param second   bearings in the second view, as many
/// @param options  threshold: the largest residual, radians (0.003)
/// @return the estimate; status InvalidInput where sizes differ, a number is not finite, a bearing
///   has no direction or an option is out of range, TooFewPoints for fewer than 5 matches
GSLAM_ESTIMATOR_EXPORT RelativePoseEstimate estimateRelativePose(
    Span<const Vec3d> first, Span<const Vec3d> second, const EstimateOptions& options = {});

/// The same of pixels of calibrated cameras of any models. Residuals are pixels of the distorted
/// images: Sampson's error, with the derivative of each bearing by its pixel. Pixels that a camera
/// has no bearing for are outliers.
/// @param first          pixels in the first view, as they are in the image
/// @param second         pixels in the second view, as many
/// @param first_camera   that took the first view
/// @param second_camera  that took the second view
/// @param options        threshold: the largest residual, pixels (2)
/// @return as above; status InvalidInput where a camera is none, too
GSLAM_ESTIMATOR_EXPORT RelativePoseEstimate
estimateRelativePose(Span<const Vec2d> first, Span<const Vec2d> second, const Camera& first_camera,
                     const Camera& second_camera, const EstimateOptions& options = {});

}  // namespace v1
}  // namespace gslam

#endif  // GSLAM_ESTIMATOR_ESTIMATE_RELATIVE_POSE_H
