#ifndef GSLAM_ESTIMATOR_SOLVERS_RELATIVE_POSE_3PT_VERTICAL_H
#define GSLAM_ESTIMATOR_SOLVERS_RELATIVE_POSE_3PT_VERTICAL_H

#include <gslam/base/span.h>
#include <gslam/estimator/export.h>
#include <gslam/geometry/se3.h>
#include <gslam/geometry/vec.h>

#include <array>
#include <cstddef>

/// @file
/// The relative pose of three matches where the vertical is known.

namespace gslam {
inline namespace v1 {

/// The relative poses T with x_second^T [t]x R x_first = 0 for exactly three matches, of cameras
/// that know the direction of gravity: a turn about it and the direction of the translation are
/// left, four solutions at most.
///
/// Source: F. Fraundorfer, P. Tanskanen, M. Pollefeys, "A minimal case solution to the calibrated
/// relative pose problem for the case of two known orientation angles", ECCV 2010; the translation
/// is eliminated first, as by C. Sweeney, J. Flynn, M. Turk, "Solving for relative pose with a
/// partially known rotation is a quadratic eigenvalue problem", 3DV 2014. The determinant of the
/// three equations is then a trigonometric polynomial of second order in the angle, whose half
/// tangent, counted from where the determinant is far from 0, solves a quartic.
///
/// Cheirality is checked: all three points are in front of both cameras. |t| = 1.
///
/// Degenerate: none or any for the true turn where the cameras did not move, and where the three
/// points are on a line with a camera or in the plane of it and the baseline; a bearing along
/// gravity says nothing about the angle, but is no obstacle.
///
/// Thread-safety: reentrant.
/// @param first           three bearings of length 1
/// @param second          the same three in the second camera
/// @param gravity_first   direction of gravity, or its opposite, in the first camera; of any length
/// @param gravity_second  the same direction in the second camera
/// @param T_second_first  what was found
/// @return the number of solutions, 0 to 4
/// @throws ArgumentError when a span has not three elements
GSLAM_ESTIMATOR_EXPORT std::size_t relativePose3ptVertical(Span<const Vec3d> first,
                                                           Span<const Vec3d> second,
                                                           const Vec3d& gravity_first,
                                                           const Vec3d& gravity_second,
                                                           std::array<SE3d, 4>& T_second_first);

}  // namespace v1
}  // namespace gslam

#endif  // GSLAM_ESTIMATOR_SOLVERS_RELATIVE_POSE_3PT_VERTICAL_H
