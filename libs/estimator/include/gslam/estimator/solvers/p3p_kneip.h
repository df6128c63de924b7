#ifndef GSLAM_ESTIMATOR_SOLVERS_P3P_KNEIP_H
#define GSLAM_ESTIMATOR_SOLVERS_P3P_KNEIP_H

#include <gslam/base/span.h>
#include <gslam/estimator/export.h>
#include <gslam/geometry/se3.h>
#include <gslam/geometry/vec.h>

#include <array>
#include <cstddef>

/// @file
/// The pose of a camera from three points, as Kneip, Scaramuzza and Siegwart find it.

namespace gslam {
inline namespace v1 {

/// The poses of a calibrated camera from which three known points are seen in three known
/// directions, by the angle between the plane of the points and that of the camera and two of them.
/// For comparisons: p3p() is faster and more exact.
///
/// Source: L. Kneip, D. Scaramuzza, R. Siegwart, "A Novel Parametrization of the
/// Perspective-Three-Point Problem for a Direct Computation of Absolute Camera Position and
/// Orientation", CVPR 2011: the quartic (11), the angle at the first point (9), the camera's place
/// (5). Other than there, the quartic is multiplied by the square of the third direction's height,
/// so that it stays finite; the first two points are those farthest apart; and every solution is
/// bettered on the three equations of distances.
///
/// Degenerate: as of p3p(). In addition directions in one plane lose digits, and of symmetric
/// configurations, where two solutions share a root, some may be missed.
///
/// Thread-safety: reentrant.
/// @param bearings        three unit directions in camera coordinates
/// @param points          the three points in world coordinates, metres
/// @param T_camera_world  the solutions; all points lie at positive depth along their bearings
/// @return the number of solutions, 0 to 4, each once
/// @throws ArgumentError when a span has not three elements
GSLAM_ESTIMATOR_EXPORT std::size_t p3pKneip(Span<const Vec3d> bearings, Span<const Vec3d> points,
                                            std::array<SE3d, 4>& T_camera_world);

}  // namespace v1
}  // namespace gslam

#endif  // GSLAM_ESTIMATOR_SOLVERS_P3P_KNEIP_H
