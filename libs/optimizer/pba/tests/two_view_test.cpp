#include <gslam/geometry/random.h>
#include <gtest/gtest.h>

#include <Eigen/Dense>
#include <cmath>
#include <cstddef>
#include <random>
#include <vector>

#include "factors/loss.h"
#include "factors/reprojection.h"
#include "pose_scene.h"
#include "solvers.h"

namespace {

using gslam::Camera;
using gslam::LossKind;
using gslam::OptimizedTwoView;
using gslam::OptimizerOptions;
using gslam::OptimizerStatus;
using gslam::SE3d;
using gslam::SO3d;
using gslam::TwoViewProblem;
using gslam::Vec2d;
using gslam::Vec3d;
using gslam::detail::pba::solveTwoView;

struct TwoViewScene {
  Camera first_camera, second_camera;
  SE3d truth, start;
  std::vector<Vec2d> first, second;
  std::vector<double> depths, true_depths, information, depth_information;

  TwoViewProblem problem() {
    TwoViewProblem p;
    p.first = first;
    p.second = second;
    p.information = information;
    p.first_camera = first_camera;
    p.second_camera = second_camera;
    p.inverse_depths = depths;
    p.depth_information = depth_information;
    return p;
  }
};

TwoViewScene twoViewScene(const Camera& first, const Camera& second, std::size_t n, double noise,
                          double outliers = 0) {
  std::mt19937_64 generator(n);
  TwoViewScene s;
  s.first_camera = first;
  s.second_camera = second;
  s.truth = SE3d(SO3d::exp({0.05, -0.1, 0.08}), {0.8, 0.1, 0.3});
  while (s.first.size() < n) {
    const Vec2d pixel = {gslam::randomUniform(generator, 40.0, 600.0),
                         gslam::randomUniform(generator, 40.0, 440.0)};
    const double depth = gslam::randomUniform(generator, 0.02, 0.3);
    Vec3d bearing{};
    Vec2d seen{};
    if (!first.unproject(pixel, bearing)) continue;
    const Vec3d p = s.truth.inverse() * (bearing / depth);
    if (!second.project(p, seen)) continue;
    if (seen[0] < 30 || seen[0] > 610) continue;  // where a panorama ends
    s.first.push_back(pixel);
    s.second.push_back(seen + noise * gslam::randomNormal<double, 2>(generator));
    if (gslam::randomUniform(generator, 0.0, 1.0) < outliers) {
      s.second.back() = {gslam::randomUniform(generator, 0.0, 640.0),
                         gslam::randomUniform(generator, 0.0, 480.0)};
    }
    s.true_depths.push_back(depth);
    s.depths.push_back(depth * gslam::randomUniform(generator, 0.7, 1.4));
  }
  const SE3d off = s.truth * SE3d::exp({0.05, -0.04, 0.06, 0.01, 0.02, -0.01});
  s.start = SE3d(off.rotation(),
                 s.truth.translation().norm() / off.translation().norm() * off.translation());
  return s;
}

// From the documentation.
struct TwoViewCost {
  TwoViewProblem problem;
  std::vector<double> means;
  gslam::RobustLoss loss;
  std::vector<Vec3d> bearings;

  TwoViewCost(const TwoViewProblem& p, const gslam::RobustLoss& robust)
      : problem(p),
        means(p.inverse_depths.begin(), p.inverse_depths.end()),
        loss(robust),
        bearings(p.first.size()) {
    for (std::size_t i = 0; i < bearings.size(); ++i) {
      EXPECT_TRUE(p.first_camera.unproject(p.first[i], bearings[i]));
    }
  }

