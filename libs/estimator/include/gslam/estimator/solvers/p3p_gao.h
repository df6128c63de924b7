#ifndef GSLAM_ESTIMATOR_SOLVERS_P3P_GAO_H
#define GSLAM_ESTIMATOR_SOLVERS_P3P_GAO_H

#include <gslam/base/span.h>
#include <gslam/estimator/export.h>
#include <gslam/geometry/se3.h>
#include <gslam/geometry/vec.h>

#include <array>
#include <cstddef>

/// @file
/// The pose of a camera from three points, as Gao, Hou, Tang and Cheng find it.

namespace gslam {
inline namespace v1 {

/// The poses of a calibrated camera from which three known points are seen in three known
/// directions, by the quartic in the ratio of two depths. For comparisons: p3p() is faster and more
/// exact.
///
/// Source: X. Gao, X. Hou, J. Tang, H. Cheng, "Complete Solution Classification for the
/// Perspective-Three-Point Problem", PAMI 25(8), 2003: the main branch of the zero decomposition,
/// section 3, of the system (2). Where the other branches begin, because the equation that is
/// linear in the second ratio vanishes, the quadratic one is solved; every solution is bettered on
/// the three equations of distances.
///
/// Degenerate: as of p3p(). In addition far points lose digits, and of symmetric configurations,
/// whose quartic has double roots, some solutions may be missed.
///
/// Thread-safety: reentrant.
/// @param bearings        three unit directions in camera coordinates
/// @param points          the three points in world coordinates, metres
/// @param T_camera_world  the solutions; all points lie at positive depth along their bearings
/// @return the number of solutions, 0 to 4, each once
/// @throws ArgumentError when a span has not three elements
GSLAM_ESTIMATOR_EXPORT std::size_t p3pGao(Span<const Vec3d> bearings, Span<const Vec3d> points,
                                          std::array<SE3d, 4>& T_camera_world);

}  // namespace v1
}  // namespace gslam

#endif  // GSLAM_ESTIMATOR_SOLVERS_P3P_GAO_H
