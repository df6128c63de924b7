#ifndef GSLAM_ESTIMATOR_SOLVERS_FUNDAMENTAL_8PT_H
#define GSLAM_ESTIMATOR_SOLVERS_FUNDAMENTAL_8PT_H

#include <gslam/base/span.h>
#include <gslam/estimator/export.h>
#include <gslam/geometry/mat.h>
#include <gslam/geometry/vec.h>

#include <cstddef>

/// @file
/// Fundamental matrix of eight points or more.

namespace gslam {
inline namespace v1 {

/// The fundamental matrix of eight points or more in two views, second^T F first = 0, by linear
/// least squares: the normalised eight-point algorithm. Source: R. Hartley, "In defense of the
/// eight-point algorithm", PAMI 19(6), 1997. The least singular value is set to 0 in the normalised
/// coordinates.
///
/// The matrix of the equations is triangulated and not squared, so that no digits are lost; for
/// eight points its null vector is enough.
///
/// Degenerate: points in a plane or on another critical surface with both centres, and pure
/// rotation: the result is one of many, or has nothing to say.
///
/// Thread-safety: reentrant.
/// @param first       eight points or more of the first view, normalised or in pixels
/// @param second      the same points in the second view
/// @param fundamental the solution, of rank 2 and Frobenius norm 1; the sign means nothing
/// @return 1, or 0 where an element is not finite
/// @throws ArgumentError when there are fewer than eight, or not as many in both views
GSLAM_ESTIMATOR_EXPORT std::size_t fundamental8pt(Span<const Vec2d> first, Span<const Vec2d> second,
                                                  Mat3d& fundamental);

}  // namespace v1
}  // namespace gslam

#endif  // GSLAM_ESTIMATOR_SOLVERS_FUNDAMENTAL_8PT_H
