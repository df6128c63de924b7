#include <gtest/gtest.h>

#include <cstring>
#include <limits>
#include <stdexcept>
#include <vector>

#include "general_bundle_tools.h"

namespace gslam {
namespace {

using bundle_scene::addNoise;
using bundle_scene::disturb;
using bundle_scene::makeEverything;
using bundle_scene::makeScene;
using bundle_scene::pinhole;
using bundle_scene::radtan;
using bundle_scene::Scene;
using detail::pba::solveGeneralBundle;
using general_bundle::expectTruth;
using general_bundle::solveToTheEnd;
using general_bundle::thorough;

TEST(general_bundle, leaves_fixed_things_untouched) {
  Scene scene = makeEverything();
  scene.bundle.pose_fixed = {1, 0, 1, 0, 0};
  scene.bundle.camera_freedom = {{0xf0u, false}, {0x0u, false}};
  const Scene before = scene;
  ASSERT_TRUE(solveGeneralBundle(scene.problem(), OptimizerOptions()).is_usable);
  const auto same = [](const SE3d& a, const SE3d& b) {
    return std::memcmp(&a, &b, sizeof(a)) == 0;
  };
  for (std::size_t i : {0u, 2u}) {
    EXPECT_TRUE(same(scene.bundle.T_world_body[i], before.bundle.T_world_body[i]));
  }
  EXPECT_FALSE(same(scene.bundle.T_world_body[1], before.bundle.T_world_body[1]));
  EXPECT_EQ(scene.bundle.points[5], before.bundle.points[5]);
  EXPECT_TRUE(same(scene.bundle.T_body_camera[0], before.bundle.T_body_camera[0]));
  EXPECT_EQ(scene.bundle.cameras[1], before.bundle.cameras[1]);
  for (std::size_t k = 0; k < 4; ++k) {
    EXPECT_EQ(scene.bundle.cameras[0].parameters()[k], before.bundle.cameras[0].parameters()[k]);
  }
  EXPECT_NE(scene.bundle.cameras[0].parameters()[4], before.bundle.cameras[0].parameters()[4]);
}

TEST(general_bundle, gives_the_same_bits_for_any_number_of_threads) {
  for (const auto kind :
       {LinearSolverKind::Dense, LinearSolverKind::Sparse, LinearSolverKind::Iterative}) {
    for (const auto schur : {SchurKind::Explicit, SchurKind::Implicit}) {
      std::vector<Scene> scenes;
      std::vector<double> costs;
      for (const unsigned threads : {1u, 2u, 3u}) {
        scenes.push_back(makeScene(60, 30, {radtan()}));
        scenes.back().bundle.camera_freedom = {{0xffu, false}};
        addNoise(scenes.back(), 1);
        disturb(scenes.back(), 0.05, 0.1);
        OptimizerOptions options;
        options.max_iterations = 3;
        options.max_linear_iterations = 15;
        options.threads = threads;
        options.linear_solver = kind;
        options.schur = schur;
        costs.push_back(solveGeneralBundle(scenes.back().problem(), options).final_cost);
      }
      for (std::size_t k = 1; k < scenes.size(); ++k) {
        EXPECT_EQ(costs[k], costs[0]);
        EXPECT_EQ(0, std::memcmp(scenes[k].bundle.points.data(), scenes[0].bundle.points.data(),
                                 30 * sizeof(Vec3d)));
        EXPECT_EQ(scenes[k].bundle.cameras[0], scenes[0].bundle.cameras[0]);
      }
    }
  }
}

TEST(general_bundle, stands_points_on_a_plane_and_two_cameras) {
  Scene scene = makeScene(2, 40, {pinhole()});
  for (std::size_t i = 0; i < scene.truth.points.size(); ++i) scene.truth.points[i][2] = 0;
  for (std::size_t i = 0; i < scene.truth.pixels.size(); ++i) {
    const SE3d& pose = scene.truth.T_world_body[scene.truth.observation_pose[i]];
    const Vec3d x = pose.inverse() * scene.truth.points[scene.truth.observation_point[i]];
    ASSERT_TRUE(pinhole().project(x, scene.truth.pixels[i]));
  }
  scene.bundle = scene.truth;
  disturb(scene, 0.05, 0.1);  // no gauge at all
  solveToTheEnd(scene);
}

TEST(general_bundle, passes_points_behind_the_camera_by_the_formula) {
  Scene scene = makeScene(4, 40, {pinhole()});
  scene.bundle.pose_fixed = {1, 0, 0, 1};
  scene.bundle.points[3] = scene.truth.T_world_body[1] * Vec3d{0.1, 0.1, -3};
  const OptimizerSummary summary = solveGeneralBundle(scene.problem(), thorough());
  EXPECT_TRUE(summary.is_usable);
  EXPECT_EQ(summary.left_out, 0u);
  EXPECT_LT(summary.final_cost, summary.initial_cost);
}

TEST(general_bundle, leaves_out_and_counts_what_a_model_does_not_see) {
  const Camera camera =
      Camera::fromParameters("kannala_brandt", 640, 480, {300, 300, 320, 240, 0, 0, 0, 0});
  const Camera sphere =
      Camera::fromParameters("double_sphere", 640, 480, {300, 300, 320, 240, -0.2, 0.6});
  Scene scene = makeScene(5, 40, {camera, sphere});
  scene.bundle.pose_fixed = {1, 0, 0, 0, 1};
  disturb(scene, 0.05, 0.1);
  // Right behind pose 1, which has the second camera; elsewhere the point is seen.
  const std::size_t n = scene.bundle.points.size();
  scene.bundle.points.push_back(scene.bundle.T_world_body[1] * Vec3d{0, 0, -1});
  scene.bundle.observation_pose.push_back(1);
  scene.bundle.observation_point.push_back(static_cast<std::uint32_t>(n));
  scene.bundle.observation_camera.push_back(1);
  scene.bundle.pixels.push_back({1, 1});
  const Vec3d before = scene.bundle.points[n];
  const OptimizerSummary summary = solveToTheEnd(scene);
  EXPECT_EQ(summary.left_out, 1u);
  EXPECT_EQ(summary.observations, scene.bundle.pixels.size() - 1);
  EXPECT_EQ(scene.bundle.points[n], before);
}

TEST(general_bundle, rejects_steps_that_make_no_camera) {
  Scene scene = makeScene(3, 30, {pinhole()});
  scene.bundle.camera_freedom = {{0x3u, false}};
  scene.bundle.cameras[0] = Camera::fromParameters("pinhole", 640, 480, {1, 1, 320, 240});
  for (Vec2d& pixel : scene.bundle.pixels) pixel = {640 - pixel[0], 480 - pixel[1]};  // f < 0
  scene.bundle.pose_fixed = {1, 1, 1};
  scene.bundle.point_fixed.assign(30, 1);
  const OptimizerSummary summary = solveGeneralBundle(scene.problem(), thorough());
  EXPECT_TRUE(summary.is_usable);
  EXPECT_LE(summary.final_cost, summary.initial_cost);
  EXPECT_GT(scene.bundle.cameras[0].parameters()[0], 0);
}

TEST(general_bundle, solves_what_has_only_points_or_only_poses_or_nothing) {
  Scene scene = makeScene(4, 30, {pinhole()});
  scene.bundle.pose_fixed.assign(4, 1);
  disturb(scene, 0.1, 0.2);
  solveToTheEnd(scene);
  expectTruth(scene, 1e-8);
  scene.bundle.pose_fixed.assign(4, 0);
  scene.bundle.point_fixed.assign(30, 1);
  disturb(scene, 0.1, 0.2);
  solveToTheEnd(scene);
  expectTruth(scene, 1e-8);
  scene.bundle.pose_fixed.assign(4, 1);
  const OptimizerSummary summary = solveGeneralBundle(scene.problem(), thorough());
  EXPECT_EQ(summary.parameters, 0u);
  EXPECT_TRUE(summary.is_usable);
  for (const auto kind : {LinearSolverKind::Sparse, LinearSolverKind::Iterative}) {
    OptimizerOptions options = thorough();
    options.linear_solver = kind;
    scene.bundle.point_fixed.assign(30, 0);
    disturb(scene, 0.1, 0.2);
    solveToTheEnd(scene, options);
  }
}

TEST(general_bundle, leaves_poses_and_points_without_observations_where_they_are) {
  Scene scene = makeScene(4, 30, {pinhole()});
  scene.bundle.pose_fixed = {1, 0, 0, 1};
  disturb(scene, 0.1, 0.2);
  scene.bundle.T_world_body.push_back(SE3d::exp({1, 2, 3, 0.1, 0.2, 0.3}));
  scene.bundle.pose_fixed.push_back(0);
  scene.bundle.points.push_back({1, 2, 3});
  const SE3d pose = scene.bundle.T_world_body[4];
  solveToTheEnd(scene);
  EXPECT_TRUE(scene.bundle.T_world_body[4].isApprox(pose, 1e-15));
  EXPECT_EQ(scene.bundle.points[30], (Vec3d{1, 2, 3}));
}

TEST(general_bundle, says_so_where_the_start_has_no_cost) {
  Scene scene = makeScene(3, 20, {pinhole()});
  const Scene before = scene;
  scene.position_priors.push_back({0, {1e200, 0, 0}, 1e300 * Mat3d::identity()});
  const OptimizerSummary summary = solveGeneralBundle(scene.problem(), OptimizerOptions());
  EXPECT_FALSE(summary.is_usable);
  EXPECT_EQ(summary.status, OptimizerStatus::Failed);
  EXPECT_EQ(scene.bundle.points, before.bundle.points);
  EXPECT_EQ(summary.initial_cost, std::numeric_limits<double>::infinity());
}

TEST(general_bundle, has_an_infinite_cost_where_infinities_cancel) {
  Scene scene = makeScene(3, 20, {pinhole()});
  WindowPrior prior;
  prior.poses = {0};
  prior.T_linear = {scene.bundle.T_world_body[0] * SE3d::exp({1e10, -1e10, 0, 0, 0, 0})};
  prior.information.assign(36, 0);
  prior.gradient = {1e300, 1e300, 0, 0, 0, 0};
  scene.window_priors = {prior};
  const OptimizerSummary summary = solveGeneralBundle(scene.problem(), OptimizerOptions());
  EXPECT_EQ(summary.status, OptimizerStatus::Failed);
  EXPECT_EQ(summary.initial_cost, std::numeric_limits<double>::infinity());
  EXPECT_EQ(summary.final_cost, std::numeric_limits<double>::infinity());
}

TEST(general_bundle, keeps_the_last_kept_step_where_progress_throws_or_cancels) {
  Scene scene = makeScene(6, 60, {pinhole()});
  scene.bundle.pose_fixed = {1, 0, 0, 0, 0, 1};
  disturb(scene, 0.1, 0.2);
  OptimizerOptions options = thorough();
  double cost = 0;
  options.progress = [&cost](const OptimizerIteration& iteration) -> bool {
    cost = iteration.cost;
    if (iteration.number == 2) throw std::runtime_error("enough");
    return true;
  };
  EXPECT_THROW(solveGeneralBundle(scene.problem(), options), std::runtime_error);
  options.max_iterations = 0;
  options.progress = nullptr;
  EXPECT_NEAR(solveGeneralBundle(scene.problem(), options).initial_cost, cost, 1e-9 * cost);
}

}  // namespace
}  // namespace gslam
