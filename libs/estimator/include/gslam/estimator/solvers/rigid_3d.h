#ifndef GSLAM_ESTIMATOR_SOLVERS_RIGID_3D_H
#define GSLAM_ESTIMATOR_SOLVERS_RIGID_3D_H

#include <gslam/base/span.h>
#include <gslam/estimator/export.h>
#include <gslam/geometry/se3.h>
#include <gslam/geometry/vec.h>

#include <cstddef>

/// @file
/// The rigid transform between two sets of points.

namespace gslam {
inline namespace v1 {

/// The rigid transform T with the least weighted sum of |x_second - T x_first|^2 for three or more
/// pairs of points.
///
/// The rotation is the quaternion that is the eigenvector of the largest eigenvalue of a symmetric
/// 4 x 4 matrix; for three pairs, which lie in planes, it is closed form. Source: B. Horn,
/// "Closed-form solution of absolute orientation using unit quaternions", JOSA A 4(4), 1987,
/// sections 3 to 5. It is a rotation for mirrored sets, too.
///
/// Degenerate: 0 where the rotation is not unique. One of the sets is collinear (for three to 1e-8,
/// else to about 1e-6 of its extent), or the second is a mirror image as thick as it is wide; also
/// where a coordinate is not finite or absurd, or a weight is negative, not finite, or zero for all
/// but two points.
///
/// Thread-safety: reentrant.
/// @param first           n >= 3 points, any unit
/// @param second          as many, in the same unit
/// @param T_second_first  the transform
/// @param weights         of the squared distances, e.g. inverse variances; as many, or none: all
///   alike
/// @return the number of solutions, 0 or 1
/// @throws ArgumentError when there are fewer than three points or the sizes differ
GSLAM_ESTIMATOR_EXPORT std::size_t rigid3D(Span<const Vec3d> first, Span<const Vec3d> second,
                                           SE3d& T_second_first, Span<const double> weights = {});

}  // namespace v1
}  // namespace gslam

#endif  // GSLAM_ESTIMATOR_SOLVERS_RIGID_3D_H
