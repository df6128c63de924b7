#ifndef GSLAM_ESTIMATOR_SOLVERS_RELATIVE_POSES_FROM_HOMOGRAPHY_H
#define GSLAM_ESTIMATOR_SOLVERS_RELATIVE_POSES_FROM_HOMOGRAPHY_H

#include <gslam/base/span.h>
#include <gslam/estimator/export.h>
#include <gslam/estimator/solvers/decompose_homography.h>
#include <gslam/geometry/mat.h>
#include <gslam/geometry/vec.h>

#include <array>
#include <cstddef>

/// @file
/// The motions of a homography that see the plane in front.

namespace gslam {
inline namespace v1 {

/// Those of the motions of decomposeHomography() for which the most matches see the plane in front
/// of both cameras; usually two, of which only other views or points beside the plane tell the
/// right one. (E. Malis, M. Vargas, INRIA RR-6303, 2007, section 4: the reference plane visibility
/// constraint.)
///
/// The sign of H is that for which more matches fit, so that the plane may be between the cameras.
///
/// Degenerate: 0 where decomposeHomography() gives 0, or no motion has more than half of the
/// matches in front of both.
///
/// Thread-safety: reentrant.
/// @param H_second_first  the homography, calibrated
/// @param first           n >= 1 bearings of any length, inliers of H for the most part
/// @param second          as many in the second camera
/// @param motions         what was found
/// @return the number of solutions, 0 to 4
/// @throws ArgumentError when there is no bearing or the sizes differ
GSLAM_ESTIMATOR_EXPORT std::size_t relativePosesFromHomography(
    const Mat3d& H_second_first, Span<const Vec3d> first, Span<const Vec3d> second,
    std::array<HomographyMotion, 4>& motions);

}  // namespace v1
}  // namespace gslam

#endif  // GSLAM_ESTIMATOR_SOLVERS_RELATIVE_POSES_FROM_HOMOGRAPHY_H
