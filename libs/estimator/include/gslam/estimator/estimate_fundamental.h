#ifndef GSLAM_ESTIMATOR_ESTIMATE_FUNDAMENTAL_H
#define GSLAM_ESTIMATOR_ESTIMATE_FUNDAMENTAL_H

#include <gslam/base/span.h>
#include <gslam/estimator/estimate.h>
#include <gslam/estimator/export.h>
#include <gslam/estimator/options.h>
#include <gslam/geometry/mat.h>
#include <gslam/geometry/vec.h>

/// @file
/// The epipolar geometry of two uncalibrated views.

namespace gslam {
inline namespace v1 {

/// F with x_second^T F x_first = 0 between pixels (x, y, 1), rank 2, Frobenius norm 1; its sign
/// means nothing. The covariance is of the nine elements, row by row; its rank is 7.
using FundamentalEstimate = Estimate<Mat3d, 9>;

/// Threshold of estimateFundamental() where the options have none, pixels.
constexpr double kFundamentalThreshold = 2;

/// The fundamental matrix of matches among outliers.
///
/// Samples of seven. Residuals are Sampson's: how far both pixels together would have to move to
/// fit, to first order (Hartley, Zisserman, "Multiple View Geometry", 2004, eq. 11.9), pixels;
/// refinement minimises their squares over the seven degrees of freedom. Samples that lie mostly on
/// one plane fit everything on it and nothing else: from its homography and two matches off it the
/// right matrix is found (O. Chum, T. Werner, J. Matas, "Two-view geometry estimation unaffected by
/// a dominant plane", CVPR 2005).
///
/// Degenerate, with Degeneracy::Planar: what is not on the plane is no more than chance explains;
/// the model is one of a family of two parameters. A camera that only turned looks the same. Also
/// Degenerate: matrices of which the inliers leave an element, at norm 1 in coordinates of size 1,
/// uncertain by more than 0.1.
///
/// Thread-safety: reentrant.
/// @param first    pixels in the first view, undistorted
/// @param second   pixels in the second view, as many
/// @param options  threshold: the largest residual, pixels (2)
/// @return the estimate; status InvalidInput where sizes differ, a number is not finite or an
/// option
///   is out of range, TooFewPoints for fewer than 7 matches
GSLAM_ESTIMATOR_EXPORT FundamentalEstimate estimateFundamental(Span<const Vec2d> first,
                                                               Span<const Vec2d> second,
                                                               const EstimateOptions& options = {});

}  // namespace v1
}  // namespace gslam

#endif  // GSLAM_ESTIMATOR_ESTIMATE_FUNDAMENTAL_H
