#ifndef GSLAM_OPTIMIZER_TWO_VIEW_PROBLEM_H
#define GSLAM_OPTIMIZER_TWO_VIEW_PROBLEM_H

#include <gslam/base/span.h>
#include <gslam/geometry/camera.h>
#include <gslam/geometry/mat.h>
#include <gslam/geometry/se3.h>
#include <gslam/geometry/vec.h>
#include <gslam/optimizer/summary.h>

/// @file
/// The motion between two views and the inverse depths of what both see.

namespace gslam {
inline namespace v1 {

/// Matches of two images, each with an inverse depth in the first one. The point of match i is
/// unproject(first[i]) / inverse_depths[i] in the first camera; zero is at infinity. Views of
/// arrays that somebody else owns.
struct TwoViewProblem {
  Span<const Vec2d> first;         ///< n pixels of the first image, taken as exact directions
  Span<const Vec2d> second;        ///< n pixels of the second image
  Span<const double> information;  ///< of the second, per squared pixel; none: 1
  Camera first_camera;             ///< of the first image
  Camera second_camera;            ///< of the second image
  /// n variables: 1 / distance along the unit bearing from the first camera, per metre.
  Span<double> inverse_depths;
  /// Information about each inverse depth, such as of a depth camera, with the given value as its
  /// mean; none, or all 0: nothing is known, and the scale of the translation stays that of the
  /// start.
  Span<const double> depth_information;
};

/// A relative pose that was optimised.
struct OptimizedTwoView {
  SE3d T_first_second;       ///< the result; the start where not usable
  OptimizerSummary summary;  ///< how it went
  /// Of the pose's tangent on the right, with the depths marginalised out; without
  /// depth_information it has rank 5: nothing in the direction of the scale. Zero where not usable
  /// or not determined, as where all points are far.
  Mat<double, 6, 6> covariance{};
};

/// The motion and the depths that explain the second image best, near a start. Without
/// depth_information the length of the translation stays what it was.
/// @param problem         the matches; its inverse depths are variables
/// @param T_first_second  where to start: the pose of the second camera in the first
/// @param options         loss, tolerances, iterations, back end
/// @return the pose, how it went, how uncertain it is; the depths are written into the problem
/// @throws ArgumentError for sizes that differ, a pixel that its camera cannot unproject, a number
///   that is not finite, an inverse depth that is negative, a translation of zero without
///   depth_information above 0, fewer than 5 matches, or when no back end can do it
GSLAM_OPTIMIZER_EXPORT OptimizedTwoView optimizeTwoView(const TwoViewProblem& problem,
                                                        const SE3d& T_first_second,
                                                        const OptimizerOptions& options = {});

}  // namespace v1
}  // namespace gslam

#endif  // GSLAM_OPTIMIZER_TWO_VIEW_PROBLEM_H
