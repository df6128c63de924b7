#ifndef GSLAM_ESTIMATOR_SOLVERS_ESSENTIAL_5PT_STEWENIUS_H
#define GSLAM_ESTIMATOR_SOLVERS_ESSENTIAL_5PT_STEWENIUS_H

#include <gslam/base/span.h>
#include <gslam/estimator/export.h>
#include <gslam/geometry/mat.h>
#include <gslam/geometry/vec.h>

#include <array>
#include <cstddef>

/// @file
/// Essential matrices of five bearings, after Stewenius, Engels and Nister.

namespace gslam {
inline namespace v1 {

/// The essential matrices of five bearings in two views, second^T E first = 0.
///
/// The named classic, for comparisons: the real eigenvectors of the 10 x 10 action matrix of a
/// Groebner basis; nothing is polished, and what is far from an essential matrix is left out.
/// essential5pt() is twice as fast and more exact.
///
/// Source: H. Stewenius, C. Engels, D. Nister, "Recent developments on direct relative
/// orientation", ISPRS J. 60(4), 2006.
///
/// Degenerate cases, scale and meaning of the solutions as for essential5pt().
///
/// Thread-safety: reentrant.
/// @param first      five bearings, of length 1 or nearly so, in the first view
/// @param second     the bearings to the same points in the second view
/// @param essentials the solutions, with singular values 1, 1, 0 but for their error
/// @return the number of solutions, 0 to 10; 0 where an element is not finite
/// @throws ArgumentError when a span has not five elements
GSLAM_ESTIMATOR_EXPORT std::size_t essential5ptStewenius(Span<const Vec3d> first,
                                                         Span<const Vec3d> second,
                                                         std::array<Mat3d, 10>& essentials);

}  // namespace v1
}  // namespace gslam

#endif  // GSLAM_ESTIMATOR_SOLVERS_ESSENTIAL_5PT_STEWENIUS_H
