// Bundles: every kind of variable and of knowledge.
#ifndef GSLAM_OPTIMIZER_TESTS_BACKEND_CONTRACT_CONTRACT_BUNDLE_H
#define GSLAM_OPTIMIZER_TESTS_BACKEND_CONTRACT_CONTRACT_BUNDLE_H

#include "fixture.h"

namespace backend_contract {

inline Camera radtan() {
  return Camera::fromParameters("radtan", 640, 480,
                                {420, 425, 320, 240, -0.1, 0.02, 0.001, -0.002});
}

/// The scene is solved to its truth, up to `tolerance`.
inline void expectSolved(BundleScene& scene, const gslam::OptimizerOptions& options,
                         double tolerance = 1e-6) {
  const gslam::OptimizerSummary summary = solveChecked(scene, options);
  EXPECT_TRUE(summary.is_usable) << fullReport(summary);
  EXPECT_LT(summary.final_cost, 1e-8) << fullReport(summary);
  EXPECT_LT(worstPose(scene.poses, scene.true_poses), tolerance) << fullReport(summary);
  EXPECT_LT(worstPoint(scene.points, scene.true_points), tolerance) << fullReport(summary);
}

/// Near points, and after them 30 points 100 km away, that start at another distance from their
/// anchors; 1 pixel of noise, which wants a third of those beyond infinity. The first and the last
/// pose are fixed.
inline BundleScene farScene(double start) {
  BundleScene scene = bundleScene(6, 60, 0);
  for (std::uint32_t i = 0; i < 30; ++i) {
    const double angle = 0.15 + 0.02 * i;
    scene.true_points[30 + i] = 1e5 * Vec3d{-std::sin(angle), 0.1 * std::sin(i), std::cos(angle)};
  }
  scene.of_pose.clear(), scene.of_point.clear(), scene.of_camera.clear(), scene.pixels.clear();
  observeAll(scene);
  addNoise(scene, 1);
  scene.points = scene.true_points;
  scene.anchors.assign(60, gslam::BundleProblem::kNoAnchor);
  for (std::uint32_t i = 30; i < 60; ++i) {
    scene.anchors[i] = 1 + i % 2;
    scene.points[i] *= start / 1e5;
  }
  scene.pose_fixed = {1, 0, 0, 0, 0, 1};
  std::mt19937 generator(8);
  for (std::size_t i = 1; i < 5; ++i) {
    scene.poses[i] = scene.poses[i] * SE3d::exp(smallTangent<SE3d>(generator, 0.01));
  }
  return scene;
}

/// No pose and no anchored point can be moved a little for a lower cost; of these points, how many
/// are as far as they can be.
inline std::size_t expectBest(const BundleScene& scene) {
  BundleScene moved = scene;
  const double best = bundleCost(moved.problem());
  for (std::size_t k = 0; k < 12; ++k) {
    SE3d::Tangent tangent{};
    tangent[k / 2] = k % 2 == 0 ? 1e-5 : -1e-5;
    moved.poses[3] = scene.poses[3] * SE3d::exp(tangent);
    EXPECT_GT(bundleCost(moved.problem()), best) << k;
  }
  moved.poses = scene.poses;
  std::size_t farthest = 0;
  for (std::size_t i = 0; i < scene.points.size(); ++i) {
    if (scene.anchors[i] == gslam::BundleProblem::kNoAnchor) continue;
    const Vec3d centre = scene.poses[scene.anchors[i]].translation();
    const Vec3d arm = scene.points[i] - centre;
    const double inverse = 1 / arm.norm();
    farthest += inverse < 1.001e-10 ? 1 : 0;
    for (const double step : {1e-5, -1e-5}) {
      if (inverse + step < 1e-10) continue;
      moved.points[i] = centre + inverse / (inverse + step) * arm;
      EXPECT_GT(bundleCost(moved.problem()), best) << i;
    }
    moved.points[i] = scene.points[i];
  }
  return farthest;
}

}  // namespace backend_contract

