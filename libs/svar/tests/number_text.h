// What the tests of numbers and text share. The C library, which is exact in glibc, says what is
// right.
#ifndef GSLAM_SVAR_TESTS_NUMBER_TEXT_H
#define GSLAM_SVAR_TESTS_NUMBER_TEXT_H

#include <gslam/svar/detail/parse_number.h>
#include <gslam/svar/detail/print_number.h>
#include <gtest/gtest.h>

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

namespace number_text {

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
// What follows far behind, which may be read faster, must not change the number.
class Parsed : public ParsedNumber {
 public:
  explicit Parsed(const std::string& text) : copy_(text.begin(), text.end()) {
    const std::string longer = text + std::string(32, ' ');
    parse(longer.data(), longer.size());
    const ParsedNumber before = *this;
    const std::size_t read_before = read;
    parse(copy_.data(), copy_.size());
    EXPECT_EQ(status, before.status) << text;
    EXPECT_EQ(read, read_before) << text;
    EXPECT_EQ(is_integer, before.is_integer) << text;
    EXPECT_EQ(integer, before.integer) << text;
    EXPECT_EQ(bitsOf(real), bitsOf(before.real)) << text;
  }
  std::size_t read;

 private:
  void parse(const char* begin, std::size_t size) {
    static_cast<ParsedNumber&>(*this) = gslam::detail::parseNumber(begin, begin + size);
    read = static_cast<std::size_t>(end - begin);
  }

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

inline std::vector<std::string> words(const std::string& text) {
  std::istringstream stream(text);
  return {std::istream_iterator<std::string>(stream), std::istream_iterator<std::string>()};
}

inline std::string print(double value) {
  char text[33] = {};
  text[32] = '#';
  const std::size_t size = gslam::detail::printDouble(value, text);
  EXPECT_EQ(text[32], '#');
  EXPECT_LE(size, 24u);
  return std::string(text, size);
}

inline std::string print(std::int64_t value) {
  char text[20];
  return std::string(text, gslam::detail::printInt64(value, text));
}

inline double anyDouble(std::mt19937_64& random) {
  double value;
  do {
    value = doubleOf(random());
  } while (!std::isfinite(value));
  return value;
}

// What is no integer: must be what strtod says.
inline void expectAsStrtod(const std::string& text) {
  const Parsed parsed(text);
  const double expected = std::strtod(text.c_str(), nullptr);
  const bool finite = std::isfinite(expected);
  ASSERT_EQ(parsed.status, finite ? NumberStatus::ok : NumberStatus::out_of_range) << text;
  ASSERT_EQ(parsed.read, text.size()) << text;
  ASSERT_FALSE(parsed.is_integer) << text;
  ASSERT_EQ(parsed.integer, 0) << text;
  ASSERT_EQ(bitsOf(parsed.real), bitsOf(finite ? expected : 0)) << text;
}

}  // namespace number_text

#endif  // GSLAM_SVAR_TESTS_NUMBER_TEXT_H
