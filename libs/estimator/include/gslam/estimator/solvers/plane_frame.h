#ifndef GSLAM_ESTIMATOR_SOLVERS_PLANE_FRAME_H
#define GSLAM_ESTIMATOR_SOLVERS_PLANE_FRAME_H

#include <gslam/estimator/export.h>
#include <gslam/geometry/se3.h>
#include <gslam/geometry/vec.h>

#include <cstddef>

/// @file
/// A plane as a frame.

namespace gslam {
inline namespace v1 {

/// The pose of a frame that has the plane as its x y plane: z is the normal, the origin the foot of
/// a point on the plane, x and y those of the world turned with z by the shortest way (half a turn
/// about x where z is opposite).
///
/// Degenerate: 0 where the normal has no direction, or a number is not finite.
///
/// Thread-safety: reentrant.
/// @param plane          (n, d) with n x + d = 0; n need not have length 1
/// @param near_point     e.g. the mean of the plane's inliers, in the unit of d / |n|
/// @param T_world_plane  the frame
/// @return the number of solutions, 0 or 1
GSLAM_ESTIMATOR_EXPORT std::size_t planeFrame(const Vec4d& plane, const Vec3d& near_point,
                                              SE3d& T_world_plane) noexcept;

}  // namespace v1
}  // namespace gslam

#endif  // GSLAM_ESTIMATOR_SOLVERS_PLANE_FRAME_H
