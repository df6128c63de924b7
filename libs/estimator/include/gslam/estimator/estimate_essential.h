#ifndef GSLAM_ESTIMATOR_ESTIMATE_ESSENTIAL_H
#define GSLAM_ESTIMATOR_ESTIMATE_ESSENTIAL_H

#include <gslam/base/span.h>
#include <gslam/estimator/estimate.h>
#include <gslam/estimator/estimate_relative_pose.h>
#include <gslam/estimator/export.h>
#include <gslam/estimator/options.h>
#include <gslam/geometry/camera.h>
#include <gslam/geometry/mat.h>
#include <gslam/geometry/vec.h>

/// @file
/// The essential matrix of two calibrated views.

namespace gslam {
inline namespace v1 {

/// E = [t]x R of T_second_first with |t| = 1, so that its Frobenius norm is sqrt(2), and
/// b_second^T E b_first = 0. The covariance is of the nine elements, row by row; its rank is 5.
using EssentialEstimate = Estimate<Mat3d, 9>;

/// The essential matrix of estimateRelativePose(): same search, same inliers, in front of both
/// cameras, same degeneracies. After Degeneracy::PureRotation it means nothing.
///
/// Thread-safety: reentrant.
/// @param first    bearings in the first view, of any length but zero
/// @param second   bearings in the second view, as many
/// @param options  threshold: the largest residual, radians (0.003)
/// @return as estimateRelativePose()
GSLAM_ESTIMATOR_EXPORT EssentialEstimate estimateEssential(Span<const Vec3d> first,
                                                           Span<const Vec3d> second,
                                                           const EstimateOptions& options = {});

/// The same of pixels of calibrated cameras of any models.
/// @param first          pixels in the first view, as they are in the image
/// @param second         pixels in the second view, as many
/// @param first_camera   that took the first view
/// @param second_camera  that took the second view
/// @param options        threshold: the largest residual, pixels (2)
/// @return as estimateRelativePose()
GSLAM_ESTIMATOR_EXPORT EssentialEstimate estimateEssential(Span<const Vec2d> first,
                                                           Span<const Vec2d> second,
                                                           const Camera& first_camera,
                                                           const Camera& second_camera,
                                                           const EstimateOptions& options = {});

}  // namespace v1
}  // namespace gslam

#endif  // GSLAM_ESTIMATOR_ESTIMATE_ESSENTIAL_H
