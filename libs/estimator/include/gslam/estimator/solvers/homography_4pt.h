#ifndef GSLAM_ESTIMATOR_SOLVERS_HOMOGRAPHY_4PT_H
#define GSLAM_ESTIMATOR_SOLVERS_HOMOGRAPHY_4PT_H

#include <gslam/base/span.h>
#include <gslam/estimator/export.h>
#include <gslam/geometry/mat.h>
#include <gslam/geometry/vec.h>

#include <cstddef>

/// @file
/// The homography of four points.

namespace gslam {
inline namespace v1 {

/// The homography H with x_second ~ H x_first for exactly four pairs of points.
///
/// H is the product of the map from the triangle of the first three points to barycentric
/// coordinates, a diagonal matrix that makes the fourth point fit, and the way out to the second
/// triangle; without a division but for the norm. (R. Hartley, A. Zisserman, "Multiple View
/// Geometry", 2nd ed. 2004, section 4.1; the factors are those of the four-point basis of the
/// projective plane, section 2.)
///
/// Norm and sign: the Frobenius norm of H is 1, and the third coordinate of H x is positive for the
/// four points. The determinant is then positive where the plane is seen from the same side twice,
/// and negative where it is between the two cameras (or one image is mirrored).
///
/// Degenerate: 0 where three of the four are collinear in one of the images (the triangle's area
/// is below 1e-10 of the square of the points' extent), or where the four triangles do not all keep
/// or all change their orientation: no plane in front of both cameras does that. Coordinates that
/// are not finite, or beyond about 1e15, or less than 1e-15 apart, give 0.
///
/// Thread-safety: reentrant.
/// @param first           four points, normalised or in pixels
/// @param second          the same four in the second image
/// @param H_second_first  the homography
/// @return the number of solutions, 0 or 1
/// @throws ArgumentError when a span has not four elements
GSLAM_ESTIMATOR_EXPORT std::size_t homography4pt(Span<const Vec2d> first, Span<const Vec2d> second,
                                                 Mat3d& H_second_first);

}  // namespace v1
}  // namespace gslam

#endif  // GSLAM_ESTIMATOR_SOLVERS_HOMOGRAPHY_4PT_H
