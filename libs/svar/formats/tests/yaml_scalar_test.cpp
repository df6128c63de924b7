// Scalars of YAML: the core schema, quotes, blocks and tags.
#include <gslam/svar_formats.h>
#include <gtest/gtest.h>

#include <cmath>
#include <cstdint>
#include <limits>
#include <string>

#include "parse_error.h"

namespace {

using gslam::parseYaml;
using gslam::Svar;
using parse_error::yamlError;

struct ScalarCase {
  const char* text;
  Svar value;
};

template <std::size_t count>
void check(const ScalarCase (&cases)[count]) {
  for (const ScalarCase& one : cases) {
    SCOPED_TRACE(one.text);
    EXPECT_EQ(parseYaml(one.text), one.value);
    EXPECT_EQ(parseYaml("a: " + std::string(one.text) + "\n"), Svar::object({{"a", one.value}}));
  }
}

TEST(YamlScalar, NullAndBool) {
  const ScalarCase cases[] = {
      {"null", nullptr}, {"Null", nullptr}, {"NULL", nullptr}, {"~", nullptr},   {"true", true},
      {"True", true},    {"TRUE", true},    {"false", false},  {"False", false}, {"FALSE", false}};
  check(cases);
  EXPECT_EQ(parseYaml("a:\nb: # nothing\nc: ''"),
            Svar::object({{"a", nullptr}, {"b", nullptr}, {"c", ""}}));
}

TEST(YamlScalar, WordsOfOtherSchemasAreText) {
  const ScalarCase cases[] = {{"nULL", "nULL"},
                              {"tRue", "tRue"},
                              {"yes", "yes"},
                              {"No", "No"},
                              {"on", "on"},
                              {"off", "off"},
                              {"y", "y"},
                              {"nan", "nan"},
                              {"inf", "inf"},
                              {"1:30", "1:30"},
                              {"1_000", "1_000"},
                              {"2001-12-14", "2001-12-14"},
                              {"0b11", "0b11"},
                              {"0o8", "0o8"},
                              {"0xG", "0xG"},
                              {"0X1F", "0X1F"},
                              {"-0x1F", "-0x1F"},
                              {"1e", "1e"},
                              {"e3", "e3"},
                              {".", "."},
                              {"+", "+"},
                              {"1.2.3", "1.2.3"},
                              {"--1", "--1"},
                              {"1 2", "1 2"},
                              {".e3", ".e3"},
                              {"+.nan", "+.nan"},
                              {"0x", "0x"},
                              {"nullify", "nullify"},
                              {"~a", "~a"},
                              {"12px", "12px"},
                              {"-.infinity", "-.infinity"}};
  check(cases);
}

TEST(YamlScalar, Integers) {
  const std::int64_t most = std::numeric_limits<std::int64_t>::max();
  const std::int64_t least = std::numeric_limits<std::int64_t>::min();
  const ScalarCase cases[] = {{"0", 0},
                              {"-0", 0},
                              {"+12", 12},
                              {"-12", -12},
                              {"007", 7},
                              {"-007", -7},
                              {"0o17", 15},
                              {"0o0", 0},
                              {"0xFF", 255},
                              {"0xdeadBEEF", std::int64_t(3735928559)},
                              {"0x7FFFFFFFFFFFFFFF", most},
                              {"0o777777777777777777777", most},
                              {"9223372036854775807", most},
                              {"-9223372036854775808", least},
                              {"00009223372036854775807", most}};
  check(cases);
}

TEST(YamlScalar, IntegersBeyondInt64AreDoublesWhereTheseAreExact) {
  const ScalarCase cases[] = {
      {"9223372036854775808", std::ldexp(1.0, 63)},
      {"100000000000000000000", 1e20},
      {"-100000000000000000000", -1e20},
      {"0x8000000000000000", std::ldexp(1.0, 63)},
      {"0x10000000000000000", std::ldexp(1.0, 64)},
      {"0o1000000000000000000000", std::ldexp(1.0, 63)},
      {"0xFFFFFFFFFFFFF80000000000000000000000", std::ldexp(9007199254740991.0, 91)}};
  check(cases);
  const std::string expected =
      "1:1: expected an integer that int64 or double can hold exactly, found ";
  EXPECT_EQ(yamlError("9223372036854775809"), expected + "\"9223372036854775809\"");
  EXPECT_EQ(yamlError("0xFFFFFFFFFFFFFFFF"), expected + "\"0xFFFFFFFFFFFFFFFF\"");
  EXPECT_EQ(yamlError("0x10000000000000001"), expected + "\"0x10000000000000001\"");
  EXPECT_EQ(yamlError("0x1" + std::string(256, '0')),
            expected + "\"0x1" + std::string(37, '0') + "...\"");
  EXPECT_EQ(parseYaml("0x1" + std::string(255, '0')), Svar(std::ldexp(1.0, 1020)));
  EXPECT_EQ(parseYaml("0x" + std::string(100000, '0') + "1"), Svar(1));
}

TEST(YamlScalar, Doubles) {
  const double infinity = std::numeric_limits<double>::infinity();
  const ScalarCase cases[] = {{"1.5", 1.5},
                              {"-1.5", -1.5},
                              {"+1.5", 1.5},
                              {".5", 0.5},
                              {"-.5", -0.5},
                              {"5.", 5.0},
                              {"-5.", -5.0},
                              {"1e3", 1000.0},
                              {"1E+3", 1000.0},
                              {"1.e-3", 0.001},
                              {".5e1", 5.0},
                              {"01.50", 1.5},
                              {"0.", 0.0},
                              {".inf", infinity},
                              {"+.Inf", infinity},
                              {"-.INF", -infinity},
                              {"1.7976931348623157e308", 1.7976931348623157e308},
                              {"1e-400", 0.0},
                              {"1305031102.175304", 1305031102.175304}};
  check(cases);
  EXPECT_TRUE(std::signbit(parseYaml("-0.").as<double>()));
  for (const char* const text : {".nan", ".NaN", ".NAN", ".Nan"}) {
    EXPECT_TRUE(std::isnan(parseYaml(text).as<double>())) << text;
  }
  EXPECT_EQ(yamlError("x:\n  - 1.5\n  - -1e400\n"),
            "3:5: expected a number that a double can hold, found \"-1e400\"");
}

TEST(YamlScalar, WhatIsQuotedIsText) {
  const ScalarCase cases[] = {{"'12'", "12"},
                              {"\"true\"", "true"},
                              {"'it''s'", "it's"},
                              {"\"\"", ""},
                              {"'~'", "~"},
                              {R"("a\tb\n\"\\\/")", "a\tb\n\"\\/"},
                              {R"("\x41\u00e9\U0001F600")", "A\xC3\xA9\xF0\x9F\x98\x80"},
                              {R"("\0")", Svar(std::string(1, '\0'))},
                              {R"("\a\b\e\v\f\r")", "\x07\b\x1B\v\f\r"},
                              {R"("\N\_\L\P")", "\xC2\x85\xC2\xA0\xE2\x80\xA8\xE2\x80\xA9"},
                              {"\"\xC3\xA9\\N\xC3\xA9\"", "\xC3\xA9\xC2\x85\xC3\xA9"},
                              {"\"\xC3\x85\xC3\xA0\"", "\xC3\x85\xC3\xA0"}};
  check(cases);
  EXPECT_EQ(parseYaml("\"one\n  two\n\n  three\\\n  four\"").as<std::string>(),
            "one two\nthreefour");
  EXPECT_EQ(parseYaml("one\n two\n\n three").as<std::string>(), "one two\nthree");
}

