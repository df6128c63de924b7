// Anchored points whose noise wants them beyond infinity. That their minimum is found, the contract
// of back ends asks.
#include <gslam/optimizer/files/bal.h>
#include <gtest/gtest.h>

#include <cmath>
#include <cstdint>
#include <cstdlib>
#include <vector>

#include "../../../../tests/harness/test_data.h"
#include "../../tests/backend_contract/scenes.h"
#include "solvers.h"

namespace gslam {
namespace {

using backend_contract::BundleScene;
using detail::by_ceres::solveBundle;
using detail::by_ceres::solveBundleCovariance;

// One point that noise wants beyond infinity, seen from known poses, and where it starts.
BundleScene oneFarPoint(double distance) {
  BundleScene scene;
  scene.cameras = {backend_contract::pinhole()};
  scene.poses = {SE3d(), SE3d(SO3d(), {1, 0, 0}), SE3d(SO3d(), {2, 0, 0})};
  scene.pose_fixed = {1, 1, 1};
  scene.points = {{0, 0, distance}};
  scene.anchors = {0};
  scene.of_pose = {0, 1, 2};
  scene.of_point = scene.of_camera = {0, 0, 0};
  scene.pixels = {{319.5, 239.5}, {320.5, 239.5}, {321.5, 239.5}};
  return scene;
}

TEST(far_points, come_to_their_end_and_stay) {
  for (const double start : {10.0, 1e3, 0.9e10, 1e10}) {
    BundleScene scene = oneFarPoint(start);
    const OptimizerSummary summary = solveBundle(scene.problem(), OptimizerOptions());
    EXPECT_EQ(summary.status, OptimizerStatus::Converged) << summary.message;
    EXPECT_LE(summary.iterations.size(), 12u) << start;
    EXPECT_NEAR(scene.points[0].norm(), 1e10, 1e3);
    // The direction that is best there: the middle one.
    EXPECT_NEAR(scene.points[0][0] / scene.points[0][2], 1 / 500.0, 1e-6);
  }
}

TEST(far_points, come_back_where_the_gradient_turns) {
  BundleScene scene = oneFarPoint(1e10);
  for (std::size_t i = 0; i < 3; ++i) scene.pixels[i][0] = 319.5 - 10.0 * static_cast<double>(i);
  const OptimizerSummary summary = solveBundle(scene.problem(), OptimizerOptions());
  EXPECT_LT(summary.final_cost, 1e-12) << summary.message;
  EXPECT_NEAR(scene.points[0].norm(), 50, 1e-3);
}

TEST(far_points, have_covariances) {
  BundleScene scene = oneFarPoint(1e10);
  const std::vector<std::uint32_t> wanted = {0};
  const BundleCovariance covariance =
      solveBundleCovariance(scene.problem(), {}, wanted, {}, OptimizerOptions());
  ASSERT_TRUE(covariance.is_valid) << covariance.message;
  for (const double value : covariance.points[0].values) EXPECT_TRUE(std::isfinite(value));
  EXPECT_GT(covariance.points[0](2, 2), 1e20);
}

TEST(far_points, do_not_hinder_ladybug_with_every_point_anchored) {
  NEEDS_TEST_DATA();
  if (std::getenv("GSLAM_FULL_TESTS") == nullptr) GTEST_SKIP() << "GSLAM_FULL_TESTS is not set";
  Bundle bundle = readBal(test_data::folder() + "bundle_adjustment/problem-49-7776-pre.txt");
  std::vector<std::uint32_t> anchors(bundle.points.size(), BundleProblem::kNoAnchor);
  for (std::size_t i = bundle.pixels.size(); i-- > 0;) {
    anchors[bundle.observation_point[i]] = bundle.observation_pose[i];
  }
  BundleProblem problem = bundle.problem();
  problem.point_anchor = anchors;
  OptimizerOptions options;
  options.max_iterations = 60;
  const OptimizerSummary summary = solveBundle(problem, options);
  EXPECT_LT(summary.final_cost, 1.3345e4) << summary.message;
}

}  // namespace
}  // namespace gslam
