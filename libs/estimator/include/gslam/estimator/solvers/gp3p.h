#ifndef GSLAM_ESTIMATOR_SOLVERS_GP3P_H
#define GSLAM_ESTIMATOR_SOLVERS_GP3P_H

#include <gslam/base/span.h>
#include <gslam/estimator/export.h>
#include <gslam/geometry/se3.h>
#include <gslam/geometry/vec.h>

#include <array>
#include <cstddef>

/// @file
/// The pose of a rig of cameras from three points.

namespace gslam {
inline namespace v1 {

/// The poses of a rig (several cameras, or any camera without one centre) in which three known
/// points lie on three known rays.
///
/// The three distances of the points are quadrics in the depths along the rays; two depths are
/// eliminated, and the first is a root of a polynomial of degree eight: D. Nister, H. Stewenius, "A
/// Minimal Solution to the Generalised 3-Point Pose Problem", JMIV 27, 2007, sections 3 and 4 (by
/// other eliminations); the problem also in L. Kneip, P. Furgale, R. Siegwart, "Using Multi-Camera
/// Systems in Robotics", ICRA 2013. The roots are sought by Descartes' rule in Bernstein's basis,
/// between the depths beyond which two rays are farther apart than their points.
///
/// Rays that start in one place are those of a camera: p3p() is asked. Two of three may share
/// theirs.
/// Degenerate: collinear points, and parallel rays: no solution, or some that fulfil the equations.
///
/// Thread-safety: reentrant.
/// @param origins      where the three rays start, in rig coordinates, metres
/// @param bearings     their unit directions, in rig coordinates
/// @param points       the three points in world coordinates, metres
/// @param T_rig_world  all points lie at positive depth along their
///   rays
/// @return the number of solutions, 0 to 8
/// @throws ArgumentError when a span has not three elements
GSLAM_ESTIMATOR_EXPORT std::size_t gp3p(Span<const Vec3d> origins, Span<const Vec3d> bearings,
                                        Span<const Vec3d> points, std::array<SE3d, 8>& T_rig_world);

}  // namespace v1
}  // namespace gslam

#endif  // GSLAM_ESTIMATOR_SOLVERS_GP3P_H
