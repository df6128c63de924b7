#ifndef GSLAM_ESTIMATOR_SOLVERS_SIMILARITY_3D_H
#define GSLAM_ESTIMATOR_SOLVERS_SIMILARITY_3D_H

#include <gslam/base/span.h>
#include <gslam/estimator/export.h>
#include <gslam/geometry/sim3.h>
#include <gslam/geometry/vec.h>

#include <cstddef>

/// @file
/// The similarity between two sets of points.

namespace gslam {
inline namespace v1 {

/// The similarity S with the least weighted sum of |x_second - S x_first|^2 for three or more pairs
/// of points.
///
/// The rotation is that of rigid3D(), the scale the one of least squares in the second set: S.
/// Umeyama, "Least-squares estimation of transformation parameters between two point patterns",
/// PAMI 13(4), 1991, equations 41 to 43. (It is not the symmetric scale of Horn 1987: with noise
/// the similarity from second to first is not the inverse.)
///
/// Degenerate: 0 where the rotation is not unique, see rigid3D(), or a result is
/// not finite.
///
/// Thread-safety: reentrant.
/// @param first           n >= 3 points, any unit
/// @param second          as many, any unit
/// @param S_second_first  the similarity
/// @param weights         of the squared distances, e.g. inverse variances; as many, or none: all
///   alike
/// @return the number of solutions, 0 or 1
/// @throws ArgumentError when there are fewer than three points or the sizes differ
GSLAM_ESTIMATOR_EXPORT std::size_t similarity3D(Span<const Vec3d> first, Span<const Vec3d> second,
                                                SIM3d& S_second_first,
                                                Span<const double> weights = {});

}  // namespace v1
}  // namespace gslam

#endif  // GSLAM_ESTIMATOR_SOLVERS_SIMILARITY_3D_H
