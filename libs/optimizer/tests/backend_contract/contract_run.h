// How a search runs and ends, shown with bundles.
#ifndef GSLAM_OPTIMIZER_TESTS_BACKEND_CONTRACT_CONTRACT_RUN_H
#define GSLAM_OPTIMIZER_TESTS_BACKEND_CONTRACT_CONTRACT_RUN_H

#include <stdexcept>

#include "fixture.h"

namespace backend_contract {

inline BundleScene noisyScene() {
  BundleScene scene = bundleScene(6, 50, 0.03);
  addNoise(scene, 0.5);
  return scene;
}

}  // namespace backend_contract

TEST_P(BackendContract, only_computes_the_cost_without_iterations) {
  using namespace backend_contract;
  NEEDS_FUNCTION(bundle);
  BundleScene scene = noisyScene();
  const BundleScene before = scene;
  gslam::OptimizerOptions none = options();
  none.max_iterations = 0;
  const gslam::OptimizerSummary summary = solveChecked(scene, none);
  EXPECT_EQ(summary.status, gslam::OptimizerStatus::MaxIterations);
  EXPECT_EQ(summary.iterations.size(), 1u);
  EXPECT_TRUE(areSameBits(scene.poses, before.poses));
  EXPECT_TRUE(areSameBits(scene.points, before.points));
}

TEST_P(BackendContract, stops_after_the_iterations_that_are_allowed) {
  using namespace backend_contract;
  NEEDS_FUNCTION(bundle);
  BundleScene scene = noisyScene();
  gslam::OptimizerOptions two = options();
  two.max_iterations = 2;
  const gslam::OptimizerSummary summary = solveChecked(scene, two);
  EXPECT_EQ(summary.status, gslam::OptimizerStatus::MaxIterations);
  EXPECT_EQ(summary.iterations.size(), 3u);
  EXPECT_TRUE(summary.is_usable);
  EXPECT_LT(summary.final_cost, summary.initial_cost);
}

TEST_P(BackendContract, converges_by_each_tolerance) {
  using namespace backend_contract;
  NEEDS_FUNCTION(bundle);
  const auto solve = [&](double function, double gradient, double parameter) {
    BundleScene scene = noisyScene();
    gslam::OptimizerOptions chosen = options();
    chosen.function_tolerance = function;
    chosen.gradient_tolerance = gradient;
    chosen.parameter_tolerance = parameter;
    return solveChecked(scene, chosen);
  };
  EXPECT_TRUE(solve(1e-4, 0, 0).hasConverged());
  EXPECT_TRUE(solve(0, 1e-2, 0).hasConverged());
  EXPECT_TRUE(solve(0, 0, 1e-5).hasConverged());
  EXPECT_LT(solve(1e-2, 0, 0).iterations.size(), solve(1e-10, 0, 0).iterations.size());
  EXPECT_EQ(solve(0, 1e30, 0).iterations.size(), 1u);
}

TEST_P(BackendContract, is_cancelled_by_its_progress_function) {
  using namespace backend_contract;
  NEEDS_FUNCTION(bundle);
  BundleScene scene = noisyScene();
  gslam::OptimizerOptions watched = options();
  std::vector<double> costs;
  watched.progress = [&](const gslam::OptimizerIteration& one) {
    EXPECT_EQ(one.number, costs.size());
    costs.push_back(one.cost);
    return one.number < 2;
  };
  const gslam::OptimizerSummary summary = solveChecked(scene, watched);
  EXPECT_EQ(summary.status, gslam::OptimizerStatus::Cancelled);
  EXPECT_TRUE(summary.is_usable);
  ASSERT_EQ(summary.iterations.size(), 3u);
  ASSERT_EQ(costs.size(), 3u);
  EXPECT_EQ(costs[2], summary.iterations[2].cost);
  EXPECT_LT(summary.final_cost, summary.initial_cost);
}

