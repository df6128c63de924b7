#ifndef GSLAM_ESTIMATOR_SOLVERS_TRIANGULATE_LINEAR_H
#define GSLAM_ESTIMATOR_SOLVERS_TRIANGULATE_LINEAR_H

#include <gslam/estimator/export.h>
#include <gslam/geometry/se3.h>
#include <gslam/geometry/vec.h>

#include <cstddef>

/// @file
/// The point of two bearings by the direct linear transform.

namespace gslam {
inline namespace v1 {

/// The point whose homogeneous coordinates (X, w), of length 1, have the least
/// |bearing_first x X|^2 + |bearing_second x (R X + w t)|^2: the direct linear transform. (R.
/// Hartley, P. Sturm, "Triangulation", CVIU 68(2), 1997, section 5.1, linear-eigen, with cross
/// products for image coordinates.)
///
/// The 3 x 3 part of the eigenproblem has known eigenvectors, the sum, difference and cross product
/// of the bearings, so that one equation in the least eigenvalue is left. The result hangs on the
/// unit of the translation; give it length 1 where nothing speaks for another. triangulateOptimal()
/// is better in all but habit.
///
/// Degenerate: 0 where the rays are parallel to 1e-12 radians, the point is behind a camera, or not
/// finite.
/// That limit of the parallax only keeps the arithmetic sound: noise of bearings is a million times
/// larger, so callers need a test of their own for points too far away.
///
/// Thread-safety: reentrant.
/// @param T_second_first  the motion
/// @param bearing_first   of length 1, in the first camera
/// @param bearing_second  of length 1, in the second camera
/// @param point_first     the point in the first camera, in the unit of the translation
/// @return the number of solutions, 0 or 1
GSLAM_ESTIMATOR_EXPORT std::size_t triangulateLinear(const SE3d& T_second_first,
                                                     const Vec3d& bearing_first,
                                                     const Vec3d& bearing_second,
                                                     Vec3d& point_first) noexcept;

}  // namespace v1
}  // namespace gslam

#endif  // GSLAM_ESTIMATOR_SOLVERS_TRIANGULATE_LINEAR_H
