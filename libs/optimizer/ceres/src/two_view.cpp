#include <algorithm>
#include <exception>
#include <memory>
#include <vector>

#include "block_covariance.h"
#include "loss_function.h"
#include "manifolds.h"
#include "match_cost.h"
#include "solve.h"
#include "solvers.h"

namespace gslam {
inline namespace v1 {
namespace detail {
namespace by_ceres {
namespace {

bool knowsDepth(const TwoViewProblem& problem, std::size_t i) {
  return !problem.depth_information.empty() && problem.depth_information[i] > 0;
}

bool knowsNoDepth(const TwoViewProblem& problem) {
  const auto is_known = [](double information) { return information > 0; };
  return std::none_of(problem.depth_information.begin(), problem.depth_information.end(), is_known);
}

class TwoViewModel {
 public:
  TwoViewModel(const TwoViewProblem& problem, const SE3d& start, const OptimizerOptions& options)
      : pose(start),
        keeps_length(knowsNoDepth(problem)),
        loss_(options.loss),
        depths_(problem.inverse_depths),
        start_(depths_.begin(), depths_.end()),
        depth_count_(problem.depth_information.size()),
        problem_(problemOptions()) {
    if (keeps_length) {
      problem_.AddParameterBlock(blockOfPose(), 7, &length_manifold_);
    } else {
      problem_.AddParameterBlock(blockOfPose(), 7, &pose_manifold_);
    }
    plan.reduced_size = keeps_length ? 5 : 6;
    match_costs_ = std::make_unique<MatchCost[]>(depths_.size());
    depth_costs_ = std::make_unique<DepthCost[]>(problem.depth_information.size());
    is_used_.assign(depths_.size(), 0);
    for (std::size_t i = 0; i < depths_.size(); ++i) addMatch(problem, i);
  }

  ceres::Problem& problem() { return problem_; }
  double* blockOfPose() { return const_cast<double*>(pose.data()); }
  // Blocks that are variables here: no depths at infinity.
  std::vector<double*> freeBlocks() {
    std::vector<double*> free = {blockOfPose()};
    for (double* const depth : plan.eliminated) {
      if (*depth > 0) {
        free.push_back(depth);
      } else {
        problem_.SetParameterBlockConstant(depth);
      }
    }
    return free;
  }
  void restore() { std::copy(start_.begin(), start_.end(), depths_.begin()); }

  void fillCounts(OptimizerSummary& summary) const {
    for (std::size_t i = 0; i < depths_.size(); ++i) {
      double squared_norm = 0;
      if (is_used_[i] == 0) {
        ++summary.left_out;
        continue;
      }
      ++summary.observations;
      const bool is_seen = squaredNorm(i, squared_norm);
      summary.inliers += is_seen && loss_.isInlier(squared_norm) ? 1 : 0;
    }
    summary.residuals = 2 * summary.observations + depth_count_;
    summary.parameters = plan.reduced_size + depths_.size();
  }

  SE3d pose;
  bool keeps_length;
  SearchPlan plan;
  // Whether the second camera sees anything.
  bool hasMatches() const {
    return std::any_of(is_used_.begin(), is_used_.end(), [](std::uint8_t used) { return used; });
  }

 private:
  bool squaredNorm(std::size_t i, double& sum) const {
    const double* const blocks[] = {pose.data(), &depths_[i]};
    double residuals[2] = {0, 0};
    if (!match_costs_[i].Evaluate(blocks, residuals, nullptr)) return false;
    sum = residuals[0] * residuals[0] + residuals[1] * residuals[1];
    return true;
  }

  void addMatch(const TwoViewProblem& problem, std::size_t i) {
    Vec3d bearing{};
    double* blocks[] = {blockOfPose(), &depths_[i]};
    const bool is_known = knowsDepth(problem, i);
    if (problem.first_camera.unproject(problem.first[i], bearing)) {
      match_costs_[i].set(problem, i, bearing, keeps_length, !is_known);
      is_used_[i] = match_costs_[i].isUsed(pose, depths_[i]) ? 1 : 0;
    }
    if (is_used_[i] == 0 && !is_known) return;
    problem_.AddParameterBlock(blocks[1], 1, &inverse_manifold_);
    plan.eliminated.push_back(blocks[1]);
    if (is_used_[i] != 0) {
      problem_.AddResidualBlock(&match_costs_[i], loss_.orNull(), blocks, 2);
    }
    if (!is_known) return;
    depth_costs_[i].set(depths_[i], problem.depth_information[i]);
    problem_.AddResidualBlock(&depth_costs_[i], nullptr, blocks + 1, 1);
  }

  SharedLoss loss_;
  Span<double> depths_;
  std::vector<double> start_;
  std::vector<std::uint8_t> is_used_;
  std::size_t depth_count_;  // of what is known
  GroupManifold<SE3d> pose_manifold_;
  FixedLengthManifold length_manifold_;
  InverseManifold inverse_manifold_;
  std::unique_ptr<MatchCost[]> match_costs_;
  std::unique_ptr<DepthCost[]> depth_costs_;
  ceres::Problem problem_;  // last: it dies first
};

// Of the tangent of SE3, also where the length is fixed.
Mat<double, 6, 6> twoViewCovariance(TwoViewModel& model, std::vector<std::string>& warnings) {
  const BlockCovariances found =
      blockCovariances(model.problem(), model.freeBlocks(), {model.blockOfPose()});
  Mat<double, 6, 6> covariance{};
  if (!found.is_valid) {
    warnings.push_back("There is no covariance: the matches do not determine the motion.");
    return covariance;
  }
  const std::vector<double>& values = found.blocks[0];
  if (!model.keeps_length) {
    std::copy(values.begin(), values.end(), covariance.data());
    return covariance;
  }
  Mat<double, 5, 5> inner;
  std::copy(values.begin(), values.end(), inner.data());
  const Mat<double, 6, 5> basis = FixedLengthManifold::tangentBasis(model.pose);
  return basis * inner * basis.transpose();
}

}  // namespace

OptimizedTwoView solveTwoView(const TwoViewProblem& problem, const SE3d& T_first_second,
                              const OptimizerOptions& options) {
  const Clock::time_point start = Clock::now();
  checkSolverOptions(options, true);
  TwoViewModel model(problem, T_first_second, options);
  model.plan.start = start;
  OptimizedTwoView result;
  SearchResult found;
  if (model.hasMatches()) {
    found = search(model.problem(), model.plan, options);
  } else {
    found.summary.message = "The second camera sees no point from where the search starts.";
  }
  if (!found.summary.is_usable) {
    model.restore();
    model.pose = T_first_second;
  }
  if (found.thrown) std::rethrow_exception(found.thrown);

  result.summary = std::move(found.summary);
  result.T_first_second = model.pose;
  model.fillCounts(result.summary);
  if (result.summary.is_usable) {
    result.covariance = twoViewCovariance(model, result.summary.warnings);
  }
  result.summary.times.total = secondsSince(start);
  return result;
}

}  // namespace by_ceres
}  // namespace detail
}  // namespace v1
}  // namespace gslam
