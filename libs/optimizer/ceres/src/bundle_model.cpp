#include "bundle_model.h"

#include <algorithm>
#include <cmath>

namespace gslam {
inline namespace v1 {
namespace detail {
namespace by_ceres {

BundleModel::BundleModel(const BundleProblem& problem, const OptimizerOptions& options)
    : variables_(problem),
      loss_(options.loss),
      far_points_(variables_, loss_),
      problem_(problemOptions(&far_points_)) {
  variables_.addTo(problem_);
  addObservations();
  addPriors();
  plan_.reduced_size = variables_.reducedFreedom();
}

void BundleModel::addObservations() {
  const BundleProblem& problem = variables_.problem();
  const std::size_t n = problem.pixels.size();
  is_used_.assign(n, 0);
  is_point_used_.assign(problem.points.size(), 0);
  for (std::size_t i = 0; i < n; ++i) {
    double squared_norm = 0;
    if (plainSquaredNorm(problem, i, squared_norm)) addObservation(i, squared_norm);
  }
}

void BundleModel::addObservation(std::size_t index, double squared_norm) {
  const ObservationBlocks blocks = blocksOf(variables_, index);
  is_used_[index] = 1;
  ++observations_;
  const BundleProblem& problem = variables_.problem();
  residuals_ += !problem.right_u.empty() && !std::isnan(problem.right_u[index]) ? 3 : 2;
  if (blocks.count == 0) {
    double rho[3];
    loss_.Evaluate(squared_norm, rho);
    plan_.constant_cost += rho[0] / 2;
    return;
  }
  const std::size_t j = problem.observation_point[index];
  if (blocks.point >= 0 && is_point_used_[j] == 0) {
    is_point_used_[j] = 1;
    variables_.addPoint(j, problem_);
    plan_.eliminated.push_back(blocks.blocks[blocks.point].data);
  }
  double* data[5];
  for (int i = 0; i < blocks.count; ++i) data[i] = blocks.blocks[i].data;
  problem_.AddResidualBlock(costOf(index, blocks), loss_.orNull(), data, blocks.count);
}

ceres::CostFunction* BundleModel::costOf(std::size_t index, const ObservationBlocks& blocks) {
  if (isPlain(variables_, index, blocks)) {
    PlainCost& cost = plain_costs_.emplace_back();
    cost.set(variables_, index, blocks);
    return &cost;
  }
  ObservationCost& cost = observation_costs_.emplace_back();
  cost.set(variables_, index, blocks);
  variables_.wantCamera(variables_.cameraOf(index));
  const std::size_t j = variables_.problem().observation_point[index];
  if (variables_.isAnchored(j)) far_points_.add(j, cost, blocks);
  return &cost;
}

PoseEnd BundleModel::endOf(std::size_t pose) const {
  const Block& block = variables_.pose(pose);
  if (block.data != nullptr) return {block.data, block.ambient};
  return {variables_.problem().T_world_body[pose].data(), 0};
}

void BundleModel::appendBlock(const PoseEnd& end, std::vector<double*>& blocks) {
  if (end.ambient != 0) blocks.push_back(const_cast<double*>(end.data));
}

template <class Cost>
void BundleModel::addPrior(Cost& cost, std::vector<double*> blocks) {
  residuals_ += static_cast<std::size_t>(cost.num_residuals());
  if (blocks.empty()) {
    plan_.constant_cost += cost.squaredNorm() / 2;
  } else if (cost.num_residuals() > 0) {
    problem_.AddResidualBlock(&cost, nullptr, blocks.data(), static_cast<int>(blocks.size()));
  }
}

void BundleModel::addPriors() {
  const BundleProblem& problem = variables_.problem();
  for (const PositionPrior& prior : problem.position_priors) {
    std::vector<double*> blocks;
    appendBlock(endOf(prior.pose), blocks);
    addPrior(position_costs_.emplace_back(prior, endOf(prior.pose)), blocks);
  }
  const PoseEnd world = {identity_.data(), 0};
  for (const AbsolutePosePrior& prior : problem.pose_priors) {
    std::vector<double*> blocks;
    appendBlock(endOf(prior.pose), blocks);
    EdgeCost<SE3d>& cost = edge_costs_.emplace_back();
    cost.set(PoseGraphResidual::Logarithm, world, endOf(prior.pose), prior.T_world_body,
             prior.information);
    addPrior(cost, blocks);
  }
  for (const RelativePosePrior& prior : problem.relative_priors) {
    std::vector<double*> blocks;
    appendBlock(endOf(prior.from), blocks);
    appendBlock(endOf(prior.to), blocks);
    EdgeCost<SE3d>& cost = edge_costs_.emplace_back();
    cost.set(PoseGraphResidual::Logarithm, endOf(prior.from), endOf(prior.to), prior.T_from_to,
             prior.information);
    addPrior(cost, blocks);
  }
  for (std::size_t i = 0; i < problem.window_priors.size(); ++i) {
    if (problem.window_priors[i].poses.empty()) continue;  // says nothing
    std::vector<PoseEnd> ends;
    std::vector<double*> blocks;
    for (const std::uint32_t pose : problem.window_priors[i].poses) {
      ends.push_back(endOf(pose));
      appendBlock(ends.back(), blocks);
    }
    const std::string name = "window_priors[" + std::to_string(i) + "]";
    WindowCost& cost = window_costs_.emplace_back(problem.window_priors[i], ends, name);
    addPrior(cost, blocks);
    plan_.constant_cost += cost.constant();
  }
}

std::vector<double*> BundleModel::freeBlocks() const {
  std::vector<double*> blocks;
  problem_.GetParameterBlocks(&blocks);
  return blocks;
}

void BundleModel::fillCounts(OptimizerSummary& summary) const {
  const BundleProblem& problem = variables_.problem();
  summary.observations = observations_;
  summary.left_out = problem.pixels.size() - observations_;
  summary.residuals = residuals_;
  summary.parameters = variables_.reducedFreedom() + variables_.pointFreedom();
  summary.inliers = observations_;
  if (loss_.isSquared()) return;
  summary.inliers = 0;
  for (std::size_t i = 0; i < problem.pixels.size(); ++i) {
    double squared_norm = 0;
    if (is_used_[i] == 0 || !plainSquaredNorm(problem, i, squared_norm)) continue;
    summary.inliers += loss_.isInlier(squared_norm) ? 1 : 0;
  }
}

}  // namespace by_ceres
}  // namespace detail
}  // namespace v1
}  // namespace gslam
