#ifndef GSLAM_ESTIMATOR_SOLVERS_P2P_KNOWN_VERTICAL_H
#define GSLAM_ESTIMATOR_SOLVERS_P2P_KNOWN_VERTICAL_H

#include <gslam/base/span.h>
#include <gslam/estimator/export.h>
#include <gslam/geometry/se3.h>
#include <gslam/geometry/vec.h>

#include <array>
#include <cstddef>

/// @file
/// The pose of a camera from two points, where the vertical is known.

namespace gslam {
inline namespace v1 {

/// The poses of a calibrated camera that knows where down is (roll and pitch, from an IMU or a
/// vanishing point) from which two known points are seen in two known directions.
///
/// The step between the points along the vertical is a linear equation in their two depths, its
/// length a quadratic one; the heading is the angle between the horizontal parts. Source of the
/// problem: Z. Kukelova, M. Bujnak, T. Pajdla, "Closed-form solutions to the minimal absolute pose
/// problems with known vertical direction", ACCV 2010, section 2.1.
///
/// Degenerate: points on one vertical (any heading does), and directions of which both are
/// horizontal, or both the same, or a gravity without length: no solution. Near them the heading
/// gets as uncertain as the condition of the problem says.
///
/// Thread-safety: reentrant.
/// @param bearings        two unit directions in camera coordinates
/// @param points          the two points in world coordinates, metres
/// @param gravity_camera  a direction of any length, such as gravity, in camera coordinates
/// @param gravity_world   the same in world coordinates
/// @param T_camera_world  the solutions; they take gravity_world to gravity_camera,
///   and both points lie at positive depth along their bearings
/// @return the number of solutions, 0 to 2
/// @throws ArgumentError when a span has not two elements
GSLAM_ESTIMATOR_EXPORT std::size_t p2pKnownVertical(Span<const Vec3d> bearings,
                                                    Span<const Vec3d> points,
                                                    const Vec3d& gravity_camera,
                                                    const Vec3d& gravity_world,
                                                    std::array<SE3d, 2>& T_camera_world);

}  // namespace v1
}  // namespace gslam

#endif  // GSLAM_ESTIMATOR_SOLVERS_P2P_KNOWN_VERTICAL_H
