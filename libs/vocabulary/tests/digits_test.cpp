#include <gslam/vocabulary/detail/digits.h>
#include <gtest/gtest.h>

#include <cmath>
#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <limits>
#include <random>
#include <string>
#include <vector>

namespace {

using gslam::detail::scanByte;
using gslam::detail::scanDouble;
using gslam::detail::scanFloat;
using gslam::detail::scanUnsigned;

// On the heap and without an end of 0, so that reading too far is seen.
struct Exactly {
  explicit Exactly(const std::string& text) : bytes(text.begin(), text.end()) {}
  const char* begin() const { return bytes.data(); }
  const char* end() const { return bytes.data() + bytes.size(); }
  std::vector<char> bytes;
};

// By strtod() and strtof(), which glibc rounds correctly; tests run in the C locale.
void expectSameAsLibrary(const std::string& text) {
  const Exactly exact(text);
  double value = -1;
  ASSERT_EQ(scanDouble(exact.begin(), exact.end(), value), exact.end()) << text;
  EXPECT_EQ(value, std::strtod(text.c_str(), nullptr)) << text;
  EXPECT_EQ(std::signbit(value), text[0] == '-') << text;
  float narrow = -1;
  const float expected = std::strtof(text.c_str(), nullptr);
  if (std::isinf(expected)) return;
  ASSERT_EQ(scanFloat(exact.begin(), exact.end(), narrow), exact.end()) << text;
  EXPECT_EQ(narrow, expected) << text;
}

TEST(digits, byte_is_every_number_up_to_255_whatever_follows) {
  for (const char* const behind : {"", " ", "\n", "\" }", "   7"}) {
    for (unsigned i = 0; i < 256; ++i) {
      const Exactly text(std::to_string(i) + behind);
      std::uint8_t value = 77;
      const char* const end = scanByte(text.begin(), text.end(), value);
      ASSERT_EQ(end, text.end() - std::strlen(behind)) << i;
      EXPECT_EQ(value, i);
    }
  }
}

TEST(digits, byte_is_nothing_else) {
  for (const char* const wrong : {"", " ", "a", "-1", "256", "999", "1000", "2555", "+1", ".5"}) {
    for (const char* const behind : {"", " ", "    "}) {
      const Exactly text(std::string(wrong) + behind);
      std::uint8_t value = 0;
      EXPECT_EQ(scanByte(text.begin(), text.end(), value), nullptr) << wrong << behind;
    }
  }
}

TEST(digits, unsigned_number_keeps_to_its_bound) {
  std::uint32_t value = 0;
  const Exactly largest("4294967295");
  ASSERT_EQ(scanUnsigned(largest.begin(), largest.end(), 0xFFFFFFFF, value), largest.end());
  EXPECT_EQ(value, 0xFFFFFFFF);
  for (const char* const wrong :
       {"4294967296", "18446744073709551616", "99999999999999999999999", "-1", "", "x"}) {
    const Exactly text(wrong);
    EXPECT_EQ(scanUnsigned(text.begin(), text.end(), 0xFFFFFFFF, value), nullptr) << wrong;
  }
}

TEST(digits, reals_are_rounded_as_the_library_does) {
  for (const char* const text :
       {"0",
        "0.",
        "-0.",
        ".5",
        "1.",
        "1.5",
        "-2.25",
        "1e3",
        "1E+3",
        "1e-3",
        "123456.789e-12",
        "9007199254740993",
        "9007199254740992.5",
        "1.2345678901234567e-01",
        "7.0e-45",
        "1e-46",
        "4.9e-324",
        "1.7976931348623157e308",
        "2.2250738585072011e-308",
        "1e23",
        "1e22",
        "179769313486231570000000000000000000000000000000000000000000000000000",
        "0.00000000000000000000000000000000000000000000000000000000001",
        "00000000000000000001.5",
        "3.4028235677973366e38",
        "1.00000005960464477539",
        "1.00000005960464477540"}) {
    expectSameAsLibrary(text);
  }
}

TEST(digits, random_reals_are_rounded_as_the_library_does) {
  std::mt19937_64 random(5);
  for (int i = 0; i < 20000; ++i) {
    const std::uint64_t bits = random();
    double any;
    std::memcpy(&any, &bits, sizeof(any));
    if (!std::isfinite(any)) continue;
    const double usual = std::ldexp(static_cast<double>(bits >> 11), -static_cast<int>(bits % 64));
    char text[64];
    const int digits = 1 + static_cast<int>(bits % 18);
    for (const double value : {any, usual}) {
      std::snprintf(text, sizeof text, "%.*e", digits, value);
      expectSameAsLibrary(text);
      std::snprintf(text, sizeof text, "%.*g", digits, value);
      expectSameAsLibrary(text);
    }
  }
}

// Decimals half way between two floats, and next to that.
TEST(digits, floats_are_rounded_once) {
  std::mt19937 random(6);
  for (int i = 0; i < 20000; ++i) {
    const float low = std::ldexp(static_cast<float>(0x800000 + random() % 0x800000),
                                 static_cast<int>(random() % 40) - 40);
    const double middle =
        (static_cast<double>(low) +
         static_cast<double>(std::nextafter(low, std::numeric_limits<float>::infinity()))) /
        2;
    char text[128];
    std::snprintf(text, sizeof text, "%.50g", middle);
    expectSameAsLibrary(text);
    expectSameAsLibrary(std::string(text) + (std::strchr(text, '.') != nullptr ? "1" : ".1"));
    std::snprintf(text, sizeof text, "%.17g", middle);
    expectSameAsLibrary(text);
  }
}

TEST(digits, reals_are_nothing_else) {
  for (const char* const wrong : {"", "-", "+", ".", "-.", "e5", "1e", "1e+", "nan", "inf", "x",
                                  "1e400", "-1e999999999999"}) {
    const Exactly text(wrong);
    double value = 0;
    EXPECT_EQ(scanDouble(text.begin(), text.end(), value), nullptr) << wrong;
  }
  float narrow = 0;
  const Exactly large("1e39");
  EXPECT_EQ(scanFloat(large.begin(), large.end(), narrow), nullptr);
}

}  // namespace
