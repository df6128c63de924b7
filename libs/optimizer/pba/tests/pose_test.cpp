#include <gslam/base/simd.h>
#include <gtest/gtest.h>

#include <cstddef>
#include <cstring>
#include <vector>

#include "pose_scene.h"
#include "pose_tools.h"
#include "small/pose_kernel.h"
#include "solvers.h"

namespace {

using gslam::LossKind;
using gslam::OptimizedPose;
using gslam::OptimizerOptions;
using gslam::OptimizerStatus;
using gslam::PoseProblem;
using gslam::SE3d;
using gslam::Vec3d;
using gslam::detail::pba::solvePose;
using pose_scene::makeScene;
using pose_scene::PoseScene;
using pose_tools::distance;
using pose_tools::kLosses;
using pose_tools::withLoss;

TEST(pose, agrees_in_all_variants) {
  PoseScene scene = makeScene({pose_scene::radtan(4)}, 203, 1.0, 0.2);
  for (const LossKind kind : kLosses) {
    if (kind == LossKind::Tukey) continue;  // sees no inlier from so far
    const PoseProblem problem = scene.problem();
    const gslam::Simd before = gslam::activeSimd();
    gslam::forceSimd(gslam::Simd::scalar);
    const OptimizedPose expected = solvePose(problem, scene.start, withLoss(kind));
    for (const gslam::Simd variant :
         gslam::detail::pba::poseKernel(gslam::detail::pba::PoseFormula::Radtan).variants()) {
      gslam::forceSimd(variant);
      const OptimizedPose result = solvePose(problem, scene.start, withLoss(kind));
      EXPECT_NEAR(result.final_cost, expected.final_cost, 1e-12 * expected.final_cost);
      EXPECT_LT(distance(result.T_world_body, expected.T_world_body), 1e-7);
      EXPECT_EQ(result.inliers, expected.inliers);
    }
    gslam::forceSimd(before);
  }
}

TEST(pose, leaves_points_behind_the_camera_out) {
  PoseScene scene = makeScene({pose_scene::pinhole()}, 50, 0.5);
  const OptimizedPose expected = solvePose(scene.problem(), scene.start, {});
  for (int i = 0; i < 20; ++i) {  // the same pixels, on the other side
    const Vec3d p = scene.truth.inverse() * scene.points[std::size_t(i)];
    scene.points.push_back(scene.truth * -p);
    scene.pixels.push_back(scene.pixels[std::size_t(i)]);
    scene.inliers.push_back(7);
  }
  const OptimizedPose result = solvePose(scene.problem(), scene.start, {});
  EXPECT_EQ(result.observations, 50u);
  EXPECT_EQ(result.inliers, 50u);
  EXPECT_NEAR(result.final_cost, expected.final_cost, 1e-12 * expected.final_cost);
  for (std::size_t i = 0; i < 70; ++i) EXPECT_EQ(scene.inliers[i], i < 50 ? 1 : 0);
}

TEST(pose, follows_its_options) {
  PoseScene scene = makeScene({pose_scene::pinhole()}, 50, 1);
  OptimizerOptions options;
  options.max_iterations = 0;
  OptimizedPose result = solvePose(scene.problem(), scene.start, options);
  EXPECT_EQ(result.status, OptimizerStatus::MaxIterations);
  EXPECT_EQ(result.iterations, 0u);
  EXPECT_EQ(result.final_cost, result.initial_cost);
  options.max_iterations = 1;
  result = solvePose(scene.problem(), scene.start, options);
  EXPECT_EQ(result.status, OptimizerStatus::MaxIterations);
  EXPECT_EQ(result.iterations, 1u);
  EXPECT_TRUE(result.is_usable);
  options = {};
  options.max_seconds = 1e-12;
  EXPECT_EQ(solvePose(scene.problem(), scene.start, options).status, OptimizerStatus::MaxTime);
  options = {};
  std::vector<double> costs;
  options.progress = [&costs](const gslam::OptimizerIteration& iteration) {
    EXPECT_EQ(iteration.number, costs.size());
    costs.push_back(iteration.cost);
    return costs.size() < 3;
  };
  result = solvePose(scene.problem(), scene.start, options);
  EXPECT_EQ(result.status, OptimizerStatus::Cancelled);
  EXPECT_EQ(result.iterations, 2u);
  ASSERT_EQ(costs.size(), 3u);
  EXPECT_GT(costs[0], costs[1]);
  EXPECT_EQ(result.final_cost, costs[2]);
  options.progress = [](const gslam::OptimizerIteration&) -> bool { throw 7; };
  EXPECT_THROW((void)solvePose(scene.problem(), scene.start, options), int);
}

TEST(pose, has_the_same_bits_every_time) {
  PoseScene scene = makeScene({pose_scene::pinhole(), pose_scene::radtan(4)}, 500, 1, 0.3);
  OptimizerOptions options = withLoss(LossKind::Cauchy);
  const OptimizedPose first = solvePose(scene.problem(), scene.start, options);
  for (unsigned threads : {0u, 1u, 7u}) {
    options.threads = threads;
    const OptimizedPose again = solvePose(scene.problem(), scene.start, options);
    EXPECT_EQ(std::memcmp(first.T_world_body.data(), again.T_world_body.data(), sizeof(SE3d)), 0);
    EXPECT_EQ(first.covariance, again.covariance);
    EXPECT_EQ(first.final_cost, again.final_cost);
  }
}

}  // namespace
