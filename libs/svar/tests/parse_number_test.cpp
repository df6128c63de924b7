// From text to numbers.
#include <gslam/svar/detail/parse_number.h>
#include <gtest/gtest.h>

#include <cfenv>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <cstdlib>
#include <limits>
#include <random>
#include <string>
#include <vector>

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
using number_text::kTopBit;
using number_text::NumberStatus;
using number_text::Parsed;
using number_text::print;
using number_text::words;

// --- what is no number

// The texts have a mark where reading must end.
void expectEnds(NumberStatus status, const std::string& marked) {
  for (std::string text : words(marked)) {
    const std::size_t mark = text.find('|');
    text.erase(mark, 1);
    EXPECT_EQ(Parsed(text).status, status) << text;
    EXPECT_EQ(Parsed(text).read, mark) << text;
  }
}

TEST(ParseNumber, SaysWhereADigitIsMissing) {
  expectEnds(NumberStatus::malformed,
             "| -| |+ |+1 |.5 -|.5 1.| 1.|e5 1.|.5 1.|x4 1e| 1E| 1e|e 1e|.5 1e+| 1e-| 1e+|-1 -|-1 "
             "0.| 0.|-1 -0.|e 0e| -|a |e5 -|e5 -|x0 |/ |: |NaN |Infinity -|Infinity "
             "12345678.|:234567");
}

TEST(ParseNumber, EndsWhereTheNumberEnds) {
  expectEnds(NumberStatus::ok,
             "0|1 -0|1 0|0.5 0|x10 1|_0 1e5|e 1e5|.5 1.5|.5 1|,2 1|-2 1.25|f 1.5|-1.5 123456|/ "
             "12345678|: 0.1234567|/9");
}

TEST(ParseNumber, TakesNoByteBehindTheEnd) {
  const std::string text = "-1234567890.1234567890e+10";
  for (std::size_t size = 0; size <= text.size(); ++size) {
    const Parsed parsed(text.substr(0, size));
    const bool complete = size > 0 && text[size - 1] >= '0' && text[size - 1] <= '9';
    EXPECT_EQ(parsed.status, complete ? NumberStatus::ok : NumberStatus::malformed) << size;
    EXPECT_EQ(parsed.read, size);
    if (size > 11 && complete) expectAsStrtod(text.substr(0, size));
  }
}

// --- integers

void expectInteger(const std::string& text, std::int64_t expected) {
  const Parsed parsed(text);
  EXPECT_EQ(parsed.status, NumberStatus::ok) << text;
  EXPECT_TRUE(parsed.is_integer) << text;
  EXPECT_EQ(parsed.integer, expected) << text;
  EXPECT_EQ(parsed.read, text.size());
  EXPECT_EQ(print(expected), text);
}

void expectLargeInteger(const std::string& text, NumberStatus status) {
  const Parsed parsed(text);
  EXPECT_EQ(parsed.status, status) << text;
  EXPECT_FALSE(parsed.is_integer) << text;
  EXPECT_EQ(parsed.real, std::strtod(text.c_str(), nullptr)) << text;
  EXPECT_EQ(parsed.read, text.size());
}

TEST(Integers, StayWhatTheyAre) {
  const std::int64_t least = std::numeric_limits<std::int64_t>::min();
  const std::int64_t greatest = std::numeric_limits<std::int64_t>::max();
  for (std::int64_t i = 0; i < 1000; ++i) {
    expectInteger(std::to_string(least + i), least + i);
    expectInteger(std::to_string(i - 500), i - 500);
    expectInteger(std::to_string(greatest - i), greatest - i);
  }
  for (std::int64_t ten = 1; ten <= greatest / 10; ten *= 10) {
    for (std::int64_t i : {ten - 1, ten, ten + 1, 9 * ten}) expectInteger(std::to_string(i), i);
  }
  std::mt19937_64 random(1);
  for (int i = 0; i < 20000; ++i) {
    const std::int64_t value = static_cast<std::int64_t>(random() >> (random() & 63));
    expectInteger(std::to_string(value), value);
    expectInteger(std::to_string(-value), -value);
  }
}

TEST(Integers, BeyondInt64AreMarked) {
  const std::string zeros(22, '0');
  for (const std::string& text : words("9223372036854775808 18446744073709551616 "  // 0 mod 2^64
                                       "-100000000000000000000 1" +
                                       zeros)) {
    expectLargeInteger(text, NumberStatus::integer_as_double);
  }
  for (const std::string& text : words("-9223372036854775809 9223372036854775809 "
                                       "18446744073709551615 10" +
                                       zeros + " 1" + std::string(308, '0'))) {
    expectLargeInteger(text, NumberStatus::integer_rounded);
  }
  std::string digits = format("%.0f", -kMax);
  expectLargeInteger(digits, NumberStatus::integer_as_double);
  ++digits.back();
  expectLargeInteger(digits, NumberStatus::integer_rounded);
  std::mt19937_64 random(2);
  for (int i = 0; i < 1000; ++i) {
    const double value = std::ldexp(static_cast<double>((random() | kTopBit) >> 11),
                                    static_cast<int>(11 + random() % 960));
    expectLargeInteger(format("%.0f", value), NumberStatus::integer_as_double);
  }
}

