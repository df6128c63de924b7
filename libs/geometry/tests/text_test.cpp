// Text of all groups: there and back to the bit in every locale, and what is refused.
#include <gmock/gmock.h>
#include <gslam/geometry/text.h>

#include <cmath>
#include <locale>
#include <string>

#include "any_group.h"

namespace {

using gslam::fromText;
using gslam::SE2d;
using gslam::SE3d;
using gslam::SE3f;
using gslam::SIM3d;
using gslam::SO2d;
using gslam::SO3d;
using gslam::toText;
using testing::HasSubstr;

template <class G>
bool isSame(const G& a, const G& b) {  // to the bit: -0 is not 0
  for (std::size_t i = 0; i < sizeof(G) / sizeof(typename G::Scalar); ++i) {
    const auto x = a.data()[i], y = b.data()[i];
    if (!(x == y) || std::signbit(x) != std::signbit(y)) return false;
  }
  return true;
}

template <class G>
class Text : public reference::AnyGroup<G> {};
TYPED_TEST_SUITE(Text, reference::AllGroups, );

TYPED_TEST(Text, ComesBackToTheBit) {
  using G = TypeParam;
  for (int i = 0; i < 500; ++i) {
    const G a = this->element();
    const G all[] = {a, (a * this->element()).normalized(), a.inverse(), G(), G().inverse()};
    for (const G& one : all) ASSERT_TRUE(isSame(fromText<G>(toText(one)), one)) << toText(one);
  }
}

// What products leave of the norm is mended, no more.
TYPED_TEST(Text, ProductsComeBack) {
  using G = TypeParam;
  G product;
  for (int i = 0; i < 500; ++i) {
    product = product * G::exp(this->tangent(1));
    ASSERT_TRUE(fromText<G>(toText(product)).isApprox(product, 4 * this->epsilon()));
  }
}

// Whatever stands first in memory, text has the order of a TUM trajectory.
TEST(TextOfNumbers, TranslationFirst) {
  EXPECT_EQ(gslam::toText(gslam::SE3d(gslam::SO3d(), {1, 2, 3})), "1 2 3 0 0 0 1");
  EXPECT_EQ(gslam::toText(gslam::SIM3d(gslam::SO3d(), {1, 2, 3}, 4)), "1 2 3 0 0 0 1 4");
  EXPECT_EQ(gslam::fromText<gslam::SE3d>("1 2 3 0 0 0 1").translation(), (gslam::Vec3d{1, 2, 3}));
}

TEST(TextOfNumbers, TheSmallestAndTheLargest) {
  const double smallest = std::numeric_limits<double>::denorm_min();
  const double largest = std::numeric_limits<double>::max();
  const SE3d pose(SO3d::fromQuaternion(smallest, -1e-310, 2.5e-308, 1), {largest, -0.0, 1e22});
  EXPECT_TRUE(isSame(fromText<SE3d>(toText(pose)), pose)) << toText(pose);
  const SE3f single({}, {std::numeric_limits<float>::denorm_min(), 3.4028235e38f, -0.0f});
  EXPECT_TRUE(isSame(fromText<SE3f>(toText(single)), single)) << toText(single);
}

TEST(TextOfNumbers, NoMoreDigitsThanNeeded) {
  EXPECT_EQ(toText(SE3d({}, {0.1, -2, 1e-7})), "0.1 -2 1e-07 0 0 0 1");
  EXPECT_EQ(toText(SIM3d(SO3d(), {1, 2, 3}, 0.3)), "1 2 3 0 0 0 1 0.3");
  EXPECT_EQ(toText(SE3f({}, {0.1f, 0, 0})), "0.1 0 0 0 0 0 1");
  EXPECT_EQ(toText(SE2d(SO2d(), {0.1 + 0.2, 1})), "0.30000000000000004 1 1 0");
}

TEST(TextOfNumbers, QuaternionsAreNormalised) {
  EXPECT_TRUE(fromText<SO3d>("0 0 3 4").isApprox(SO3d::fromQuaternion(0, 0, 0.6, 0.8), 1e-15));
  EXPECT_EQ(toText(fromText<SE3d>("\t+1 2.\n.5 0 0 0 2e0 \r\n")), "1 2 0.5 0 0 0 1");
}

struct Comma : std::numpunct<char> {
  char do_decimal_point() const override { return ','; }
  char do_thousands_sep() const override { return '.'; }
  std::string do_grouping() const override { return "\3"; }
};
TEST(TextOfNumbers, NoDecimalComma) {
  const std::locale before = std::locale::global(std::locale(std::locale(), new Comma));
  const SE3d pose({}, {1234567.5, 0.25, 0});
  const std::string text = toText(pose);
  const SE3d back = fromText<SE3d>(text);
  std::locale::global(before);
  EXPECT_EQ(text, "1234567.5 0.25 0 0 0 0 1");
  EXPECT_TRUE(isSame(back, pose));
}

template <class G>
std::string textRefusal(const std::string& text) {
  try {
    (void)fromText<G>(text);
  } catch (const gslam::ParseError& error) {
    return error.what();
  } catch (const gslam::ArgumentError& error) {
    return std::string("argument: ") + error.what();
  }
  return "taken";
}

TEST(TextInput, WhatIsRefused) {
  EXPECT_EQ(textRefusal<SO3d>(""), "text:1:1: is empty, expected qx qy qz qw");
  EXPECT_EQ(textRefusal<SO3d>(" \t\n"), "text:1:1: is empty, expected qx qy qz qw");
  EXPECT_EQ(textRefusal<SE3d>("1 2 3"),
            "text:1:6: ends after 3 of 7 numbers, expected tx ty tz qx qy qz qw");
  EXPECT_EQ(textRefusal<SIM3d>("1 2 3 0 0 0 1 "),
            "text:1:15: ends after 7 of 8 numbers, expected tx ty tz qx qy qz qw scale");
  EXPECT_THAT(textRefusal<SE3d>("1 2 x3 0 0 0 1"), HasSubstr("text:1:5: 'x3' is no finite number"));
  EXPECT_THAT(textRefusal<SO3d>("0 0 0 1 5 6"), HasSubstr("text:1:9: '5 6' stands after the end"));
  EXPECT_THAT(textRefusal<SE2d>("0 0 1 0 0 0 1"), HasSubstr("'0 0 1' stands after the end"));
  EXPECT_THAT(textRefusal<SO3d>("0 0 0 0"), HasSubstr("argument: quaternion (0 0 0 0) has a norm"));
  EXPECT_THAT(textRefusal<SIM3d>("0 0 0 0 0 0 1 0"), HasSubstr("argument: scale is 0"));
  EXPECT_THAT(textRefusal<SO2d>("0 0"), HasSubstr("argument: cosine and sine (0 0)"));
  EXPECT_THAT(textRefusal<SE3d>("1e400 0 0 0 0 0 1"), HasSubstr("1e400 is too large"));
  EXPECT_THAT(textRefusal<SE3f>("0 -1e39 0 0 0 0 1"), HasSubstr("text:1:3: -1e39 is too large"));
}

TEST(TextInput, WordsThatAreNoNumbers) {
  for (const char* word : {"nan", "NaN", "inf", "-infinity", "0x10", "1e", "1e+", ".", "-", "+-1",
                           "1,5", "1.5f", "1..2", "1d3", "--1", "1e5.5", "'1'"}) {
    EXPECT_THAT(textRefusal<SO3d>(std::string("0 0 ") + word + " 1"),
                HasSubstr("text:1:5: '" + std::string(word) + "' is no finite number"));
  }
}

}  // namespace
