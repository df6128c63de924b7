#ifndef GSLAM_ESTIMATOR_SOLVERS_EPNP_H
#define GSLAM_ESTIMATOR_SOLVERS_EPNP_H

#include <gslam/base/span.h>
#include <gslam/estimator/export.h>
#include <gslam/geometry/se3.h>
#include <gslam/geometry/vec.h>

#include <cstddef>

/// @file
/// Absolute pose from four points or more, by control points.

namespace gslam {
inline namespace v1 {

/// The pose of a camera from n >= 4 points and the rays to them, by control points: the camera
/// coordinates of the centroid and of one point on each principal axis of the points are a
/// combination of null vectors, whose factors, the betas, are fitted to the distances between the
/// control points. O(n). sqpnp() is faster and finds the global minimum; this one is for
/// comparisons.
///
/// Source: V. Lepetit, F. Moreno-Noguer, P. Fua, "EPnP: an accurate O(n) solution to the PnP
/// problem", IJCV 81(2), 2009. Other than there, the centroid is eliminated beforehand (9 unknowns
/// instead of 12, at the same solutions), the distances from it and the right angles between the
/// axes stand for the six distances, all rays count by the distance of the point from the ray
/// instead of by pixels, and a descent to the minimum next to the result ends it. With two control
/// points beside the centroid, planes have their own way, which is tried as well when the points
/// are nearly in a plane (standard deviation across below 3 % of the whole).
///
/// Lost on exact data (error above 1e-6): none of 1e4 from 5 points on, nor of 4 points in a plane.
/// The four betas of 4 points outside of planes have many minima, which are looked for from twelve
/// directions: none of 1e4 of a box is lost, 0.5 % nearly on a line (1e-4), 5 % on a twisted cubic
/// through the camera. With noise and few points the minimum may not be the global one. None is
/// given when the points are on a line or all equal, when all rays are parallel, or when a number
/// is not finite.
///
/// @param bearings        unit vectors in camera coordinates, in any direction
/// @param points          metres, in world coordinates, as many; far from zero they lose nothing
/// @param T_camera_world  the pose, unchanged where there is none
/// @return how many poses were found, 0 or 1
/// @throws ArgumentError when there are fewer than 4 bearings, or another number of points
///
/// Thread-safety: reentrant.
GSLAM_ESTIMATOR_EXPORT std::size_t epnp(Span<const Vec3d> bearings, Span<const Vec3d> points,
                                        SE3d& T_camera_world);

}  // namespace v1
}  // namespace gslam

#endif  // GSLAM_ESTIMATOR_SOLVERS_EPNP_H
