#include <gmock/gmock.h>
#include <gslam/optimizer.h>
#include <gtest/gtest.h>

#include <cmath>
#include <cstddef>
#include <random>
#include <vector>

#include "backend_contract/scenes.h"
#include "not_finite.h"

namespace {

using backend_contract::BundleScene;
using backend_contract::bundleScene;
using gslam::LossKind;
using gslam::RobustLoss;
using gslam::SE3d;
using gslam::Vec2d;
using gslam::Vec3d;

using not_finite::kNan;

// One body at the origin that sees (1, 2, 5) with f = 100: at (20, 40).
BundleScene onePoint(const Vec2d& off) {
  BundleScene scene;
  scene.poses = {SE3d()};
  scene.points = {{1, 2, 5}};
  scene.cameras = {gslam::Camera::fromParameters("pinhole", 640, 480, {100, 100, 0, 0})};
  scene.of_pose = scene.of_point = scene.of_camera = {0};
  scene.pixels = {Vec2d{20, 40} + off};
  return scene;
}

TEST(bundle_cost, is_half_of_the_squared_residuals) {
  BundleScene scene = onePoint({3, -4});
  EXPECT_DOUBLE_EQ(bundleCost(scene.problem()), 12.5);
  scene.information = {{2, 0.5, 3}};  // 2 9 - 2 0.5 12 + 3 16
  EXPECT_DOUBLE_EQ(bundleCost(scene.problem()), 27);
  scene.of_camera.clear();
  EXPECT_DOUBLE_EQ(bundleCost(scene.problem()), 27);
  scene.baseline = {0.5};  // the right camera sees it at 10
  scene.right_u = {12};
  EXPECT_DOUBLE_EQ(bundleCost(scene.problem()), 31);
  scene.right_u = {kNan};
  EXPECT_DOUBLE_EQ(bundleCost(scene.problem()), 27);
}

TEST(bundle_cost, knows_every_loss) {
  // s = 25, a = 2
  BundleScene scene = onePoint({3, -4});
  const auto cost = [&](LossKind kind, double scale) {
    return bundleCost(scene.problem(), RobustLoss{kind, scale});
  };
  EXPECT_DOUBLE_EQ(cost(LossKind::Squared, 2), 12.5);
  EXPECT_DOUBLE_EQ(cost(LossKind::Huber, 2), 8);
  EXPECT_DOUBLE_EQ(cost(LossKind::Huber, 6), 12.5);
  EXPECT_DOUBLE_EQ(cost(LossKind::Cauchy, 2), 2 * std::log(7.25));
  EXPECT_DOUBLE_EQ(cost(LossKind::Tukey, 2), 2.0 / 3);
  EXPECT_DOUBLE_EQ(cost(LossKind::Tukey, 10), 100.0 / 6 * (1 - 0.75 * 0.75 * 0.75));
  EXPECT_DOUBLE_EQ(cost(LossKind::GemanMcClure, 2), 50.0 / 29);
  EXPECT_THROW(cost(LossKind::Huber, 0), gslam::ArgumentError);
}

TEST(bundle_cost, places_the_cameras_of_a_rig) {
  BundleScene scene = onePoint({3, -4});
  std::mt19937 generator(1);
  const SE3d moved = SE3d::exp(backend_contract::smallTangent<SE3d>(generator, 1));
  scene.poses = {moved};
  scene.extrinsics = {moved.inverse()};
  EXPECT_NEAR(bundleCost(scene.problem()), 12.5, 1e-12);
}

TEST(bundle_cost, leaves_out_what_a_camera_does_not_see) {
  BundleScene scene = onePoint({3, -4});
  scene.points[0] = {1, 2, 0};  // in the plane of the camera
  EXPECT_EQ(bundleCost(scene.problem()), 0);
  scene.points[0] = {-1, -2, -5};  // behind it: pinhole cameras are formulas
  EXPECT_DOUBLE_EQ(bundleCost(scene.problem()), 12.5);
}

TEST(bundle_cost, holds_priors_without_a_loss) {
  BundleScene scene = onePoint({0, 0});
  const auto cost = [&] { return bundleCost(scene.problem(), {LossKind::Cauchy, 0.1}); };
  EXPECT_NEAR(cost(), 0, 1e-24);
  gslam::Mat3d weights = gslam::Mat3d::identity();
  weights(0, 1) = weights(1, 0) = 0.5;
  scene.position_priors = {{0, {1, -2, 0}, weights}};  // 1 + 4 - 2 0.5 2
  EXPECT_NEAR(cost(), 1.5, 1e-14);
  scene.position_priors.clear();

  auto information = gslam::Mat<double, 6, 6>::identity();
  information(3, 3) = 10;
  const SE3d::Tangent tangent = {0.1, 0.2, -0.3, 0.4, -0.1, 0.2};
  double expected = 0;
  for (std::size_t i = 0; i < 6; ++i) expected += 0.5 * tangent[i] * tangent[i] * information(i, i);
  scene.pose_priors = {{0, SE3d::exp(tangent).inverse(), information}};
  EXPECT_NEAR(cost(), expected, 1e-14);
  scene.pose_priors.clear();

  scene.poses.push_back(SE3d::exp({1, 2, 3, 0.1, 0.2, 0.3}));
  scene.relative_priors = {{0, 1, scene.poses[1] * SE3d::exp(tangent).inverse(), information}};
  EXPECT_NEAR(cost(), expected, 1e-14);
  scene.relative_priors[0] = {1, 0, scene.poses[1].inverse() * SE3d::exp(tangent).inverse(),
                              information};
  EXPECT_NEAR(cost(), expected, 1e-14);
}

TEST(bundle_cost, holds_window_priors) {
  BundleScene scene = onePoint({0, 0});
  scene.poses.push_back(SE3d::exp({1, 2, 3, 0.1, 0.2, 0.3}));
  const SE3d::Tangent first = {0.1, 0.2, -0.3, 0.4, -0.1, 0.2}, second = {0, 0.3, 0, 0, 0, -0.2};
  gslam::WindowPrior prior;
  prior.poses = {1, 0};
  prior.T_linear = {scene.poses[1] * SE3d::exp(first).inverse(), SE3d::exp(second).inverse()};
  prior.information.assign(144, 0);
  for (std::size_t i = 0; i < 12; ++i) prior.information[13 * i] = 2;
  prior.information[7] = prior.information[84] = 0.5;  // of numbers 0 and 7
  prior.gradient.assign(12, 0);
  prior.gradient[11] = 3;
  scene.window_priors = {prior};
  const double expected = first.squaredNorm() + second.squaredNorm() + 0.5 * 0.1 * 0.3 + 3 * -0.2;
  EXPECT_NEAR(bundleCost(scene.problem()), expected, 1e-14);
}

TEST(bundle_cost, is_zero_at_the_truth_and_sums_many) {
  BundleScene scene = bundleScene(30, 300, 0);
  EXPECT_LT(bundleCost(scene.problem()), 1e-18);
  backend_contract::addNoise(scene, 1);
  BundleScene exact = bundleScene(30, 300, 0);
  double expected = 0;
  for (std::size_t i = 0; i < scene.pixels.size(); ++i) {
    expected += 0.5 * (scene.pixels[i] - exact.pixels[i]).squaredNorm();
  }
  EXPECT_NEAR(bundleCost(scene.problem()), expected, 1e-9 * expected);
}

TEST(bundle_cost, refuses_what_cannot_be_right) {
  BundleScene scene = onePoint({0, 0});
  scene.of_point[0] = 1;
  EXPECT_EQ(backend_contract::complaintOf([&] { bundleCost(scene.problem()); }),
            "observation_point[0] is 1, expected below 1");
}

}  // namespace