TEST_P(BackendContract, solves_bundles_of_every_camera_model) {
  using namespace backend_contract;
  NEEDS_FUNCTION(bundle);
  const std::vector<Camera> cameras = {
      pinhole(), radtan(),
      Camera::fromParameters("kannala_brandt", 640, 480,
                             {260, 262, 320, 240, 0.01, -0.005, 0.002, -0.001}),
      Camera::fromParameters("equirectangular", 1024, 512, {})};
  for (const Camera& camera : cameras) {
    SCOPED_TRACE(camera.modelName());
    BundleScene scene = bundleScene(5, 40, 0.02, camera);
    const BundleScene before = scene;
    expectSolved(scene, options());
    EXPECT_TRUE(areSameBits(scene.poses[0], before.poses[0]));
    EXPECT_TRUE(areSameBits(scene.poses[1], before.poses[1]));
    EXPECT_TRUE(areSameBits(scene.cameras, before.cameras));
  }
}

TEST_P(BackendContract, counts_residuals_and_parameters) {
  using namespace backend_contract;
  NEEDS_FUNCTION(bundle);
  BundleScene scene = bundleScene(5, 40, 0.02);
  scene.point_fixed.assign(40, 0);
  scene.point_fixed[7] = 1;
  scene.freedom = {{0xf, true}};
  const gslam::OptimizerSummary summary = solveChecked(scene, options());
  EXPECT_EQ(summary.observations, 200u);
  EXPECT_EQ(summary.inliers, 200u);
  EXPECT_EQ(summary.left_out, 0u);
  EXPECT_EQ(summary.residuals, 400u);
  EXPECT_EQ(summary.parameters, 3u * 6 + 39u * 3 + 3);
}

TEST_P(BackendContract, leaves_fixed_variables_as_they_are) {
  using namespace backend_contract;
  NEEDS_FUNCTION(bundle);
  BundleScene scene = bundleScene(5, 40, 0.02);
  addNoise(scene, 1);
  scene.point_fixed.assign(40, 0);
  for (std::size_t i = 0; i < 40; i += 3) scene.point_fixed[i] = 1;
  scene.pose_fixed[3] = 1;
  scene.freedom = {{0x1, false}};
  const BundleScene before = scene;
  solveChecked(scene, options());
  for (std::size_t i = 0; i < 5; ++i) {
    EXPECT_EQ(areSameBits(scene.poses[i], before.poses[i]), scene.pose_fixed[i] != 0) << i;
  }
  for (std::size_t i = 0; i < 40; ++i) {
    EXPECT_EQ(areSameBits(scene.points[i], before.points[i]), scene.point_fixed[i] != 0) << i;
  }
  const std::vector<double> now = scene.cameras[0].parameters(),
                            then = before.cameras[0].parameters();
  EXPECT_NE(now[0], then[0]);
  for (std::size_t i = 1; i < 4; ++i) EXPECT_EQ(now[i], then[i]) << i;
}

TEST_P(BackendContract, minimises_every_loss) {
  using namespace backend_contract;
  NEEDS_FUNCTION(bundle);
  for (const gslam::RobustLoss& loss : allLosses()) {
    SCOPED_TRACE(nameOf(loss.kind));
    BundleScene scene = bundleScene(6, 60, 0.01);
    addNoise(scene, 0.5, 13);        // no point is seen wrongly twice
    scene.poses = scene.true_poses;  // Tukey's and Geman and McClure's need a good start
    for (std::size_t i = 2; i < 6; ++i) {
      scene.poses[i] = scene.poses[i] * SE3d::exp({1e-3, -1e-3, 2e-3, 1e-3, 1e-3, -1e-3});
    }
    scene.points = scene.true_points;
    gslam::OptimizerOptions robust = options();
    robust.loss = loss;
    const gslam::OptimizerSummary summary = solveChecked(scene, robust);
    EXPECT_TRUE(summary.is_usable);
    if (loss.kind == gslam::LossKind::Squared) {
      EXPECT_EQ(summary.inliers, 360u);
    } else {
      EXPECT_LT(worstPose(scene.poses, scene.true_poses), 0.02);
      EXPECT_EQ(summary.inliers, 360u - 28u);
    }
    // An optimum: no small change of a pose lowers the cost.
    const double best = bundleCost(scene.problem(), loss);
    for (std::size_t k = 0; k < 6; ++k) {
      for (const double step : {-1e-4, 1e-4}) {
        BundleScene moved = scene;
        SE3d::Tangent tangent{};
        tangent[k] = step;
        moved.poses[4] = moved.poses[4] * SE3d::exp(tangent);
        EXPECT_GT(bundleCost(moved.problem(), loss), best * (1 - 1e-9)) << k;
      }
    }
  }
}

