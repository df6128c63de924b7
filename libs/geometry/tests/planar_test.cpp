// What makes SO2 and SE2 groups that act on the plane, and what comes in from outside.
#include <gmock/gmock.h>

#include <sstream>
#include <string>
#include <type_traits>

#include "planar_reference.h"
#include "refusal.h"

namespace {

using gslam::SE2d;
using gslam::SO2d;
using gslam::Vec;
using testing::HasSubstr;

static_assert(std::is_trivially_copyable<SE2d>::value, "");
static_assert(std::is_standard_layout<SE2d>::value, "");
static_assert(sizeof(SO2d) == 2 * sizeof(double), "");
static_assert(sizeof(SE2d) == 4 * sizeof(double), "");
static_assert(alignof(SE2d) == alignof(double), "no over-alignment");
static_assert(sizeof(gslam::SE2f) == 4 * sizeof(float), "");

template <class G>
class PlanarTest : public testing::Test {
 public:
  using T = typename G::Scalar;
  static constexpr T epsilon() { return std::numeric_limits<T>::epsilon(); }
  G random() {
    using reference::convert;
    const T x = random_.uniform(-1, 1), y = random_.uniform(-1, 1), a = random_.uniform(-3, 3);
    return G::exp(convert<T>(reference::GroupFacts<G>::tangent(x, y, a)));
  }
  Vec<T, 2> point() { return {random_.uniform(-1, 1), random_.uniform(-1, 1)}; }

