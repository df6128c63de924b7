#ifndef GSLAM_ESTIMATOR_SOLVERS_FUNDAMENTAL_7PT_H
#define GSLAM_ESTIMATOR_SOLVERS_FUNDAMENTAL_7PT_H

#include <gslam/base/span.h>
#include <gslam/estimator/export.h>
#include <gslam/geometry/mat.h>
#include <gslam/geometry/vec.h>

#include <array>
#include <cstddef>

/// @file
/// Fundamental matrices of seven points.

namespace gslam {
inline namespace v1 {

/// The fundamental matrices of seven points in two views, second^T F first = 0.
///
/// The two matrices that span the null space of the seven equations, and the cubic det(F) = 0 on
/// the line through them, whose leading term is chosen so that no root is at infinity. Source: R.
/// Hartley, A. Zisserman, "Multiple View Geometry", 2nd edition, 2004, section 11.1.2. Points of
/// any unit and size: they are normalised inside (R. Hartley, "In defense of the eight-point
/// algorithm", PAMI 19(6), 1997).
///
/// Degenerate: points in a plane or pure rotation, where there is a family of solutions, of which
/// up to three are found; fewer than seven distinct points.
///
/// Thread-safety: reentrant.
/// @param first        seven points of the first view, normalised or in pixels
/// @param second       the same points in the second view
/// @param fundamentals the solutions, distinct, of rank 2, Frobenius norm 1 and any sign
/// @return the number of solutions, 0 to 3 (1 or 3 but for double ones); 0 where an element is not
///   finite
/// @throws ArgumentError when a span has not seven elements
GSLAM_ESTIMATOR_EXPORT std::size_t fundamental7pt(Span<const Vec2d> first, Span<const Vec2d> second,
                                                  std::array<Mat3d, 3>& fundamentals);

}  // namespace v1
}  // namespace gslam

#endif  // GSLAM_ESTIMATOR_SOLVERS_FUNDAMENTAL_7PT_H
