#ifndef GSLAM_ESTIMATOR_SOLVERS_TRIANGULATE_MIDPOINT_H
#define GSLAM_ESTIMATOR_SOLVERS_TRIANGULATE_MIDPOINT_H

#include <gslam/estimator/export.h>
#include <gslam/geometry/se3.h>
#include <gslam/geometry/vec.h>

#include <cstddef>

/// @file
/// The point between two rays.

namespace gslam {
inline namespace v1 {

/// The midpoint of the shortest segment between two rays: the fastest way to a point, and the least
/// exact one where the distances to the cameras differ much. (R. Hartley, P. Sturm,
/// "Triangulation", CVIU 68(2), 1997, section 5.3; the depths by cross products as in S. H. Lee, J.
/// Civera, "Triangulation: Why Optimize?", BMVC 2019, equations 6 and 7, which keeps digits at
/// small parallax.)
///
/// Degenerate: 0 where the rays are parallel to 1e-12 radians, the nearest point of a ray is not in
/// front of its camera, or the point is not finite.
/// That limit of the parallax only keeps the arithmetic sound: noise of bearings is a million times
/// larger, so callers need a test of their own for points too far away.
///
/// Thread-safety: reentrant.
/// @param T_second_first  the motion, its translation in any unit
/// @param bearing_first   of length 1, in the first camera
/// @param bearing_second  of length 1, in the second camera
/// @param point_first     the point in the first camera, in the unit of the translation
/// @return the number of solutions, 0 or 1
GSLAM_ESTIMATOR_EXPORT std::size_t triangulateMidpoint(const SE3d& T_second_first,
                                                       const Vec3d& bearing_first,
                                                       const Vec3d& bearing_second,
                                                       Vec3d& point_first) noexcept;

}  // namespace v1
}  // namespace gslam

#endif  // GSLAM_ESTIMATOR_SOLVERS_TRIANGULATE_MIDPOINT_H