TEST(Integers, TooLargeForADoubleAreRefused) {
  for (const std::string& text :
       {"1" + std::string(309, '0'), "-" + std::string(1000, '9'), std::string(1000000, '3')}) {
    const Parsed parsed(text);
    EXPECT_EQ(parsed.status, NumberStatus::out_of_range);
    EXPECT_EQ(parsed.read, text.size());
    EXPECT_EQ(parsed.real, 0);
  }
}

TEST(Integers, MinusZeroKeepsItsSign) {
  for (const char* const text : {"-0", "-0.0", "-0e7", "-1e-999"}) expectAsStrtod(text);
  EXPECT_EQ(print(-0.0), "-0.0");
  EXPECT_TRUE(Parsed("0").is_integer);
}

// --- doubles from text

TEST(ParseDouble, AgreesWithStrtodOnWhatIsPrinted) {
  std::mt19937_64 random(3);
  for (int i = 0; i < 100000; ++i) {
    const double value = anyDouble(random);
    expectAsStrtod(format("%.17e", value));
    expectAsStrtod(format("%.20e", value));
    expectAsStrtod(format("%.*e", static_cast<int>(random() % 17), value));
    if (HasFatalFailure()) return;
  }
}

TEST(ParseDouble, AgreesWithStrtodOnShortDecimals) {
  std::mt19937_64 random(11);
  for (int i = 0; i < 300000 && !HasFatalFailure(); ++i) {
    std::string text = std::to_string(random() >> (random() & 63));
    text.insert(random() % text.size(), ".");
    if (text.front() == '.') text.insert(0, "0");
    if (text.back() == '.') text += std::to_string(random() % 1000);
    if (text.find_first_not_of('0') == text.find('.')) text.erase(1, text.find('.') - 1);
    expectAsStrtod(random() % 2 == 0 ? text : "-" + text);
  }
  for (const std::string& text :
       words("0.0 -0.0 0.00 0.5 1.0 -1.5 2.50 0.10000000 99999999999.9999999 99999999999.99999999 "
             "99999999999.999999999 999999999999.9 0.000000000000000001 0.0000000000000000001 "
             "1.0000000 1.00000000 1.000000000000000 1.0000000000000000 4.35 0.3 1305031102.175304 "
             "1.5e3 1.5E-3 -1.2345678e+1 9007199254740993.0 1.0000000000000001110")) {
    expectAsStrtod(text);
  }
}

TEST(ParseDouble, AgreesWithStrtodOnRandomText) {
  std::mt19937_64 random(4);
  const auto digits = [&](std::uint64_t most) {
    std::string made;
    for (std::uint64_t left = random() % most; left > 0; --left) {
      made += static_cast<char>('0' + random() % 10);
    }
    return made;
  };
  for (int i = 0; i < 200000; ++i) {
    const std::uint64_t most = i % 10 == 0 ? 60 : 12;
    std::string text = random() % 2 == 0 ? "-" : "";
    text += random() % 2 == 0 ? "0" : std::to_string(1 + random() % 9) + digits(most);
    text += "." + std::string(random() % 8 == 0 ? random() % 30 : 0, '0') + digits(most) + "7";
    std::uniform_int_distribution<int> exponent(i % 2 == 0 ? -30 : -350, i % 2 == 0 ? 30 : 350);
    if (i % 4 != 0) text += format("e%d", exponent(random));
    expectAsStrtod(text);
    if (HasFatalFailure()) return;
  }
}

TEST(ParseDouble, AgreesWithStrtodOnEveryPowerOfTen) {
  std::mt19937_64 random(5);
  for (int exponent = -400; exponent <= 400; ++exponent) {
    for (const char* const digits : {"1", "-9", "9007199254740993", "18446744073709551615",
                                     "9999999999999999999", "0.000000000000000000001"}) {
      expectAsStrtod(digits + format("e%d", exponent));
    }
    for (int i = 0; i < 100; ++i) {
      expectAsStrtod(std::to_string(random()) + format("e%d", exponent));
    }
    if (HasFatalFailure()) return;
  }
}

// H stands for 20 nines, Z for a million zeros.
std::vector<std::string> longWords(const std::string& text) {
  std::string expanded;
  for (const char c : text) {
    expanded +=
        c == 'H' ? std::string(20, '9') : std::string(c == 'Z' ? 1000000 : 1, c == 'Z' ? '0' : c);
  }
  return words(expanded);
}