TEST_P(BackendContract, weighs_pixels_by_their_information) {
  using namespace backend_contract;
  NEEDS_FUNCTION(bundle);
  // Every third pixel is wrong and says that it knows nothing in that direction, or not at all.
  BundleScene scene = bundleScene(6, 40, 0.02);
  scene.information.assign(scene.pixels.size(), {4, 1, 2});
  for (std::size_t i = 0; i < scene.pixels.size(); i += 3) {
    scene.pixels[i] += i % 2 == 0 ? Vec2d{5, 5} : Vec2d{7, -90};
    scene.information[i] = i % 2 == 0 ? Vec3d{1, -1, 1} : Vec3d{0, 0, 0};
  }
  expectSolved(scene, options());
}

TEST_P(BackendContract, finds_intrinsics_that_poses_share) {
  using namespace backend_contract;
  NEEDS_FUNCTION(bundle);
  BundleScene scene = bundleScene(7, 60, 0.01, radtan());
  scene.cameras[0] =
      Camera::fromParameters("radtan", 640, 480, {430, 425, 322, 239, -0.08, 0.02, 0.001, -0.002});
  scene.freedom = {{0x1f, false}};
  expectSolved(scene, options(), 1e-5);
  const std::vector<double> found = scene.cameras[0].parameters(), truth = radtan().parameters();
  for (std::size_t i = 0; i < truth.size(); ++i) EXPECT_NEAR(found[i], truth[i], 1e-3) << i;
}

TEST_P(BackendContract, keeps_the_aspect_of_a_camera) {
  using namespace backend_contract;
  NEEDS_FUNCTION(bundle);
  BundleScene scene = bundleScene(6, 60, 0.01);
  scene.cameras[0] = Camera::fromParameters("pinhole", 640, 480, {480, 484.8, 319.5, 239.5});
  scene.freedom = {{0x1, true}};
  expectSolved(scene, options(), 1e-5);
  EXPECT_NEAR(scene.cameras[0].parameters()[0], 500, 1e-4);
  EXPECT_NEAR(scene.cameras[0].parameters()[1], 505, 1e-4);
}

TEST_P(BackendContract, moves_the_cameras_of_a_rig) {
  using namespace backend_contract;
  NEEDS_FUNCTION(bundle);
  BundleScene scene = bundleScene(5, 40, 0.01);
  scene.true_cameras = scene.cameras = {pinhole(), radtan()};
  scene.true_extrinsics = {SE3d::exp({0.01, 0, 0, 0.02, 0, 0}),
                           SE3d::exp({0.3, 0.02, 0, -0.05, 0.1, 0})};
  scene.extrinsics = scene.true_extrinsics;
  scene.of_pose.clear(), scene.of_point.clear(), scene.of_camera.clear(), scene.pixels.clear();
  observeAll(scene);
  BundleScene known = scene;
  expectSolved(known, options());
  EXPECT_TRUE(areSameBits(known.extrinsics, scene.extrinsics));

  scene.extrinsics[1] = scene.extrinsics[1] * SE3d::exp({0.01, 0.01, -0.01, 0.01, 0, 0.01});
  scene.extrinsic_free = {0, 1};
  const SE3d first = scene.extrinsics[0];
  expectSolved(scene, options());
  EXPECT_TRUE(areSameBits(scene.extrinsics[0], first));
  EXPECT_LT(worstPose(scene.extrinsics, scene.true_extrinsics), 1e-6);
}

TEST_P(BackendContract, takes_scale_from_stereo) {
  using namespace backend_contract;
  NEEDS_FUNCTION(bundle);
  BundleScene scene = bundleScene(5, 40, 0.02);
  scene.baseline = {0.2};
  scene.pose_fixed[1] = 0;  // nothing but the pair knows the scale
  scene.poses[1] = scene.poses[1] * SE3d::exp({0.02, -0.01, 0.02, 0, 0.01, 0});
  for (std::size_t i = 0; i < scene.pixels.size(); ++i) {
    const Vec3d seen =
        scene.true_poses[scene.of_pose[i]].inverse() * scene.true_points[scene.of_point[i]];
    Vec2d right;
    ASSERT_TRUE(pinhole().project(seen - Vec3d{0.2, 0, 0}, right));
    scene.right_u.push_back(i % 4 == 0 ? std::nan("") : right[0]);
  }
  expectSolved(scene, options());
}

