#ifndef GSLAM_ESTIMATOR_SOLVERS_DECOMPOSE_ESSENTIAL_H
#define GSLAM_ESTIMATOR_SOLVERS_DECOMPOSE_ESSENTIAL_H

#include <gslam/estimator/export.h>
#include <gslam/geometry/mat.h>
#include <gslam/geometry/se3.h>

#include <array>
#include <cstddef>

/// @file
/// The poses of an essential matrix.

namespace gslam {
inline namespace v1 {

/// The four poses of an essential matrix, E = +-[t]x R up to scale: two rotations, a half turn
/// about t apart, each with t and -t.
///
/// With |t| = 1 and the matrix of cofactors C = t t^T R it is R = C -+ [t]x E. Source: B. Horn,
/// "Recovering baseline and orientation from essential matrix", 1990. A matrix that is not an
/// essential one is replaced by the next one first.
///
/// Thread-safety: reentrant.
/// @param essential     essential matrix of any scale
/// @param T_second_first the poses, |t| = 1
/// @return 4, or 0 where an element is not finite or the rank is 1 or less
GSLAM_ESTIMATOR_EXPORT std::size_t decomposeEssential(const Mat3d& essential,
                                                      std::array<SE3d, 4>& T_second_first) noexcept;

}  // namespace v1
}  // namespace gslam

#endif  // GSLAM_ESTIMATOR_SOLVERS_DECOMPOSE_ESSENTIAL_H
