#ifndef GSLAM_ESTIMATOR_SOLVERS_SQPNP_H
#define GSLAM_ESTIMATOR_SOLVERS_SQPNP_H

#include <gslam/base/span.h>
#include <gslam/estimator/export.h>
#include <gslam/geometry/se3.h>
#include <gslam/geometry/vec.h>

#include <array>
#include <cstddef>

/// @file
/// Absolute pose from three points or more, by the global optimum of a least squares cost.

namespace gslam {
inline namespace v1 {

/// The pose of a camera from n >= 3 points and the rays to them: the global minimum of the sum of
/// the squared distances of the points from their rays, in metres. The solver to take for n points.
///
/// The cost is a quadratic form of the nine elements of the rotation. It is searched as in the
/// paper, minima of a relaxed problem first and then a descent on the rotations from each, but: the
/// relaxed problem leaves the shortest principal axis of the points free (6 unknowns instead of 9,
/// and planes are no special case), the descents are Newton's on the rotations themselves instead
/// of sequential quadratic programs, and where the relaxed problem does not prove that nothing is
/// left, the solutions of triples of points are more places to start from. Last, a step of
/// Gauss-Newton on the rays gives back the digits that the squares took. All points have their say
/// once a pass: O(n).
///
/// Source: G. Terzakis, M. Lourakis, "A consistently fast and globally optimal solution to the
/// perspective-n-point problem", ECCV 2020 (equations 7 to 9 for the form).
///
/// Bearings may have any direction, more than 90 degrees from z, too, and need not be of one half
/// space. A distance in metres gives far points more weight than an error in pixels does: refine by
/// reprojection where that matters.
///
/// Several minima are given when the others cost at most four times the least: three points have up
/// to four poses; few points or far planes, with noise, often two. With n >= 4 points in general
/// position and little noise it is one. None is given when the points are on a line or all equal,
/// when all rays are parallel, when a number is not finite, or when most points would be behind.
/// Of points nearly on a line (1e-4) the minima that are given may not be all.
///
/// @param bearings        unit vectors in camera coordinates
/// @param points          metres, in world coordinates, as many; far from zero they lose nothing
/// @param T_camera_world  the poses, from the least cost on
/// @return how many poses were found, 0 to 4
/// @throws ArgumentError when there are fewer than 3 bearings, or another number of points
///
/// Thread-safety: reentrant.
GSLAM_ESTIMATOR_EXPORT std::size_t sqpnp(Span<const Vec3d> bearings, Span<const Vec3d> points,
                                         std::array<SE3d, 4>& T_camera_world);

}  // namespace v1
}  // namespace gslam

#endif  // GSLAM_ESTIMATOR_SOLVERS_SQPNP_H
