// From numbers to text, and what that and reading share.
#include <gslam/svar/detail/print_number.h>
#include <gtest/gtest.h>

#include <cmath>
#include <cstddef>
#include <cstdint>
#include <cstdlib>
#include <random>
#include <string>

#include "number_text.h"

namespace {

using number_text::anyDouble;
using number_text::bitsOf;
using number_text::doubleOf;
using number_text::expectAsStrtod;
using number_text::format;
using number_text::kInfinity;
using number_text::kLeast;
using number_text::kMax;
using number_text::kMin;
using number_text::print;
using number_text::words;

// --- text from doubles

TEST(PrintDouble, WritesAsPeopleDo) {
  for (const std::string& text :
       words("0.0 -0.0 1.0 -30.0 100.0 0.1 -12.34 100.25 0.00012 0.00001 1e-6 9.9e-6 -2.5e-7 "
             "1000000000000000.0 9007199254740992.0 9999999999999998.0 9500000000000000.0 1e16 "
             "1.2345678901234568e16 1e22 1e23 1.5e300 1.7976931348623157e308 5e-324 1e-323 "
             "1.5e-323 -2.2250738585072014e-308 -0.000012345678901234568 0.30000000000000004 "
             "0.3333333333333333 1311868164.363181 123456789012345.6")) {
    EXPECT_EQ(print(std::strtod(text.c_str(), nullptr)), text);
  }
}

TEST(PrintDouble, LeavesWhatIsNotFinite) {
  for (const double value : {kInfinity, -kInfinity, std::nan("")}) EXPECT_EQ(print(value), "");
}

std::string digitsOf(const std::string& text) {
  std::string digits;
  for (const char c : text.substr(0, text.find('e'))) {
    if (c >= '0' && c <= '9') digits += c;
  }
  return digits;
}

std::string withoutZerosAround(const std::string& digits) {
  const std::size_t first = digits.find_first_not_of('0');
  return digits.substr(first, digits.find_last_not_of('0') + 1 - first);
}

// It reads back; of those with as many digits it is the nearest; none with less digits reads back.
void expectShortest(double value) {
  const std::string text = print(value);
  ASSERT_EQ(bitsOf(std::strtod(text.c_str(), nullptr)), bitsOf(value)) << text;
  expectAsStrtod(text);

  const std::string printed = withoutZerosAround(digitsOf(text));
  const int count = static_cast<int>(printed.size());
  const std::string nearest = format("%.*e", count - 1, value);
  if (std::strtod(nearest.c_str(), nullptr) == value) {
    ASSERT_EQ(printed, withoutZerosAround(digitsOf(nearest))) << text;
  } else {  // below a power of two the next double is but half as far away, and so is what is far
    ASSERT_EQ(bitsOf(value) << 12, 0u) << text;
  }
  if (count == 1) return;
  const std::string shorter = format("%.*e", count - 2, std::fabs(value));
  const int exponent = std::atoi(shorter.c_str() + shorter.find('e') + 1) - (count - 2);
  for (int step = -1; step <= 1; ++step) {
    const long long digits = std::stoll(digitsOf(shorter)) + step;
    const std::string beside = std::to_string(digits) + format("e%d", exponent);
    ASSERT_NE(std::strtod(beside.c_str(), nullptr), std::fabs(value)) << text;
  }
}

void expectShortestAround(double value) {
  expectShortest(value);
  expectShortest(-value);
  if (value > kLeast) expectShortest(std::nextafter(value, 0));
  if (value < kMax) expectShortest(std::nextafter(value, kInfinity));
}

TEST(PrintDouble, IsShortestForRandomBits) {
  std::mt19937_64 random(8);
  for (int i = 0; i < 300000 && !HasFatalFailure(); ++i) expectShortest(anyDouble(random));
}

TEST(PrintDouble, IsShortestForShortDecimals) {
  std::mt19937_64 random(9);
  for (int i = 0; i < 50000 && !HasFatalFailure(); ++i) {
    const double digits = static_cast<double>(1 + random() % 1000000);
    expectShortest(digits / std::pow(10, static_cast<int>(random() % 12)));
    expectShortest(static_cast<double>(random() >> (random() & 63) | 1));
    expectShortest(doubleOf(random() >> (12 + random() % 52) | 1));  // subnormal
  }
}

TEST(PrintDouble, IsShortestAtTheBoundaries) {
  for (int i = -1074; i < 1024 && !HasFatalFailure(); ++i) expectShortestAround(std::ldexp(1.0, i));
  for (int i = -323; i <= 308 && !HasFatalFailure(); ++i) {
    expectShortestAround(std::strtod(format("1e%d", i).c_str(), nullptr));
  }
  for (double value : {kLeast, 2 * kLeast, 3 * kLeast, kMin, kMax}) expectShortestAround(value);
  for (std::uint64_t bits = 1; bits < 3000 && !HasFatalFailure(); ++bits) {
    expectShortest(doubleOf(bits));
  }
}

// --- what both are made of

TEST(WideProduct, IsTheSameByHalves) {
  std::mt19937_64 random(10);
  for (int i = 0; i < 10000; ++i) {
    const std::uint64_t a = i < 4 ? ~std::uint64_t(0) >> i : random() >> (random() & 63);
    const std::uint64_t b = i < 4 ? ~std::uint64_t(0) : random();
    const gslam::detail::Uint128 product = gslam::detail::multiplyWide(a, b);
    EXPECT_EQ(product.high, gslam::detail::multiplyByHalves(a, b).high);
    EXPECT_EQ(product.low, gslam::detail::multiplyByHalves(a, b).low);
    EXPECT_EQ(product.low, a * b);
  }
}

TEST(PowersOfTen, AreThoseOfTheTable) {
  for (std::size_t n = 1; n <= 19; ++n) {
    const int exponent = -static_cast<int>(n);
    const gslam::detail::RoughPower power = gslam::detail::tenToTheMinus(n);
    EXPECT_EQ(power.digits, gslam::detail::PowersOfFive::table()[exponent].high);
    EXPECT_EQ(power.exponent, gslam::detail::floorLog2OfTenToThe(exponent));
  }
}

TEST(Logarithms, AreExact) {
  for (int n = -342; n <= 324; ++n) {
    const double exact = std::floor(n * std::log2(10.0));  // never near a whole number but for 0
    EXPECT_EQ(gslam::detail::floorLog2OfTenToThe(n), static_cast<int>(exact));
  }
  for (int n = -1074; n <= 971; ++n) {
    const double log2 = n * std::log10(2.0);
    EXPECT_EQ(gslam::detail::floorLog10OfTwoToThe(n, false), static_cast<int>(std::floor(log2)));
    EXPECT_EQ(gslam::detail::floorLog10OfTwoToThe(n, true),
              static_cast<int>(std::floor(log2 + std::log10(0.75))));
  }
}

}  // namespace
