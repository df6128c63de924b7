#ifndef GSLAM_ESTIMATOR_ESTIMATE_PLANE_H
#define GSLAM_ESTIMATOR_ESTIMATE_PLANE_H

#include <gslam/base/span.h>
#include <gslam/estimator/estimate.h>
#include <gslam/estimator/export.h>
#include <gslam/estimator/options.h>
#include <gslam/geometry/vec.h>

/// @file
/// A plane among outliers.

namespace gslam {
inline namespace v1 {

/// The plane (n, d): n x + d = 0, |n| = 1, so that n x + d is the distance of x. Of both signs the
/// one with d >= 0 is given: n points from the plane to the origin. The covariance is that of the
/// four numbers; it has rank 3.
using PlaneEstimate = Estimate<Vec4d, 4>;

/// The plane through most of the points.
///
/// The residual is the distance from the plane, the sum of whose squares is least at the inliers.
/// Chance: the slab of twice the threshold as a part of a cube as long as the box around most of
/// the points.
///
/// Degenerate: all inliers on one line (Collinear) or at one point (Coincident), to within twice
/// the residuals.
///
/// Thread-safety: reentrant; `options.threads` at work.
/// @param points   three or more
/// @param options  threshold in the unit of the points; there is no default: 0 is InvalidInput,
///   except with EstimateScoring::Lmeds, which needs none
/// @return the estimate; status InvalidInput where sizes differ, a number is not finite or an
/// option
///   is out of range, TooFewPoints for fewer than 3 points, Degenerate as above, NoConsensus where
///   chance explains the inliers: always for 3, and for a dozen unless the threshold is small
GSLAM_ESTIMATOR_EXPORT PlaneEstimate estimatePlane(Span<const Vec3d> points,
                                                   const EstimateOptions& options);

}  // namespace v1
}  // namespace gslam

#endif  // GSLAM_ESTIMATOR_ESTIMATE_PLANE_H