TEST(ParseDouble, TakesAnyExponent) {
  for (const std::string& text : longWords("1e400 1e309 1eH -1e+H 0.1e310 1Ze9 1.Ze309 1Z.0")) {
    EXPECT_EQ(Parsed(text).status, NumberStatus::out_of_range) << text;
    EXPECT_EQ(Parsed(text).read, text.size()) << text;
  }
  for (const std::string& text : longWords("0e999999 1E+007 1e-H 0.0e-H 0eH -0.0eH 0.Z 0.Z7 "
                                           "0.Z1e1000001 1Ze-1000000")) {
    expectAsStrtod(text);
  }
}

TEST(ParseDouble, KnowsTheBoundaries) {
  for (const std::string& text :
       words("1.7976931348623157e308 1.7976931348623158e308 1.797693134862315807e308 "
             "1.79769313486231580793e308 2.2250738585072011e-308 2.2250738585072012e-308 "
             "2.2250738585072014e-308 4.9406564584124654e-324 2.4703282292062327e-324 "
             "2.4703282292062328e-324 6.631236846766476e-316 3.2378839133029012895883524e-319 "
             "9007199254740993.0 9007199254740992.999999999999999999999999 1e23 8.5e22 1e-22 "
             "7.2057594037927933e16 1311868164.363181")) {
    expectAsStrtod(text);
  }
  EXPECT_EQ(Parsed("1311868164.363181").real, 1311868164.363181);
}

// Half way between two doubles: exactly, a little less and a little more, in up to 2000 digits.
void expectTie(double below) {
  const double above = std::nextafter(below, kInfinity);
  const long double middle = (static_cast<long double>(below) + above) / 2;
  const double even = (bitsOf(below) & 1) == 0 ? below : above;
  std::string digits = format("%.780Le", middle);
  const std::string exponent = digits.substr(digits.find('e'));
  digits.resize(digits.find('e'));
  for (const std::size_t count : {0u, 1u, 19u, 1200u}) {
    std::string longer = digits + std::string(count, '0');
    EXPECT_EQ(Parsed(longer + exponent).real, even);
    longer += '1';
    EXPECT_EQ(Parsed(longer + exponent).real, above);
  }
  digits.resize(digits.find_last_not_of('0') + 1);
  EXPECT_EQ(Parsed(digits + exponent).real, even);
  EXPECT_EQ(Parsed(digits + "1" + exponent).real, above);
  --digits.back();
  EXPECT_EQ(Parsed(digits + exponent).real, below);
  EXPECT_EQ(Parsed(digits + std::string(1200, '9') + exponent).real, below);
}

TEST(ParseDouble, RoundsTiesToEven) {
  if (std::numeric_limits<long double>::digits < 54) GTEST_SKIP() << "long double is double";
  for (const double value : {0.0, kLeast, 2 * kLeast, kMin, kMin - kLeast, kMin + kLeast, 1.0, 1e22,
                             std::nextafter(1.0, 0), std::nextafter(1.0, 2), std::ldexp(1.0, 53),
                             std::ldexp(1.0, 53) + 2, std::ldexp(1.0, 60), std::ldexp(1.0, 64)}) {
    expectTie(value);
  }
  std::mt19937_64 random(6);
  for (int i = 0; i < 3000; ++i) {
    const double value = std::fabs(anyDouble(random));
    expectTie(value);
    expectTie(doubleOf(bitsOf(value) >> (12 + random() % 50)));  // subnormal
  }
  // 2^1024 is no double, but half way to it belongs to it.
  std::string limit = format("%.0Lf", static_cast<long double>(kMax) + std::ldexp(1.0L, 970));
  EXPECT_EQ(Parsed(limit + ".0").status, NumberStatus::out_of_range);
  --limit.back();
  EXPECT_EQ(Parsed(limit + ".99").real, kMax);
}

TEST(NumberText, DoesNotDependOnTheRoundingMode) {
  std::mt19937_64 random(7);
  for (int i = 0; i < 1000; ++i) {
    const double value = anyDouble(random);
    const std::string text = i % 2 == 0 ? print(value) : format("%.*e", i % 17, value);
    const double nearest = std::strtod(text.c_str(), nullptr);
#ifdef FE_UPWARD
    std::fesetround(i % 4 < 2 ? FE_UPWARD : FE_DOWNWARD);
#endif
    const Parsed parsed(text);
    const std::string again = print(value);
    std::fesetround(FE_TONEAREST);
    EXPECT_EQ(bitsOf(parsed.real), bitsOf(nearest)) << text;
    EXPECT_EQ(again, print(value));
  }
}

}  // namespace
