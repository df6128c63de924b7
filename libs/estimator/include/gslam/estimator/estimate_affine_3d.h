#ifndef GSLAM_ESTIMATOR_ESTIMATE_AFFINE_3D_H
#define GSLAM_ESTIMATOR_ESTIMATE_AFFINE_3D_H

#include <gslam/base/span.h>
#include <gslam/estimator/estimate.h>
#include <gslam/estimator/export.h>
#include <gslam/estimator/options.h>
#include <gslam/geometry/mat.h>
#include <gslam/geometry/vec.h>

/// @file
/// An affine map of space among outliers.

namespace gslam {
inline namespace v1 {

/// A with x_second = A (x_first, 1). The covariance is that of its twelve elements, row by row.
using Affine3DEstimate = Estimate<Mat<double, 3, 4>, 12>;

/// The affine map between matched points of space, among outliers.
///
/// The residual is the distance of the second points; A has the least sum of their squares at the
/// inliers. Chance: a cube of twice the threshold as a part of the box around most of the second
/// points.
///
/// Degenerate: the first points of all inliers on one plane (Planar), line (Collinear) or at one
/// point (Coincident), to within twice the residuals, but for two
/// that nothing confirms.
///
/// Thread-safety: reentrant; `options.threads` at work.
/// @param first    points of the first set
/// @param second   their matches, as many
/// @param options  threshold in the unit of the second points; there is no default: 0 is
///   InvalidInput, except with EstimateScoring::Lmeds, which needs none
/// @return the estimate; status InvalidInput where sizes differ, a number is not finite or an
/// option
///   is out of range, TooFewPoints for fewer than 4 matches, Degenerate as above, NoConsensus where
///   chance explains the inliers: always for 4
GSLAM_ESTIMATOR_EXPORT Affine3DEstimate estimateAffine3D(Span<const Vec3d> first,
                                                         Span<const Vec3d> second,
                                                         const EstimateOptions& options);

}  // namespace v1
}  // namespace gslam

#endif  // GSLAM_ESTIMATOR_ESTIMATE_AFFINE_3D_H