TEST_P(BackendContract, hands_on_what_its_progress_function_throws) {
  using namespace backend_contract;
  NEEDS_FUNCTION(bundle);
  BundleScene scene = noisyScene();
  gslam::OptimizerOptions watched = options();
  double kept = 0;
  watched.progress = [&](const gslam::OptimizerIteration& one) {
    if (one.is_successful) kept = one.cost;
    if (one.number == 2) throw std::runtime_error("enough");
    return true;
  };
  EXPECT_THROW(optimizeBundle(scene.problem(), watched), std::runtime_error);
  EXPECT_GT(kept, 0);
  EXPECT_NEAR(bundleCost(scene.problem()), kept, 1e-9 * kept);
}

TEST_P(BackendContract, begins_no_step_when_the_time_is_over) {
  using namespace backend_contract;
  NEEDS_FUNCTION(bundle);
  BundleScene scene = noisyScene();
  gslam::OptimizerOptions hurried = options();
  hurried.max_seconds = 1e-9;
  const gslam::OptimizerSummary summary = solveChecked(scene, hurried);
  EXPECT_EQ(summary.status, gslam::OptimizerStatus::MaxTime);
  EXPECT_LE(summary.iterations.size(), 2u);
}

TEST_P(BackendContract, reaches_one_optimum_with_every_linear_solver) {
  using namespace backend_contract;
  NEEDS_FUNCTION(bundle);
  using gslam::LinearSolverKind;
  using gslam::PreconditionerKind;
  BundleScene reference = noisyScene();
  const double best = solveChecked(reference, options()).final_cost;
  std::size_t solved = 0;
  const auto solve = [&](const gslam::OptimizerOptions& chosen) {
    BundleScene scene = noisyScene();
    const BundleScene before = scene;
    try {
      const gslam::OptimizerSummary summary = solveChecked(scene, chosen);
      EXPECT_NEAR(summary.final_cost, best, 1e-6 * best) << fullReport(summary);
      ++solved;
    } catch (const gslam::ArgumentError& error) {  // says so before it starts
      EXPECT_STRNE(error.what(), "");
      EXPECT_TRUE(areSameBits(scene.poses, before.poses));
    }
  };
  for (const auto precision : {gslam::PrecisionKind::Double, gslam::PrecisionKind::Mixed}) {
    for (const auto schur : {gslam::SchurKind::Explicit, gslam::SchurKind::Implicit}) {
      gslam::OptimizerOptions chosen = options();
      chosen.function_tolerance = 1e-10;
      chosen.precision = precision;
      chosen.schur = schur;
      for (const auto preconditioner :
           {PreconditionerKind::BlockJacobi, PreconditionerKind::SchurJacobi,
            PreconditionerKind::PowerSeries}) {
        chosen.linear_solver = LinearSolverKind::Iterative;
        chosen.preconditioner = preconditioner;
        solve(chosen);
      }
      chosen.preconditioner = PreconditionerKind::Automatic;
      for (const auto kind : {LinearSolverKind::Dense, LinearSolverKind::Sparse}) {
        chosen.linear_solver = kind;
        solve(chosen);
      }
    }
  }
  EXPECT_GE(solved, 4u);
}

TEST_P(BackendContract, repeats_itself_bit_for_bit) {
  using namespace backend_contract;
  NEEDS_FUNCTION(bundle);
  const auto solve = [&](unsigned threads) {
    BundleScene scene = bundleScene(12, 400, 0.02);
    addNoise(scene, 0.5);
    gslam::OptimizerOptions chosen = options();
    chosen.max_iterations = 5;
    chosen.threads = threads;
    optimizeBundle(scene.problem(), chosen);
    return scene;
  };
  const BundleScene first = solve(1);
  for (const unsigned threads : {1u, 2u, 3u, 7u}) {
    if (threads != 1 && backend().name != "pba") continue;  // the others promise one thread only
    const BundleScene again = solve(threads);
    EXPECT_TRUE(areSameBits(again.poses, first.poses)) << threads;
    EXPECT_TRUE(areSameBits(again.points, first.points)) << threads;
  }
}

