#ifndef GSLAM_ESTIMATOR_SOLVERS_RELATIVE_POSE_FROM_ESSENTIAL_H
#define GSLAM_ESTIMATOR_SOLVERS_RELATIVE_POSE_FROM_ESSENTIAL_H

#include <gslam/base/span.h>
#include <gslam/estimator/export.h>
#include <gslam/geometry/mat.h>
#include <gslam/geometry/se3.h>
#include <gslam/geometry/vec.h>

#include <cstddef>

/// @file
/// The pose of an essential matrix that has the points in front.

namespace gslam {
inline namespace v1 {

/// The one of the four poses of an essential matrix that has the most points in front of both
/// views. It returns how many: not the number of solutions, but a count of points.
///
/// In front is said with angles, not with depths: a bearing of the second view must lie on the arc
/// from the turned bearing of the first to the translation. So it holds for bearings beyond 90
/// degrees, and points at infinity, for which the two are equal, count for both directions of the
/// translation.
///
/// Thread-safety: reentrant.
/// @param essential      essential matrix of any scale
/// @param first          bearings of length 1 in the first view
/// @param second         the bearings to the same points in the second view
/// @param T_second_first the pose, |t| = 1
/// @return how many points are in front; 0 where there is no pose
/// @throws ArgumentError when there are none, or not as many in both views
GSLAM_ESTIMATOR_EXPORT std::size_t relativePoseFromEssential(const Mat3d& essential,
                                                             Span<const Vec3d> first,
                                                             Span<const Vec3d> second,
                                                             SE3d& T_second_first);

}  // namespace v1
}  // namespace gslam

#endif  // GSLAM_ESTIMATOR_SOLVERS_RELATIVE_POSE_FROM_ESSENTIAL_H
