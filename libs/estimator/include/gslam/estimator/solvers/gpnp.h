#ifndef GSLAM_ESTIMATOR_SOLVERS_GPNP_H
#define GSLAM_ESTIMATOR_SOLVERS_GPNP_H

#include <gslam/base/span.h>
#include <gslam/estimator/export.h>
#include <gslam/geometry/se3.h>
#include <gslam/geometry/vec.h>

#include <array>
#include <cstddef>

/// @file
/// Absolute pose of a rig of cameras from four points or more.

namespace gslam {
inline namespace v1 {

/// The pose of a rig of cameras, or of any other set of rays, from n >= 4 points: the minimum of
/// the sum of the squared distances of the points from their rays, in metres.
///
/// The problem is that of the paper; the way is another one, the way of sqpnp(), whose quadratic
/// form of the rotation has a linear part for a rig. The relaxed problem is a trust region problem
/// of six unknowns; where it does not prove that nothing is left, the rotations of an icosahedron
/// are more places to start from. O(n).
///
/// Source: L. Kneip, P. Furgale, R. Siegwart, "Using multi-camera systems in robotics: efficient
/// solutions to the NPnP problem", ICRA 2013. For the form: G. Terzakis, M. Lourakis, "A
/// consistently fast and globally optimal solution to the perspective-n-point problem", ECCV 2020.
///
/// Four points are the fewest of which the pose is unique in general (three have up to eight: take
/// a minimal solver). Planes, cameras with one centre (all origins equal, or nearly) and bearings
/// in all directions are right, too. With 4 or 5 points that are not in a plane nothing proves that
/// the minimum is the global one; it is missed in about one of 10 000 cases (of points nearly on a
/// line, 1e-4, in one of 60).
///
/// Several minima are given when the others cost at most four times the least. None is given when
/// the points are on a line or all equal, when all rays are parallel, when a number is not finite,
/// or when most points would be behind.
///
/// @param origins      where the rays start, metres, in rig coordinates
/// @param bearings     unit vectors along the rays, in rig coordinates, as many
/// @param points       metres, in world coordinates, as many; far from zero they lose nothing
/// @param T_rig_world  the poses, from the least cost on
/// @return how many poses were found, 0 to 4
/// @throws ArgumentError when there are fewer than 4 bearings, or another number of origins or
///   points
///
/// Thread-safety: reentrant.
GSLAM_ESTIMATOR_EXPORT std::size_t gpnp(Span<const Vec3d> origins, Span<const Vec3d> bearings,
                                        Span<const Vec3d> points, std::array<SE3d, 4>& T_rig_world);

}  // namespace v1
}  // namespace gslam

#endif  // GSLAM_ESTIMATOR_SOLVERS_GPNP_H
