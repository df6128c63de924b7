#ifndef GSLAM_OPTIMIZER_PBA_SRC_SMALL_POSE_COST_H
#define GSLAM_OPTIMIZER_PBA_SRC_SMALL_POSE_COST_H

#include <gslam/optimizer/pose_problem.h>

#include <cstddef>

#include "small/dense.h"
#include "small/pose_tiles.h"

// The cost of a pose, with its normal equations. Nothing is allocated.

namespace gslam {
inline namespace v1 {
namespace detail {
namespace pba {

struct PoseValue {
  double cost = 0;  // not finite where there is none
  SmallEquations<6> equations;
  std::size_t seen = 0;
  std::size_t inliers = 0;
};

// What the normal equations take of a robust loss: its weights, or its second derivative too, with
// which steps converge quadratically near the minimum, and which may be indefinite elsewhere.
enum class PoseCurvature { Weights, Full };

// Points behind their camera at the start, and points that a model other than pinhole and radtan
// does not see from there, are left out of all costs. Later on pinhole and radtan are evaluated by
// their formulas on both sides of the plane of the camera, as in bundle adjustment.
class PoseCost {
 public:
  PoseCost(const PoseProblem& problem, const SE3d& start, const RobustLoss& loss);

  // with_flags: also writes problem.inliers.
  PoseValue at(const SE3d& T_world_body, PoseCurvature curvature, bool with_flags = false);

 private:
  const PoseProblem& problem_;
  const RobustLoss& robust_loss_;
  PoseTiles tiles_;
};

}  // namespace pba
}  // namespace detail
}  // namespace v1
}  // namespace gslam

#endif  // GSLAM_OPTIMIZER_PBA_SRC_SMALL_POSE_COST_H