TEST_P(BackendContract, stays_near_the_start_where_nothing_fixes_the_whole) {
  using namespace backend_contract;
  NEEDS_FUNCTION(bundle);
  BundleScene scene = bundleScene(6, 50, 0.02);
  scene.pose_fixed.clear();
  const gslam::OptimizerSummary summary = solveChecked(scene, options());
  EXPECT_TRUE(summary.is_usable);
  EXPECT_LT(summary.final_cost, 1e-8) << fullReport(summary);
  EXPECT_LT(worstPose(scene.poses, scene.true_poses), 0.2);
  ASSERT_FALSE(summary.warnings.empty());
  EXPECT_THAT(summary.warnings[0], testing::HasSubstr("position, orientation, scale"));
}

TEST_P(BackendContract, survives_what_is_degenerate) {
  using namespace backend_contract;
  NEEDS_FUNCTION(bundle);
  const auto solve = [&](BundleScene& scene) {
    const gslam::OptimizerSummary summary = solveChecked(scene, options());
    for (const SE3d& pose : scene.poses) {
      EXPECT_TRUE(std::isfinite(pose.translation().norm())) << fullReport(summary);
    }
    for (const Vec3d& point : scene.points) {
      EXPECT_TRUE(std::isfinite(point.norm())) << fullReport(summary);
    }
  };
  BundleScene two = bundleScene(2, 20, 0.02);
  solve(two);
  BundleScene fixed = bundleScene(4, 20, 0.02);
  fixed.pose_fixed.assign(4, 1);
  fixed.point_fixed.assign(20, 1);
  solve(fixed);
  BundleScene once = bundleScene(4, 20, 0.02);
  for (std::size_t i = 0; i < once.of_point.size(); ++i) {
    if (once.of_point[i] == 19 && once.of_pose[i] != 3) once.of_point[i] = 18;
  }
  solve(once);
  BundleScene same = bundleScene(4, 20, 0.02);  // no parallax at all
  for (std::size_t i = 0; i < 4; ++i) same.poses[i] = same.poses[0];
  solve(same);
  BundleScene behind = bundleScene(4, 20, 0.02);
  behind.points[3] = behind.poses[2] * Vec3d{0.1, 0.1, -2};
  solve(behind);
  BundleScene unused = bundleScene(4, 20, 0.02);
  unused.points.push_back({1, 2, 3});
  unused.poses.push_back(SE3d());
  unused.pose_fixed.push_back(0);
  unused.cameras.push_back(pinhole());
  solve(unused);
  EXPECT_TRUE(areSameBits(unused.points[20], Vec3d{1, 2, 3}));
  EXPECT_TRUE(areSameBits(unused.poses[4], SE3d()));
}

TEST_P(BackendContract, leaves_out_what_a_camera_does_not_see) {
  using namespace backend_contract;
  NEEDS_FUNCTION(bundle);
  BundleScene scene = bundleScene(
      4, 40, 0.01,
      Camera::fromParameters("double_sphere", 640, 480, {300, 300, 320, 240, 0.1, 0.55}));
  scene.of_pose.push_back(2);
  scene.of_point.push_back(40);
  scene.of_camera.push_back(0);
  scene.pixels.push_back({300, 200});
  scene.points.push_back(scene.poses[2] * Vec3d{0.1, 0.1, -5});
  const gslam::OptimizerSummary summary = solveChecked(scene, options());
  EXPECT_EQ(summary.left_out, 1u);
  EXPECT_EQ(summary.observations, 160u);
  EXPECT_LT(summary.final_cost, 1e-8);
}

#endif  // GSLAM_OPTIMIZER_TESTS_BACKEND_CONTRACT_CONTRACT_RUN_H
