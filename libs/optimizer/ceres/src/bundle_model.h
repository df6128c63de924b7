#ifndef GSLAM_OPTIMIZER_CERES_SRC_BUNDLE_MODEL_H
#define GSLAM_OPTIMIZER_CERES_SRC_BUNDLE_MODEL_H

#include <cstddef>
#include <cstdint>
#include <deque>
#include <memory>
#include <string>
#include <vector>

#include "bundle_variables.h"
#include "far_points.h"
#include "loss_function.h"
#include "observation_cost.h"
#include "plain_cost.h"
#include "prior_costs.h"
#include "solve.h"

// A bundle as Ceres' problem.

namespace gslam {
inline namespace v1 {
namespace detail {
namespace by_ceres {

// Cost functions lie in a few arrays. Residuals without a variable are not made known to Ceres:
// their cost is added to what it finds.
class BundleModel {
 public:
  BundleModel(const BundleProblem& problem, const OptimizerOptions& options);

  ceres::Problem& problem() { return problem_; }
  BundleVariables& variables() { return variables_; }
  // For a search: steps end where inverse distances do.
  void holdFarPoints() { far_points_.hold(); }
  // plan() has no start.
  const SearchPlan& plan() const { return plan_; }
  // Blocks that residuals depend on.
  std::vector<double*> freeBlocks() const;
  // Whether a residual depends on a point that is free.
  bool isPointUsed(std::size_t i) const { return is_point_used_[i] != 0; }
  // Sizes and counts; inliers with what stands in the arrays of the problem.
  void fillCounts(OptimizerSummary& summary) const;

 private:
  void addObservations();
  void addObservation(std::size_t index, double squared_norm);
  ceres::CostFunction* costOf(std::size_t index, const ObservationBlocks& blocks);
  void addPriors();
  // Adds the cost of a residual that is not known to Ceres where `blocks` are none.
  template <class Cost>
  void addPrior(Cost& cost, std::vector<double*> blocks);
  PoseEnd endOf(std::size_t pose) const;
  static void appendBlock(const PoseEnd& end, std::vector<double*>& blocks);

  BundleVariables variables_;
  SharedLoss loss_;
  FarPoints far_points_;
  SearchPlan plan_;
  std::deque<PlainCost> plain_costs_;
  std::deque<ObservationCost> observation_costs_;
  std::deque<EdgeCost<SE3d>> edge_costs_;
  std::deque<PositionCost> position_costs_;
  std::deque<WindowCost> window_costs_;
  std::vector<std::uint8_t> is_used_;        // of observations
  std::vector<std::uint8_t> is_point_used_;  // by a residual known to Ceres
  std::size_t observations_ = 0, residuals_ = 0;
  SE3d identity_;
  ceres::Problem problem_;  // last: it dies first
};

}  // namespace by_ceres
}  // namespace detail
}  // namespace v1
}  // namespace gslam

#endif  // GSLAM_OPTIMIZER_CERES_SRC_BUNDLE_MODEL_H
