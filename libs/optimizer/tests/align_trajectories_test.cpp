#include <gslam/base/error.h>
#include <gslam/geometry/random.h>
#include <gslam/optimizer/align_trajectories.h>
#include <gtest/gtest.h>

#include <cmath>
#include <cstddef>
#include <limits>
#include <random>
#include <vector>

namespace {

using gslam::alignTrajectories;
using gslam::ArgumentError;
using gslam::SE3d;
using gslam::SIM3d;
using gslam::SO3d;
using gslam::TrajectoryPair;
using gslam::Vec3d;

const SIM3d kMap(SE3d(SO3d::exp({0.4, -1.3, 2.1}), {100, -20, 3}), 2.5);

struct Trajectories {
  std::vector<SE3d> a, b;
  TrajectoryPair pair() const {
    TrajectoryPair p;
    p.T_a_body = a;
    p.T_b_body = b;
    return p;
  }
};

Trajectories walk(std::size_t n, double noise, double scale) {
  std::mt19937_64 generator(n);
  const SIM3d map(kMap.rigid(), scale);
  Trajectories t;
  for (std::size_t i = 0; i < n; ++i) {
    const double s = 0.1 * static_cast<double>(i);
    t.b.push_back(SE3d(SO3d::exp({0.1 * s, 0.2, s}), {5 * std::cos(s), 4 * std::sin(s), 0.1 * s}));
    t.a.push_back(
        SE3d(map.rotation() * t.b.back().rotation(),
             map * t.b.back().translation() + noise * gslam::randomNormal<double, 3>(generator)));
  }
  return t;
}

TEST(align_trajectories, finds_the_transform_without_noise) {
  const Trajectories rigid = walk(50, 0, 1), scaled = walk(50, 0, 2.5);
  const auto a = alignTrajectories<SE3d>(rigid.pair());
  EXPECT_TRUE(a.summary.is_usable);
  EXPECT_TRUE(a.T_a_b.isApprox(kMap.rigid(), 1e-12));
  const auto b = alignTrajectories<SIM3d>(scaled.pair());
  EXPECT_TRUE(b.summary.is_usable);
  EXPECT_TRUE(b.T_a_b.isApprox(kMap, 1e-12));
  EXPECT_EQ(b.summary.parameters, 7u);
}

TEST(align_trajectories, has_the_least_cost) {
  const Trajectories t = walk(80, 0.3, 2.5);
  const auto cost = [&t](const SIM3d& T) {
    double sum = 0;
    for (std::size_t i = 0; i < t.a.size(); ++i) {
      sum += 0.5 * (T * t.b[i].translation() - t.a[i].translation()).squaredNorm();
    }
    return sum;
  };
  const auto rigid = alignTrajectories<SE3d>(t.pair());
  const auto similar = alignTrajectories<SIM3d>(t.pair());
  EXPECT_NEAR(rigid.summary.final_cost, cost(SIM3d(rigid.T_a_b)), 1e-10);
  EXPECT_NEAR(similar.summary.final_cost, cost(similar.T_a_b), 1e-10);
  EXPECT_LT(similar.summary.final_cost, rigid.summary.final_cost);
  for (std::size_t i = 0; i < 7; ++i) {
    for (const double by : {-1e-4, 1e-4}) {
      SIM3d::Tangent step{};
      step[i] = by;
      EXPECT_GT(cost(similar.T_a_b * SIM3d::exp(step)), similar.summary.final_cost);
      if (i == 6) continue;
      EXPECT_GT(cost(SIM3d(rigid.T_a_b) * SIM3d::exp(step)), rigid.summary.final_cost);
    }
    EXPECT_GT(similar.covariance(i, i), 0);
  }
}

TEST(align_trajectories, says_where_positions_do_not_determine_it) {
  Trajectories t = walk(20, 0, 1);
  for (std::size_t i = 0; i < t.b.size(); ++i) {
    t.b[i].setTranslation({1e3 + static_cast<double>(i), 2e3 + static_cast<double>(i), 5e2});
    t.a[i].setTranslation(kMap.rigid() * t.b[i].translation());
  }
  const auto line = alignTrajectories<SE3d>(t.pair());
  EXPECT_FALSE(line.summary.is_usable);
  EXPECT_FALSE(line.summary.message.empty());
  for (SE3d& pose : t.b) pose.setTranslation({1, 2, 3});
  const auto place = alignTrajectories<SIM3d>(t.pair());
  EXPECT_FALSE(place.summary.is_usable);
  const std::vector<SE3d> one(1), two(2);
  TrajectoryPair pair;
  pair.T_a_body = pair.T_b_body = one;
  EXPECT_FALSE(alignTrajectories<SE3d>(pair).summary.is_usable);
  pair.T_a_body = pair.T_b_body = two;
  EXPECT_FALSE(alignTrajectories<SIM3d>(pair).summary.is_usable);
}

TEST(align_trajectories, takes_any_unit_of_length) {
  const auto inUnits = [](double unit) {
    Trajectories t = walk(30, 0.1, 1);
    for (SE3d& pose : t.a) pose.setTranslation(unit * pose.translation());
    for (SE3d& pose : t.b) pose.setTranslation(unit * pose.translation());
    return alignTrajectories<SE3d>(t.pair());
  };
  const auto metres = inUnits(1);
  for (const double unit : {1e-150, 1e-30, 1e-3, 1e30, 1e150}) {
    const auto other = inUnits(unit);
    EXPECT_TRUE(other.summary.is_usable) << unit;
    for (std::size_t i = 0; i < 6; ++i) {
      // Residuals have unit information: only rotations depend on lengths.
      const double ratio = i < 3 ? 1 : unit * unit;
      EXPECT_NEAR(other.covariance(i, i) * ratio / metres.covariance(i, i), 1, 1e-6) << unit << i;
    }
  }
  EXPECT_FALSE(inUnits(1e-170).summary.is_usable);
  EXPECT_THROW((void)inUnits(1e160), ArgumentError);
}

TEST(align_trajectories, refuses_what_does_not_fit) {
  Trajectories t = walk(20, 0, 1);
  EXPECT_THROW((void)alignTrajectories<SE3d>({}), ArgumentError);
  t.b.pop_back();
  EXPECT_THROW((void)alignTrajectories<SE3d>(t.pair()), ArgumentError);
  t = walk(20, 0, 1);
  t.a[7].setTranslation({0, std::numeric_limits<double>::quiet_NaN(), 0});
  EXPECT_THROW((void)alignTrajectories<SIM3d>(t.pair()), ArgumentError);
  t = walk(20, 0, 1);
  const std::vector<gslam::Mat3d> positions(20, gslam::Mat3d::identity());
  const std::vector<gslam::Mat<double, 6, 6>> poses(20, gslam::Mat<double, 6, 6>::identity());
  TrajectoryPair pair = t.pair();
  pair.pose_information = poses;
  EXPECT_THROW((void)alignTrajectories<SE3d>(pair), ArgumentError);
  pair = t.pair();
  pair.position_information = positions;
  pair.uses_orientations = true;
  EXPECT_THROW((void)alignTrajectories<SE3d>(pair), ArgumentError);
  gslam::OptimizerOptions options;
  options.function_tolerance = -1;
  EXPECT_THROW((void)alignTrajectories<SE3d>(t.pair(), options), ArgumentError);
}

}  // namespace
