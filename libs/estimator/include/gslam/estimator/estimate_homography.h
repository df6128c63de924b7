#ifndef GSLAM_ESTIMATOR_ESTIMATE_HOMOGRAPHY_H
#define GSLAM_ESTIMATOR_ESTIMATE_HOMOGRAPHY_H

#include <gslam/base/span.h>
#include <gslam/estimator/estimate.h>
#include <gslam/estimator/export.h>
#include <gslam/estimator/options.h>
#include <gslam/geometry/camera.h>
#include <gslam/geometry/mat.h>
#include <gslam/geometry/vec.h>

/// @file
/// A homography among outliers.

namespace gslam {
inline namespace v1 {

/// H with x_second ~ H x_first, of norm 1 (Frobenius) and with a positive third coordinate of H x
/// at the inliers. The covariance is that of its nine elements, row by row; it has rank 8.
using HomographyEstimate = Estimate<Mat3d, 9>;

/// Threshold of estimateHomography() where the options have none, pixels.
constexpr double kHomographyThreshold = 3;

/// The homography between two images of a plane, or of a camera that turned, among outliers.
///
/// The residual is the distance in the second image between a point and where H takes the first
/// one; H has the least sum of their squares at the inliers, which is best where the second points
/// carry the noise. Beyond the horizon of H nothing is an inlier. Chance: a square of twice the
/// threshold as a part of the box around most of the second points.
///
/// Degenerate: all inliers, or all points, on one line (Collinear) or at one point (Coincident), to
/// within twice their residuals, but for two that nothing confirms.
///
/// Thread-safety: reentrant; `options.threads` at work.
/// @param first    points of the first image, e.g. in pixels
/// @param second   their matches in the second image, as many
/// @param options  threshold: the largest residual, in the unit of the second points (3)
/// @return the estimate; status InvalidInput where sizes differ, a number is not finite or an
/// option
///   is out of range, TooFewPoints for fewer than 4 matches, Degenerate as above, NoConsensus where
///   chance explains the inliers: always for 4 matches, mostly for 5
GSLAM_ESTIMATOR_EXPORT HomographyEstimate estimateHomography(Span<const Vec2d> first,
                                                             Span<const Vec2d> second,
                                                             const EstimateOptions& options = {});

/// The same with cameras of any model: H takes bearings of the first camera to those of the second,
/// y = H b1 with b2 ~ y.
///
/// Residuals are pixels of the second camera, made linear at the observed pixel: exact to first
/// order, and altogether for a pinhole camera. Pixels that a camera cannot unproject are no
/// inliers. Chance: as above, of the second camera's image.
/// @param first          pixels of the first camera
/// @param second         their matches, pixels of the second camera, as many
/// @param first_camera   the first camera
/// @param second_camera  the second camera, of any other model or the same
/// @param options        threshold: the largest residual, pixels (3)
/// @return as above; status InvalidInput where a camera is none, too
GSLAM_ESTIMATOR_EXPORT HomographyEstimate estimateHomography(Span<const Vec2d> first,
                                                             Span<const Vec2d> second,
                                                             const Camera& first_camera,
                                                             const Camera& second_camera,
                                                             const EstimateOptions& options = {});

}  // namespace v1
}  // namespace gslam

#endif  // GSLAM_ESTIMATOR_ESTIMATE_HOMOGRAPHY_H
