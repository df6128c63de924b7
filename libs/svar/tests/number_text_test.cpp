// From numbers to text and back. The C library, which is exact in glibc, says what is right.
#include <gslam/svar/detail/parse_number.h>
#include <gslam/svar/detail/print_number.h>
#include <gtest/gtest.h>

#include <cfenv>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <iterator>
#include <limits>
#include <random>
#include <sstream>
#include <string>
#include <vector>

namespace {

using gslam::detail::bitsOf;
using gslam::detail::doubleOf;
using gslam::detail::NumberStatus;
using gslam::detail::ParsedNumber;

constexpr double kInfinity = std::numeric_limits<double>::infinity();
constexpr double kMax = std::numeric_limits<double>::max();
constexpr double kMin = std::numeric_limits<double>::min();  // the least that is not subnormal
constexpr std::uint64_t kTopBit = std::uint64_t(1) << 63;
constexpr double kLeast = std::numeric_limits<double>::denorm_min();

// A copy without a zero byte behind it, so that the address sanitizer sees who reads too far.
class Parsed : public ParsedNumber {
 public:
  explicit Parsed(const std::string& text) : copy_(text.begin(), text.end()) {
    const char* const begin = copy_.data();
    static_cast<ParsedNumber&>(*this) = gslam::detail::parseNumber(begin, begin + copy_.size());
    read = static_cast<std::size_t>(end - begin);
  }
  std::size_t read;

 private:
  std::vector<char> copy_;
};

template <class... Values>
std::string format(const char* how, Values... values) {
  const int size = std::snprintf(nullptr, 0, how, values...);
  std::string text(static_cast<std::size_t>(size) + 1, '\0');
  std::snprintf(&text[0], text.size(), how, values...);
  text.pop_back();
  return text;
}

std::vector<std::string> words(const std::string& text) {
  std::istringstream stream(text);
  return {std::istream_iterator<std::string>(stream), std::istream_iterator<std::string>()};
}

std::string print(double value) {
  char text[33] = {};
  text[32] = '#';
  const std::size_t size = gslam::detail::printDouble(value, text);
  EXPECT_EQ(text[32], '#');
  EXPECT_LE(size, 24u);
  return std::string(text, size);
}

std::string print(std::int64_t value) {
  char text[20];
  return std::string(text, gslam::detail::printInt64(value, text));
}

double anyDouble(std::mt19937_64& random) {
  double value;
  do {
    value = doubleOf(random());
  } while (!std::isfinite(value));
  return value;
}

// What is no integer: must be what strtod says.
void expectAsStrtod(const std::string& text) {
  const Parsed parsed(text);
  const double expected = std::strtod(text.c_str(), nullptr);
  const bool finite = std::isfinite(expected);
  ASSERT_EQ(parsed.status, finite ? NumberStatus::ok : NumberStatus::out_of_range) << text;
  ASSERT_EQ(parsed.read, text.size()) << text;
  ASSERT_FALSE(parsed.is_integer) << text;
  ASSERT_EQ(parsed.integer, 0) << text;
  ASSERT_EQ(bitsOf(parsed.real), bitsOf(finite ? expected : 0)) << text;
}

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