TEST(YamlScalar, Blocks) {
  EXPECT_EQ(parseYaml("a: |\n  one\n   two\n\n  three\nb: 1"),
            Svar::object({{"a", "one\n two\n\nthree\n"}, {"b", 1}}));
  EXPECT_EQ(parseYaml("a: >\n  one\n  two\n\n  three\n"),
            Svar::object({{"a", "one two\nthree\n"}}));
  EXPECT_EQ(parseYaml("a: |-\n  12\n"), Svar::object({{"a", "12"}}));
  EXPECT_EQ(parseYaml("a: |+\n  x\n\nb: 1"), Svar::object({{"a", "x\n\n"}, {"b", 1}}));
  EXPECT_EQ(parseYaml("a: |2\n   x\n"), Svar::object({{"a", " x\n"}}));
}

TEST(YamlScalar, Tags) {
  const ScalarCase cases[] = {{"!!str 12", "12"},
                              {"!!str null", "null"},
                              {"!!int \"12\"", 12},
                              {"!!int 0x1F", 31},
                              {"!!float 3", 3.0},
                              {"!!float 0x10", 16.0},
                              {"!!float .5", 0.5},
                              {"!!bool 'true'", true},
                              {"!!null ''", nullptr},
                              {"!!null", nullptr},
                              {"! 12", "12"},
                              {"!mine 12", 12},
                              {"!mine \"12\"", "12"},
                              {"!mine 'x'", "x"},
                              {"!mine &a '12'", "12"},
                              {"!!float 9007199254740993", 9007199254740992.0},
                              {"!!timestamp 2001-12-14", "2001-12-14"},
                              {"!<tag:yaml.org,2002:str> 1", "1"},
                              {"!<tag:example.com,2000:x> 1", 1}};
  check(cases);
  EXPECT_EQ(parseYaml("[!!str , !!str]"), Svar::array({"", ""}));
  EXPECT_EQ(parseYaml("a: !mine |\n  12\n"), Svar::object({{"a", "12\n"}}));
  EXPECT_EQ(parseYaml("%TAG !e! tag:yaml.org,2002:\n---\n!e!str 1"), Svar("1"));
  EXPECT_EQ(parseYaml("!!map {a: !!seq [1]}"), Svar::object({{"a", Svar::array({1})}}));
  EXPECT_EQ(parseYaml("!mine {a: !yours [1]}"), Svar::object({{"a", Svar::array({1})}}));
}

