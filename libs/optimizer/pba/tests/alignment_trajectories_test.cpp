#include <gslam/geometry/random.h>
#include <gslam/optimizer/align_trajectories.h>
#include <gslam/optimizer_pba.h>
#include <gtest/gtest.h>

#include <cmath>
#include <cstddef>
#include <random>
#include <vector>

// The parts of alignTrajectories() that need a back end.

namespace {

using gslam::alignTrajectories;
using gslam::LossKind;
using gslam::OptimizerOptions;
using gslam::SE3d;
using gslam::SIM3d;
using gslam::SO3d;
using gslam::TrajectoryPair;
using gslam::Vec3d;

const SIM3d kMap(SE3d(SO3d::exp({0.4, -1.3, 2.1}), {10, -20, 3}), 2.5);

struct Trajectories {
  std::vector<SE3d> a, b;
  TrajectoryPair pair() const {
    TrajectoryPair p;
    p.T_a_body = a;
    p.T_b_body = b;
    return p;
  }
};

Trajectories walk(std::size_t n, double noise, const Vec3d& size) {
  std::mt19937_64 generator(n);
  Trajectories t;
  for (std::size_t i = 0; i < n; ++i) {
    const double s = 0.1 * static_cast<double>(i);
    t.b.push_back(SE3d(SO3d::exp({0.1 * s, 0.2, s}),
                       {size[0] * std::cos(s), size[1] * std::sin(s), size[2] * s}));
    const Vec3d turn = 0.1 * noise * gslam::randomNormal<double, 3>(generator);
    t.a.push_back(
        SE3d(kMap.rotation() * t.b.back().rotation() * SO3d::exp(turn),
             kMap * t.b.back().translation() + noise * gslam::randomNormal<double, 3>(generator)));
  }
  return t;
}

TEST(alignment_of_trajectories, with_unit_information_is_that_of_the_closed_form) {
  const Trajectories t = walk(60, 0.1, {5, 4, 0.1});
  TrajectoryPair pair = t.pair();
  const auto closed = alignTrajectories<SIM3d>(pair);
  const std::vector<gslam::Mat3d> information(60, gslam::Mat3d::identity());
  pair.position_information = information;
  const auto refined = alignTrajectories<SIM3d>(pair);
  ASSERT_TRUE(refined.summary.is_usable);
  EXPECT_TRUE(refined.T_a_b.isApprox(closed.T_a_b, 1e-7));
  EXPECT_NEAR(refined.summary.final_cost, closed.summary.final_cost, 1e-10);
  for (std::size_t i = 0; i < 49; ++i) {
    EXPECT_NEAR(refined.covariance.values[i], closed.covariance.values[i], 1e-8);
  }
}

TEST(alignment_of_trajectories, bears_outliers_with_a_robust_loss) {
  Trajectories t = walk(100, 0.02, {5, 4, 0.1});
  for (std::size_t i = 0; i < 100; i += 5) {
    t.a[i].setTranslation(t.a[i].translation() + Vec3d{3, -8, 5});
  }
  OptimizerOptions options;
  options.loss = {LossKind::Cauchy, 0.1};
  const auto result = alignTrajectories<SIM3d>(t.pair(), options);
  ASSERT_TRUE(result.summary.is_usable);
  EXPECT_TRUE(result.T_a_b.isApprox(kMap, 0.05));
  EXPECT_EQ(result.summary.inliers, 80u);
}

TEST(alignment_of_trajectories, on_a_line_takes_the_rotation_from_orientations) {
  const Trajectories t = walk(60, 0.01, {0, 0, 3});
  TrajectoryPair pair = t.pair();
  EXPECT_FALSE(alignTrajectories<SIM3d>(pair).summary.is_usable);
  pair.uses_orientations = true;
  const auto result = alignTrajectories<SIM3d>(pair);
  ASSERT_TRUE(result.summary.is_usable);
  EXPECT_TRUE(result.T_a_b.isApprox(kMap, 0.02));
}

}  // namespace
