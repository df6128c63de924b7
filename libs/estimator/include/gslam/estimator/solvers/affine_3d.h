#ifndef GSLAM_ESTIMATOR_SOLVERS_AFFINE_3D_H
#define GSLAM_ESTIMATOR_SOLVERS_AFFINE_3D_H

#include <gslam/base/span.h>
#include <gslam/estimator/export.h>
#include <gslam/geometry/mat.h>
#include <gslam/geometry/vec.h>

#include <cstddef>

/// @file
/// The affine map of points of space.

namespace gslam {
inline namespace v1 {

/// The affine map A with x_second = A (x_first, 1) of four or more pairs of points: exact for four,
/// with the least sum of squared distances of the second points for more. (The normal equations of
/// centred points, as for the plane: R. Hartley, A. Zisserman, "Multiple View Geometry", 2nd ed.
/// 2004, section 4.4.8.)
///
/// Degenerate: 0 where the first points are coplanar (to about 1e-10 of their extent for four, 1e-6
/// for more) or a result is not finite. The second points may be: A is singular then.
///
/// Thread-safety: reentrant.
/// @param first           n >= 4 points, any unit
/// @param second          as many
/// @param A_second_first  the map, 3 x 4
/// @return the number of solutions, 0 or 1
/// @throws ArgumentError when there are fewer than four points or the sizes differ
GSLAM_ESTIMATOR_EXPORT std::size_t affine3D(Span<const Vec3d> first, Span<const Vec3d> second,
                                            Mat<double, 3, 4>& A_second_first);

}  // namespace v1
}  // namespace gslam

#endif  // GSLAM_ESTIMATOR_SOLVERS_AFFINE_3D_H
