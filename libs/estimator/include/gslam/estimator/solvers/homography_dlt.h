#ifndef GSLAM_ESTIMATOR_SOLVERS_HOMOGRAPHY_DLT_H
#define GSLAM_ESTIMATOR_SOLVERS_HOMOGRAPHY_DLT_H

#include <gslam/base/span.h>
#include <gslam/estimator/export.h>
#include <gslam/geometry/mat.h>
#include <gslam/geometry/vec.h>

#include <cstddef>

/// @file
/// The homography of many points by linear least squares.

namespace gslam {
inline namespace v1 {

/// The homography H with x_second ~ H x_first of four or more pairs of points, by the direct linear
/// transform on normalised points.
///
/// The rows of H that give the numerators are linear in the third row and are eliminated, so that
/// the eigenvector of a 3 x 3 matrix is left. Source: M. Harker, P. O'Leary, "Computation of
/// Homographies", BMVC 2005. The points are normalised before (R. Hartley, "In defense of the
/// eight-point algorithm", PAMI 19(6), 1997): the second ones in position and scale, the first
/// ones in shape as well, which keeps all digits for long thin sets. What is minimised is
/// algebraic; for the least reprojection error begin here and iterate. Four pairs go to
/// homography4pt().
///
/// Norm and sign: the Frobenius norm of H is 1, and the third coordinate of H x is positive for the
/// mean of the first points.
///
/// Degenerate: 0 where the points do not determine H: all, or all but one, on a line, or fewer than
/// four different ones; and where a coordinate is not finite, or absurd.
///
/// Thread-safety: reentrant.
/// @param first           n >= 4 points, normalised or in pixels
/// @param second          as many in the second image
/// @param H_second_first  the homography
/// @return the number of solutions, 0 or 1
/// @throws ArgumentError when there are fewer than four points or the sizes differ
GSLAM_ESTIMATOR_EXPORT std::size_t homographyDlt(Span<const Vec2d> first, Span<const Vec2d> second,
                                                 Mat3d& H_second_first);

}  // namespace v1
}  // namespace gslam

#endif  // GSLAM_ESTIMATOR_SOLVERS_HOMOGRAPHY_DLT_H
