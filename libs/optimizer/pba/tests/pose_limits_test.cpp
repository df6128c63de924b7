#include <gtest/gtest.h>

#include <cmath>
#include <cstddef>
#include <cstring>

#include "pose_scene.h"
#include "pose_tools.h"
#include "solvers.h"

namespace {

using gslam::Camera;
using gslam::LossKind;
using gslam::OptimizedPose;
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

void expectFailed(const OptimizedPose& result, const PoseScene& scene) {
  EXPECT_FALSE(result.is_usable);
  EXPECT_EQ(result.status, OptimizerStatus::Failed);
  EXPECT_EQ(std::memcmp(result.T_world_body.data(), scene.start.data(), sizeof(SE3d)), 0);
  EXPECT_EQ(result.covariance, (gslam::Mat<double, 6, 6>{}));
  EXPECT_EQ(result.inliers, 0u);
  for (const std::uint8_t flag : scene.inliers) EXPECT_EQ(flag, 0);
}

TEST(pose, is_not_usable_where_it_is_not_determined) {
  {
    SCOPED_TRACE("two points");
    PoseScene scene = makeScene({pose_scene::pinhole()}, 2, 0.5);
    expectFailed(solvePose(scene.problem(), scene.start, {}), scene);
  }
  {
    SCOPED_TRACE("no points");
    PoseScene scene = makeScene({pose_scene::pinhole()}, 0, 0);
    expectFailed(solvePose(scene.problem(), scene.start, {}), scene);
  }
  {
    SCOPED_TRACE("all behind");
    PoseScene scene = makeScene({pose_scene::pinhole()}, 20, 0);
    scene.start = scene.truth * SE3d(gslam::SO3d::exp({0, 3.1, 0}), {0, 0, 0});
    const OptimizedPose result = solvePose(scene.problem(), scene.start, {});
    expectFailed(result, scene);
    EXPECT_EQ(result.observations, 0u);
  }
  for (const Camera& camera :
       {pose_scene::pinhole(), pose_scene::radtan(4), pose_scene::camerasOfAllModels()[6]}) {
    SCOPED_TRACE("on a line, " + camera.modelName());
    PoseScene scene = makeScene({camera}, 50, 0);
    for (std::size_t i = 0; i < 50; ++i) {
      const double t = 0.02 * double(i) - 0.5;
      const Vec3d p = {0.3 + t, -0.2 + 0.5 * t, 3 + 0.7 * t};
      scene.points[i] = scene.truth * p;
      ASSERT_TRUE(camera.project(p, scene.pixels[i]));
    }
    for (const LossKind kind : {LossKind::Squared, LossKind::Huber, LossKind::Cauchy}) {
      expectFailed(solvePose(scene.problem(), scene.start, withLoss(kind)), scene);
    }
  }
  {
    SCOPED_TRACE("all at one place");
    PoseScene scene = makeScene({pose_scene::pinhole()}, 50, 0);
    for (Vec3d& point : scene.points) point = scene.points[0];
    for (gslam::Vec2d& pixel : scene.pixels) pixel = scene.pixels[0];
    expectFailed(solvePose(scene.problem(), scene.start, {}), scene);
  }
  {
    SCOPED_TRACE("no information");
    PoseScene scene = makeScene({pose_scene::pinhole()}, 50, 1);
    scene.information.assign(50, 0.0);
    expectFailed(solvePose(scene.problem(), scene.start, {}), scene);
  }
}

TEST(pose, is_usable_near_degenerate_scenes) {
  {
    SCOPED_TRACE("on a plane");
    PoseScene scene = makeScene({pose_scene::pinhole()}, 60, 0);
    for (std::size_t i = 0; i < 60; ++i) {
      const Vec3d p = {0.1 * double(i % 10) - 0.5, 0.2 * double(i / 10) - 0.5, 4};
      scene.points[i] = scene.truth * p;
      ASSERT_TRUE(scene.cameras[0].project(p, scene.pixels[i]));
    }
    const OptimizedPose result = solvePose(scene.problem(), scene.start, {});
    EXPECT_TRUE(result.is_usable);
    EXPECT_LT(distance(result.T_world_body, scene.truth), 1e-7);
  }
  {
    SCOPED_TRACE("three points");
    PoseScene scene = makeScene({pose_scene::pinhole()}, 3, 0);
    const OptimizedPose result = solvePose(scene.problem(), scene.start, {});
    EXPECT_TRUE(result.is_usable);
    EXPECT_LT(result.final_cost, 1e-15);
  }
  {
    SCOPED_TRACE("kilometres away");
    PoseScene scene = makeScene({pose_scene::pinhole()}, 60, 0.1);
    for (std::size_t i = 0; i < 60; ++i) {
      const Vec3d p = scene.truth.inverse() * scene.points[i];
      scene.points[i] = scene.truth * (1000 * p);
    }
    const OptimizedPose result = solvePose(scene.problem(), scene.start, {});
    EXPECT_TRUE(result.is_usable);
    EXPECT_EQ(result.status, OptimizerStatus::Converged);
    EXPECT_LT((result.T_world_body.rotation().inverse() * scene.truth.rotation()).angle(), 1e-3);
  }
  {
    SCOPED_TRACE("a prior alone");
    PoseScene scene = makeScene({pose_scene::pinhole()}, 0, 0);
    const gslam::PosePrior prior{scene.truth, gslam::Mat<double, 6, 6>::identity()};
    PoseProblem problem = scene.problem();
    problem.prior = &prior;
    const OptimizedPose result = solvePose(problem, scene.start, {});
    EXPECT_TRUE(result.is_usable);
    EXPECT_LT(distance(result.T_world_body, scene.truth), 1e-9);
    for (std::size_t i = 0; i < 6; ++i) EXPECT_NEAR(result.covariance(i, i), 1, 1e-6);
  }
}

TEST(pose, is_not_disturbed_by_numbers_that_are_too_large) {
  PoseScene scene = makeScene({pose_scene::pinhole()}, 30, 1);
  scene.pixels[3] = {1e200, 0};
  expectFailed(solvePose(scene.problem(), scene.start, {}), scene);
  scene.pixels[3] = {1e100, 0};
  for (const LossKind kind : kLosses) {
    const OptimizedPose result = solvePose(scene.problem(), scene.start, withLoss(kind));
    for (const double value : result.covariance.values) EXPECT_TRUE(std::isfinite(value));
    for (int i = 0; i < 7; ++i) EXPECT_TRUE(std::isfinite(result.T_world_body.data()[i]));
  }
}

TEST(pose, is_not_disturbed_by_points_far_behind_the_camera) {
  for (const Camera& camera : {pose_scene::pinhole(), pose_scene::radtan(5)}) {
    for (const bool is_stereo : {false, true}) {
      PoseScene scene = makeScene({camera}, 29, 1);  // fills no register
      if (is_stereo) pose_scene::addRight(scene, 1);
      scene.points[3] = scene.points[28] = scene.truth * Vec3d{1e200, 1e200, -1e200};
      scene.pixels[4] = {1e200, 0};
      scene.points[4] = scene.truth * Vec3d{0, 0, -1};
      const OptimizedPose result = solvePose(scene.problem(), scene.start, {});
      EXPECT_TRUE(result.is_usable) << camera.modelName() << is_stereo;
      EXPECT_EQ(result.observations, 26u);
      EXPECT_LT(distance(result.T_world_body, scene.truth), 0.1);
    }
  }
}

}  // namespace
