#ifndef GSLAM_ESTIMATOR_SOLVERS_TRIANGULATE_VIEWS_H
#define GSLAM_ESTIMATOR_SOLVERS_TRIANGULATE_VIEWS_H

#include <gslam/base/span.h>
#include <gslam/estimator/export.h>
#include <gslam/geometry/se3.h>
#include <gslam/geometry/vec.h>

#include <cstddef>

/// @file
/// The point of bearings in two or more views.

namespace gslam {
inline namespace v1 {

/// The point with a least sum of squared chords between the bearings and the directions to the
/// point; a chord is the angle to third order. A local minimum, for rays that nearly meet; of rays
/// that do not, the point may be between minima.
///
/// It begins at the point with the least sum of squared distances to the rays, which is linear (the
/// sum of the projectors; S. Ramalingam, S. Lodha, P. Sturm, "A generic structure-from-motion
/// framework", CVIU 103(3), 2006, section 3.3), and takes at most ten steps of Gauss and Newton, as
/// long as the sum falls. The equations are set up along the mean of the rays, so that points far
/// away keep their digits.
///
/// Degenerate: 0 where all rays are parallel to about 1e-10 radians, the point is behind one of the
/// cameras, or not finite. That limit of the parallax only keeps the arithmetic sound: noise of
/// bearings is far larger, so callers need a test of their own for points too far away.
///
/// Thread-safety: reentrant.
/// @param T_camera_world  n >= 2 poses
/// @param bearings        as many, of length 1, each in its camera
/// @param point_world     the point
/// @return the number of solutions, 0 or 1
/// @throws ArgumentError when there are fewer than two views or the sizes differ
GSLAM_ESTIMATOR_EXPORT std::size_t triangulateViews(Span<const SE3d> T_camera_world,
                                                    Span<const Vec3d> bearings, Vec3d& point_world);

}  // namespace v1
}  // namespace gslam

#endif  // GSLAM_ESTIMATOR_SOLVERS_TRIANGULATE_VIEWS_H
