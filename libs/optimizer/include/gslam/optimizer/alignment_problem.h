#ifndef GSLAM_OPTIMIZER_ALIGNMENT_PROBLEM_H
#define GSLAM_OPTIMIZER_ALIGNMENT_PROBLEM_H

#include <gslam/base/span.h>
#include <gslam/geometry/mat.h>
#include <gslam/geometry/se3.h>
#include <gslam/geometry/sim3.h>
#include <gslam/geometry/vec.h>
#include <gslam/optimizer/summary.h>

/// @file
/// A transform between two sets of points, planes, lines or poses: a step of ICP, and the fit of
/// two trajectories.

namespace gslam {
inline namespace v1 {

/// What corresponds in frames `a` and `b`; the transform T_a_b is searched for. All parts may be
/// given together. Views of arrays that somebody else owns.
struct AlignmentProblem {
  /// Points of b, and where they are in a: residual T_a_b p_b - p_a.
  Span<const Vec3d> points_b;
  Span<const Vec3d> points_a;           ///< as many
  Span<const Mat3d> point_information;  ///< of the residual, in a; none: the identity
  /// Points of b, and planes of a (unit normal, offset), n p + d = 0, that they lie on: residual
  /// n (T_a_b p_b) + d.
  Span<const Vec3d> plane_points_b;
  Span<const Vec4d> planes_a;            ///< as many
  Span<const double> plane_information;  ///< none: 1
  /// Points of b, and lines of a (point, unit direction) that they lie on: residual is the offset
  /// from the line, 3 numbers.
  Span<const Vec3d> line_points_b;
  Span<const Vec3d> line_origins_a;     ///< as many
  Span<const Vec3d> line_directions_a;  ///< as many, of length 1
  Span<const double> line_information;  ///< none: 1
  /// Poses of a body in b, and of the same body in a: residual log(T_a_body^-1 T_a_b T_b_body),
  /// with the scale taken off the rotation.
  Span<const SE3d> T_b_body;
  Span<const SE3d> T_a_body;                       ///< as many
  Span<const Mat<double, 6, 6>> pose_information;  ///< none: the identity
};

/// A transform that was optimised.
/// @tparam Group  SE3d or SIM3d
template <class Group>
struct OptimizedAlignment {
  Group T_a_b;               ///< the result; the start where not usable
  OptimizerSummary summary;  ///< how it went
  /// Inverse of the normal equations at the result, of the tangent on the right. Zero where not
  /// usable or not determined: along what nothing determines the transform is that of the start.
  typename Group::Jacobian covariance{};
};

/// The transform that brings b onto a best, near a start.
///
/// What nothing determines stays as at the start. What is determined badly goes where noise takes
/// it, as far as the covariance says: along a floor of planes that are nearly parallel it may be
/// metres. A pose holds it: T_b_body and T_a_body that agree at the start, with an information of
/// how well the start is known.
/// @param problem  what corresponds
/// @param T_a_b    where to start
/// @param options  loss (of each correspondence), tolerances, iterations, back end
/// @return the transform, how it went, how uncertain it is
/// @throws ArgumentError for sizes that differ, a number that is not finite, a normal or direction
///   that is not of length 1, an information that is not positive semi-definite, nothing to align,
///   or when no back end can do it
GSLAM_OPTIMIZER_EXPORT OptimizedAlignment<SE3d> optimizeAlignment(
    const AlignmentProblem& problem, const SE3d& T_a_b, const OptimizerOptions& options = {});
/// The same with a scale.
/// @param problem  what corresponds
/// @param T_a_b    where to start
/// @param options  as above
/// @return as above
/// @throws ArgumentError as above
GSLAM_OPTIMIZER_EXPORT OptimizedAlignment<SIM3d> optimizeAlignment(
    const AlignmentProblem& problem, const SIM3d& T_a_b, const OptimizerOptions& options = {});

}  // namespace v1
}  // namespace gslam

#endif  // GSLAM_OPTIMIZER_ALIGNMENT_PROBLEM_H
