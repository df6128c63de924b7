#include <algorithm>
#include <exception>
#include <memory>
#include <vector>

#include "block_covariance.h"
#include "edge_cost.h"
#include "known_point_cost.h"
#include "loss_function.h"
#include "manifolds.h"
#include "solve.h"
#include "solvers.h"

namespace gslam {
inline namespace v1 {
namespace detail {
namespace by_ceres {
namespace {

class PoseModel {
 public:
  PoseModel(const PoseProblem& problem, const SE3d& start, const OptimizerOptions& options)
      : pose(start), loss_(options.loss), problem_(problemOptions()) {
    const std::size_t n = problem.points.size();
    double* block = blockOfPose();
    problem_.AddParameterBlock(block, kPoseNumbers, &manifold_);
    costs_ = std::make_unique<KnownPointCost[]>(n);
    is_used.assign(n, 0);
    for (std::size_t i = 0; i < n; ++i) {
      costs_[i].set(problem, i);
      if (!costs_[i].isUsed(start)) continue;
      is_used[i] = 1;
      problem_.AddResidualBlock(&costs_[i], loss_.orNull(), &block, 1);
    }
    if (problem.prior == nullptr) return;
    prior_.set(PoseGraphResidual::Logarithm, {world_.data(), 0}, {pose.data(), kPoseNumbers},
               problem.prior->pose, problem.prior->information);
    problem_.AddResidualBlock(&prior_, nullptr, &block, 1);
  }

  ceres::Problem& problem() { return problem_; }
  double* blockOfPose() { return const_cast<double*>(pose.data()); }
  bool isInlier(std::size_t i) const {
    double squared_norm = 0;
    return is_used[i] != 0 && costs_[i].isUsed(pose) && costs_[i].squaredNorm(pose, squared_norm) &&
           loss_.isInlier(squared_norm);
  }

  SE3d pose;
  std::vector<std::uint8_t> is_used;

 private:
  SharedLoss loss_;
  SE3d world_;
  GroupManifold<SE3d> manifold_;
  std::unique_ptr<KnownPointCost[]> costs_;
  EdgeCost<SE3d> prior_;
  ceres::Problem problem_;  // last: it dies first
};

}  // namespace

OptimizedPose solvePose(const PoseProblem& problem, const SE3d& T_world_body,
                        const OptimizerOptions& options) {
  SearchPlan plan;
  plan.start = Clock::now();
  plan.reduced_size = SE3d::kFreedom;
  checkSolverOptions(options, false);
  PoseModel model(problem, T_world_body, options);
  const SearchResult found = search(model.problem(), plan, options);
  if (found.thrown) std::rethrow_exception(found.thrown);

  OptimizedPose result;
  result.status = found.summary.status;
  result.initial_cost = found.summary.initial_cost;
  result.final_cost = found.summary.final_cost;
  const std::size_t counted = found.summary.iterations.size();
  result.iterations = counted > 0 ? counted - 1 : 0;
  if (found.summary.is_usable) {
    const std::vector<double*> block = {model.blockOfPose()};
    const BlockCovariances covariance = blockCovariances(model.problem(), block, block);
    result.is_usable = covariance.is_valid;
    if (result.is_usable) {
      std::copy(covariance.blocks[0].begin(), covariance.blocks[0].end(), result.covariance.data());
    }
  }
  if (!result.is_usable) {
    result.status = OptimizerStatus::Failed;
    model.pose = T_world_body;
    result.final_cost = result.initial_cost;
  }
  result.T_world_body = model.pose;
  for (std::size_t i = 0; i < problem.points.size(); ++i) {
    const bool is_inlier = result.is_usable && model.isInlier(i);
    result.observations += model.is_used[i];
    result.inliers += is_inlier ? 1 : 0;
    if (!problem.inliers.empty()) problem.inliers[i] = is_inlier ? 1 : 0;
  }
  return result;
}

}  // namespace by_ceres
}  // namespace detail
}  // namespace v1
}  // namespace gslam
