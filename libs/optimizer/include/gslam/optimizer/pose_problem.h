#ifndef GSLAM_OPTIMIZER_POSE_PROBLEM_H
#define GSLAM_OPTIMIZER_POSE_PROBLEM_H

#include <gslam/base/span.h>
#include <gslam/geometry/camera.h>
#include <gslam/geometry/mat.h>
#include <gslam/geometry/se3.h>
#include <gslam/geometry/vec.h>
#include <gslam/optimizer/summary.h>

#include <cstddef>
#include <cstdint>

/// @file
/// The pose of a camera or rig from points that are known: motion-only bundle adjustment.

namespace gslam {
inline namespace v1 {

/// What is known about a pose before observations: the residual is log(T_prior^-1 T).
struct PosePrior {
  SE3d pose;                        ///< T_world_body
  Mat<double, 6, 6> information{};  ///< of the tangent (translation, rotation), on the right
};

/// Points of the world, and where they are seen. Views of arrays that somebody else owns.
///
/// Points that their camera does not see at the start are left out: for pinhole and radtan models
/// those not before the camera.
struct PoseProblem {
  Span<const Vec3d> points;  ///< n, world coordinates, metres
  Span<const Vec2d> pixels;  ///< n, where they are seen
  /// Of pixels, per squared pixel: none: 1. Or n of them.
  Span<const double> information;
  /// n u-coordinates in the right image of a rectified stereo pair with `baseline`, NaN where there
  /// is none; or none at all. They may lie beside the image: so a depth image can stand for a
  /// second camera, as far away as suits its noise.
  Span<const double> right_u;
  double baseline = 0;                  ///< metres, of right_u
  Span<const Camera> cameras;           ///< one or more
  Span<const SE3d> T_body_camera;       ///< one for each camera; none: all are the body
  Span<const std::uint32_t> camera_of;  ///< n, the camera of each observation; none: the first one
  const PosePrior* prior = nullptr;     ///< may be null
  Span<std::uint8_t> inliers;  ///< n results: 1 where the weight under the loss is at least a half;
                               ///< or none
};

/// A pose that was optimised.
struct OptimizedPose {
  SE3d T_world_body;                                 ///< the result; the start where not usable
  OptimizerStatus status = OptimizerStatus::Failed;  ///< why it ended
  bool is_usable =
      false;  ///< whether the pose is finite, determined, and costs no more than the start
  double initial_cost = 0;       ///< as OptimizerSummary
  double final_cost = 0;         ///< as OptimizerSummary
  std::size_t iterations = 0;    ///< steps tried
  std::size_t observations = 0;  ///< seen by their cameras at the start
  std::size_t inliers = 0;       ///< with a weight of at least a half
  /// Inverse of the normal equations at the result: of the tangent (translation, rotation) on the
  /// right, where information is the inverse of the variance. Zero where not usable.
  Mat<double, 6, 6> covariance{};
};

/// The pose that explains the observations best, near a start. Allocates nothing with the pba back
/// end.
/// @param problem       the observations; at least three, or a prior
/// @param T_world_body  where to start
/// @param options       loss, tolerances, iterations, back end
/// @return the pose, how it went, how uncertain it is
/// @throws ArgumentError for sizes that differ, a camera that is not there, a number that is not
///   finite, an information that is negative, or when no back end can do it
GSLAM_OPTIMIZER_EXPORT OptimizedPose optimizePose(const PoseProblem& problem,
                                                  const SE3d& T_world_body,
                                                  const OptimizerOptions& options = {});

}  // namespace v1
}  // namespace gslam

#endif  // GSLAM_OPTIMIZER_POSE_PROBLEM_H
