#ifndef GSLAM_ESTIMATOR_ESTIMATE_AFFINE_2D_H
#define GSLAM_ESTIMATOR_ESTIMATE_AFFINE_2D_H

#include <gslam/base/span.h>
#include <gslam/estimator/estimate.h>
#include <gslam/estimator/export.h>
#include <gslam/estimator/options.h>
#include <gslam/geometry/mat.h>
#include <gslam/geometry/vec.h>

/// @file
/// An affine map of the plane among outliers.

namespace gslam {
inline namespace v1 {

/// A with x_second = A (x_first, 1). The covariance is that of its six elements, row by row.
using Affine2DEstimate = Estimate<Mat<double, 2, 3>, 6>;

/// Threshold of estimateAffine2D() where the options have none, pixels.
constexpr double kAffine2DThreshold = 3;

/// The affine map between matched points of the plane, among outliers.
///
/// The residual is the distance of the second points; A has the least sum of their squares at the
/// inliers. Chance: a square of twice the threshold as a part of the box around most of the second
/// points.
///
/// Degenerate: the first points of all inliers on one line (Collinear) or at one point
/// (Coincident), to within twice the residuals, but for two
/// that nothing confirms.
///
/// Thread-safety: reentrant; `options.threads` at work.
/// @param first    points of the first image, e.g. in pixels
/// @param second   their matches, as many
/// @param options  threshold: the largest residual, in the unit of the second points (3)
/// @return the estimate; status InvalidInput where sizes differ, a number is not finite or an
/// option
///   is out of range, TooFewPoints for fewer than 3 matches, Degenerate as above, NoConsensus where
///   chance explains the inliers: always for 3
GSLAM_ESTIMATOR_EXPORT Affine2DEstimate estimateAffine2D(Span<const Vec2d> first,
                                                         Span<const Vec2d> second,
                                                         const EstimateOptions& options = {});

}  // namespace v1
}  // namespace gslam

#endif  // GSLAM_ESTIMATOR_ESTIMATE_AFFINE_2D_H
