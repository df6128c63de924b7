#ifndef GSLAM_OPTIMIZER_CERES_SRC_FAR_POINTS_H
#define GSLAM_OPTIMIZER_CERES_SRC_FAR_POINTS_H

#include <ceres/evaluation_callback.h>

#include <cstddef>
#include <vector>

#include "bundle_variables.h"
#include "loss_function.h"
#include "observation_cost.h"

// Anchored points that are as far as they can be.

namespace gslam {
inline namespace v1 {
namespace detail {
namespace by_ceres {

// Ceres calls it before it evaluates residuals. Once hold() was called, it takes the inverse
// distances out of each linearisation that have come to their end, and whose slope leads beyond it:
// steps of all others would count on what cannot be.
class FarPoints : public ceres::EvaluationCallback {
 public:
  FarPoints(BundleVariables& variables, const SharedLoss& loss)
      : variables_(variables), loss_(loss) {}

  // Makes an observation of an anchored point known. The cost function must stay where it is.
  void add(std::size_t point, const ObservationCost& cost, const ObservationBlocks& blocks);
  void hold() { is_holding_ = true; }

  void PrepareForEvaluation(bool evaluate_jacobians, bool new_evaluation_point) override;

 private:
  struct Observation {
    const ObservationCost* cost;
    ObservationBlocks blocks;
  };
  double slope(const std::vector<Observation>& observations) const;

  BundleVariables& variables_;
  const SharedLoss& loss_;
  std::vector<std::vector<Observation>> observations_;  // of each point; none: none is anchored
  bool is_holding_ = false;
};

}  // namespace by_ceres
}  // namespace detail
}  // namespace v1
}  // namespace gslam

#endif  // GSLAM_OPTIMIZER_CERES_SRC_FAR_POINTS_H
