#ifndef GSLAM_ESTIMATOR_SOLVERS_AFFINE_2D_H
#define GSLAM_ESTIMATOR_SOLVERS_AFFINE_2D_H

#include <gslam/base/span.h>
#include <gslam/estimator/export.h>
#include <gslam/geometry/mat.h>
#include <gslam/geometry/vec.h>

#include <cstddef>

/// @file
/// The affine map of points of the plane.

namespace gslam {
inline namespace v1 {

/// The affine map A with x_second = A (x_first, 1) of three or more pairs of points: exact for
/// three, with the least sum of squared distances in the second image for more. (R. Hartley,
/// A. Zisserman, "Multiple View Geometry", 2nd ed. 2004, section 4.4.8; here the errors are in the
/// second image only, which makes it a linear problem.)
///
/// Degenerate: 0 where the first points are collinear (to about 1e-10 of their extent for three,
/// 1e-6 for more) or a result is not finite. The second points may be: A is singular then.
///
/// Thread-safety: reentrant.
/// @param first           n >= 3 points, any unit
/// @param second          as many
/// @param A_second_first  the map, 2 x 3
/// @return the number of solutions, 0 or 1
/// @throws ArgumentError when there are fewer than three points or the sizes differ
GSLAM_ESTIMATOR_EXPORT std::size_t affine2D(Span<const Vec2d> first, Span<const Vec2d> second,
                                            Mat<double, 2, 3>& A_second_first);

}  // namespace v1
}  // namespace gslam

#endif  // GSLAM_ESTIMATOR_SOLVERS_AFFINE_2D_H
