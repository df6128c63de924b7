#ifndef GSLAM_ESTIMATOR_ESTIMATE_RIGID_3D_H
#define GSLAM_ESTIMATOR_ESTIMATE_RIGID_3D_H

#include <gslam/base/span.h>
#include <gslam/estimator/estimate.h>
#include <gslam/estimator/export.h>
#include <gslam/estimator/options.h>
#include <gslam/geometry/se3.h>
#include <gslam/geometry/vec.h>

/// @file
/// A rigid transform between sets of points among outliers.

namespace gslam {
inline namespace v1 {

/// T_second_first. The covariance is that of the right tangent delta of T SE3d::exp(delta):
/// translation, rotation.
using Rigid3DEstimate = Estimate<SE3d, 6>;

/// The rigid transform between matched points of space, such as two clouds, among outliers.
///
/// The residual is the distance of the second points; T has the least sum of their squares at the
/// inliers. Chance: a cube of twice the threshold as a part of the box around most of the second
/// points, which may be flat.
///
/// Degenerate: the first points of all inliers on one line (Collinear) or at one point
/// (Coincident), to within twice the residuals, but for two
/// that nothing confirms.
///
/// Thread-safety: reentrant; `options.threads` at work.
/// @param first    points of the first set
/// @param second   their matches, as many, in the same unit
/// @param options  threshold in this unit; there is no default: 0 is InvalidInput, except with
///   EstimateScoring::Lmeds, which needs none
/// @return the estimate; status InvalidInput where sizes differ, a number is not finite or an
/// option
///   is out of range, TooFewPoints for fewer than 3 matches, Degenerate as above, NoConsensus where
///   chance explains the inliers: always for 3
GSLAM_ESTIMATOR_EXPORT Rigid3DEstimate estimateRigid3D(Span<const Vec3d> first,
                                                       Span<const Vec3d> second,
                                                       const EstimateOptions& options);

}  // namespace v1
}  // namespace gslam

#endif  // GSLAM_ESTIMATOR_ESTIMATE_RIGID_3D_H
