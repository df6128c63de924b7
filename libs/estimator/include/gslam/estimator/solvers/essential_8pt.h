#ifndef GSLAM_ESTIMATOR_SOLVERS_ESSENTIAL_8PT_H
#define GSLAM_ESTIMATOR_SOLVERS_ESSENTIAL_8PT_H

#include <gslam/base/span.h>
#include <gslam/estimator/export.h>
#include <gslam/geometry/mat.h>
#include <gslam/geometry/vec.h>

#include <cstddef>

/// @file
/// Essential matrix of eight bearings or more.

namespace gslam {
inline namespace v1 {

/// The essential matrix of eight bearings or more in two views, second^T E first = 0, by linear
/// least squares, then replaced by the next essential matrix. Source: H. C. Longuet-Higgins, "A
/// computer algorithm for reconstructing a scene from two projections", Nature 293, 1981; R.
/// Hartley, A. Zisserman, "Multiple View Geometry", 2nd edition, 2004, section 11.7.3. Bearings
/// need no normalisation.
///
/// Degenerate: points in a plane or on another critical surface with both centres, and pure
/// rotation. For those take essential5pt().
///
/// Thread-safety: reentrant.
/// @param first     eight bearings or more, of length 1 or nearly so, in the first view
/// @param second    the bearings to the same points in the second view
/// @param essential the solution, with singular values 1, 1, 0, of any sign
/// @return 1, or 0 where an element is not finite or the solution has rank 1
/// @throws ArgumentError when there are fewer than eight, or not as many in both views
GSLAM_ESTIMATOR_EXPORT std::size_t essential8pt(Span<const Vec3d> first, Span<const Vec3d> second,
                                                Mat3d& essential);

}  // namespace v1
}  // namespace gslam

#endif  // GSLAM_ESTIMATOR_SOLVERS_ESSENTIAL_8PT_H
