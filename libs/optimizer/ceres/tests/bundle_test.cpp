#include <gslam/optimizer/files/bal.h>
#include <gslam/optimizer_ceres.h>
#include <gtest/gtest.h>

#include <cmath>
#include <cstdlib>
#include <cstring>
#include <limits>

#include "../../../../tests/harness/test_data.h"
#include "scenes.h"

namespace {

using gslam::BundleProblem;
using gslam::Camera;
using gslam::CameraFreedom;
using gslam::Mat3d;
using gslam::OptimizerOptions;
using gslam::OptimizerStatus;
using gslam::OptimizerSummary;
using gslam::SE3d;
using gslam::SO3d;
using gslam::Vec2d;
using gslam::Vec3d;
using scenes::Bundle;
using scenes::exact;
using scenes::kTwoFixed;
using scenes::solve;

TEST(bundle, finds_poses_and_points_with_two_poses_fixed) {
  const Bundle truth = Bundle::make(5, 60, {scenes::radtan()}, {}, 1);
  Bundle scene = truth;
  scene.disturb(0.05, 0.02, 0.1, 2);
  BundleProblem problem = scene.problem();
  problem.pose_fixed = kTwoFixed;
  const OptimizerSummary summary = solve(problem, exact());
  EXPECT_TRUE(summary.is_usable);
  EXPECT_EQ(OptimizerStatus::Converged, summary.status) << summary.message;
  EXPECT_LT(summary.final_cost, 1e-15);
  EXPECT_LT(scenes::farthest(truth.poses, scene.poses), 1e-8);
  EXPECT_LT(scenes::farthest(truth.points, scene.points), 1e-7);
  EXPECT_EQ(0, std::memcmp(truth.poses.data(), scene.poses.data(), 2 * sizeof(SE3d)));
  EXPECT_EQ(300u, summary.observations);
  EXPECT_EQ(600u, summary.residuals);
  EXPECT_EQ(3u * 6 + 60 * 3, summary.parameters);
  EXPECT_EQ(300u, summary.inliers);
  EXPECT_EQ("ceres", summary.backend);
}

TEST(bundle, finds_anchored_points_also_seen_from_their_anchor_only_by_direction) {
  const Bundle truth = Bundle::make(5, 60, {scenes::pinhole()}, {}, 1);
  Bundle scene = truth;
  scene.disturb(0.02, 0.01, 0.1, 2);
  std::vector<std::uint32_t> anchors;
  for (std::size_t j = 0; j < 60; ++j) {
    anchors.push_back(j % 4 == 3 ? BundleProblem::kNoAnchor : std::uint32_t(j % 5));
  }
  BundleProblem problem = scene.problem();
  problem.pose_fixed = kTwoFixed;
  problem.point_anchor = anchors;
  const OptimizerSummary summary = solve(problem, exact());
  EXPECT_LT(summary.final_cost, 1e-12) << summary.message;
  EXPECT_LT(scenes::farthest(truth.poses, scene.poses), 1e-6);
  EXPECT_LT(scenes::farthest(truth.points, scene.points), 1e-5);
}

TEST(bundle, takes_anchored_points_at_any_distance) {
  Bundle scene = Bundle::make(5, 60, {scenes::pinhole()}, {}, 1);
  const SE3d& first = scene.poses[0];
  // As good as in the anchor, where there is no direction, and as good as infinitely far.
  scene.points[0] = first * Vec3d{1e-11, 0, 1e-10};
  scene.points[1] = first * Vec3d{0, 0, 1e10};
  scene.points[2] = first * Vec3d{1e11, 0, 1e12};
  std::vector<Vec3d> information(scene.pixels.size(), {1, 0, 1});
  for (std::size_t o = 0; o < scene.pixels.size(); ++o) {
    const std::size_t j = scene.observation_point[o];
    if (j == 0) information[o] = {0, 0, 0};
    if (j == 0 || j >= 3) continue;
    const SE3d back = scene.poses[scene.observation_pose[o]].inverse();
    ASSERT_TRUE(scene.cameras[0].project(back * scene.points[j], scene.pixels[o]));
  }
  const std::vector<std::uint32_t> anchors(60, 0);
  BundleProblem problem = scene.problem();
  problem.pose_fixed = kTwoFixed;
  problem.point_anchor = anchors;
  problem.information = information;
  const std::vector<Vec3d> before = scene.points;
  const double cost = gslam::bundleCost(problem);
  OptimizerOptions options = exact();
  options.max_iterations = 0;
  EXPECT_NEAR(cost, solve(problem, options).initial_cost, 1e-9 * cost + 1e-15);
  EXPECT_EQ(0, std::memcmp(before.data(), scene.points.data(), 60 * sizeof(Vec3d)));
  scene.disturb(0, 1e-3, 0, 2);
  problem = scene.problem();
  problem.pose_fixed = kTwoFixed;
  problem.point_anchor = anchors;
  problem.information = information;
  options.max_iterations = 50;
  const OptimizerSummary summary = solve(problem, options);
  EXPECT_LT(summary.final_cost, 1e-9) << summary.message;
  const double left = gslam::bundleCost(problem);
  EXPECT_NEAR(left, summary.final_cost, 1e-9 * left + 1e-15);
  EXPECT_GT(scene.points[1].norm(), 1e6);
  EXPECT_GT(scene.points[2].norm(), 1e6);
}

// Everything else that is known, and nothing else.
struct Calibration {
  std::size_t cameras, cameras_of_pose;
  std::uint32_t mask;
  bool keeps_aspect;
  const char* model;
};

class bundle_calibration : public testing::TestWithParam<Calibration> {};

TEST_P(bundle_calibration, finds_the_free_parameters) {
  const Calibration& wanted = GetParam();
  const Camera camera = std::string(wanted.model) == "radtan" ? scenes::radtan()
                        : std::string(wanted.model) == "pinhole"
                            ? scenes::pinhole()
                            : Camera::fromParameters("kannala_brandt", 640, 480,
                                                     {400, 410, 320, 240, 0.01, -0.002, 0.001, 0});
  const Bundle truth =
      Bundle::make(5, 80, std::vector<Camera>(wanted.cameras, camera), {}, wanted.cameras_of_pose);
  Bundle scene = truth;
  scene.disturb(0.02, 0.01, 0.05, 2);
  for (Camera& moved : scene.cameras) {
    std::vector<double> values = moved.parameters();
    values[0] *= 1.02;
    if ((wanted.mask & 2U) != 0 || wanted.keeps_aspect) values[1] *= 1.02;
    moved = Camera::fromParameters(wanted.model, 640, 480, values);
  }
  const std::vector<CameraFreedom> freedom(wanted.cameras,
                                           CameraFreedom{wanted.mask, wanted.keeps_aspect});
  BundleProblem problem = scene.problem();
  problem.pose_fixed = kTwoFixed;
  problem.camera_freedom = freedom;
  OptimizerOptions options = exact();
  options.max_iterations = 200;
  const OptimizerSummary summary = solve(problem, options);
  EXPECT_LT(summary.final_cost, 1e-12) << summary.message;
  EXPECT_LT(scenes::farthest(truth.poses, scene.poses), 1e-5);
  for (std::size_t c = 0; c < scene.cameras.size(); ++c) {
    const std::vector<double> now = scene.cameras[c].parameters();
    const std::vector<double> then = truth.cameras[c].parameters();
    for (std::size_t i = 0; i < now.size(); ++i) {
      const bool is_free = ((wanted.mask >> i) & 1U) != 0 || (i == 1 && wanted.keeps_aspect);
      EXPECT_NEAR(then[i], now[i], is_free ? 1e-3 : 0) << i;
    }
  }
}

INSTANTIATE_TEST_SUITE_P(all, bundle_calibration,
                         testing::Values(Calibration{1, 1, 0b110011, false, "radtan"},
                                         Calibration{5, 1, 0b110011, false, "radtan"},
                                         Calibration{5, 1, 0b110001, true, "radtan"},
                                         Calibration{1, 1, 0b1, true, "pinhole"},
                                         Calibration{2, 2, 0b1111, false, "pinhole"},
                                         Calibration{5, 1, 0b110011, false, "kannala_brandt"},
                                         Calibration{1, 1, 0b10011, false, "kannala_brandt"}));

TEST(bundle, finds_where_cameras_sit_on_the_body) {
  const std::vector<SE3d> extrinsics = {SE3d(SO3d::exp({0, 0.05, 0}), {-0.3, 0, 0}),
                                        SE3d(SO3d::exp({0.02, -0.05, 0}), {0.3, 0.1, 0})};
  const Bundle truth = Bundle::make(5, 60, {scenes::pinhole(), scenes::radtan()}, extrinsics, 2);
  Bundle scene = truth;
  scene.disturb(0.02, 0.01, 0.05, 2);
  std::mt19937_64 generator(3);
  scene.T_body_camera[1] *= scenes::smallMotion(generator, 0.02, 0.02);
  const std::vector<std::uint8_t> is_free = {0, 1};
  BundleProblem problem = scene.problem();
  problem.pose_fixed = kTwoFixed;
  problem.T_body_camera_free = is_free;
  const OptimizerSummary summary = solve(problem, exact());
  EXPECT_LT(summary.final_cost, 1e-12) << summary.message;
  EXPECT_LT(scenes::farthest(truth.T_body_camera, scene.T_body_camera), 1e-7);
  EXPECT_EQ(0, std::memcmp(&truth.T_body_camera[0], &scene.T_body_camera[0], sizeof(SE3d)));
}

TEST(bundle, stereo_fixes_the_scale) {
  const Bundle truth = Bundle::make(5, 60, {scenes::pinhole()}, {}, 1);
  Bundle scene = truth;
  scene.baseline = {0.2};
  for (std::size_t o = 0; o < scene.pixels.size(); ++o) {
    Vec2d right{};
    const Vec3d point =
        truth.poses[truth.observation_pose[o]].inverse() * truth.points[truth.observation_point[o]];
    ASSERT_TRUE(truth.cameras[0].project(point - Vec3d{0.2, 0, 0}, right));
    scene.right_u.push_back(o % 3 == 0 ? std::numeric_limits<double>::quiet_NaN() : right[0]);
  }
  scene.disturb(0.02, 0.01, 0.1);
  const std::vector<std::uint8_t> fixed = {1, 0, 0, 0, 0};
  BundleProblem problem = scene.problem();
  problem.pose_fixed = fixed;
  const OptimizerSummary summary = solve(problem, exact());
  EXPECT_LT(summary.final_cost, 1e-12) << summary.message;
  EXPECT_LT(scenes::farthest(truth.poses, scene.poses), 1e-6);
  EXPECT_EQ(600u + 200u, summary.residuals);
}

TEST(bundle, priors_hold_the_whole) {
  const Bundle truth = Bundle::make(5, 60, {scenes::pinhole()}, {}, 1);
  Bundle scene = truth;
  scene.disturb(0.05, 0.02, 0.1, 0);
  std::vector<gslam::PositionPrior> positions;
  for (std::uint32_t i = 0; i < 5; ++i) {
    positions.push_back({i, truth.poses[i].translation(), 100 * Mat3d::identity()});
  }
  const gslam::AbsolutePosePrior prior = {0, truth.poses[0],
                                          100 * gslam::Mat<double, 6, 6>::identity()};
  const gslam::RelativePosePrior odometry = {1, 2, truth.poses[1].inverse() * truth.poses[2],
                                             100 * gslam::Mat<double, 6, 6>::identity()};
  BundleProblem problem = scene.problem();
  problem.position_priors = positions;
  problem.pose_priors = {&prior, 1};
  problem.relative_priors = {&odometry, 1};
  const OptimizerSummary summary = solve(problem, exact());
  EXPECT_LT(summary.final_cost, 1e-12) << summary.message;
  EXPECT_LT(scenes::farthest(truth.poses, scene.poses), 1e-6);
  EXPECT_EQ(600u + 15 + 6 + 6, summary.residuals);
}

// A quadratic of two poses, with a gradient and without information along one direction.
TEST(bundle, window_prior_is_the_quadratic_that_it_says) {
  std::mt19937_64 generator(5);
  gslam::WindowPrior prior;
  prior.poses = {0, 2};
  prior.T_linear = {scenes::smallMotion(generator, 1, 0.5), scenes::smallMotion(generator, 1, 0.5)};
  std::vector<double> root(11 * 12), minimum(12);
  for (double& value : root) value = scenes::noise(generator, 1);
  for (double& value : minimum) value = scenes::noise(generator, 0.01);
  prior.information.assign(144, 0);
  prior.gradient.assign(12, 0);
  for (std::size_t r = 0; r < 12; ++r) {
    for (std::size_t c = 0; c < 12; ++c) {
      for (std::size_t k = 0; k < 11; ++k) {
        prior.information[12 * r + c] += root[12 * k + r] * root[12 * k + c];
      }
      prior.gradient[r] -= prior.information[12 * r + c] * minimum[c];
    }
  }
  double least = 0;
  for (std::size_t r = 0; r < 12; ++r) least += 0.5 * prior.gradient[r] * minimum[r];
  std::vector<SE3d> poses = {prior.T_linear[0], SE3d(), prior.T_linear[1]};
  BundleProblem problem;
  problem.T_world_body = poses;
  problem.window_priors = {&prior, 1};
  const OptimizerSummary summary = solve(problem, exact());
  EXPECT_NEAR(0, summary.initial_cost, 1e-12);
  EXPECT_NEAR(least, summary.final_cost, 1e-9 * std::fabs(least));
  EXPECT_LT(summary.final_cost, 0);
  EXPECT_EQ(11u, summary.residuals);
}

// What rounding leaves of a gradient along what the information does not know is no gradient.
TEST(bundle, window_prior_may_be_linearised_at_its_optimum) {
  gslam::WindowPrior prior;
  prior.poses = {0};
  prior.T_linear = {SE3d()};
  prior.information.assign(36, 0);
  for (std::size_t i = 0; i < 5; ++i) prior.information[7 * i] = 1e7;
  prior.gradient.assign(6, 1e-9);
  std::vector<SE3d> poses = {SE3d()};
  BundleProblem problem;
  problem.T_world_body = poses;
  problem.window_priors = {&prior, 1};
  EXPECT_TRUE(solve(problem, exact()).is_usable);
  prior.gradient[5] = 1e-3;
  EXPECT_THROW(solve(problem, exact()), gslam::ArgumentError);
}

TEST(bundle, each_loss_survives_false_observations) {
  for (const gslam::LossKind kind : {gslam::LossKind::Huber, gslam::LossKind::Cauchy,
                                     gslam::LossKind::Tukey, gslam::LossKind::GemanMcClure}) {
    const Bundle truth = Bundle::make(5, 80, {scenes::pinhole()}, {}, 1);
    Bundle scene = truth;
    scene.disturb(0.003, 0.002, 0.01, 2);
    for (std::size_t o = 0; o < scene.pixels.size(); o += 17) scene.pixels[o] += Vec2d{60, -80};
    BundleProblem problem = scene.problem();
    problem.pose_fixed = kTwoFixed;
    OptimizerOptions options = exact();
    options.loss = {kind, 4};
    options.max_iterations = 100;
    const OptimizerSummary summary = solve(problem, options);
    const bool is_convex = kind == gslam::LossKind::Huber;
    EXPECT_LT(scenes::farthest(truth.poses, scene.poses), is_convex ? 0.05 : 3e-3) << int(kind);
    EXPECT_EQ(400u - 24u, summary.inliers) << int(kind);
    EXPECT_TRUE(summary.is_usable);
  }
}

TEST(bundle, losses_cost_what_they_say) {
  Bundle scene = Bundle::make(1, 2, {scenes::pinhole()}, {}, 1);
  scene.pixels[0] += Vec2d{3, 4};  // s = 25
  scene.pixels[1] += Vec2d{1, 0};  // s = 1
  const double a2 = 4;
  const double far[] = {25, 2 * 2 * 5 - a2, a2 * std::log(1 + 25 / a2), a2 / 3,
                        25 * a2 / (a2 + 25)};
  const double near[] = {1, 1, a2 * std::log(1 + 1 / a2), a2 / 3 * (1 - std::pow(0.75, 3)),
                         a2 / (a2 + 1)};
  for (int kind = 0; kind < 5; ++kind) {
    OptimizerOptions options;
    options.max_iterations = 0;
    options.loss = {gslam::LossKind(kind), 2};
    const OptimizerSummary summary = solve(scene.problem(), options);
    EXPECT_NEAR((far[kind] + near[kind]) / 2, summary.initial_cost, 1e-9) << kind;
    EXPECT_EQ(kind == 0 ? 2u : 1u, summary.inliers) << kind;
  }
}

TEST(bundle, information_weighs_pixels) {
  Bundle scene = Bundle::make(2, 1, {scenes::pinhole()}, {}, 1);
  scene.pixels[0] += Vec2d{3, 1};
  const std::vector<std::uint8_t> all = {1, 1};
  const std::vector<Vec3d> information = {{4, 1, 2}, {1, 0, 1}};
  BundleProblem problem = scene.problem();
  problem.pose_fixed = all;
  problem.information = information;
  OptimizerOptions options;
  options.max_iterations = 0;
  const OptimizerSummary summary = solve(problem, options);
  EXPECT_NEAR(0.5 * (4 * 9 + 2 * 1 * 3 + 2), summary.initial_cost, 1e-9);
  EXPECT_EQ(summary.initial_cost, summary.final_cost);
}

TEST(bundle, leaves_out_what_is_not_seen_and_counts_residuals_without_variables) {
  const Camera fisheye =
      Camera::fromParameters("kannala_brandt", 640, 480, {400, 410, 320, 240, 0, 0, 0, 0});
  Bundle scene = Bundle::make(2, 10, {fisheye}, {}, 1);
  scene.points[3] = scene.poses[0] * Vec3d{0, 0, -5};
  const std::vector<std::uint8_t> poses_fixed = {1, 1}, points_fixed(10, 1);
  BundleProblem problem = scene.problem();
  problem.pose_fixed = poses_fixed;
  problem.point_fixed = points_fixed;
  const OptimizerSummary summary = solve(problem);
  Vec2d pixel{};
  const std::size_t unseen = fisheye.project({0, 0, -5}, pixel) ? 0 : 1;
  EXPECT_GE(summary.left_out, unseen);
  EXPECT_EQ(20u, summary.left_out + summary.observations);
  EXPECT_EQ(0u, summary.parameters);
  EXPECT_TRUE(summary.is_usable);
  EXPECT_EQ(summary.initial_cost, summary.final_cost);
}

TEST(bundle, only_points_are_free) {
  const Bundle truth = Bundle::make(3, 10, {scenes::pinhole()}, {}, 1);
  Bundle scene = truth;
  scene.disturb(0, 0, 0.1);
  scene.poses = truth.poses;
  const std::vector<std::uint8_t> fixed = {1, 1, 1};
  BundleProblem problem = scene.problem();
  problem.pose_fixed = fixed;
  EXPECT_LT(solve(problem, exact()).final_cost, 1e-15);
  EXPECT_LT(scenes::farthest(truth.points, scene.points), 1e-6);
}

TEST(bundle, ladybug_reaches_the_known_optimum) {
  NEEDS_TEST_DATA();
  gslam::Bundle data =
      gslam::readBal(test_data::folder() + "bundle_adjustment/problem-49-7776-pre.txt");
  const bool is_full = std::getenv("GSLAM_FULL_TESTS") != nullptr;
  OptimizerOptions options;
  if (!is_full) options.max_iterations = 6;
  OptimizerSummary summary = solve(data.problem(), options);
  EXPECT_NEAR(8.509125e5, summary.initial_cost, 1);
  EXPECT_LT(summary.final_cost, is_full ? 1.3345e4 : 1.3380e4) << summary.message;
  EXPECT_EQ(49u * 9 + 7776 * 3, summary.parameters);
  const double final_cost = summary.final_cost;
  options.max_iterations = 0;
  EXPECT_NEAR(final_cost, solve(data.problem(), options).initial_cost, 1e-9 * final_cost);
}

}  // namespace
