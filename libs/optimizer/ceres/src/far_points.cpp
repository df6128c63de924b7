#include "far_points.h"

namespace gslam {
inline namespace v1 {
namespace detail {
namespace by_ceres {

void FarPoints::add(std::size_t point, const ObservationCost& cost,
                    const ObservationBlocks& blocks) {
  observations_.resize(variables_.problem().points.size());
  observations_[point].push_back({&cost, blocks});
}

void FarPoints::PrepareForEvaluation(bool evaluate_jacobians, bool new_evaluation_point) {
  if (new_evaluation_point) variables_.prepareCameras();
  if (!is_holding_ || !evaluate_jacobians) return;
  for (std::size_t j = 0; j < observations_.size(); ++j) {
    if (observations_[j].empty()) continue;
    variables_.setHeld(j, false);
    if (variables_.isFarthest(j) && slope(observations_[j]) > 0) variables_.setHeld(j, true);
  }
}

// Of the cost, by the inverse distance.
double FarPoints::slope(const std::vector<Observation>& observations) const {
  double sum = 0;
  for (const Observation& seen : observations) {
    double residual[3] = {0, 0, 0}, by_point[12], rho[3];
    double* blocks[5] = {};
    double* jacobians[5] = {};
    for (int i = 0; i < seen.blocks.count; ++i) blocks[i] = seen.blocks.blocks[i].data;
    jacobians[seen.blocks.point] = by_point;
    if (!seen.cost->Evaluate(blocks, residual, jacobians)) return 0;
    double squared = 0, along = 0;
    for (int r = 0; r < seen.cost->num_residuals(); ++r) {
      squared += residual[r] * residual[r];
      along += residual[r] * by_point[4 * r + 2];
    }
    loss_.Evaluate(squared, rho);
    sum += rho[1] * along;
  }
  return sum;
}

}  // namespace by_ceres
}  // namespace detail
}  // namespace v1
}  // namespace gslam
