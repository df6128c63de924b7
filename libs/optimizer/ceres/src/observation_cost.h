#ifndef GSLAM_OPTIMIZER_CERES_SRC_OBSERVATION_COST_H
#define GSLAM_OPTIMIZER_CERES_SRC_OBSERVATION_COST_H

#include <ceres/cost_function.h>
#include <factors/bundle_terms.h>

#include <cstddef>
#include <cstdint>

#include "bundle_variables.h"

// Residuals of the observations of a bundle.

namespace gslam {
inline namespace v1 {
namespace detail {
namespace by_ceres {

struct WeightedObservation {
  ReprojectionObservation seen;
  PixelRoot root;
};

WeightedObservation weightedObservation(const BundleProblem& problem, std::size_t index);

// The squared norm of the whitened residual with what stands in the problem. False where it is not
// seen.
bool plainSquaredNorm(const BundleProblem& problem, std::size_t index, double& squared_norm);

// The blocks that an observation depends on, in the order of its cost function.
struct ObservationBlocks {
  Block blocks[5];
  int count = 0;
  // Places in `blocks`; -1: not a variable.
  std::int8_t pose = -1, point = -1, camera = -1, extrinsic = -1, anchor = -1;
  // The point is anchored to the very pose that sees it, which then does not matter.
  bool is_own_anchor = false;
};

ObservationBlocks blocksOf(const BundleVariables& variables, std::size_t index);

// Any observation. Views what it needs in the problem.
class ObservationCost : public ceres::CostFunction {
 public:
  void set(const BundleVariables& variables, std::size_t index, const ObservationBlocks& blocks);
  bool Evaluate(double const* const* parameters, double* residuals,
                double** jacobians) const override;

 private:
  struct Point;
  Point pointAt(double const* const* parameters, const SE3d& T_world_body) const;
  SE3d poseAt(int place, double const* const* parameters, std::size_t index) const;
  void setJacobians(const WeightedObservation& weighted, const Point& point,
                    ReprojectionJacobians& raw, double** jacobians) const;

  const BundleVariables* variables_ = nullptr;
  std::uint32_t index_ = 0;
  std::int8_t pose_ = -1, point_ = -1, camera_ = -1, extrinsic_ = -1, anchor_ = -1;
  bool is_own_anchor_ = false;
};

}  // namespace by_ceres
}  // namespace detail
}  // namespace v1
}  // namespace gslam

#endif  // GSLAM_OPTIMIZER_CERES_SRC_OBSERVATION_COST_H
