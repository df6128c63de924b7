#ifndef GSLAM_ESTIMATOR_SOLVERS_ESSENTIAL_5PT_NISTER_H
#define GSLAM_ESTIMATOR_SOLVERS_ESSENTIAL_5PT_NISTER_H

#include <gslam/base/span.h>
#include <gslam/estimator/export.h>
#include <gslam/geometry/mat.h>
#include <gslam/geometry/vec.h>

#include <array>
#include <cstddef>

/// @file
/// Essential matrices of five bearings, after Nister.

namespace gslam {
inline namespace v1 {

/// The essential matrices of five bearings in two views, second^T E first = 0.
///
/// The named classic, for comparisons: elimination, the determinant of a 3 x 3 matrix of
/// polynomials, the real roots of degree ten by signs and Sturm's chain; nothing is polished, and
/// what is far from an essential matrix is left out. (Not as published: roots are ratios, so that
/// none is at infinity.) It misses the truth by more than 1e-6 in a few of a thousand usual
/// instances, where the elimination or the polynomial is ill-conditioned, and by more than 1e-4 in
/// 7 of 100 of forward motion by a twentieth of the depth and half of those with a baseline of a
/// thousandth of it, nearly all if the points are in a plane; essential5pt() loses far fewer, and
/// takes as long for usual scenes.
///
/// Source: D. Nister, "An efficient solution to the five-point relative pose problem", PAMI 26(6),
/// 2004.
///
/// Degenerate cases, scale and meaning of the solutions as for essential5pt().
///
/// Thread-safety: reentrant.
/// @param first      five bearings, of length 1 or nearly so, in the first view
/// @param second     the bearings to the same points in the second view
/// @param essentials the solutions, with singular values 1, 1, 0 but for their error
/// @return the number of solutions, 0 to 10; 0 where an element is not finite
/// @throws ArgumentError when a span has not five elements
GSLAM_ESTIMATOR_EXPORT std::size_t essential5ptNister(Span<const Vec3d> first,
                                                      Span<const Vec3d> second,
                                                      std::array<Mat3d, 10>& essentials);

}  // namespace v1
}  // namespace gslam

#endif  // GSLAM_ESTIMATOR_SOLVERS_ESSENTIAL_5PT_NISTER_H
