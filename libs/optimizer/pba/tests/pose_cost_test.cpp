#include "small/pose_cost.h"

#include <gslam/base/simd.h>
#include <gtest/gtest.h>

#include <cmath>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "pose_reference.h"
#include "pose_scene.h"
#include "pose_tools.h"

namespace {

using gslam::LossKind;
using gslam::RobustLoss;
using gslam::SE3d;
using gslam::detail::pba::PoseCost;
using gslam::detail::pba::PoseCurvature;
using gslam::detail::pba::PoseValue;
using pose_scene::PoseScene;
using pose_tools::kLosses;

template <class Check>
void inAllVariants(const Check& check) {
  for (const gslam::Simd variant :
       gslam::detail::pba::poseKernel(gslam::detail::pba::PoseFormula::Pinhole).variants()) {
    SCOPED_TRACE(gslam::simdName(variant));
    const gslam::ScopedSimd scoped(variant);
    check();
  }
}

void expectSame(const PoseValue& value, const pose_reference::Value& expected,
                const pose_reference::Value& sizes) {
  EXPECT_NEAR(value.cost, static_cast<double>(expected.cost),
              1e-12 * static_cast<double>(expected.cost));
  EXPECT_EQ(value.seen, expected.seen);
  EXPECT_EQ(value.inliers, expected.inliers);
  for (std::size_t i = 0; i < 6; ++i) {
    const long double size = std::sqrt(sizes.hessian[i][i]);
    EXPECT_NEAR(value.equations.gradient[i], static_cast<double>(expected.gradient[i]),
                1e-11 * static_cast<double>(size * std::sqrt(2 * expected.cost)));
    for (std::size_t j = i; j < 6; ++j) {
      const long double other = std::sqrt(sizes.hessian[j][j]);
      EXPECT_NEAR(value.equations.hessian(i, j), static_cast<double>(expected.hessian[i][j]),
                  1e-11 * static_cast<double>(size * other))
          << i << ' ' << j;
    }
  }
}

// With both curvatures, in all variants.
void expectAsReference(const gslam::PoseProblem& problem, const SE3d& start, const SE3d& pose,
                       const RobustLoss& loss) {
  SCOPED_TRACE(gslam::nameOf(loss.kind));
  // Weights alone, so that what is compared with is the sum of sizes.
  const pose_reference::Value weights = pose_reference::at(problem, start, pose, loss, 0);
  const pose_reference::Value full = pose_reference::at(problem, start, pose, loss, 2);
  inAllVariants([&] {
    PoseCost cost(problem, start, loss);
    expectSame(cost.at(pose, PoseCurvature::Weights), weights, weights);
    expectSame(cost.at(pose, PoseCurvature::Full, true), full, weights);
    std::size_t flags = 0;
    for (const std::uint8_t flag : problem.inliers) flags += flag;
    EXPECT_EQ(flags, problem.inliers.empty() ? 0 : full.inliers);
  });
}

TEST(pose_cost, is_that_of_the_factor_for_all_models_losses_and_variants) {
  for (const gslam::Camera& camera : pose_scene::camerasOfAllModels()) {
    SCOPED_TRACE(camera.modelName());
    PoseScene scene = pose_scene::makeScene({camera}, 75, 1.0, 0.2);
    pose_scene::addInformation(scene);
    const SE3d pose = scene.truth * SE3d::exp({0.001, 0.003, -0.002, 0.001, -0.002, 0.001});
    for (const LossKind kind : kLosses) {
      expectAsReference(scene.problem(), scene.start, pose, {kind, 2.5});
    }
  }
}

TEST(pose_cost, is_that_of_the_factor_for_stereo) {
  for (const gslam::Camera& camera : {pose_scene::pinhole(), pose_scene::radtan(5)}) {
    PoseScene scene = pose_scene::makeScene({camera}, 130, 1.0, 0.2);
    pose_scene::addRight(scene, 1.0);
    for (const LossKind kind : kLosses) {
      expectAsReference(scene.problem(), scene.start, scene.truth, {kind, 2.5});
    }
  }
}

TEST(pose_cost, is_that_of_the_factor_for_rigs_with_a_prior) {
  PoseScene scene = pose_scene::makeScene(
      {pose_scene::pinhole(), pose_scene::camerasOfAllModels().back(), pose_scene::radtan(4)}, 200,
      1.0, 0.2);
  gslam::PosePrior prior{scene.start, gslam::Mat<double, 6, 6>::identity()};
  prior.information *= 1e4;
  prior.information(0, 4) = prior.information(4, 0) = 3e3;
  gslam::PoseProblem problem = scene.problem();
  problem.prior = &prior;
  for (const LossKind kind : kLosses) {
    expectAsReference(problem, scene.start, scene.truth, {kind, 2.5});
  }
}

TEST(pose_cost, is_that_of_the_factor_for_more_points_than_are_kept) {
  for (const gslam::Camera& camera : {pose_scene::pinhole(), pose_scene::radtan(8)}) {
    PoseScene scene = pose_scene::makeScene({camera}, 1100, 1.0, 0.2);
    expectAsReference(scene.problem(), scene.start, scene.truth, {LossKind::Huber, 2.5});
  }
}

TEST(pose_cost, has_the_gradient_of_its_values) {
  for (const gslam::Camera& camera : pose_scene::camerasOfAllModels()) {
    SCOPED_TRACE(camera.modelName());
    PoseScene scene = pose_scene::makeScene({camera}, 30, 1.0);
    const gslam::PoseProblem problem = scene.problem();
    const RobustLoss loss = {LossKind::Cauchy, 2.0};
    PoseCost cost(problem, scene.start, loss);
    const PoseValue value = cost.at(scene.start, PoseCurvature::Weights);
    for (std::size_t i = 0; i < 6; ++i) {
      constexpr double kStep = 1e-6;
      SE3d::Tangent step{};
      step[i] = kStep;
      const double numeric =
          (cost.at(scene.start * SE3d::exp(step), PoseCurvature::Weights).cost -
           cost.at(scene.start * SE3d::exp(-step), PoseCurvature::Weights).cost) /
          (2 * kStep);
      EXPECT_NEAR(value.equations.gradient[i], numeric,
                  1e-5 * (1 + std::sqrt(value.equations.hessian(i, i) * value.cost)));
    }
  }
}

TEST(pose_cost, of_tiny_residuals_has_all_its_digits) {
  PoseScene scene = pose_scene::makeScene({pose_scene::pinhole()}, 60, 1e-7);
  for (const LossKind kind : kLosses) {
    SCOPED_TRACE(gslam::nameOf(kind));
    const RobustLoss loss = {kind, 2.0}, none;
    const gslam::PoseProblem problem = scene.problem();
    inAllVariants([&] {
      const double cost =
          PoseCost(problem, scene.truth, loss).at(scene.truth, PoseCurvature::Weights).cost;
      const double squared =
          PoseCost(problem, scene.truth, none).at(scene.truth, PoseCurvature::Weights).cost;
      EXPECT_NEAR(cost, squared, 1e-11 * squared);
    });
  }
}

TEST(pose_cost, of_huge_residuals_is_finite_and_right) {
  PoseScene scene = pose_scene::makeScene({pose_scene::pinhole()}, 70, 0);
  for (gslam::Vec2d& pixel : scene.pixels) pixel = {1e9, -1e120};
  const RobustLoss loss = {LossKind::Cauchy, 2.0};
  const gslam::PoseProblem problem = scene.problem();
  inAllVariants([&] {
    const double cost =
        PoseCost(problem, scene.truth, loss).at(scene.truth, PoseCurvature::Weights).cost;
    EXPECT_NEAR(cost, 70 * 0.5 * 4 * std::log(1e240 / 4), 1e-9 * cost);
  });
}

TEST(pose_cost, has_no_value_where_a_point_is_in_the_plane_of_the_camera) {
  PoseScene scene = pose_scene::makeScene({pose_scene::pinhole()}, 9, 0);
  scene.truth = SE3d();
  scene.points[4] = {0.5, 0.25, 1};
  const gslam::PoseProblem problem = scene.problem();
  for (const LossKind kind : kLosses) {
    const RobustLoss loss = {kind, 2.0};
    PoseCost cost(problem, SE3d(), loss);
    inAllVariants([&] {
      const SE3d at_plane(gslam::SO3d(), {0, 0, 1});
      EXPECT_FALSE(std::isfinite(cost.at(at_plane, PoseCurvature::Weights).cost));
    });
  }
}

}  // namespace
