#ifndef GSLAM_ESTIMATOR_SOLVERS_ROTATION_2PT_H
#define GSLAM_ESTIMATOR_SOLVERS_ROTATION_2PT_H

#include <gslam/base/span.h>
#include <gslam/estimator/export.h>
#include <gslam/geometry/so3.h>
#include <gslam/geometry/vec.h>

#include <cstddef>

/// @file
/// The rotation between two sets of bearings.

namespace gslam {
inline namespace v1 {

/// The rotation R with the least sum of |x_second - R x_first|^2 for two or more pairs of bearings:
/// the motion of a camera that only turns. (G. Wahba, "A least squares estimate of satellite
/// attitude", SIAM Review 7(3), 1965.)
///
/// For two pairs it is closed form: the planes of the pairs are laid on each other, and the angle
/// errors shared; for more it is an eigenvector. Source: B. Horn, "Closed-form solution of absolute
/// orientation using unit quaternions", JOSA A 4(4), 1987, sections 4 and 5.
///
/// Degenerate: 0 where the bearings of one set are parallel or opposite (two: to 1e-8 radians,
/// more: to about 1e-6), or one is not finite.
///
/// Thread-safety: reentrant.
/// @param first           n >= 2 bearings; of another length than 1 they count for the product of
///   the lengths
/// @param second          as many
/// @param R_second_first  the rotation
/// @return the number of solutions, 0 or 1
/// @throws ArgumentError when there are fewer than two bearings or the sizes differ
GSLAM_ESTIMATOR_EXPORT std::size_t rotation2pt(Span<const Vec3d> first, Span<const Vec3d> second,
                                               SO3d& R_second_first);

}  // namespace v1
}  // namespace gslam

#endif  // GSLAM_ESTIMATOR_SOLVERS_ROTATION_2PT_H
