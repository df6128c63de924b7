#ifndef GSLAM_ESTIMATOR_SOLVERS_PLANE_H
#define GSLAM_ESTIMATOR_SOLVERS_PLANE_H

#include <gslam/base/span.h>
#include <gslam/estimator/export.h>
#include <gslam/geometry/vec.h>

#include <cstddef>

/// @file
/// The plane of points.

namespace gslam {
inline namespace v1 {

/// The plane with the least sum of squared distances to three or more points: through three, and
/// through the mean of more, at right angles to the direction in which they spread least. (K.
/// Pearson, "On lines and planes of closest fit to systems of points in space", Phil. Mag. 2,
/// 1901.)
///
/// The plane is (n, d) with n x + d = 0 for its points x and |n| = 1. Sign: d >= 0, so that the
/// origin is on the side to which n points; where the plane goes through the origin, either.
///
/// Degenerate: 0 where the points are collinear (three to 1e-8, more to about 1e-7 of their
/// extent), or spread alike in all directions to rounding, or a coordinate is not finite or absurd.
///
/// Thread-safety: reentrant.
/// @param points  n >= 3 points, any unit
/// @param plane   the plane, its fourth element in the unit of the points
/// @return the number of solutions, 0 or 1
/// @throws ArgumentError when there are fewer than three points
GSLAM_ESTIMATOR_EXPORT std::size_t planeFromPoints(Span<const Vec3d> points, Vec4d& plane);

}  // namespace v1
}  // namespace gslam

#endif  // GSLAM_ESTIMATOR_SOLVERS_PLANE_H
