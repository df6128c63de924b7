#ifndef GSLAM_ESTIMATOR_SOLVERS_DECOMPOSE_HOMOGRAPHY_H
#define GSLAM_ESTIMATOR_SOLVERS_DECOMPOSE_HOMOGRAPHY_H

#include <gslam/estimator/export.h>
#include <gslam/geometry/mat.h>
#include <gslam/geometry/se3.h>
#include <gslam/geometry/vec.h>

#include <array>
#include <cstddef>

/// @file
/// The motions that a homography allows.

namespace gslam {
inline namespace v1 {

/// A motion and the plane that was seen: H ~ R + t n^T, the plane being n x = 1 in the first
/// camera.
///
/// Thread-safety: plain data.
struct HomographyMotion {
  SE3d T_second_first;   ///< its translation in units of the plane's distance from the first camera
  Vec3d normal_first{};  ///< n, of length 1, from the first camera towards the plane; zero where
                         ///< the camera only turned
};

/// The motions and planes of a homography between bearings or normalised points: four, as two pairs
/// that differ in the sign of translation and normal. Two where the camera moved along the normal.
/// One, without a plane, where it only turned: the translation is below 1e-9 of the distance.
///
/// The directions that H / s, s its middle singular value, leaves at their length span two planes;
/// each is the scene's for one pair. Source: Y. Ma, S. Soatto, J. Kosecka, S. Sastry, "An
/// Invitation to 3-D Vision", 2004, section 5.3.3; E. Malis, M. Vargas, "Deeper understanding of
/// the homography decomposition for vision-based control", INRIA RR-6303, 2007, for the conditions.
///
/// The scale of H does not count, nor does its sign: the cameras are taken to be on the same side
/// of the plane, where the determinant is above 0. See relativePosesFromHomography() to sort out.
///
/// Degenerate: 0 where H has rank 1 or 0, or an element is not finite. Where the camera moved
/// nearly along the normal, half of the digits are lost.
///
/// Thread-safety: reentrant.
/// @param H_second_first  the homography, calibrated
/// @param motions         what was found
/// @return the number of solutions, 0, 1, 2 or 4
GSLAM_ESTIMATOR_EXPORT std::size_t decomposeHomography(
    const Mat3d& H_second_first, std::array<HomographyMotion, 4>& motions) noexcept;

}  // namespace v1
}  // namespace gslam

#endif  // GSLAM_ESTIMATOR_SOLVERS_DECOMPOSE_HOMOGRAPHY_H
