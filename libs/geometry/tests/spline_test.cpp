// Splines on all groups against products of matrix exponentials and their numeric derivatives, in
// long double.
#include <gmock/gmock.h>
#include <gslam/geometry/spline.h>

#include "any_group.h"
#include "refusal.h"

namespace {

using gslam::Spline;
using gslam::SplineSample;
using reference::convert;
using reference::GroupFacts;
using reference::Real;

template <class G>
class SplineTest : public reference::AnyGroup<G> {
 public:
  static constexpr std::int64_t kStart = 1403636580838555648, kInterval = 50000000;
  static constexpr std::size_t n = GroupFacts<G>::size;
  using Square = reference::Square<n>;

  // Each up to a radian and a metre from the one before.
  std::vector<G> controls(std::size_t count) {
    std::vector<G> all = {this->element()};
    while (all.size() < count) all.push_back(all.back() * G::exp(this->tangent(1)));
    return all;
  }

  // The definition, for u intervals after the second control.
  static Square curve(const std::vector<G>& controls, Real u) {
    const Real weights[3] = {(5 + 3 * u - 3 * u * u + u * u * u) / 6,
                             (1 + 3 * u + 3 * u * u - 2 * u * u * u) / 6, u * u * u / 6};
    Square value = convert<Real>(controls[0].matrix());
    for (std::size_t j = 0; j < 3; ++j) {
      const auto d = convert<Real>((controls[j].inverse() * controls[j + 1]).log());
      const auto e = reference::expMinusIdentityOf(GroupFacts<G>::hat(weights[j] * d));
      value = value + value * e;
    }
    return value;
  }
};
TYPED_TEST_SUITE(SplineTest, reference::AllGroups, );

TYPED_TEST(SplineTest, ValueAndDerivatives) {
  using G = TypeParam;
  for (int trial = 0; trial < 10; ++trial) {
    const auto controls = this->controls(4);
    const Spline<G> spline(this->kStart, this->kInterval, controls);
    for (int i = 0; i <= 8; ++i) {
      const Real u = i / 8.0L, h = 1e-3L;
      const SplineSample<G> sample = spline.sampleAt(this->kStart + this->kInterval * i / 8);
      const auto at = [&](int k) { return this->curve(controls, u + static_cast<Real>(k) * h); };
      const Real rate = 20;  // intervals a second
      // Differences of the fourth order: their error is about h^4, and 1e-19 / h^2.
      const auto first = (rate / (12 * h)) * (Real(8) * (at(1) - at(-1)) - (at(2) - at(-2)));
      const auto second = (rate * rate / (12 * h * h)) *
                          (Real(16) * (at(1) + at(-1)) - Real(30) * at(0) - (at(2) + at(-2)));
      const auto velocity = GroupFacts<G>::hat(convert<Real>(sample.velocity));
      const auto acceleration = GroupFacts<G>::hat(convert<Real>(sample.acceleration));
      const auto value = at(0);
      const Real rounding = 64 * this->epsilon();
      ASSERT_LE(reference::errorOf(sample.value.matrix(), value), rounding) << u;
      ASSERT_LE(reference::frobenius(value * velocity - first),
                (rounding + 1e-10L) * (reference::frobenius(first) + rate))
          << u;
      const auto expected = value * (velocity * velocity + acceleration);
      ASSERT_LE(reference::frobenius(expected - second),
                (rounding + 1e-9L) * (reference::frobenius(second) + rate * rate))
          << u;
      ASSERT_EQ(spline.at(this->kStart + this->kInterval * i / 8).matrix(), sample.value.matrix());
    }
  }
}

// Where one piece ends and the next begins, nothing jumps up to the acceleration.
TYPED_TEST(SplineTest, ContinuousAtTheKnots) {
  using G = TypeParam;
  for (int trial = 0; trial < 50; ++trial) {
    const auto controls = this->controls(5);
    const Spline<G> one(0, this->kInterval, {controls.begin(), controls.end() - 1});
    const Spline<G> next(0, this->kInterval, {controls.begin() + 1, controls.end()});
    const auto before = one.sampleAt(one.end()), after = next.sampleAt(next.start());
    const auto rounding = 64 * this->epsilon();
    ASSERT_LE(this->distance(before.value, after.value), rounding);
    ASSERT_LE((before.velocity - after.velocity).norm(), 20 * rounding);
    ASSERT_LE((before.acceleration - after.acceleration).norm(), 400 * rounding);
    // And they are the pieces of the whole.
    const Spline<G> whole(0, this->kInterval, controls);
    ASSERT_EQ(whole.at(this->kInterval).matrix(), after.value.matrix());
    ASSERT_EQ(whole.at(this->kInterval / 2).matrix(), one.at(this->kInterval / 2).matrix());
    ASSERT_EQ(whole.at(2 * this->kInterval).matrix(), next.at(this->kInterval).matrix());
  }
}

TYPED_TEST(SplineTest, ConstantMotionIsReproduced) {
  using G = TypeParam;
  using T = typename G::Scalar;
  const auto step = this->tangent(T(0.5));
  const G start = this->element();
  std::vector<G> controls;
  for (int i = 0; i < 12; ++i) controls.push_back(start * G::exp(step * static_cast<T>(i)));
  const Spline<G> spline(this->kStart, this->kInterval, controls);
  EXPECT_EQ(spline.end(), this->kStart + 9 * this->kInterval);
  for (int i = 0; i <= 36; ++i) {
    const auto sample = spline.sampleAt(this->kStart + this->kInterval * i / 4);
    const G expected = start * G::exp(step * (1 + static_cast<T>(i) / 4));
    ASSERT_LE(this->distance(sample.value, expected), 128 * this->epsilon()) << i;
    ASSERT_LE((sample.velocity - step * 20).norm(), 20 * 128 * this->epsilon()) << i;
    ASSERT_LE(sample.acceleration.norm(), 400 * 128 * this->epsilon()) << i;
  }
}

TYPED_TEST(SplineTest, MovesWithItsFrame) {
  using G = TypeParam;
  const auto controls = this->controls(6);
  const G g = this->element();
  std::vector<G> moved;
  for (const G& control : controls) moved.push_back(g * control);
  const Spline<G> a(0, 1000, controls), b(0, 1000, moved);
  for (std::int64_t t = 0; t <= 3000; t += 100) {
    ASSERT_LE(this->distance(g * a.at(t), b.at(t)), 64 * this->epsilon());
  }
}

using gslam::SE3d;
using testing::HasSubstr;

TEST(SplineInput, WhatIsRefused) {
  const std::vector<SE3d> four(4);
  const auto make = [](std::int64_t start, std::int64_t interval, std::size_t count) {
    return refusal([=] { return Spline<SE3d>(start, interval, std::vector<SE3d>(count)); });
  };
  EXPECT_THAT(make(0, 1, 3), HasSubstr("controls are 3, expected 4 or more"));
  EXPECT_THAT(make(0, 0, 4), HasSubstr("interval is 0 ns, expected more than 0"));
  EXPECT_THAT(make(0, -5, 4), HasSubstr("interval is -5 ns"));
  EXPECT_THAT(make(0, INT64_MAX / 2, 6), HasSubstr("beyond the range"));
  EXPECT_THAT(make(INT64_MAX - 9, 10, 4), HasSubstr("beyond the range"));
  EXPECT_EQ(make(INT64_MAX - 10, 10, 4), "taken");
  EXPECT_EQ(make(INT64_MIN, INT64_MAX, 4), "taken");
  const Spline<SE3d> spline(100, 10, four);
  EXPECT_THAT(refusal([&] { return spline.at(99); }),
              HasSubstr("time is 99 ns, expected one from 100 to 110"));
  EXPECT_THAT(refusal([&] { return spline.sampleAt(111); }), HasSubstr("time is 111 ns"));
  EXPECT_EQ(refusal([&] { return spline.at(110); }), "taken");
}

// The whole range of times in one piece.
TEST(SplineInput, LongTimes) {
  std::vector<SE3d> controls;
  for (int i = 0; i < 5; ++i) controls.push_back(SE3d({}, {i - 1.0, 0, 0}));
  const Spline<SE3d> spline(INT64_MIN, INT64_MAX, controls);
  EXPECT_NEAR(spline.at(-1).translation()[0], 1, 1e-15);
  EXPECT_NEAR(spline.at(spline.end()).translation()[0], 2, 1e-15);
  EXPECT_NEAR(spline.at(INT64_MIN).translation()[0], 0, 1e-15);
}

}  // namespace