 private:
  reference::Random<T> random_;
};
TYPED_TEST_SUITE(PlanarTest, reference::PlanarGroups, );

TYPED_TEST(PlanarTest, GroupAxioms) {
  using G = TypeParam;
  const auto tolerance = 16 * this->epsilon();
  for (int i = 0; i < 2000; ++i) {
    const G a = this->random(), b = this->random(), c = this->random();
    ASSERT_TRUE(((a * b) * c).isApprox(a * (b * c), tolerance));
    ASSERT_TRUE((a * G::identity()).isApprox(a, 0));
    ASSERT_TRUE((a * a.inverse()).isApprox(G(), tolerance));
    ASSERT_TRUE((a.inverse() * a).isApprox(G(), tolerance));
    ASSERT_TRUE((a * b).inverse().isApprox(b.inverse() * a.inverse(), tolerance));
    G product = a;
    product *= b;
    ASSERT_TRUE(product.isApprox(a * b, 0));
  }
}

TYPED_TEST(PlanarTest, Action) {
  using G = TypeParam;
  for (int i = 0; i < 2000; ++i) {
    const G a = this->random(), b = this->random();
    const auto p = this->point();
    ASSERT_LE(((a * b) * p - a * (b * p)).norm(), 16 * this->epsilon());
    const auto m = a.matrix();
    Vec<typename G::Scalar, 2> q = m.template block<2, 2>(0, 0) * p;
    if (m.rows() == 3) q += m.col(m.cols() - 1).template segment<2>(0);
    ASSERT_LE((a * p - q).norm(), 8 * this->epsilon());
  }
}

TYPED_TEST(PlanarTest, HatVeeAndMatrices) {
  using G = TypeParam;
  for (int i = 0; i < 200; ++i) {
    const G a = this->random();
    const auto v = a.log();
    ASSERT_EQ(G::vee(G::hat(v)), v);
    ASSERT_TRUE(G::fromMatrix(a.matrix()).isApprox(a, 4 * this->epsilon()));
    const auto d = (a * G::exp(typename G::Tangent{} + v) * a.inverse()).log();
    ASSERT_LE((d - a.adjoint() * v).norm(), 64 * this->epsilon());
  }
}

// Differences of points that are near, in double: the derivative has no other way to be right.
TYPED_TEST(PlanarTest, ActionJacobian) {
  using G = TypeParam;
  for (int i = 0; i < 200; ++i) {
    const auto a = this->random().template cast<double>();
    const auto p = this->point().template cast<double>();
    const auto jacobian = a.actionJacobian(p);
    for (std::size_t j = 0; j < G::kFreedom; ++j) {
      typename std::remove_const<decltype(a)>::type::Tangent step{};
      step[j] = 1e-5;
      const auto difference = (a * a.exp(step) * p - a * a.exp(-step) * p) / 2e-5;
      ASSERT_LE((difference - jacobian.col(j)).norm(), 1e-9);
    }
  }
}

TYPED_TEST(PlanarTest, LongProductsAreMended) {
  using G = TypeParam;
  G product;
  for (int i = 0; i < 10000; ++i) product *= this->random();
  EXPECT_TRUE(product.normalized().isApprox(product, 4 * this->epsilon()));
  const auto m = product.normalized().matrix();
  EXPECT_NEAR(m(0, 0) * m(0, 0) + m(1, 0) * m(1, 0), 1, 4 * this->epsilon());
}

// A quarter turn takes x to y.
TEST(Planar, Handedness) {
  const SE2d T_world_body(SO2d::fromAngle(std::acos(-1.0) / 2), {10, 20});
  EXPECT_LE((T_world_body * gslam::Vec2d{1, 0} - gslam::Vec2d{10, 21}).norm(), 1e-14);
  EXPECT_NEAR(T_world_body.rotation().angle(), std::acos(-1.0) / 2, 1e-15);
  EXPECT_EQ(SO2d::fromAngle(-0.25).angle(), -0.25);
}

// An arc: forward by pi / 2 while turning left by a quarter ends at (1, 1), for a radius of 1.
TEST(Planar, ExpGoesAlongAnArc) {
  const double quarter = std::acos(-1.0) / 2;
  EXPECT_LE((SE2d::exp({quarter, 0, quarter}).translation() - gslam::Vec2d{1, 1}).norm(), 1e-15);
  EXPECT_EQ(SE2d::exp({1, 2, 0}).translation(), (gslam::Vec2d{1, 2}));
}

TEST(Planar, PrintedAsStored) {
  std::ostringstream out;
  out << SE2d(SO2d::fromComplex(0, -1), {3, 4.5});
  EXPECT_EQ(out.str(), "3 4.5 0 -1");
  EXPECT_EQ(SE2d(SO2d::fromComplex(0, -1), {3, 4.5}).data()[3], -1);
}

TEST(Planar, WhatIsRefused) {
  const double nan = std::numeric_limits<double>::quiet_NaN();
  EXPECT_THAT(refusal([&] { return SO2d::fromAngle(nan); }), HasSubstr("angle is nan"));
  EXPECT_THAT(refusal([&] { return SE2d::exp({0, 0, -nan}); }), HasSubstr("expected a finite"));
  EXPECT_THAT(refusal([&] { return SO2d::fromComplex(0, 0); }), HasSubstr("norm near zero"));
  EXPECT_THAT(refusal([&] { return SO2d::fromComplex(nan, 0); }), HasSubstr("not finite"));
  EXPECT_THAT(refusal([&] {
                return SO2d::fromMatrix({1, 0, 0, -1});
              }),
              HasSubstr("is a reflection"));
  EXPECT_THAT(refusal([&] {
                return SO2d::fromMatrix({1, 0, 0.1, 1});
              }),
              HasSubstr("row 1 has the squared length 1.01"));
  EXPECT_THAT(refusal([&] {
                return SE2d::fromMatrix(gslam::Mat3d{1, 0, 0, 0, 1, 0, 0, 1, 1});
              }),
              HasSubstr("has the last row (0 1 1), expected 0 0 1"));
  EXPECT_THAT(refusal([&] {
                return SE2d::fromMatrix(gslam::Mat<double, 2, 3>{1, 0, nan, 0, 1, 0});
              }),
              HasSubstr("nan in row 0, column 2"));
}

TEST(Planar, UnitNumbersKeepTheirBits) {
  for (int i = -3000; i < 3000; ++i) {
    const SO2d r = SO2d::fromAngle(0.001 * i) * SO2d::fromAngle(0.3);
    const SO2d unit = r.normalized();
    const SO2d again = SO2d::fromComplex(unit.cosine(), unit.sine());
    ASSERT_EQ(again.cosine(), unit.cosine());
    ASSERT_EQ(again.sine(), unit.sine());
    ASSERT_EQ(SO2d::fromComplex(3 * r.cosine(), 3 * r.sine()).isApprox(r, 1e-15), true);
  }
}

}  // namespace
