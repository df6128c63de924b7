#ifndef GSLAM_ESTIMATOR_SOLVERS_P3P_H
#define GSLAM_ESTIMATOR_SOLVERS_P3P_H

#include <gslam/base/span.h>
#include <gslam/estimator/export.h>
#include <gslam/geometry/se3.h>
#include <gslam/geometry/vec.h>

#include <array>
#include <cstddef>

/// @file
/// The pose of a camera from three points: the solver to take by default.

namespace gslam {
inline namespace v1 {

/// The poses of a calibrated camera from which three known points are seen in three known
/// directions.
///
/// The two conics of the depths' ratios meet where a degenerate conic of their pencil, two lines,
/// meets another. Source: Y. Ding, J. Yang, V. Larsson, C. Olsson, K. Astrom, "Revisiting the P3P
/// Problem", CVPR 2023, sections 3 and 4. Other than there, the pencil is written in the
/// differences of the depths, so that far points and narrow bundles of rays lose no digits; of the
/// degenerate conics the one farthest from the others is taken; and nearly collinear points get
/// steps of Newton's method on the pose itself.
///
/// Exactness: about epsilon times the condition of the problem. Distances of points count, not
/// their coordinates: an origin 1e6 metres away costs no digit of the camera's place or attitude
/// (but the translation, the world's origin as the camera sees it, moves with errors of the
/// rotation).
/// Degenerate: fewer than three different points or directions, and exactly collinear points, have
/// no isolated solutions: none are given, or some that fulfil the equations. A camera on the danger
/// cylinder, through the points and at right angles to their plane, is a double solution: exact to
/// about the square root of epsilon.
///
/// Thread-safety: reentrant.
/// @param bearings        three unit directions in camera coordinates
/// @param points          the three points in world coordinates, metres
/// @param T_camera_world  the solutions; all points lie at positive depth along their bearings
/// @return the number of solutions, 0 to 4
/// @throws ArgumentError when a span has not three elements
GSLAM_ESTIMATOR_EXPORT std::size_t p3p(Span<const Vec3d> bearings, Span<const Vec3d> points,
                                       std::array<SE3d, 4>& T_camera_world);

}  // namespace v1
}  // namespace gslam

#endif  // GSLAM_ESTIMATOR_SOLVERS_P3P_H
