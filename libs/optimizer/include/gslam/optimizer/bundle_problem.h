#ifndef GSLAM_OPTIMIZER_BUNDLE_PROBLEM_H
#define GSLAM_OPTIMIZER_BUNDLE_PROBLEM_H

#include <gslam/base/span.h>
#include <gslam/geometry/camera.h>
#include <gslam/geometry/mat.h>
#include <gslam/geometry/se3.h>
#include <gslam/geometry/vec.h>
#include <gslam/optimizer/summary.h>

#include <cstddef>
#include <cstdint>
#include <limits>
#include <vector>

/// @file
/// Bundle adjustment: poses, points, and cameras from what was seen where.

namespace gslam {
inline namespace v1 {

/// Which parameters of a Camera are variables.
struct CameraFreedom {
  std::uint32_t parameters = 0;  ///< bit i is set: parameter i of Camera::parameters() is free
  /// fy follows fx with the ratio that they have at the start, and bit 1 is ignored. Nothing to
  /// models without fx and fy, such as ocam.
  bool keeps_aspect = false;
};

/// Something known about the position of a body, such as from GPS: residual p_world_body -
/// position.
struct PositionPrior {
  std::uint32_t pose = 0;  ///< which one
  Vec3d position{};        ///< metres, world
  Mat3d information{};     ///< of the residual
};

/// Something known about a pose: residual log(T_prior^-1 T).
struct AbsolutePosePrior {
  std::uint32_t pose = 0;           ///< which one
  SE3d T_world_body;                ///< the prior
  Mat<double, 6, 6> information{};  ///< of the tangent (translation, rotation) on the right
};

/// A measured pose of one body in another: residual log(T_from_to^-1 T_from^-1 T_to).
struct RelativePosePrior {
  std::uint32_t from = 0;           ///< pose
  std::uint32_t to = 0;             ///< pose
  SE3d T_from_to;                   ///< as measured
  Mat<double, 6, 6> information{};  ///< of the tangent on the right
};

/// A joint prior on several poses, such as marginalize() makes: cost 1/2 d^T H d + b^T d with d the
/// stacked tangents log(T_linear^-1 T).
struct WindowPrior {
  std::vector<std::uint32_t> poses;  ///< n of them
  std::vector<SE3d> T_linear;        ///< n, where it was linearised
  std::vector<double> information;   ///< H, (6 n x 6 n), row by row
  std::vector<double> gradient;      ///< b, 6 n
};

/// Poses, points and cameras, and what was seen where: structure of arrays, views of memory that
/// somebody else owns (see Bundle). The variables are written in place.
///
/// A pixel is predicted by cameras[c].project((T_world_body[p] T_body_camera[c])^-1 X). Pinhole and
/// radtan models are evaluated by their formulas wherever a point is not in the plane of the
/// camera, as other bundle adjusters do; where another model does not see the point at the start,
/// the observation is left out and counted.
struct BundleProblem {
  /// @{
  /// Variables
  Span<SE3d> T_world_body;              ///< poses
  Span<const std::uint8_t> pose_fixed;  ///< 1 for each pose that is none; empty: all are variables
  Span<Vec3d> points;  ///< world coordinates, metres; see point_anchor for how they are varied
  Span<const std::uint8_t>
      point_fixed;  ///< 1 for each point that is none; empty: all are variables
  /// For each point the pose that it is anchored to: the variables are the direction (2) and
  /// inverse distance (1) from that body as it moves, which suits far points: they end at
  /// 1e10 m, or where they start if that is farther. kNoAnchor: x, y, z. Empty: all are x, y, z.
  Span<const std::uint32_t> point_anchor;
  Span<Camera> cameras;                         ///< intrinsics; any observations may share one
  Span<const CameraFreedom> camera_freedom;     ///< for each camera; empty: all are fixed
  Span<SE3d> T_body_camera;                     ///< for each camera; empty: each is the body
  Span<const std::uint8_t> T_body_camera_free;  ///< 1 for each that is a variable; empty: none is
  /// @}
  /// @{
  /// Observations, n of each
  Span<const std::uint32_t> observation_pose;    ///< indices of poses
  Span<const std::uint32_t> observation_point;   ///< indices of points
  Span<const std::uint32_t> observation_camera;  ///< indices of cameras; empty: all are the first
  Span<const Vec2d> pixels;                      ///< where the points were seen
  Span<const Vec3d> information;  ///< xx, xy, yy of the inverse covariance of a pixel; empty: 1 0 1
  /// u in the right image of a rectified pair, NaN where there is none; empty: none anywhere. Its
  /// information is xx.
  Span<const double> right_u;
  Span<const double> baseline;  ///< metres, of each camera, where right_u is given
  /// @}
  /// @{
  /// What else is known
  Span<const PositionPrior> position_priors;      ///< GPS
  Span<const AbsolutePosePrior> pose_priors;      ///< poses
  Span<const RelativePosePrior> relative_priors;  ///< odometry, between two poses
  Span<const WindowPrior> window_priors;          ///< what marginalize() left
  /// @}

  /// In point_anchor: no anchor.
  static constexpr std::uint32_t kNoAnchor = std::numeric_limits<std::uint32_t>::max();
};

/// The poses, points and cameras that explain the observations best, near those given, which are
/// the start and are overwritten.
///
/// Where nothing fixes position, orientation or scale of the whole, they stay near what they were:
/// damping does not move them; a warning says so.
/// @param problem  variables and observations
/// @param options  loss, tolerances, iterations, linear solver, back end
/// @return how it went
/// @throws ArgumentError for what checkBundle() calls an error, and when no back end can do it
GSLAM_OPTIMIZER_EXPORT OptimizerSummary optimizeBundle(const BundleProblem& problem,
                                                       const OptimizerOptions& options = {});

/// Half the sum of rho over all residuals, as OptimizerSummary::final_cost, computed in double by
/// the plain formulas: the reference of all back ends. What a camera does not see now is free;
/// final_cost leaves out what was not seen at the start. They differ where an observation was left
/// out and is seen in the end (see OptimizerSummary::left_out): to solve again takes it in.
/// @param problem  as it is now
/// @param loss     of observations
/// @return the cost; an observation that its camera does not see costs nothing
/// @throws ArgumentError as optimizeBundle()
GSLAM_OPTIMIZER_EXPORT double bundleCost(const BundleProblem& problem, const RobustLoss& loss = {});

}  // namespace v1
}  // namespace gslam

#endif  // GSLAM_OPTIMIZER_BUNDLE_PROBLEM_H
