// Sophus' groups and ours are the same: elements, products, exp and log, adjoints.
#include <gslam/geometry/random.h>
#include <gslam/geometry/sophus.h>
#include <gtest/gtest.h>

#include <limits>
#include <random>

namespace {

using gslam::fromSophus;
using gslam::randomOf;
using gslam::toSophus;

template <class G>
class SophusTest : public testing::Test {
 public:
  std::mt19937 generator{1};
};
using Groups =
    testing::Types<gslam::SO2d, gslam::SO3d, gslam::SE2d, gslam::SE3d, gslam::SIM3d, gslam::SE3f>;
TYPED_TEST_SUITE(SophusTest, Groups, );

TYPED_TEST(SophusTest, TheSameGroup) {
  using G = TypeParam;
  using T = typename G::Scalar;
  constexpr auto n = static_cast<int>(G::kFreedom);
  const T tolerance = 200 * std::numeric_limits<T>::epsilon();
  for (int i = 0; i < 200; ++i) {
    const G a = randomOf<G>(this->generator), b = randomOf<G>(this->generator);
    const auto x = toSophus(a), y = toSophus(b);
    ASSERT_TRUE(fromSophus(x).isApprox(a, tolerance));
    ASSERT_TRUE(fromSophus(x * y).isApprox(a * b, tolerance));
    ASSERT_TRUE(fromSophus(x.inverse()).isApprox(a.inverse(), tolerance));
    // The tangents have the same order, so they are the same numbers.
    const Eigen::Matrix<T, n, 1> log = Eigen::Matrix<T, n, 1>::Map(a.log().data());
    if constexpr (n == 1) {
      ASSERT_NEAR(x.log(), log[0], tolerance);
      ASSERT_TRUE(fromSophus(decltype(toSophus(a))::exp(log[0])).isApprox(a, tolerance));
    } else {
      ASSERT_LE((x.log() - log).norm(), tolerance * (1 + log.norm()));
      ASSERT_TRUE(fromSophus(decltype(toSophus(a))::exp(log)).isApprox(a, tolerance));
      const auto adjoint = a.adjoint();
      const auto view = Eigen::Matrix<T, n, n, Eigen::RowMajor>::Map(adjoint.data());
      ASSERT_LE((x.Adj() - view).norm(), tolerance * view.norm());
    }
  }
}

TEST(SophusScale, WhatWouldEndTheProgramIsRefused) {
  EXPECT_THROW((void)toSophus(gslam::SIM3d(gslam::SE3d(), 1e-11)), gslam::ArgumentError);
  EXPECT_THROW((void)toSophus(gslam::SIM3d(gslam::SE3d(), 1e11)), gslam::ArgumentError);
  EXPECT_NEAR(toSophus(gslam::SIM3d(gslam::SE3d(), 1e-9)).scale(), 1e-9, 1e-20);
}

}  // namespace
