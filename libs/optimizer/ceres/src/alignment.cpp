#include <algorithm>
#include <exception>
#include <memory>
#include <vector>

#include "block_covariance.h"
#include "correspondence_cost.h"
#include "loss_function.h"
#include "manifolds.h"
#include "solve.h"
#include "solvers.h"

namespace gslam {
inline namespace v1 {
namespace detail {
namespace by_ceres {
namespace {

template <class Group>
class AlignmentModel {
 public:
  AlignmentModel(const AlignmentProblem& problem, const Group& start,
                 const OptimizerOptions& options)
      : transform(start), loss_(options.loss), problem_(problemOptions()) {
    count_ = problem.points_b.size() + problem.plane_points_b.size() +
             problem.line_points_b.size() + problem.T_b_body.size();
    costs_ = std::make_unique<CorrespondenceCost<Group>[]>(count_);
    double* const block = blockOfTransform();
    problem_.AddParameterBlock(block, ambientSize<Group>(), &manifold_);
    std::size_t next = 0;
    next = add(problem, Correspondence::Point, problem.points_b.size(), next);
    next = add(problem, Correspondence::Plane, problem.plane_points_b.size(), next);
    next = add(problem, Correspondence::Line, problem.line_points_b.size(), next);
    add(problem, Correspondence::Pose, problem.T_b_body.size(), next);
  }

  ceres::Problem& problem() { return problem_; }
  double* blockOfTransform() { return const_cast<double*>(transform.data()); }

  void fillCounts(OptimizerSummary& summary) const {
    summary.observations = count_;
    summary.parameters = Group::kFreedom;
    for (std::size_t i = 0; i < count_; ++i) {
      summary.residuals += static_cast<std::size_t>(costs_[i].num_residuals());
      summary.inliers += loss_.isInlier(costs_[i].squaredNorm(transform)) ? 1 : 0;
    }
  }

  Group transform;

 private:
  std::size_t add(const AlignmentProblem& problem, Correspondence kind, std::size_t count,
                  std::size_t first) {
    double* block = blockOfTransform();
    for (std::size_t i = 0; i < count; ++i) {
      costs_[first + i].set(problem, kind, i);
      problem_.AddResidualBlock(&costs_[first + i], loss_.orNull(), &block, 1);
    }
    return first + count;
  }

  SharedLoss loss_;
  GroupManifold<Group> manifold_;
  std::size_t count_ = 0;
  std::unique_ptr<CorrespondenceCost<Group>[]> costs_;
  ceres::Problem problem_;  // last: it dies first
};

}  // namespace

template <class Group>
OptimizedAlignment<Group> solveAlignment(const AlignmentProblem& problem, const Group& T_a_b,
                                         const OptimizerOptions& options) {
  SearchPlan plan;
  plan.start = Clock::now();
  plan.reduced_size = Group::kFreedom;
  checkSolverOptions(options, false);
  AlignmentModel<Group> model(problem, T_a_b, options);
  SearchResult found = search(model.problem(), plan, options);
  if (found.thrown) std::rethrow_exception(found.thrown);

  OptimizedAlignment<Group> result;
  result.summary = std::move(found.summary);
  if (!result.summary.is_usable) model.transform = T_a_b;
  result.T_a_b = model.transform;
  model.fillCounts(result.summary);
  if (result.summary.is_usable) {
    const std::vector<double*> block = {model.blockOfTransform()};
    const BlockCovariances covariance = blockCovariances(model.problem(), block, block);
    if (covariance.is_valid) {
      std::copy(covariance.blocks[0].begin(), covariance.blocks[0].end(), result.covariance.data());
    } else {
      result.summary.warnings.push_back("The correspondences do not determine the transform.");
    }
  }
  result.summary.times.total = secondsSince(plan.start);
  return result;
}

template OptimizedAlignment<SE3d> solveAlignment(const AlignmentProblem&, const SE3d&,
                                                 const OptimizerOptions&);
template OptimizedAlignment<SIM3d> solveAlignment(const AlignmentProblem&, const SIM3d&,
                                                  const OptimizerOptions&);

}  // namespace by_ceres
}  // namespace detail
}  // namespace v1
}  // namespace gslam
