#include <gslam/geometry/random.h>
#include <gtest/gtest.h>

#include <Eigen/Dense>
#include <cmath>
#include <cstddef>
#include <random>
#include <vector>

#include "factors/loss.h"
#include "solvers.h"

namespace {

using gslam::AlignmentProblem;
using gslam::LossKind;
using gslam::Mat3d;
using gslam::OptimizedAlignment;
using gslam::OptimizerOptions;
using gslam::OptimizerStatus;
using gslam::SE3d;
using gslam::SIM3d;
using gslam::SO3d;
using gslam::Vec3d;
using gslam::Vec4d;
using gslam::detail::pba::solveAlignment;
using Mat6d = gslam::Mat<double, 6, 6>;

SE3d rigidOf(const SE3d& T) {
  return T;
}
SE3d rigidOf(const SIM3d& T) {
  return T.rigid();
}

struct AlignmentScene {
  std::vector<Vec3d> points_b, points_a, plane_points, line_points, line_origins, line_directions;
  std::vector<Vec4d> planes;
  std::vector<Mat3d> point_information;
  std::vector<double> plane_information, line_information;
  std::vector<SE3d> T_b_body, T_a_body;
  std::vector<Mat6d> pose_information;

  AlignmentProblem problem() const {
    AlignmentProblem p;
    p.points_b = points_b;
    p.points_a = points_a;
    p.point_information = point_information;
    p.plane_points_b = plane_points;
    p.planes_a = planes;
    p.plane_information = plane_information;
    p.line_points_b = line_points;
    p.line_origins_a = line_origins;
    p.line_directions_a = line_directions;
    p.line_information = line_information;
    p.T_b_body = T_b_body;
    p.T_a_body = T_a_body;
    p.pose_information = pose_information;
    return p;
  }
};

template <std::size_t N>
gslam::Mat<double, N, N> randomInformation(std::mt19937_64& generator) {
  gslam::Mat<double, N, N> root = 2.0 * gslam::Mat<double, N, N>::identity();
  for (double& value : root.values) value += gslam::randomUniform(generator, -0.5, 0.5);
  return root.transpose() * root;
}

// n of each kind, of which `outliers` are anywhere.
template <class Group>
AlignmentScene alignmentScene(const Group& T, std::size_t n, double noise, double outliers = 0) {
  std::mt19937_64 generator(n);
  const auto normal = [&] { return noise * gslam::randomNormal<double, 3>(generator); };
  const auto place = [&] { return 3.0 * gslam::randomNormal<double, 3>(generator); };
  AlignmentScene s;
  for (std::size_t i = 0; i < n; ++i) {
    const bool is_outlier = gslam::randomUniform(generator, 0.0, 1.0) < outliers;
    const auto moved = [&](const Vec3d& p) { return is_outlier ? place() : T * p + normal(); };
    s.points_b.push_back(place());
    s.points_a.push_back(moved(s.points_b.back()));
    s.point_information.push_back(randomInformation<3>(generator));
    s.plane_points.push_back(place());
    const Vec3d n_a = gslam::randomDirection<double>(generator);
    s.planes.push_back({n_a[0], n_a[1], n_a[2], -n_a.dot(moved(s.plane_points.back()))});
    s.plane_information.push_back(gslam::randomUniform(generator, 0.5, 2.0));
    s.line_points.push_back(place());
    s.line_directions.push_back(gslam::randomDirection<double>(generator));
    s.line_origins.push_back(moved(s.line_points.back()) +
                             gslam::randomUniform(generator, -2.0, 2.0) * s.line_directions.back());
    s.line_information.push_back(gslam::randomUniform(generator, 0.5, 2.0));
    s.T_b_body.push_back(SE3d(SO3d::exp(0.2 * place()), place()));
    const Vec3d turn = normal();
    s.T_a_body.push_back(SE3d(rigidOf(T).rotation() * s.T_b_body.back().rotation() *
                                  SO3d::exp(is_outlier ? place() : turn),
                              moved(s.T_b_body.back().translation())));
    s.pose_information.push_back(randomInformation<6>(generator));
  }
  return s;
}

// From the documentation, one correspondence after the other, in long double where it sums.
template <class Group>
double costOf(const AlignmentProblem& p, const Group& T, const gslam::RobustLoss& loss) {
  long double sum = 0;
  const auto add = [&](double s) { sum += 0.5L * gslam::detail::lossAt(loss, s).rho; };
  for (std::size_t i = 0; i < p.points_b.size(); ++i) {
    const Vec3d r = T * p.points_b[i] - p.points_a[i];
    add(p.point_information.empty() ? r.dot(r) : r.dot(p.point_information[i] * r));
  }
  for (std::size_t i = 0; i < p.plane_points_b.size(); ++i) {
    const Vec4d& plane = p.planes_a[i];
    const double r = Vec3d{plane[0], plane[1], plane[2]}.dot(T * p.plane_points_b[i]) + plane[3];
    add((p.plane_information.empty() ? 1 : p.plane_information[i]) * r * r);
  }
  for (std::size_t i = 0; i < p.line_points_b.size(); ++i) {
    const Vec3d r = p.line_directions_a[i].cross(T * p.line_points_b[i] - p.line_origins_a[i]);
    add((p.line_information.empty() ? 1 : p.line_information[i]) * r.squaredNorm());
  }
  for (std::size_t i = 0; i < p.T_b_body.size(); ++i) {
    const SE3d moved(rigidOf(T).rotation() * p.T_b_body[i].rotation(),
                     T * p.T_b_body[i].translation());
    const SE3d::Tangent r = (p.T_a_body[i].inverse() * moved).log();
    add(p.pose_information.empty() ? r.dot(r) : r.dot(p.pose_information[i] * r));
  }
  return static_cast<double>(sum);
}

// At a minimum all derivatives vanish, and the inverse of the second ones (from differences) is
// near the covariance where residuals are small.
template <class Group>
void expectMinimum(const AlignmentProblem& problem, const Group& start,
                   const OptimizerOptions& options, double covariance_tolerance) {
  const OptimizedAlignment<Group> result = solveAlignment(problem, start, options);
  ASSERT_TRUE(result.summary.is_usable) << result.summary.message;
  EXPECT_EQ(result.summary.status, OptimizerStatus::Converged) << result.summary.message;
  EXPECT_TRUE(result.summary.warnings.empty());
  const double cost = costOf(problem, result.T_a_b, options.loss);
  EXPECT_NEAR(result.summary.final_cost, cost, 1e-11 * cost);
  EXPECT_NEAR(result.summary.initial_cost, costOf(problem, start, options.loss),
              1e-11 * result.summary.initial_cost);
  constexpr int kFreedom = static_cast<int>(Group::kFreedom);
  constexpr double kStep = 1e-4;
  const auto at = [&](int i, double by_i, int j, double by_j) {
    typename Group::Tangent step{};
    step[std::size_t(i)] += by_i;
    step[std::size_t(j)] += by_j;
    return costOf(problem, result.T_a_b * Group::exp(step), options.loss);
  };
  Eigen::Matrix<double, kFreedom, kFreedom> second;
  for (int i = 0; i < kFreedom; ++i) {
    for (int j = 0; j < kFreedom; ++j) {
      second(i, j) = (at(i, kStep, j, kStep) - at(i, kStep, j, -kStep) - at(i, -kStep, j, kStep) +
                      at(i, -kStep, j, -kStep)) /
                     (4 * kStep * kStep);
    }
  }
  const Eigen::Matrix<double, kFreedom, kFreedom> covariance = second.inverse();
  for (int i = 0; i < kFreedom; ++i) {
    const double slope = (at(i, kStep, i, 0) - at(i, -kStep, i, 0)) / (2 * kStep);
    EXPECT_NEAR(slope, 0, 2e-4 * std::sqrt(second(i, i) * cost)) << i;
    for (int j = 0; j < kFreedom; ++j) {
      EXPECT_NEAR(result.covariance(std::size_t(i), std::size_t(j)), covariance(i, j),
                  covariance_tolerance * std::sqrt(covariance(i, i) * covariance(j, j)))
          << i << ' ' << j;
    }
  }
}

const SE3d kRigid(SO3d::exp({0.4, -0.3, 0.6}), {1, -2, 0.5});
const SIM3d kSimilar(kRigid, 1.7);
const SE3d::Tangent kOff = {0.1, -0.2, 0.15, 0.1, 0.2, -0.1};
const SIM3d::Tangent kSimilarOff = {0.1, -0.2, 0.15, 0.1, 0.2, -0.1, 0.3};

TEST(alignment, is_a_minimum_for_each_kind_of_correspondence) {
  const AlignmentScene rigid = alignmentScene(kRigid, 40, 0.01);
  const AlignmentScene similar = alignmentScene(kSimilar, 40, 0.01);
  for (int kind = 0; kind < 5; ++kind) {
    SCOPED_TRACE(kind);
    const auto only = [kind](AlignmentScene s) {
      if (kind != 0 && kind != 4) s.points_b.clear(), s.points_a.clear(), s.point_information = {};
      if (kind != 1 && kind != 4)
        s.plane_points.clear(), s.planes.clear(), s.plane_information = {};
      if (kind != 2 && kind != 4) {
        s.line_points.clear(), s.line_origins.clear(), s.line_directions.clear();
        s.line_information.clear();
      }
      if (kind != 3 && kind != 4) s.T_a_body.clear(), s.T_b_body.clear(), s.pose_information = {};
      return s;
    };
    const AlignmentScene a = only(rigid), b = only(similar);
    expectMinimum(a.problem(), kRigid * SE3d::exp(kOff), {}, 0.02);
    expectMinimum(b.problem(), kSimilar * SIM3d::exp(kSimilarOff), {}, 0.02);
  }
}

TEST(alignment, is_a_minimum_without_information) {
  AlignmentScene s = alignmentScene(kSimilar, 40, 0.01);
  s.point_information = {};
  s.plane_information = {};
  s.line_information = {};
  s.pose_information = {};
  expectMinimum(s.problem(), kSimilar * SIM3d::exp(kSimilarOff), {}, 0.02);
}

TEST(alignment, is_a_minimum_with_every_loss_among_half_outliers) {
  const AlignmentScene rigid = alignmentScene(kRigid, 100, 0.01, 0.5);
  const AlignmentScene similar = alignmentScene(kSimilar, 100, 0.01, 0.5);
  const SE3d::Tangent near = {0.01, 0.02, -0.01, 0.01, 0.01, -0.01};
  const SIM3d::Tangent near_similar = {0.01, 0.02, -0.01, 0.01, 0.01, -0.01, 0.01};
  for (const LossKind kind :
       {LossKind::Huber, LossKind::Cauchy, LossKind::Tukey, LossKind::GemanMcClure}) {
    SCOPED_TRACE(gslam::nameOf(kind));
    OptimizerOptions options;
    options.loss = {kind, 0.2};
    options.function_tolerance = 1e-12;
    options.max_iterations = 200;
    const auto a = solveAlignment(rigid.problem(), kRigid * SE3d::exp(near), options);
    ASSERT_TRUE(a.summary.is_usable);
    EXPECT_LT((a.T_a_b.inverse() * kRigid).log().norm(), 0.1);
    EXPECT_EQ(a.summary.observations, 400u);
    const auto b = solveAlignment(similar.problem(), kSimilar * SIM3d::exp(near_similar), options);
    ASSERT_TRUE(b.summary.is_usable);
    EXPECT_LT((b.T_a_b.inverse() * kSimilar).log().norm(), 0.1);
    if (kind == LossKind::Huber) continue;  // outliers keep half their pull
    EXPECT_NEAR(double(a.summary.inliers), 200, 60);
    EXPECT_NEAR(double(b.summary.inliers), 200, 60);
  }
}

TEST(alignment, stays_where_planes_do_not_hold_it) {
  // A floor: nothing holds x, y and the turn about z.
  AlignmentScene s;
  std::mt19937_64 generator(1);
  for (int i = 0; i < 50; ++i) {
    const Vec3d p = gslam::randomNormal<double, 3>(generator);
    s.plane_points.push_back({p[0], p[1], 0});
    s.planes.push_back({0, 0, 1, 0});
  }
  for (const SE3d& start : {SE3d(SO3d(), {3, 4, 0.5}), SE3d(SO3d::exp({0.1, 0.2, 0}), {3, 4, 0.5}),
                            SE3d(SO3d::exp({0.1, 0.2, 1.3}), {3, 4, 0.5})}) {
    const auto result = solveAlignment(s.problem(), start, {});
    EXPECT_TRUE(result.summary.is_usable);
    EXPECT_EQ(result.summary.status, OptimizerStatus::Converged);
    EXPECT_LT(result.summary.final_cost, 1e-10);
    EXPECT_LT((result.T_a_b.translation() - start.translation()).norm(), 1.2);
    EXPECT_LT((result.T_a_b.rotation().inverse() * start.rotation()).angle(), 0.4);
    EXPECT_EQ(result.covariance, Mat6d{});
    EXPECT_EQ(result.summary.warnings.size(), 1u);
  }
  // Long after it has been reached, too.
  OptimizerOptions endless;
  endless.function_tolerance = endless.parameter_tolerance = endless.gradient_tolerance = 0;
  endless.max_iterations = 500;
  const auto result =
      solveAlignment(s.problem(), SE3d(SO3d::exp({0.1, 0.2, 0}), {3, 4, 0.5}), endless);
  EXPECT_LT(std::fabs(result.T_a_b.translation()[0] - 3), 0.5);
  EXPECT_LT(std::fabs(result.T_a_b.translation()[1] - 4), 0.5);
}

TEST(alignment, on_a_noisy_floor_goes_as_far_as_its_covariance_says_and_a_pose_holds_it) {
  constexpr double kNoise = 0.01;
  AlignmentScene s;
  std::mt19937_64 generator(2);
  for (int i = 0; i < 200; ++i) {
    Vec3d p = 3.0 * gslam::randomNormal<double, 3>(generator);
    p[2] = 0;
    const Vec3d tilt = kNoise * gslam::randomNormal<double, 3>(generator);
    const Vec3d n = (Vec3d{0, 0, 1} + tilt).normalized();
    const double offset = kNoise * gslam::randomNormal<double, 1>(generator)[0];
    s.plane_points.push_back(p);
    s.planes.push_back({n[0], n[1], n[2], offset - n.dot(p)});
    s.plane_information.push_back(1 / (kNoise * kNoise));
  }
  const SE3d start(SO3d::exp({0.01, 0.02, 0.03}), {0.3, -0.2, 0.05});
  const auto free = solveAlignment(s.problem(), start, {});
  ASSERT_TRUE(free.summary.is_usable);
  EXPECT_TRUE(free.summary.warnings.empty());
  const SE3d::Tangent error = free.T_a_b.log();  // the truth is the identity
  for (std::size_t i = 0; i < 6; ++i) {
    EXPECT_LT(std::fabs(error[i]), 4 * std::sqrt(free.covariance(i, i))) << i;
  }
  EXPECT_GT(free.covariance(0, 0), 100 * free.covariance(2, 2));
  s.T_b_body = {SE3d()};
  s.T_a_body = {start};
  s.pose_information = {1 / (kNoise * kNoise) * Mat6d::identity()};
  const auto held = solveAlignment(s.problem(), start, {});
  ASSERT_TRUE(held.summary.is_usable);
  for (std::size_t i = 0; i < 2; ++i) {
    EXPECT_NEAR(held.T_a_b.translation()[i], start.translation()[i], 0.03);
  }
  EXPECT_LT(std::fabs(held.T_a_b.translation()[2]), 0.01);
}

TEST(alignment, of_one_point_or_of_points_on_a_line_turns_as_little_as_it_can) {
  AlignmentScene s;
  s.points_b = {{1, 2, 3}};
  s.points_a = {{2, 2, 3}};
  const auto one = solveAlignment(s.problem(), SE3d(), {});
  EXPECT_TRUE(one.summary.is_usable);
  EXPECT_LT(one.summary.final_cost, 1e-12);
  EXPECT_EQ(one.covariance, Mat6d{});
  for (int i = 1; i < 10; ++i) {
    s.points_b.push_back({1, 2 + 0.1 * i, 3});
    s.points_a.push_back({2, 2, 3 + 0.1 * i});
  }
  const auto line = solveAlignment(s.problem(), SE3d(), {});
  EXPECT_TRUE(line.summary.is_usable);
  EXPECT_LT(line.summary.final_cost, 1e-10);
  EXPECT_EQ(line.covariance, Mat6d{});
  EXPECT_EQ(line.summary.warnings.size(), 1u);
}

TEST(alignment, without_information_at_all_stays) {
  AlignmentScene s = alignmentScene(kRigid, 10, 0.01);
  for (Mat3d& information : s.point_information) information = {};
  s.plane_points.clear(), s.planes.clear(), s.plane_information.clear();
  s.line_points.clear(), s.line_origins.clear(), s.line_directions.clear();
  s.line_information.clear(), s.T_a_body.clear(), s.T_b_body.clear(), s.pose_information.clear();
  const auto result = solveAlignment(s.problem(), kRigid, {});
  EXPECT_LT((result.T_a_b.inverse() * kRigid).log().norm(), 1e-15);
  EXPECT_EQ(result.covariance, Mat6d{});
}

TEST(alignment, gives_back_the_start_where_the_cost_has_no_value) {
  AlignmentScene s = alignmentScene(kRigid, 10, 0.01);
  s.points_a[3] = {1e200, 0, 0};
  const auto result = solveAlignment(s.problem(), kRigid, {});
  EXPECT_FALSE(result.summary.is_usable);
  EXPECT_EQ(result.summary.status, OptimizerStatus::Failed);
  EXPECT_EQ(result.T_a_b.translation(), kRigid.translation());
  EXPECT_EQ(result.covariance, Mat6d{});
}

TEST(alignment, converges_from_half_a_turn) {
  AlignmentScene s = alignmentScene(kRigid, 40, 0.01);
  s.plane_points.clear(), s.planes.clear(), s.plane_information.clear();
  s.line_points.clear(), s.line_origins.clear(), s.line_directions.clear();
  s.line_information.clear(), s.T_a_body.clear(), s.T_b_body.clear(), s.pose_information.clear();
  s.point_information.clear();
  const auto result =
      solveAlignment(s.problem(), kRigid * SE3d::exp({0, 0, 0, 1.5, -1.5, 1.5}), {});
  EXPECT_TRUE(result.summary.is_usable);
  EXPECT_LT((result.T_a_b.inverse() * kRigid).log().norm(), 0.05);
}

}  // namespace
