// Means of all groups: what defines them, and what says that there is none.
#include <gmock/gmock.h>
#include <gslam/geometry/mean.h>

#include "any_group.h"
#include "refusal.h"

namespace {

using gslam::mean;
using gslam::MeanStatus;
using gslam::SE3d;
using gslam::SO2d;
using gslam::SO3d;

template <class G>
class MeanTest : public reference::AnyGroup<G> {
 public:
  std::vector<G> cloud(typename G::Scalar radius, std::size_t count = 20) {
    const G centre = this->element();
    std::vector<G> all;
    while (all.size() < count) all.push_back(centre * G::exp(this->tangent(radius)));
    return all;
  }
};
TYPED_TEST_SUITE(MeanTest, reference::AllGroups, );

TYPED_TEST(MeanTest, TheLogarithmsCancel) {
  using G = TypeParam;
  for (int trial = 0; trial < 50; ++trial) {
    const auto all = this->cloud(1);
    const auto found = mean(all);
    ASSERT_EQ(found.status, MeanStatus::unique);
    ASSERT_LE(found.iterations, 40);
    typename G::Tangent sum{};
    for (const G& one : all) sum += (found.value.inverse() * one).log();
    ASSERT_LE(sum.norm() / 20, 32 * this->epsilon());
  }
}

TYPED_TEST(MeanTest, NoFrameIsSpecial) {
  using G = TypeParam;
  for (int trial = 0; trial < 20; ++trial) {
    const auto all = this->cloud(1);
    const G centre = mean(all).value, a = this->element(), b = this->element();
    std::vector<G> moved, inverses, reversed(all.rbegin(), all.rend());
    for (const G& one : all) moved.push_back(a * one * b);
    for (const G& one : all) inverses.push_back(one.inverse());
    const auto allowed = 256 * this->epsilon();
    ASSERT_LE(this->distance(mean(moved).value, a * centre * b), 8 * allowed);
    ASSERT_LE(this->distance(mean(inverses).value, centre.inverse()), 4 * allowed);
    ASSERT_LE(this->distance(mean(reversed).value, centre), allowed);
  }
}

// Of two it is half the way, with weights a part of it; pairs around a centre have it as their
// mean.
TYPED_TEST(MeanTest, KnownMeans) {
  using G = TypeParam;
  for (int trial = 0; trial < 50; ++trial) {
    const G centre = this->element();
    const auto d = this->tangent(1);
    const G a = centre * G::exp(d), b = centre * G::exp(-d);
    ASSERT_LE(this->distance(mean(std::vector<G>{a, b}).value, centre), 64 * this->epsilon());
    ASSERT_LE(this->distance(mean(std::vector<G>{a, b}, {3, 1}).value, centre * G::exp(d * 0.5f)),
              64 * this->epsilon());
    ASSERT_LE(this->distance(mean(std::vector<G>{a}).value, a), 64 * this->epsilon());
    ASSERT_LE(this->distance(mean(std::vector<G>{a, b}, {0, 2}).value, b), 64 * this->epsilon());
    std::vector<G> pairs;
    for (int i = 0; i < 5; ++i) {
      const auto e = this->tangent(1);
      pairs.push_back(centre * G::exp(e));
      pairs.push_back(centre * G::exp(-e));
    }
    ASSERT_LE(this->distance(mean(pairs).value, centre), 64 * this->epsilon());
  }
}

// Weights are as if an element stood there several times.
TYPED_TEST(MeanTest, WeightsCount) {
  using G = TypeParam;
  const auto all = this->cloud(1, 4);
  std::vector<G> repeated;
  for (std::size_t i = 0; i < 4; ++i) repeated.insert(repeated.end(), i + 1, all[i]);
  const auto weighted = mean(all, {10, 20, 30, 40});
  EXPECT_LE(this->distance(mean(repeated).value, weighted.value), 64 * this->epsilon());
}

// No rotation next to the mean has a lower sum of squared angles.
TEST(MeanOfRotations, LeastSquares) {
  std::mt19937 generator(1);
  std::vector<SO3d> all;
  for (int i = 0; i < 30; ++i) {
    all.push_back(SO3d::exp(1.2 * gslam::randomUniform(generator, 0.0, 1.0) *
                            gslam::randomDirection<double>(generator)));
  }
  const auto squares = [&](const SO3d& m) {
    double sum = 0;
    for (const SO3d& r : all) sum += std::pow((m.inverse() * r).angle(), 2);
    return sum;
  };
  const SO3d m = mean(all).value;
  for (int i = 0; i < 100; ++i) {
    const SO3d other = m * SO3d::exp(1e-4 * gslam::randomDirection<double>(generator));
    ASSERT_GT(squares(other), squares(m));
  }
  // The chordal mean is another, but near.
  const auto chordal = gslam::chordalMean(all);
  EXPECT_TRUE(chordal.is_unique);
  EXPECT_LT((m.inverse() * chordal.rotation).angle(), 0.05);
  EXPECT_GT((m.inverse() * chordal.rotation).angle(), 1e-6);
}

TEST(MeanOfRotations, OppositesHaveNoOneMean) {
  const double pi = std::acos(-1.0);
  const SO3d about_x = SO3d::exp({pi, 0, 0}), about_y = SO3d::exp({0, pi, 0}),
             about_z = SO3d::exp({0, 0, pi});
  const auto two = mean(std::vector<SO3d>{SO3d(), about_x});
  EXPECT_EQ(two.status, MeanStatus::ambiguous);
  EXPECT_TRUE(two.isConverged());
  EXPECT_NE(mean(std::vector<SO3d>{SO3d(), about_x, about_y, about_z}).status, MeanStatus::unique);
  const std::vector<SO2d> ends = {SO2d(), SO2d::fromAngle(pi)};
  EXPECT_NE(mean(ends).status, MeanStatus::unique);
  const std::vector<SO2d> thirds = {SO2d(), SO2d::fromAngle(2 * pi / 3),
                                    SO2d::fromAngle(-2 * pi / 3)};
  EXPECT_NE(mean(thirds).status, MeanStatus::unique);
  EXPECT_FALSE(gslam::chordalMean(std::vector<SO3d>{SO3d(), about_x}).is_unique);
  EXPECT_THAT(gslam::meanStatusText(two.status), testing::HasSubstr("need not be the only one"));
}

// A rotation beyond a quarter turn makes it uncertain, not wrong.
TEST(MeanOfRotations, Outlier) {
  const std::vector<SO3d> all = {SO3d(), SO3d(), SO3d(), SO3d::exp({2.4, 0, 0})};
  const auto found = mean(all);
  EXPECT_EQ(found.status, MeanStatus::ambiguous);
  EXPECT_NEAR(found.value.log()[0], 0.6, 1e-14);
}

// Far from the origin differences of translations are rounded to much more than epsilon.
TEST(MeanOfPoses, FarFromTheOrigin) {
  std::mt19937 generator(1);
  std::vector<SE3d> all;
  const SE3d centre(SO3d::exp({1, 2, 0}), {4e6, -5e6, 3e5});
  for (int i = 0; i < 10; ++i) {
    const auto d = 0.1 * gslam::randomNormal<double, 6>(generator);
    all.push_back(centre * SE3d::exp(d));
    all.push_back(centre * SE3d::exp(-d));
  }
  const auto found = mean(all);
  EXPECT_EQ(found.status, MeanStatus::unique);
  EXPECT_LT(found.iterations, 30);
  EXPECT_TRUE(found.value.isApprox(centre, 1e-8));
}

TEST(MeanInput, WhatIsRefused) {
  using testing::HasSubstr;
  const std::vector<SE3d> two(2);
  const double nan = std::numeric_limits<double>::quiet_NaN();
  EXPECT_THAT(refusal([] { return mean(std::vector<SE3d>()); }),
              HasSubstr("elements are none, expected one or more"));
  EXPECT_THAT(refusal([&] {
                return mean(two, {1, 2, 3});
              }),
              HasSubstr("weights are 3, expected as many as elements, 2"));
  EXPECT_THAT(refusal([&] {
                return mean(two, {1, -2});
              }),
              HasSubstr("weight number 1 is -2, expected 0 or more"));
  EXPECT_THAT(refusal([&] { return mean(two, {nan, 1}); }), HasSubstr("weight number 0 is nan"));
  EXPECT_THAT(refusal([&] { return mean(two, {0, 0}); }), HasSubstr("weights have the sum 0"));
  EXPECT_THAT(refusal([&] { return gslam::chordalMean(std::vector<SO3d>(2), {1.0}); }),
              HasSubstr("weights are 1"));
}

TEST(MeanInput, WhatHasNoWeightSpoilsNothing) {
  const double nan = std::numeric_limits<double>::quiet_NaN();
  const std::vector<gslam::SE3d> poses = {gslam::SE3d(gslam::SO3d(), {1, 0, 0}),
                                          gslam::SE3d(gslam::SO3d(), {nan, 0, 0})};
  const gslam::Mean<gslam::SE3d> mean = gslam::mean(poses, {1, 0});
  EXPECT_TRUE(mean.value.isApprox(poses[0], 1e-15));
}

}  // namespace
