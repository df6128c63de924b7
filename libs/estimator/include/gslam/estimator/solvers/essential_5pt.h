#ifndef GSLAM_ESTIMATOR_SOLVERS_ESSENTIAL_5PT_H
#define GSLAM_ESTIMATOR_SOLVERS_ESSENTIAL_5PT_H

#include <gslam/base/span.h>
#include <gslam/estimator/export.h>
#include <gslam/geometry/mat.h>
#include <gslam/geometry/vec.h>

#include <array>
#include <cstddef>

/// @file
/// Essential matrices of five bearings: the solver to take.

namespace gslam {
inline namespace v1 {

/// The essential matrices of five bearings in two views, second^T E first = 0.
///
/// The polynomial of Nister's method, and around it what makes it lose little: roots as ratios, so
/// that none is at infinity; every solution polished on all ten equations; and where the
/// elimination was ill-conditioned or a root needed much polishing, up to eight times more in a
/// turned basis. Source: D. Nister, "An efficient solution to the five-point relative pose
/// problem", PAMI 26(6), 2004, section 3.2.
///
/// Of cameras that face a scene from different sides it misses the true motion in fewer than one
/// of 10000 instances. Where the views are nearly the same, solutions lie close to each other, and
/// of two within 1e-7 or so neither may be found: the truth is missed by more than 1e-4 in up to 1
/// of 1000 instances of forward motion by a twentieth of the depth or of a car, 2 of 1000 at a
/// baseline of a thousandth of the depth, and 1 or 2 of 100 where that is seen in 10 degrees or of
/// a plane. Time rises with it, to ten times that of the usual scene.
///
/// The solutions are distinct: two within 1e-7 of each other are given as one. They have the
/// singular values 1, 1, 0 (Frobenius norm sqrt(2)), to rounding but where two are so near, and to
/// 1e-6 there; so E = +-[t]x R with |t| = 1. There are at most ten, on average four or five. The
/// sign of E means nothing.
///
/// Degenerate: equal bearings, or pure rotation, where every E = [t]x R with the right R is a
/// solution and some or none are found. Points in a plane, at infinity (with a translation that is
/// seen), and forward motion are not degenerate. A tiny baseline costs digits in proportion.
///
/// Thread-safety: reentrant.
/// @param first      five bearings, of length 1 or nearly so, in the first view
/// @param second     the bearings to the same points in the second view
/// @param essentials the solutions
/// @return the number of solutions, 0 to 10; 0 where an element is not finite
/// @throws ArgumentError when a span has not five elements
GSLAM_ESTIMATOR_EXPORT std::size_t essential5pt(Span<const Vec3d> first, Span<const Vec3d> second,
                                                std::array<Mat3d, 10>& essentials);

}  // namespace v1
}  // namespace gslam

#endif  // GSLAM_ESTIMATOR_SOLVERS_ESSENTIAL_5PT_H