TEST_P(BackendContract, varies_far_points_along_their_anchors) {
  using namespace backend_contract;
  NEEDS_FUNCTION(bundle);
  BundleScene scene = bundleScene(6, 40, 0);
  for (std::size_t i = 0; i < 10; ++i) {
    scene.true_points[i] = scene.true_points[i] + Vec3d{0, 0, 60};
  }
  scene.of_pose.clear(), scene.of_point.clear(), scene.of_camera.clear(), scene.pixels.clear();
  observeAll(scene);
  scene.points = scene.true_points;
  std::mt19937 generator(8);
  for (std::size_t i = 0; i < 10; ++i) {  // twice as far as they are
    scene.points[i] = scene.poses[1] * (2 * (scene.poses[1].inverse() * scene.points[i]));
  }
  for (std::size_t i = 2; i < 6; ++i) {
    scene.poses[i] = scene.poses[i] * SE3d::exp(smallTangent<SE3d>(generator, 0.01));
  }
  scene.anchors.assign(40, gslam::BundleProblem::kNoAnchor);
  for (std::uint32_t i = 0; i < 20; ++i) scene.anchors[i] = i < 10 ? 1 : 3;
  expectSolved(scene, options(), 1e-5);
}

TEST_P(BackendContract, ends_at_the_minimum_before_infinity) {
  using namespace backend_contract;
  NEEDS_FUNCTION(bundle);
  double first = 0;
  for (const double start : {30.0, 5e3, 5e9}) {
    SCOPED_TRACE(start);
    BundleScene scene = farScene(start);
    const gslam::OptimizerSummary summary = solveChecked(scene, options());
    EXPECT_EQ(summary.status, gslam::OptimizerStatus::Converged) << fullReport(summary);
    if (first == 0) first = summary.final_cost;
    EXPECT_NEAR(summary.final_cost, first, 1e-8 * first) << fullReport(summary);
    const std::size_t farthest = expectBest(scene);
    EXPECT_GT(farthest, 5u);
    EXPECT_LT(farthest, 25u);
  }
}

TEST_P(BackendContract, holds_poses_by_priors) {
  using namespace backend_contract;
  NEEDS_FUNCTION(bundle);
  BundleScene scene = bundleScene(6, 40, 0.02);
  scene.pose_fixed.clear();
  auto information = 100 * gslam::Mat<double, 6, 6>::identity();
  information(0, 4) = information(4, 0) = 20;
  scene.pose_priors = {{0, scene.true_poses[0], information}};
  scene.position_priors = {{5, scene.true_poses[5].translation(), gslam::Mat3d::identity()}};
  scene.relative_priors = {
      {1, 2, scene.true_poses[1].inverse() * scene.true_poses[2], information}};
  expectSolved(scene, options());
}

TEST_P(BackendContract, weighs_priors_against_observations) {
  using namespace backend_contract;
  NEEDS_FUNCTION(bundle);
  BundleScene scene = bundleScene(5, 30, 0.01);
  addNoise(scene, 0.5);
  gslam::WindowPrior window;
  window.poses = {4, 2};
  window.T_linear = {scene.poses[4], scene.poses[2]};
  window.information.assign(144, 0);
  for (std::size_t i = 0; i < 12; ++i) window.information[13 * i] = 1e4;
  window.information[8] = window.information[96] = 3e3;
  window.gradient.assign(12, 10);
  scene.window_priors = {window};
  scene.position_priors = {{3, {1, 1, 1}, 50 * gslam::Mat3d::identity()}};
  const gslam::OptimizerSummary summary = solveChecked(scene, options());
  const double best = bundleCost(scene.problem());
  for (std::uint32_t pose = 2; pose < 5; ++pose) {
    for (std::size_t k = 0; k < 12; ++k) {
      BundleScene moved = scene;
      SE3d::Tangent tangent{};
      tangent[k / 2] = k % 2 == 0 ? 1e-5 : -1e-5;
      moved.poses[pose] = moved.poses[pose] * SE3d::exp(tangent);
      EXPECT_GT(bundleCost(moved.problem()), best * (1 - 1e-10)) << fullReport(summary);
    }
  }
}

#endif  // GSLAM_OPTIMIZER_TESTS_BACKEND_CONTRACT_CONTRACT_BUNDLE_H
