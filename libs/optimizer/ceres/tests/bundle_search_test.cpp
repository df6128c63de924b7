// How a search ends, and what it leaves behind.
#include <gslam/optimizer_ceres.h>
#include <gtest/gtest.h>

#include <cmath>
#include <cstring>
#include <stdexcept>

#include "scenes.h"

namespace {

using gslam::BundleProblem;
using gslam::Mat3d;
using gslam::OptimizerIteration;
using gslam::OptimizerOptions;
using gslam::OptimizerStatus;
using gslam::OptimizerSummary;
using gslam::SE3d;
using gslam::Vec3d;
using scenes::Bundle;
using scenes::exact;
using scenes::kTwoFixed;
using scenes::solve;

TEST(bundle_search, progress_ends_the_search_or_passes_through) {
  Bundle scene = Bundle::make(5, 60, {scenes::radtan()}, {}, 1);
  scene.disturb(0.05, 0.02, 0.1, 2);
  const Bundle start = scene;
  BundleProblem problem = scene.problem();
  problem.pose_fixed = kTwoFixed;
  OptimizerOptions options;
  options.progress = [](const OptimizerIteration& step) { return step.number < 2; };
  OptimizerSummary summary = solve(problem, options);
  EXPECT_EQ(OptimizerStatus::Cancelled, summary.status);
  EXPECT_TRUE(summary.is_usable);
  ASSERT_EQ(3u, summary.iterations.size());
  EXPECT_EQ(summary.iterations[2].cost, summary.final_cost);
  OptimizerOptions only_cost;
  only_cost.max_iterations = 0;
  EXPECT_NEAR(summary.final_cost, solve(problem, only_cost).initial_cost, 1e-9);

  scene = start;
  problem = scene.problem();
  problem.pose_fixed = kTwoFixed;
  options.progress = [](const OptimizerIteration& step) -> bool {
    if (step.number == 2) throw std::runtime_error("enough");
    return true;
  };
  EXPECT_THROW(solve(problem, options), std::runtime_error);
  EXPECT_NEAR(summary.final_cost, solve(problem, only_cost).initial_cost, 1e-9);
}

TEST(bundle_search, variables_are_what_they_were_when_there_is_no_cost) {
  Bundle scene = Bundle::make(3, 10, {scenes::pinhole()}, {}, 1);
  // So far that squares of the position are not finite, but the pixel is.
  std::vector<gslam::PositionPrior> priors = {{1, {1e200, 0, 0}, Mat3d::identity()}};
  const Bundle start = scene;
  BundleProblem problem = scene.problem();
  problem.position_priors = priors;
  const OptimizerSummary summary = solve(problem);
  EXPECT_FALSE(summary.is_usable);
  EXPECT_EQ(OptimizerStatus::Failed, summary.status);
  EXPECT_TRUE(std::isinf(summary.initial_cost) && std::isinf(summary.final_cost));
  EXPECT_EQ(0, std::memcmp(start.poses.data(), scene.poses.data(), 3 * sizeof(SE3d)));
  EXPECT_EQ(0, std::memcmp(start.points.data(), scene.points.data(), 10 * sizeof(Vec3d)));
}

TEST(bundle_search, says_what_ceres_cannot_do) {
  Bundle scene = Bundle::make(3, 10, {scenes::pinhole()}, {}, 1);
  OptimizerOptions options;
  options.preconditioner = gslam::PreconditionerKind::PowerSeries;
  EXPECT_THROW(solve(scene.problem(), options), gslam::ArgumentError);
  options = {};
  options.precision = gslam::PrecisionKind::Mixed;
  EXPECT_THROW(solve(scene.problem(), options), gslam::ArgumentError);
  options = {};
  options.schur = gslam::SchurKind::Implicit;
  options.linear_solver = gslam::LinearSolverKind::Sparse;
  EXPECT_THROW(solve(scene.problem(), options), gslam::ArgumentError);
  options.linear_solver = gslam::LinearSolverKind::Iterative;
  options.schur = gslam::SchurKind::Explicit;
  options.preconditioner = gslam::PreconditionerKind::BlockJacobi;
  EXPECT_THROW(solve(scene.problem(), options), gslam::ArgumentError);
}

TEST(bundle_search, all_linear_solvers_agree_and_repeat) {
  Bundle first;
  for (int kind = 0; kind < 8; ++kind) {
    Bundle scene = Bundle::make(5, 60, {scenes::radtan()}, {}, 1);
    for (std::size_t o = 0; o < scene.pixels.size(); ++o) scene.pixels[o][o % 2] += 0.1;
    scene.disturb(0.01, 0.01, 0.05, 2);
    BundleProblem problem = scene.problem();
    problem.pose_fixed = kTwoFixed;
    OptimizerOptions options = exact();
    options.max_iterations = 100;
    options.linear_solver = gslam::LinearSolverKind(kind % 4);
    options.linear_tolerance = 1e-8;
    if (kind == 4) options.schur = gslam::SchurKind::Explicit;
    if (kind == 5) {
      options.linear_solver = gslam::LinearSolverKind::Iterative;
      options.preconditioner = gslam::PreconditionerKind::BlockJacobi;
    }
    if (kind == 6) options.linear_solver = gslam::LinearSolverKind::Automatic;
    if (kind == 7) options.threads = 2;
    if (kind == 6) options.schur = gslam::SchurKind::Implicit;
    const OptimizerSummary summary = solve(problem, options);
    EXPECT_EQ(OptimizerStatus::Converged, summary.status) << kind << summary.message;
    if (kind == 0) {
      first = scene;
    } else {
      EXPECT_LT(scenes::farthest(first.poses, scene.poses), 1e-6) << summary.linear_solver;
    }
    if (kind == 4) {  // the same solver as at first
      EXPECT_EQ(0, std::memcmp(first.poses.data(), scene.poses.data(), 5 * sizeof(SE3d)));
    }
  }
}

}  // namespace
