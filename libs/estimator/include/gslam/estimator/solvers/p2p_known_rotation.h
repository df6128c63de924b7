#ifndef GSLAM_ESTIMATOR_SOLVERS_P2P_KNOWN_ROTATION_H
#define GSLAM_ESTIMATOR_SOLVERS_P2P_KNOWN_ROTATION_H

#include <gslam/base/span.h>
#include <gslam/estimator/export.h>
#include <gslam/geometry/se3.h>
#include <gslam/geometry/so3.h>
#include <gslam/geometry/vec.h>

#include <cstddef>

/// @file
/// The place of a camera from two points, where its attitude is known.

namespace gslam {
inline namespace v1 {

/// The pose of a calibrated camera of known attitude (from an IMU) from which two known points are
/// seen in two known directions.
///
/// Each point says that the camera is on a line; four equations for three numbers. Of all places
/// it is the one whose squared distances from the two lines have the least sum, the middle between
/// the lines. Source: L. Kneip, M. Chli, R. Siegwart, "Robust Real-Time Visual Odometry with a
/// Single Camera and an IMU", BMVC 2011, section 3.2 (the two-point translation solver).
///
/// Degenerate: directions that are parallel to 1e-12 radians say nothing of the distance: no
/// solution.
///
/// Thread-safety: reentrant.
/// @param bearings        two unit directions in camera coordinates
/// @param points          the two points in world coordinates, metres
/// @param R_camera_world  the attitude, which takes world to camera coordinates
/// @param T_camera_world  written if there is a solution; R_camera_world and the translation, both
///   points at positive depth along their bearings
/// @return the number of solutions, 0 or 1
/// @throws ArgumentError when a span has not two elements
GSLAM_ESTIMATOR_EXPORT std::size_t p2pKnownRotation(Span<const Vec3d> bearings,
                                                    Span<const Vec3d> points,
                                                    const SO3d& R_camera_world,
                                                    SE3d& T_camera_world);

}  // namespace v1
}  // namespace gslam

#endif  // GSLAM_ESTIMATOR_SOLVERS_P2P_KNOWN_ROTATION_H
