#ifndef GSLAM_ESTIMATOR_SOLVERS_TRIANGULATE_OPTIMAL_H
#define GSLAM_ESTIMATOR_SOLVERS_TRIANGULATE_OPTIMAL_H

#include <gslam/estimator/export.h>
#include <gslam/geometry/se3.h>
#include <gslam/geometry/vec.h>

#include <cstddef>

/// @file
/// The point of two bearings with the least angular errors.

namespace gslam {
inline namespace v1 {

/// The point with the least sum of squared sines of the two angles between bearings and rays to the
/// point: best for noise that is alike in all directions of view. Closed form.
///
/// Source: S. H. Lee, J. Civera, "Closed-Form Optimal Two-View Triangulation Based on Angular
/// Errors", ICCV 2019, section 5 (L2). The epipolar plane's normal is the leading direction of the
/// two bearings' normals; here it comes from their 2 x 2 Gram matrix. The bearings are projected on
/// that plane, where they meet.
///
/// Degenerate: 0 where the corrected rays are parallel to 1e-12 radians, meet behind a camera, the
/// cameras coincide, or the point is not finite.
/// That limit of the parallax only keeps the arithmetic sound: noise of bearings is a million times
/// larger, so callers need a test of their own for points too far away.
///
/// Thread-safety: reentrant.
/// @param T_second_first  the motion, its translation in any unit
/// @param bearing_first   of length 1, in the first camera
/// @param bearing_second  of length 1, in the second camera
/// @param point_first     the point in the first camera, in the unit of the translation
/// @return the number of solutions, 0 or 1
GSLAM_ESTIMATOR_EXPORT std::size_t triangulateOptimal(const SE3d& T_second_first,
                                                      const Vec3d& bearing_first,
                                                      const Vec3d& bearing_second,
                                                      Vec3d& point_first) noexcept;

}  // namespace v1
}  // namespace gslam

#endif  // GSLAM_ESTIMATOR_SOLVERS_TRIANGULATE_OPTIMAL_H
