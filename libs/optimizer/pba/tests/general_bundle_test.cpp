#include <gtest/gtest.h>

#include <cmath>
#include <vector>

#include "general_bundle_tools.h"

namespace gslam {
namespace {

using bundle_scene::addStereo;
using bundle_scene::disturb;
using bundle_scene::makeEverything;
using bundle_scene::makeScene;
using bundle_scene::pinhole;
using bundle_scene::radtan;
using bundle_scene::Random;
using bundle_scene::Scene;
using detail::pba::solveGeneralBundle;
using general_bundle::expectTruth;
using general_bundle::solveToTheEnd;
using general_bundle::thorough;

void expectParameters(const Camera& found, const Camera& truth, double tolerance) {
  for (std::size_t i = 0; i < truth.parameterCount(); ++i) {
    const double expected = truth.parameters()[i];
    EXPECT_NEAR(found.parameters()[i], expected, tolerance * (1 + std::fabs(expected))) << i;
  }
}

Camera changed(const Camera& camera, const std::vector<double>& change) {
  std::vector<double> values = camera.parameters();
  for (std::size_t i = 0; i < change.size(); ++i) values[i] += change[i];
  return Camera::fromParameters(camera.modelName(), camera.width(), camera.height(), values);
}

TEST(general_bundle, recovers_poses_and_points) {
  Scene scene = makeScene(6, 60, {pinhole()});
  scene.bundle.pose_fixed = {1, 0, 0, 0, 0, 1};
  disturb(scene, 0.1, 0.2);
  const OptimizerSummary summary = solveToTheEnd(scene);
  expectTruth(scene, 1e-8);
  EXPECT_EQ(summary.residuals, 2 * scene.bundle.pixels.size());
  EXPECT_EQ(summary.parameters, 4u * 6 + 60 * 3);
  EXPECT_EQ(summary.observations, scene.bundle.pixels.size());
  EXPECT_EQ(summary.inliers, scene.bundle.pixels.size());
  EXPECT_EQ(summary.left_out, 0u);
  EXPECT_EQ(summary.backend, "pba");
}

TEST(general_bundle, recovers_shared_intrinsics_with_distortion) {
  Scene scene = makeScene(8, 80, {radtan(), pinhole()});
  scene.bundle.pose_fixed = {1, 0, 0, 0, 0, 0, 0, 1};
  scene.bundle.camera_freedom = {{0xffu, false}, {0xfu, false}};
  scene.bundle.cameras[0] = changed(radtan(), {15, -10, 5, -5, 0.05, -0.02, 0, 0});
  scene.bundle.cameras[1] = changed(pinhole(), {10, 12, -4, 3});
  disturb(scene, 0.05, 0.1);
  solveToTheEnd(scene);
  expectTruth(scene, 1e-6);
  expectParameters(scene.bundle.cameras[0], radtan(), 1e-6);
  expectParameters(scene.bundle.cameras[1], pinhole(), 1e-6);
}

TEST(general_bundle, keeps_the_aspect_where_it_is_told_to) {
  Scene scene = makeScene(5, 50, {pinhole()});
  scene.bundle.pose_fixed = {1, 0, 0, 0, 1};
  scene.bundle.camera_freedom = {{0x3u, true}};
  scene.bundle.cameras[0] = changed(pinhole(), {20, 20 * 505. / 500, 0, 0});
  disturb(scene, 0.05, 0.1);
  const OptimizerSummary summary = solveToTheEnd(scene);
  expectParameters(scene.bundle.cameras[0], pinhole(), 1e-7);
  EXPECT_NEAR(scene.bundle.cameras[0].parameters()[1] / scene.bundle.cameras[0].parameters()[0],
              505. / 500, 1e-14);
  EXPECT_EQ(summary.parameters, 3u * 6 + 50 * 3 + 1);
}

TEST(general_bundle, recovers_the_extrinsics_of_a_rig) {
  Scene scene = makeScene(6, 60, {pinhole(), radtan(), pinhole()}, true);
  scene.bundle.pose_fixed = {1, 0, 0, 0, 0, 1};
  scene.T_body_camera_free = {0, 1, 1};
  Random random(5);
  for (std::size_t c : {1u, 2u}) {
    scene.bundle.T_body_camera[c] *= SE3d::exp(random.tangent(0.1, 0.03));
  }
  disturb(scene, 0.05, 0.1);
  solveToTheEnd(scene);
  expectTruth(scene, 1e-7);
  for (std::size_t c = 0; c < 3; ++c) {
    EXPECT_TRUE(scene.bundle.T_body_camera[c].isApprox(scene.truth.T_body_camera[c], 1e-7));
  }
}

TEST(general_bundle, takes_the_scale_from_stereo) {
  Scene scene = makeScene(5, 50, {pinhole()});
  addStereo(scene, 0.4);
  scene.bundle.pose_fixed = {1, 0, 0, 0, 0};
  for (Vec3d& x : scene.bundle.points) {  // a wrong scale, about the fixed camera
    const Vec3d& centre = scene.bundle.T_world_body[0].translation();
    x = centre + 1.1 * (x - centre);
  }
  disturb(scene, 0.05, 0.1);
  const OptimizerSummary summary = solveToTheEnd(scene);
  expectTruth(scene, 1e-7);
  EXPECT_EQ(summary.residuals, 3 * scene.bundle.pixels.size());
}

TEST(general_bundle, takes_the_gauge_from_positions) {
  Scene scene = makeScene(5, 50, {pinhole()});
  for (std::uint32_t i = 0; i < 5; ++i) {
    scene.position_priors.push_back(
        {i, scene.truth.T_world_body[i].translation(), 100 * Mat3d::identity()});
  }
  disturb(scene, 0.1, 0.2);
  OptimizerOptions options = thorough();
  options.max_iterations = 300;
  solveToTheEnd(scene, options);
  expectTruth(scene, 1e-5);
}

TEST(general_bundle, takes_scale_from_relative_and_gauge_from_absolute_poses) {
  Scene scene = makeScene(5, 50, {pinhole()});
  const std::vector<SE3d>& truth = scene.truth.T_world_body;
  const Mat<double, 6, 6> information = 100 * Mat<double, 6, 6>::identity();
  scene.pose_priors.push_back({2, truth[2], information});
  for (std::uint32_t i = 0; i + 1 < 5; ++i) {
    scene.relative_priors.push_back({i, i + 1, truth[i].inverse() * truth[i + 1], information});
  }
  disturb(scene, 0.1, 0.2);
  solveToTheEnd(scene);
  expectTruth(scene, 1e-7);
}

TEST(general_bundle, recovers_far_points_by_direction_and_inverse_distance) {
  Scene scene = makeScene(4, 60, {pinhole()});
  Random random(9);
  for (std::size_t i = 0; i < 20; ++i) {  // 100 m to 10 km away
    const double distance = std::pow(10, 2 + 2 * double(i) / 20);
    scene.truth.points[i] = {0.3 * distance * random.uniform(), 0.2 * distance * random.uniform(),
                             distance};
  }
  for (std::size_t i = 0; i < scene.truth.pixels.size(); ++i) {
    const SE3d& pose = scene.truth.T_world_body[scene.truth.observation_pose[i]];
    const Vec3d x = pose.inverse() * scene.truth.points[scene.truth.observation_point[i]];
    ASSERT_TRUE(pinhole().project(x, scene.truth.pixels[i]));
  }
  scene.bundle = scene.truth;
  scene.bundle.pose_fixed = {1, 0, 0, 1};
  scene.point_anchor.assign(60, BundleProblem::kNoAnchor);
  for (std::uint32_t i = 0; i < 20; ++i) {
    scene.point_anchor[i] = i % 4;  // fixed and free anchors
    const Vec3d& centre = scene.truth.T_world_body[i % 4].translation();
    scene.bundle.points[i] = centre + (i % 3 == 0 ? 0.2 : 4.0) * (scene.truth.points[i] - centre);
  }
  disturb(scene, 0.05, 0.05);
  solveToTheEnd(scene);
  expectTruth(scene, 1e-5);
}

TEST(general_bundle, returns_anchored_points_that_cost_what_it_says) {
  Scene scene = makeEverything();
  OptimizerOptions options;
  options.loss.kind = LossKind::Cauchy;
  const OptimizerSummary summary = solveGeneralBundle(scene.problem(), options);
  ASSERT_TRUE(summary.is_usable);
  EXPECT_LT(summary.final_cost, summary.initial_cost);
  options.max_iterations = 0;
  const OptimizerSummary again = solveGeneralBundle(scene.problem(), options);
  EXPECT_NEAR(again.initial_cost, summary.final_cost, 1e-9 * std::fabs(summary.final_cost));
}

TEST(general_bundle, bears_half_of_the_observations_being_wrong) {
  for (const LossKind kind : {LossKind::Cauchy, LossKind::GemanMcClure, LossKind::Tukey}) {
    Scene scene = makeScene(8, 80, {pinhole()});
    scene.bundle.pose_fixed = {1, 0, 0, 0, 0, 0, 0, 1};
    Random random(21);
    std::size_t wrong = 0;
    for (Vec2d& pixel : scene.bundle.pixels) {
      if (random.uniform() > 0) continue;
      pixel += Vec2d{200 * random.uniform(), 200 * random.uniform()};
      ++wrong;
    }
    disturb(scene, 0.005, 0.01);
    OptimizerOptions options = thorough();
    options.max_iterations = 200;
    options.loss.kind = kind;
    options.loss.scale = kind == LossKind::Tukey ? 20 : 2;
    const OptimizerSummary summary = solveGeneralBundle(scene.problem(), options);
    ASSERT_TRUE(summary.is_usable);
    double sum = 0;
    for (std::size_t i = 1; i < 7; ++i) {
      sum +=
          (scene.bundle.T_world_body[i].translation() - scene.truth.T_world_body[i].translation())
              .norm();
    }
    EXPECT_LT(sum / 6, 0.02) << nameOf(kind);
    EXPECT_NEAR(double(summary.inliers), double(scene.bundle.pixels.size() - wrong),
                0.1 * double(wrong));
  }
}

}  // namespace
}  // namespace gslam
