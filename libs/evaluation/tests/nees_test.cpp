#include <gslam/base/error.h>
#include <gslam/evaluation/nees.h>
#include <gtest/gtest.h>

#include <cmath>
#include <random>

#include "made_trajectory.h"

namespace {

using gslam::neesOf;
using gslam::PoseCovariance;
using gslam::SE3d;
using gslam::SIM3d;

// L L^T of some lower triangle, with much correlation.
PoseCovariance triangle(std::mt19937& random) {
  std::normal_distribution<double> normal;
  PoseCovariance l{};
  for (std::size_t r = 0; r < 6; ++r) {
    for (std::size_t c = 0; c < r; ++c) l(r, c) = 0.01 * normal(random);
    l(r, r) = 0.01 + 0.01 * std::fabs(normal(random));
  }
  return l;
}

struct Estimates {
  gslam::PosePairs pairs;
  std::vector<PoseCovariance> covariances;
};

// Errors drawn from the covariances, scaled: 1 is consistent. T = P exp(d) is the truth.
Estimates drawn(std::size_t count, double scale) {
  std::mt19937 random(5);
  std::normal_distribution<double> normal;
  Estimates run;
  for (std::size_t i = 0; i < count; ++i) {
    const PoseCovariance l = triangle(random);
    SE3d::Tangent unit;
    for (std::size_t k = 0; k < 6; ++k) unit[k] = normal(random);
    const SE3d estimate = made::poseAt(0.1 * double(i));
    run.pairs.stamps.push_back(std::int64_t(i));
    run.pairs.estimate.push_back(estimate);
    run.pairs.reference.push_back(estimate * SE3d::exp(scale * (l * unit)));
    run.covariances.push_back(l * l.transpose());
  }
  return run;
}

TEST(nees, of_a_consistent_system_is_the_number_of_freedoms) {
  const Estimates run = drawn(20000, 1);
  const gslam::Nees nees = neesOf(run.pairs, run.covariances);
  EXPECT_EQ(nees.values.size(), 20000U);
  EXPECT_GT(nees.mean, nees.least_mean);
  EXPECT_LT(nees.mean, nees.most_mean);
  EXPECT_NEAR(nees.mean, 6, 0.1);
  EXPECT_NEAR(nees.inside_percent, 95, 0.7);
}

TEST(nees, shows_who_is_too_sure_of_himself) {
  const Estimates sure = drawn(2000, 2), shy = drawn(2000, 0.5);
  const gslam::Nees too_sure = neesOf(sure.pairs, sure.covariances);
  const gslam::Nees too_shy = neesOf(shy.pairs, shy.covariances);
  EXPECT_NEAR(too_sure.mean, 24, 1);
  EXPECT_GT(too_sure.mean, too_sure.most_mean);
  EXPECT_NEAR(too_shy.mean, 1.5, 0.1);
  EXPECT_LT(too_shy.mean, too_shy.least_mean);
}

TEST(nees, does_not_depend_on_world_and_scale) {
  const Estimates run = drawn(100, 1);
  const gslam::Nees before = neesOf(run.pairs, run.covariances);
  const SIM3d alignment(made::someMotion(), 3);
  Estimates moved = run;
  for (SE3d& pose : moved.pairs.reference) {
    // The world is three times as large and lies elsewhere.
    const SE3d large(pose.rotation(), 3.0 * pose.translation());
    pose = made::someMotion() * large;
  }
  const gslam::Nees after = neesOf(moved.pairs, moved.covariances, alignment);
  ASSERT_EQ(after.values.size(), before.values.size());
  for (std::size_t i = 0; i < before.values.size(); ++i) {
    ASSERT_NEAR(after.values[i], before.values[i], 1e-6 * before.values[i]);
  }
}

// Tables of chi-square with 6 freedoms: 1.237 and 14.449 for one; 95 % of a mean of 10 with 60
// freedoms: 40.482 and 83.298.
TEST(nees, has_the_quantiles_of_tables) {
  const Estimates run = drawn(10, 1);
  const gslam::Nees nees = neesOf(run.pairs, run.covariances);
  EXPECT_NEAR(nees.least_mean * 10, 40.482, 0.05);
  EXPECT_NEAR(nees.most_mean * 10, 83.298, 0.05);
}

TEST(nees, leaves_out_what_cannot_be_inverted) {
  Estimates run = drawn(10, 1);
  for (std::size_t k = 0; k < 6; ++k) run.covariances[3](k, 2) = run.covariances[3](2, k) = 0;
  run.covariances[4] = PoseCovariance{};
  // Of two directions that are one, and of two that are more than that.
  for (const double joint : {1.0, 2.0}) {
    PoseCovariance& c = run.covariances[joint > 1 ? 5 : 6];
    c = PoseCovariance::identity();
    c(4, 5) = c(5, 4) = joint;
  }
  const gslam::Nees nees = neesOf(run.pairs, run.covariances);
  EXPECT_EQ(nees.values.size(), 6U);
  EXPECT_EQ(nees.singular, 4U);
  for (PoseCovariance& c : run.covariances) c = PoseCovariance{};
  EXPECT_FALSE(neesOf(run.pairs, run.covariances).reason.empty());
}

TEST(nees, refuses_wrong_covariances) {
  Estimates run = drawn(10, 1);
  run.covariances[2](1, 1) = std::nan("");
  EXPECT_THROW(neesOf(run.pairs, run.covariances), gslam::ArgumentError);
  run.covariances.pop_back();
  EXPECT_THROW(neesOf(run.pairs, run.covariances), gslam::ArgumentError);
}

}  // namespace