  double at(const SE3d& T, const std::vector<double>& depths) const {
    const TwoViewProblem& p = problem;
    long double cost = 0;
    for (std::size_t i = 0; i < p.first.size(); ++i) {
      Vec2d pixel{};
      const Vec3d q = T.rotation().inverse() * (bearings[i] - depths[i] * T.translation());
      if (!gslam::detail::projectEverywhere(p.second_camera, q, pixel)) return 1e300;
      const double w = p.information.empty() ? 1 : p.information[i];
      cost += 0.5L * gslam::detail::lossAt(loss, w * (pixel - p.second[i]).squaredNorm()).rho;
      if (p.depth_information.empty()) continue;
      cost += 0.5L * p.depth_information[i] * (depths[i] - means[i]) * (depths[i] - means[i]);
    }
    return static_cast<double>(cost);
  }
};

// All second derivatives from differences, of the pose and then the depths; slopes too.
Eigen::MatrixXd differences(const TwoViewCost& cost, const SE3d& T,
                            const std::vector<double>& depths, Eigen::VectorXd& slope) {
  constexpr double kStep = 1e-5;
  const int n = 6 + static_cast<int>(depths.size());
  const auto at = [&](int i, double by_i, int j, double by_j) {
    SE3d::Tangent tangent{};
    std::vector<double> moved = depths;
    const auto move = [&](int k, double by) {
      if (k < 6) {
        tangent[std::size_t(k)] += by;
      } else {
        moved[std::size_t(k - 6)] += by;
      }
    };
    move(i, by_i);
    move(j, by_j);
    return cost.at(T * SE3d::exp(tangent), moved);
  };
  Eigen::MatrixXd second = Eigen::MatrixXd::Zero(n, n);
  slope.resize(n);
  for (int i = 0; i < n; ++i) {
    slope[i] = (at(i, kStep, i, 0) - at(i, -kStep, i, 0)) / (2 * kStep);
    for (int j = i; j < n; ++j) {
      if (i >= 6 && j != i) continue;  // depths know nothing of each other
      second(i, j) = second(j, i) = (at(i, kStep, j, kStep) - at(i, kStep, j, -kStep) -
                                     at(i, -kStep, j, kStep) + at(i, -kStep, j, -kStep)) /
                                    (4 * kStep * kStep);
    }
  }
  return second;
}

void expectMinimum(TwoViewScene& s, const OptimizerOptions& options) {
  const TwoViewCost cost(s.problem(), options.loss);
  const double before = cost.at(s.start, s.depths);
  const OptimizedTwoView result = solveTwoView(s.problem(), s.start, options);
  ASSERT_TRUE(result.summary.is_usable) << result.summary.message;
  EXPECT_EQ(result.summary.status, OptimizerStatus::Converged) << result.summary.message;
  EXPECT_TRUE(result.summary.warnings.empty());
  const double after = cost.at(result.T_first_second, s.depths);
  EXPECT_NEAR(result.summary.initial_cost, before, 1e-11 * before);
  EXPECT_NEAR(result.summary.final_cost, after, 1e-11 * after);
  Eigen::VectorXd slope;
  const Eigen::MatrixXd second = differences(cost, result.T_first_second, s.depths, slope);
  const Eigen::Index n = second.rows();
  Eigen::MatrixXd basis = Eigen::MatrixXd::Identity(n, n);
  if (s.depth_information.empty()) {
    EXPECT_NEAR(result.T_first_second.translation().norm(), s.start.translation().norm(), 1e-12);
    const Vec3d t =
        (result.T_first_second.rotation().inverse() * result.T_first_second.translation())
            .normalized();
    const Vec3d first = t.cross(Vec3d{0, 0, 1}).normalized(), last = t.cross(first);
    basis = Eigen::MatrixXd::Zero(n, n - 1);
    for (std::size_t i = 0; i < 3; ++i) {
      basis(Eigen::Index(i), 0) = first[i];
      basis(Eigen::Index(i), 1) = last[i];
    }
    basis.bottomRightCorner(n - 3, n - 3).setIdentity();
  }
  const Eigen::VectorXd free_slope = basis.transpose() * slope;
  const Eigen::MatrixXd free_second = basis.transpose() * second * basis;
  for (Eigen::Index i = 0; i < free_slope.size(); ++i) {
    EXPECT_NEAR(free_slope[i], 0, 3e-4 * std::sqrt(free_second(i, i) * (after + 1e-9))) << i;
  }
  const Eigen::MatrixXd covariance = basis * free_second.inverse() * basis.transpose();
  for (int i = 0; i < 36; ++i) {
    const double size = std::sqrt(covariance(i / 6, i / 6) * covariance(i % 6, i % 6));
    EXPECT_NEAR(result.covariance.values[i], covariance(i / 6, i % 6), 0.05 * size + 1e-12) << i;
  }
}

OptimizerOptions precise() {
  OptimizerOptions options;
  options.function_tolerance = 1e-12;
  options.max_iterations = 200;
  return options;
}

TEST(two_view, is_a_minimum_for_every_model) {
  for (const Camera& camera : pose_scene::camerasOfAllModels()) {
    SCOPED_TRACE(camera.modelName());
    TwoViewScene s = twoViewScene(camera, camera, 16, 0.3);
    expectMinimum(s, precise());
  }
}

TEST(two_view, is_a_minimum_with_depths_and_information) {
  TwoViewScene s = twoViewScene(pose_scene::radtan(5), pose_scene::pinhole(), 16, 0.3);
  std::mt19937_64 generator(3);
  for (std::size_t i = 0; i < 16; ++i) {
    s.information.push_back(gslam::randomUniform(generator, 0.5, 2.0));
    s.depths[i] = s.true_depths[i] + 0.003 * gslam::randomNormal<double, 1>(generator)[0];
    s.depth_information.push_back(i % 3 == 0 ? 0 : 1 / (0.003 * 0.003));
  }
  // Not of the length of the start.
  s.start = SE3d(s.start.rotation(), 1.2 * s.start.translation());
  expectMinimum(s, precise());
}

TEST(two_view, finds_the_motion_exactly_without_noise) {
  TwoViewScene s = twoViewScene(pose_scene::pinhole(), pose_scene::radtan(4), 200, 0);
  const OptimizedTwoView result = solveTwoView(s.problem(), s.start, precise());
  EXPECT_LT((result.T_first_second.inverse() * s.truth).log().norm(), 1e-8);
  for (std::size_t i = 0; i < 200; ++i) EXPECT_NEAR(s.depths[i], s.true_depths[i], 1e-8);
  EXPECT_EQ(result.summary.observations, 200u);
  EXPECT_EQ(result.summary.residuals, 400u);
  EXPECT_EQ(result.summary.parameters, 205u);
}

TEST(two_view, finds_the_motion_among_half_outliers) {
  TwoViewScene clean = twoViewScene(pose_scene::pinhole(), pose_scene::pinhole(), 400, 0.3, 0.5);
  for (const LossKind kind : {LossKind::Huber, LossKind::Cauchy, LossKind::GemanMcClure}) {
    SCOPED_TRACE(gslam::nameOf(kind));
    TwoViewScene s = clean;
    OptimizerOptions options = precise();
    options.loss = {kind, 1};
    const OptimizedTwoView result = solveTwoView(s.problem(), s.start, options);
    ASSERT_TRUE(result.summary.is_usable);
    EXPECT_LT(result.summary.final_cost, result.summary.initial_cost);
    if (kind == LossKind::Huber) continue;  // outliers pull with all the weight it leaves them
    EXPECT_LT((result.T_first_second.inverse() * s.truth).log().norm(), 0.02);
    EXPECT_NEAR(double(result.summary.inliers), 200, 50);
  }
}

TEST(two_view, keeps_points_at_infinity_and_never_goes_beyond) {
  TwoViewScene s = twoViewScene(pose_scene::pinhole(), pose_scene::pinhole(), 60, 0.3);
  for (std::size_t i = 0; i < 30; ++i) {  // far points with noise want to be beyond
    Vec3d bearing{};
    ASSERT_TRUE(s.first_camera.unproject(s.first[i], bearing));
    Vec2d pixel{};
    ASSERT_TRUE(s.second_camera.project(s.truth.rotation().inverse() * bearing, pixel));
    s.second[i] = pixel + Vec2d{i % 2 == 0 ? 0.5 : -0.5, 0.1};
    s.depths[i] = i % 3 == 0 ? 0 : 0.01;
  }
  const OptimizedTwoView result = solveTwoView(s.problem(), s.start, precise());
  ASSERT_TRUE(result.summary.is_usable);
  EXPECT_EQ(result.summary.status, OptimizerStatus::Converged) << result.summary.message;
  EXPECT_LT((result.T_first_second.inverse() * s.truth).log().norm(), 0.02);
  std::size_t at_infinity = 0;
  for (const double depth : s.depths) {
    EXPECT_GE(depth, 0);
    at_infinity += depth == 0 ? 1u : 0u;
  }
  EXPECT_GT(at_infinity, 5u);
  EXPECT_LT(at_infinity, 25u);
}

TEST(two_view, of_far_points_finds_the_rotation_alone) {
  TwoViewScene s = twoViewScene(pose_scene::pinhole(), pose_scene::pinhole(), 60, 0);
  for (std::size_t i = 0; i < 60; ++i) {
    Vec3d bearing{};
    ASSERT_TRUE(s.first_camera.unproject(s.first[i], bearing));
    ASSERT_TRUE(s.second_camera.project(s.truth.rotation().inverse() * bearing, s.second[i]));
    s.depths[i] = 0;
  }
  const OptimizedTwoView result = solveTwoView(s.problem(), s.start, precise());
  EXPECT_TRUE(result.summary.is_usable);
  EXPECT_LT((result.T_first_second.rotation().inverse() * s.truth.rotation()).angle(), 1e-5);
  EXPECT_NEAR(result.T_first_second.translation().norm(), s.start.translation().norm(), 1e-12);
}

TEST(two_view, leaves_points_behind_the_second_camera_out) {
  TwoViewScene s = twoViewScene(pose_scene::pinhole(), pose_scene::pinhole(), 60, 0.3);
  s.truth = s.start = SE3d(SO3d(), {0, 0, 1});
  for (std::size_t i = 0; i < 60; ++i) {
    Vec3d bearing{};
    ASSERT_TRUE(s.first_camera.unproject(s.first[i], bearing));
    const Vec3d p = bearing / s.true_depths[i] - Vec3d{0, 0, 1};
    ASSERT_TRUE(s.second_camera.project(p, s.second[i]));
    s.depths[i] = i < 10 ? 5 : s.true_depths[i];  // 20 cm away, behind the second camera
  }
  const OptimizedTwoView result = solveTwoView(s.problem(), s.start, {});
  EXPECT_EQ(result.summary.left_out, 10u);
  EXPECT_EQ(result.summary.observations, 50u);
  for (std::size_t i = 0; i < 10; ++i) EXPECT_EQ(s.depths[i], 5);
}

TEST(two_view, gives_back_what_it_got_where_it_fails) {
  TwoViewScene s = twoViewScene(pose_scene::pinhole(), pose_scene::pinhole(), 20, 0.3);
  s.second[5] = {1e200, 0};
  const std::vector<double> before = s.depths;
  const OptimizedTwoView result = solveTwoView(s.problem(), s.start, {});
  EXPECT_FALSE(result.summary.is_usable);
  EXPECT_EQ(s.depths, before);
  EXPECT_EQ(result.T_first_second.translation(), s.start.translation());
  for (double& depth : s.depths) depth = 1e3;  // all of them behind the second camera
  s.start = SE3d(SO3d(), {0, 0, 1});
  const OptimizedTwoView behind = solveTwoView(s.problem(), s.start, {});
  EXPECT_FALSE(behind.summary.is_usable);
  EXPECT_EQ(behind.summary.status, OptimizerStatus::Failed);
}

TEST(two_view, keeps_the_last_step_where_progress_throws) {
  TwoViewScene s = twoViewScene(pose_scene::pinhole(), pose_scene::pinhole(), 50, 0.3);
  const std::vector<double> before = s.depths;
  OptimizerOptions options;
  options.progress = [](const gslam::OptimizerIteration& iteration) {
    if (iteration.number == 2) throw 7;
    return true;
  };
  EXPECT_THROW((void)solveTwoView(s.problem(), s.start, options), int);
  EXPECT_NE(s.depths, before);
}

}  // namespace
