#include <algorithm>
#include <exception>
#include <memory>

#include "block_covariance.h"
#include "edge_cost.h"
#include "loss_function.h"
#include "solve.h"
#include "solvers.h"

namespace gslam {
inline namespace v1 {
namespace detail {
namespace by_ceres {
namespace {

// A pose graph as Ceres' problem. Poses are blocks where they stand in the graph.
template <class Group>
class GraphModel {
 public:
  GraphModel(const PoseGraphProblem<Group>& graph, const OptimizerOptions& options)
      : graph_(graph), loss_(options.loss), problem_(problemOptions()) {
    start_.assign(graph.T_world_body.begin(), graph.T_world_body.end());
    // Where nothing else says where the whole is, the first pose does.
    has_anchor_ = !graph.prior_pose.empty() ||
                  std::any_of(graph.pose_fixed.begin(), graph.pose_fixed.end(),
                              [](std::uint8_t is_fixed) { return is_fixed != 0; });
    addEdges();
    addPriors();
  }

  ceres::Problem& problem() { return problem_; }
  const SearchPlan& plan() const { return plan_; }
  bool isFree(std::size_t pose) const {
    if (!has_anchor_ && pose == 0) return false;
    return graph_.pose_fixed.empty() || graph_.pose_fixed[pose] == 0;
  }
  bool isUsed(std::size_t pose) const { return problem_.HasParameterBlock(blockOf(pose)); }
  double* blockOf(std::size_t pose) const {
    return const_cast<double*>(graph_.T_world_body[pose].data());
  }

  void restore() { std::copy(start_.begin(), start_.end(), graph_.T_world_body.begin()); }

  void fillCounts(OptimizerSummary& summary) const {
    summary.observations = graph_.from.size();
    summary.inliers = 0;
    for (std::size_t i = 0; i < graph_.from.size(); ++i) {
      const bool is_inlier = !isRobust(i) || loss_.isInlier(costs_[i].squaredNorm());
      summary.inliers += is_inlier ? 1 : 0;
    }
    for (std::size_t i = 0; i < graph_.from.size() + graph_.prior_pose.size(); ++i) {
      summary.residuals += static_cast<std::size_t>(costs_[i].num_residuals());
    }
    for (std::size_t p = 0; p < graph_.T_world_body.size(); ++p) {
      summary.parameters += isFree(p) ? Group::kFreedom : 0;
    }
  }

 private:
  bool isRobust(std::size_t edge) const {
    return graph_.is_robust.empty() || graph_.is_robust[edge] != 0;
  }

  EdgeEnd<Group> endOf(std::size_t pose) const {
    return {graph_.T_world_body[pose].data(), isFree(pose) ? ambientSize<Group>() : 0};
  }

  void addEdges() {
    const std::size_t n = graph_.from.size();
    costs_ = std::make_unique<EdgeCost<Group>[]>(n + graph_.prior_pose.size());
    const auto identity = Group::Jacobian::identity();
    for (std::size_t i = 0; i < n; ++i) {
      const auto& information = graph_.information.empty() ? identity : graph_.information[i];
      costs_[i].set(graph_.residual, endOf(graph_.from[i]), endOf(graph_.to[i]),
                    graph_.T_from_to[i], information);
      double* blocks[2];
      int count = 0;
      for (const std::uint32_t pose : {graph_.from[i], graph_.to[i]}) {
        if (isFree(pose)) blocks[count++] = useBlock(pose);
      }
      add(costs_[i], isRobust(i), blocks, count);
    }
  }

  void addPriors() {
    for (std::size_t i = 0; i < graph_.prior_pose.size(); ++i) {
      const std::size_t pose = graph_.prior_pose[i];
      EdgeCost<Group>& cost = costs_[graph_.from.size() + i];
      cost.set(graph_.residual, {world_.data(), 0}, endOf(pose), graph_.prior_T_world_body[i],
               graph_.prior_information[i]);
      double* block = isFree(pose) ? useBlock(pose) : nullptr;
      add(cost, false, &block, block != nullptr ? 1 : 0);
    }
  }

  double* useBlock(std::size_t pose) {
    double* const block = blockOf(pose);
    if (problem_.HasParameterBlock(block)) return block;
    problem_.AddParameterBlock(block, ambientSize<Group>(), &manifold_);
    plan_.reduced_size += Group::kFreedom;
    return block;
  }

  void add(EdgeCost<Group>& cost, bool is_robust, double** blocks, int count) {
    if (count > 0) {
      problem_.AddResidualBlock(&cost, is_robust ? loss_.orNull() : nullptr, blocks, count);
      return;
    }
    double rho[3] = {cost.squaredNorm(), 1, 0};
    if (is_robust) loss_.Evaluate(rho[0], rho);
    plan_.constant_cost += rho[0] / 2;
  }

  const PoseGraphProblem<Group>& graph_;
  SharedLoss loss_;
  SearchPlan plan_;
  bool has_anchor_ = false;
  std::vector<Group> start_;
  Group world_;
  GroupManifold<Group> manifold_;
  std::unique_ptr<EdgeCost<Group>[]> costs_;  // edges, then priors
  ceres::Problem problem_;                    // last: it dies first
};

}  // namespace

template <class Group>
OptimizerSummary solvePoseGraph(const PoseGraphProblem<Group>& problem,
                                const OptimizerOptions& options) {
  const Clock::time_point start = Clock::now();
  checkSolverOptions(options, false);
  GraphModel<Group> model(problem, options);
  SearchPlan plan = model.plan();
  plan.start = start;
  SearchResult result = search(model.problem(), plan, options);
  if (!result.summary.is_usable) model.restore();
  if (result.thrown) std::rethrow_exception(result.thrown);
  model.fillCounts(result.summary);
  result.summary.times.total = secondsSince(start);
  return result.summary;
}

template <class Group>
PoseGraphCovariance<Group> solvePoseGraphCovariance(const PoseGraphProblem<Group>& problem,
                                                    Span<const std::uint32_t> poses,
                                                    const OptimizerOptions& options) {
  GraphModel<Group> model(problem, options);
  PoseGraphCovariance<Group> result;
  std::vector<double*> free, wanted;
  model.problem().GetParameterBlocks(&free);
  for (const std::uint32_t pose : poses) {
    if (!model.isFree(pose)) continue;
    if (!model.isUsed(pose)) {
      result.message = "T_world_body[" + std::to_string(pose) + "] has no edge.";
      return result;
    }
    wanted.push_back(model.blockOf(pose));
  }
  const BlockCovariances found = blockCovariances(model.problem(), free, wanted);
  result.is_valid = found.is_valid;
  result.message = found.message;
  if (!found.is_valid) return result;
  auto next = found.blocks.begin();
  for (const std::uint32_t pose : poses) {
    result.poses.push_back(typename Group::Jacobian{});
    if (!model.isFree(pose)) continue;
    std::copy(next->begin(), next->end(), result.poses.back().data());
    ++next;
  }
  return result;
}

template OptimizerSummary solvePoseGraph(const PoseGraphProblem<SE2d>&, const OptimizerOptions&);
template OptimizerSummary solvePoseGraph(const PoseGraphProblem<SE3d>&, const OptimizerOptions&);
template OptimizerSummary solvePoseGraph(const PoseGraphProblem<SIM3d>&, const OptimizerOptions&);
template PoseGraphCovariance<SE2d> solvePoseGraphCovariance(const PoseGraphProblem<SE2d>&,
                                                            Span<const std::uint32_t>,
                                                            const OptimizerOptions&);
template PoseGraphCovariance<SE3d> solvePoseGraphCovariance(const PoseGraphProblem<SE3d>&,
                                                            Span<const std::uint32_t>,
                                                            const OptimizerOptions&);
template PoseGraphCovariance<SIM3d> solvePoseGraphCovariance(const PoseGraphProblem<SIM3d>&,
                                                             Span<const std::uint32_t>,
                                                             const OptimizerOptions&);

}  // namespace by_ceres
}  // namespace detail
}  // namespace v1
}  // namespace gslam
