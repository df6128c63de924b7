// Stamps as text: exact on both ways.
#include <gmock/gmock.h>
#include <gslam/core/stamp.h>
#include <gtest/gtest.h>

#include <cstdint>
#include <random>
#include <string>
#include <utility>

namespace {

using gslam::ParseError;
using gslam::parseStamp;
using gslam::secondsText;
using gslam::StampUnit;
using testing::HasSubstr;

template <class... Arguments>
std::string stampProblem(Arguments... arguments) {
  try {
    return "read as " + std::to_string(parseStamp(arguments...));
  } catch (const ParseError& error) {
    return error.what();
  }
}

TEST(Stamp, SecondsHaveNineDecimals) {
  EXPECT_EQ(secondsText(1305031098665900000), "1305031098.665900000");
  EXPECT_EQ(secondsText(0), "0.000000000");
  EXPECT_EQ(secondsText(1), "0.000000001");
  EXPECT_EQ(secondsText(-1), "-0.000000001");
  EXPECT_EQ(secondsText(-1500000000), "-1.500000000");
  EXPECT_EQ(secondsText(INT64_MAX), "9223372036.854775807");
  EXPECT_EQ(secondsText(INT64_MIN), "-9223372036.854775808");
}

TEST(Stamp, IsReadAsItIsWritten) {
  const std::pair<const char*, std::int64_t> cases[] = {
      {"1305031098.6659", 1305031098665900000},
      {"1403715273.262142976", 1403715273262142976},  // not a double
      {"0", 0},
      {"-0.0", 0},
      {"+2.5", 2500000000},
      {".5", 500000000},
      {"5.", 5000000000},
      {"007", 7000000000},
      {"1.044989e-01", 104498900},
      {"0.000000e+00", 0},
      {"1.305031098665900E9", 1305031098665900000},
      {"13050310986659e-4", 1305031098665900000},
      {"0.0000000001e1", 1},
      {"9223372036.854775807", INT64_MAX},
      {"-9223372036.854775808", INT64_MIN},
      {"1e-400", 0},
      {"0e400", 0},
      {"0e99999999999999999999", 0}};
  for (const auto& one : cases) EXPECT_EQ(parseStamp(one.first), one.second) << one.first;
}

TEST(Stamp, TheNearestNanosecondIsTaken) {
  EXPECT_EQ(parseStamp("0.0000000004"), 0);
  EXPECT_EQ(parseStamp("0.0000000006"), 1);
  EXPECT_EQ(parseStamp("-0.0000000006"), -1);
  EXPECT_EQ(parseStamp("0.0000000005"), 0);  // of two as near the even one
  EXPECT_EQ(parseStamp("0.0000000015"), 2);
  EXPECT_EQ(parseStamp("0.0000000025"), 2);
  EXPECT_EQ(parseStamp("0.00000000250000000000000000000000000001"), 3);
  EXPECT_EQ(parseStamp("0.0000000004999999999999999999999999999999999"), 0);
  EXPECT_EQ(parseStamp("0.00000000005"), 0);
  EXPECT_EQ(parseStamp("0.9999999999"), 1000000000);
  EXPECT_EQ(parseStamp("9223372036.8547758074"), INT64_MAX);
  EXPECT_THAT(stampProblem("9223372036.8547758075"), HasSubstr("2262"));
}

TEST(Stamp, EveryStampComesBack) {
  std::mt19937_64 random(1);
  for (int i = 0; i < 100000; ++i) {
    const std::int64_t stamp = static_cast<std::int64_t>(random()) >> (i % 64);
    const std::string text = secondsText(stamp);
    ASSERT_EQ(parseStamp(text), stamp) << text;
    ASSERT_EQ(parseStamp(std::to_string(stamp), StampUnit::nanoseconds), stamp);
    ASSERT_EQ(parseStamp(std::to_string(stamp) + "e-9"), stamp);
    ASSERT_EQ(parseStamp(std::to_string(stamp) + "e-3", StampUnit::microseconds), stamp);
    ASSERT_EQ(parseStamp(std::to_string(stamp) + "000e-9", StampUnit::milliseconds), stamp);
  }
}

TEST(Stamp, UnitsAreThousands) {
  EXPECT_EQ(parseStamp("1403715273262142976", StampUnit::nanoseconds), 1403715273262142976);
  EXPECT_EQ(parseStamp("1.5", StampUnit::microseconds), 1500);
  EXPECT_EQ(parseStamp("1.5", StampUnit::milliseconds), 1500000);
  EXPECT_STREQ(gslam::stampUnitName(StampUnit::seconds), "seconds");
  EXPECT_STREQ(gslam::stampUnitName(static_cast<StampUnit>(9)), "unknown");
}

TEST(Stamp, AnotherUnitIsSuspected) {
  EXPECT_THAT(stampProblem("1403636579763555584"), HasSubstr("is it in nanoseconds?"));
  EXPECT_THAT(stampProblem("1403636579763555584.000000"), HasSubstr("is it in nanoseconds?"));
  EXPECT_THAT(stampProblem("1403636579763555"), HasSubstr("is it in microseconds?"));
  EXPECT_THAT(stampProblem("1403636579763"), HasSubstr("is it in milliseconds?"));
  EXPECT_THAT(stampProblem("1e300"), testing::Not(HasSubstr("is it in")));
  EXPECT_THAT(stampProblem("9223372036854775808", StampUnit::nanoseconds), HasSubstr("2262"));
}

TEST(Stamp, WhatIsNoNumberIsRefused) {
  for (const char* text : {"", " ", ".", "-", "+", "e5", "1e", "1e+", "--1", "1 ", " 1", "1.2.3",
                           "nan", "inf", "0x10", "1,5", "1s", "-.", ".e1"}) {
    EXPECT_THAT(stampProblem(text), HasSubstr("is no number of seconds")) << text;
  }
  EXPECT_THAT(stampProblem(std::string("1\0", 2)), HasSubstr("'1\\x00'"));
}

}  // namespace
