#ifndef GSLAM_ESTIMATOR_SOLVERS_ROTATION_5PT_KNEIP_H
#define GSLAM_ESTIMATOR_SOLVERS_ROTATION_5PT_KNEIP_H

#include <gslam/base/span.h>
#include <gslam/estimator/export.h>
#include <gslam/geometry/so3.h>
#include <gslam/geometry/vec.h>

#include <array>
#include <cstddef>

/// @file
/// Rotations of five bearings, without the translation.

namespace gslam {
inline namespace v1 {

/// The rotations between two views of five bearings, found directly: those for which the normals of
/// the epipolar planes, n_i = (R first_i) x second_i, lie in one plane. Source: L. Kneip, R.
/// Siegwart, M. Pollefeys, "Finding the exact rotation between two images independently of the
/// translation", ECCV 2012, equations 5 to 8.
///
/// The conditions are the paper's, the way to solve them is not. There they are cubics in the
/// elements of R, solved with a Groebner basis of 66 polynomials. Here R is a unit quaternion q.
/// That a t is at right angles to all n_i is bilinear in q and r = t q; the six such equations
/// (with r q = 0) have an r where all fifteen minors of a 6 x 4 matrix linear in q are zero, which
/// are quartics whose 20 solutions are the eigenvectors of a 20 x 20 action matrix. Each solution
/// is polished, and comes with its partner, a half turn about t away, which solves the same
/// equations.
///
/// Half of the rotations have the points behind one view. The translation is the direction at right
/// angles to all n_i. Degenerate: pure rotation (the n_i of the right R are zero), and equal
/// bearings. essential5pt() finds the same motions four times faster or more.
///
/// Thread-safety: reentrant.
/// @param first                  five bearings, of length 1 or nearly so, in the first view
/// @param second                 the bearings to the same points in the second view
/// @param rotations_second_first the rotations, distinct to 1e-7; each of an even place before its
///   partner
/// @return the number of rotations, even, 0 to 20; 0 where an element is not finite
/// @throws ArgumentError when a span has not five elements
GSLAM_ESTIMATOR_EXPORT std::size_t rotation5ptKneip(Span<const Vec3d> first,
                                                    Span<const Vec3d> second,
                                                    std::array<SO3d, 20>& rotations_second_first);

}  // namespace v1
}  // namespace gslam

#endif  // GSLAM_ESTIMATOR_SOLVERS_ROTATION_5PT_KNEIP_H