TEST(YamlScalar, Binary) {
  const ScalarCase cases[] = {{"!!binary aGVsbG8=", Svar::binary("hello", 5)},
                              {"!!binary 'aGVs bG8='", Svar::binary("hello", 5)},
                              {"!!binary aGVsbG8h", Svar::binary("hello!", 6)},
                              {"!!binary aA==", Svar::binary("h", 1)},
                              {"!!binary AP/+", Svar::binary("\0\xFF\xFE", 3)},
                              {"!!binary ''", Svar::binary("", 0)}};
  check(cases);
  EXPECT_EQ(parseYaml("a: !!binary |\n  aGVs\n  bG8=\n"),
            Svar::object({{"a", Svar::binary("hello", 5)}}));
  for (const char* const wrong :
       {"aGVsbG8", "aGVsbG8==", "a===", "aGVs=bG8", "aG*s", "aB==", "aGVsbG9=", "="}) {
    EXPECT_EQ(yamlError("!!binary \"" + std::string(wrong) + "\""),
              "1:1: expected base64 after !!binary, found \"" + std::string(wrong) + "\"");
  }
}

TEST(YamlScalar, TagsAreChecked) {
  EXPECT_EQ(yamlError("a: !!int 1.5"),
            "1:4: expected what the tag !!int stands for, found \"1.5\"");
  EXPECT_EQ(yamlError("!!int x"), "1:1: expected what the tag !!int stands for, found \"x\"");
  EXPECT_EQ(yamlError("!!bool yes"), "1:1: expected what the tag !!bool stands for, found \"yes\"");
  EXPECT_EQ(yamlError("!!null 0"), "1:1: expected what the tag !!null stands for, found \"0\"");
  EXPECT_EQ(yamlError("!!float x"), "1:1: expected what the tag !!float stands for, found \"x\"");
  EXPECT_EQ(yamlError("!!int [1]"), "1:1: expected what the tag !!int stands for, found an array");
  EXPECT_EQ(yamlError("!!seq {a: 1}"),
            "1:1: expected what the tag !!seq stands for, found an object");
  EXPECT_EQ(yamlError("!!map [a]"), "1:1: expected what the tag !!map stands for, found an array");
}

}  // namespace
