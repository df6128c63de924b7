// Anchored points whose noise wants them beyond infinity.
#include <gslam/optimizer/files/bal.h>
#include <gslam/optimizer/marginalize.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <string>
#include <vector>

#include "factors/bundle_blocks.h"
#include "general_bundle_tools.h"
#include "test_data.h"

namespace gslam {
namespace {

using bundle_scene::addNoise;
using bundle_scene::disturb;
using bundle_scene::makeScene;
using bundle_scene::pinhole;
using bundle_scene::Random;
using bundle_scene::Scene;
using detail::pba::solveBundleCovariance;
using detail::pba::solveGeneralBundle;
using general_bundle::thorough;

constexpr std::uint32_t kNear = 30, kFar = 60;

// Near points, and after them points at `distance`, that start at some other; noise in pixels.
Scene makeFarScene(double start, double distance = 1e5, double noise = 1) {
  Scene scene = makeScene(5, kNear + kFar, {pinhole()});
  Random random(4);
  for (std::uint32_t i = kNear; i < kNear + kFar; ++i) {
    scene.truth.points[i] = distance * Vec3d{0.1 * random.uniform(), 0.1 * random.uniform(), 1};
    scene.bundle.points[i] = start / distance * scene.truth.points[i];
  }
  for (std::size_t i = 0; i < scene.truth.pixels.size(); ++i) {
    const SE3d& pose = scene.truth.T_world_body[scene.truth.observation_pose[i]];
    const Vec3d x = pose.inverse() * scene.truth.points[scene.truth.observation_point[i]];
    EXPECT_TRUE(pinhole().project(x, scene.bundle.pixels[i]));
  }
  scene.bundle.pose_fixed = {1, 0, 0, 0, 1};
  scene.point_anchor.assign(kNear + kFar, BundleProblem::kNoAnchor);
  for (std::uint32_t i = kNear; i < kNear + kFar; ++i) scene.point_anchor[i] = i % 5;
  addNoise(scene, noise);
  disturb(scene, 0.02, 0.02);
  return scene;
}

std::vector<std::uint32_t> farthestOf(const Scene& scene) {
  std::vector<std::uint32_t> list;
  for (std::uint32_t i = kNear; i < kNear + kFar; ++i) {
    if (scene.bundle.points[i].norm() > 0.9 / detail::kLeastInverse) list.push_back(i);
  }
  return list;
}

double costOf(Scene& scene) {
  OptimizerOptions options;
  options.max_iterations = 0;
  return solveGeneralBundle(scene.problem(), options).initial_cost;
}

TEST(general_far_points, end_at_the_minimum_before_infinity) {
  std::vector<double> costs;
  for (const double start : {40.0, 5e3, 5e10}) {
    for (const auto kind : {LinearSolverKind::Dense, LinearSolverKind::Iterative}) {
      Scene scene = makeFarScene(start);
      OptimizerOptions options = thorough();
      options.linear_solver = kind;
      options.linear_tolerance = 1e-6;
      options.max_iterations = 40;
      const OptimizerSummary summary = solveGeneralBundle(scene.problem(), options);
      EXPECT_EQ(summary.status, OptimizerStatus::Converged) << summary.message;
      EXPECT_LE(summary.iterations.size(), 10u) << start;
      costs.push_back(summary.final_cost);
      EXPECT_NEAR(costs.back(), costs.front(), 1e-7 * costs.front()) << start;
      EXPECT_NEAR(costOf(scene), summary.final_cost, 1e-9 * summary.final_cost);
    }
  }
}

TEST(general_far_points, are_held_only_where_the_cost_falls_outwards) {
  Scene scene = makeFarScene(200);
  const OptimizerSummary summary = solveGeneralBundle(scene.problem(), thorough());
  const std::vector<std::uint32_t> farthest = farthestOf(scene);
  EXPECT_GT(farthest.size(), kFar / 5);
  EXPECT_LT(farthest.size(), kFar - kFar / 5);
  for (std::uint32_t i = kNear; i < kNear + kFar; ++i) {  // nearer is worse
    const Vec3d x = scene.bundle.points[i];
    const Vec3d& centre = scene.bundle.T_world_body[scene.point_anchor[i]].translation();
    const double inverse = 1 / (x - centre).norm();
    scene.bundle.points[i] = centre + inverse / (inverse + 1e-5) * (x - centre);
    EXPECT_GE(costOf(scene), summary.final_cost * (1 - 1e-9)) << i;
    scene.bundle.points[i] = x;
  }
}

TEST(general_far_points, come_back_where_the_gradient_turns) {
  for (const double start : {0.99 / detail::kLeastInverse, 1e14}) {
    Scene scene = makeFarScene(start, 80, 0);
    general_bundle::solveToTheEnd(scene);
    general_bundle::expectTruth(scene, 1e-6);
  }
}

TEST(general_far_points, leave_finite_covariances_and_priors) {
  Scene scene = makeFarScene(200);
  ASSERT_TRUE(solveGeneralBundle(scene.problem(), thorough()).is_usable);
  const std::vector<std::uint32_t> poses = {1, 2, 3}, farthest = farthestOf(scene);
  ASSERT_FALSE(farthest.empty());
  const BundleCovariance covariance =
      solveBundleCovariance(scene.problem(), poses, farthest, {}, OptimizerOptions());
  ASSERT_TRUE(covariance.is_valid) << covariance.message;
  for (const Mat3d& c : covariance.points) {
    for (const double value : c.values) EXPECT_TRUE(std::isfinite(value));
    EXPECT_GT(c(0, 0) + c(1, 1) + c(2, 2), 1e6);
  }
  for (const Mat<double, 6, 6>& c : covariance.poses) {
    for (std::size_t i = 0; i < 6; ++i) {
      EXPECT_GT(c(i, i), 0);
      EXPECT_LT(c(i, i), 1e-2);
    }
  }
  // At the minimum nothing pulls the poses, whatever points would like.
  const WindowPrior prior = marginalize(scene.problem(), poses);
  ASSERT_EQ(prior.gradient.size(), 18u);
  for (std::size_t i = 0; i < 18; ++i) {
    const double information = prior.information[19 * i];
    EXPECT_GT(information, 0);
    EXPECT_NEAR(prior.gradient[i] / std::sqrt(information), 0, 1e-3) << i;
  }
}

TEST(general_far_points, do_not_hinder_ladybug_with_every_point_anchored) {
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
  const OptimizerSummary summary = solveGeneralBundle(problem, options);
  EXPECT_LT(summary.final_cost, 1.3345e4) << summary.message;
  for (const OptimizerIteration& iteration : summary.iterations) {  // what it promised, it kept
    EXPECT_TRUE(iteration.is_successful) << iteration.number;
  }
}

}  // namespace
}  // namespace gslam
