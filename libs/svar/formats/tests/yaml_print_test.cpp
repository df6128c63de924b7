// YAML as it is printed, and that it is read as what was printed.
#include <gslam/svar_formats.h>
#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <string>

#include "random_value.h"

namespace {

using gslam::parseYaml;
using gslam::printYaml;
using gslam::Svar;

struct PrintedYaml {
  const char* name;
  Svar value;
  std::string text;
};

TEST(YamlPrint, Scalars) {
  const double infinity = std::numeric_limits<double>::infinity();
  const PrintedYaml cases[] = {
      {"null", nullptr, "null"},
      {"true", true, "true"},
      {"int", -30, "-30"},
      {"int64_min", std::numeric_limits<std::int64_t>::min(), "-9223372036854775808"},
      {"half", 0.5, "0.5"},
      {"whole", 30.0, "30.0"},
      {"minus_zero", -0.0, "-0.0"},
      {"large", 1e22, "1.0e+22"},
      {"small", 2.5e-7, "2.5e-7"},
      {"smallest", 5e-324, "5.0e-324"},
      {"infinity", infinity, ".inf"},
      {"minus_infinity", -infinity, "-.inf"},
      {"text", "abc", "abc"},
      {"text_with_spaces", "left camera 2", "left camera 2"},
      {"path", "/cam0/image_raw", "/cam0/image_raw"},
      {"empty", "", "\"\""},
      {"word", "true", "\"true\""},
      {"word_of_yaml_1_1", "Off", "\"Off\""},
      {"number", "12", "\"12\""},
      {"date", "2001-12-14", "\"2001-12-14\""},
      {"colon", "a: b", "\"a: b\""},
      {"space_at_end", "a ", "\"a \""},
      {"merge", "<<", "\"<<\""},
      {"lines", "a\nb\t\"c\"\\\r", "\"a\\nb\\t\\\"c\\\"\\\\\\r\""},
      {"controls", std::string("\0\x1B\x7F", 3), "\"\\x00\\x1B\\x7F\""},
      {"beyond_ascii", "caf\xC3\xA9", "\"caf\xC3\xA9\""},
      {"not_seen", "\xC2\x85\xC2\xA0\xE2\x80\xA8\xEF\xBB\xBF\xEF\xBF\xBE",
       "\"\\u0085\\u00A0\\u2028\\uFEFF\\uFFFE\""},
      {"binary", Svar::binary("hello", 5), "!!binary \"aGVsbG8=\""},
      {"empty_binary", Svar::binary("", 0), "!!binary \"\""},
      {"array_of_binary", Svar::array({Svar::binary("\0\xFF", 2)}), "[!!binary \"AP8=\"]"},
      {"empty_array", Svar::array(), "[]"},
      {"empty_object", Svar::object(), "{}"},
  };
  for (const PrintedYaml& one : cases) {
    SCOPED_TRACE(one.name);
    EXPECT_EQ(printYaml(one.value), one.text);
    EXPECT_EQ(parseYaml(one.text), one.value);
  }
  EXPECT_EQ(printYaml(std::nan("")), ".nan");
}

TEST(YamlPrint, Structure) {
  const Svar value = Svar::object(
      {{"fps", 30},
       {"camera", Svar::object({{"k", Svar::array({535.4, 539})}, {"name", "left"}})},
       {"list", Svar::array({1, Svar::object({{"a", 1}, {"b", Svar::array({Svar::object()})}}),
                             Svar::array({Svar::array({1, 2}), Svar::array({})})})},
       {"words", Svar::array({"a", true, nullptr})},
       {"none", Svar::array()},
       {"a b:", Svar::object({{"12", nullptr}})}});
  const std::string text = R"(fps: 30
camera:
  k: [535.4, 539]
  name: left
list:
  - 1
  - a: 1
    b:
      - {}
  - - [1, 2]
    - []
words: [a, true, null]
none: []
"a b:":
  "12": null)";
  EXPECT_EQ(printYaml(value), text);
  EXPECT_EQ(parseYaml(text), value);
}

TEST(YamlPrint, LongArrays) {
  Svar numbers = Svar::array(), words = Svar::array();
  for (int i = 0; i < 30; ++i) {
    numbers.push_back(1000000 + i);
    words.push_back("word " + std::to_string(i));
  }
  const std::string text = printYaml(Svar::object({{"n", numbers}, {"w", words}}));
  EXPECT_EQ(text.substr(0, 97),
            "n: [1000000, 1000001, 1000002, 1000003, 1000004, 1000005, 1000006, 1000007, 1000008,\n"
            "  1000009, 1");
  EXPECT_NE(text.find("w:\n  - word 0\n  - word 1\n"), std::string::npos) << text;
  EXPECT_EQ(parseYaml(text), Svar::object({{"n", numbers}, {"w", words}}));
}

TEST(YamlPrint, LongNames) {
  for (const std::size_t size : {200u, 201u, 1023u, 1024u, 5000u}) {
    const std::string name(size, 'x');
    const Svar object = Svar::object({{name, Svar::object({{name + ":", 1}})}, {"b", 2}});
    for (const Svar& value : {object, Svar::array({object, 1})}) {
      EXPECT_EQ(parseYaml(printYaml(value)), value) << size;
    }
    Svar deep = object;
    for (int i = 0; i < 50; ++i) deep = Svar::array({deep});
    EXPECT_EQ(parseYaml(printYaml(deep)), deep) << size;
  }
}

TEST(YamlPrint, SaysWhereThereIsNoUtf8) {
  const auto error_of = [](const Svar& value) -> std::string {
    try {
      printYaml(value);
    } catch (const gslam::SvarError& error) {
      return error.what();
    }
    return "(no error)";
  };
  EXPECT_EQ(error_of(Svar::object({{"a", Svar::array({1, "ab\xFF"})}})),
            "a.1: cannot be printed as YAML: expected UTF-8, found byte 0xFF at 2");
  EXPECT_EQ(error_of(Svar::object({{"a", Svar::array({Svar::function([](int i) { return i; })})}})),
            "a.0: cannot be printed as YAML: expected a value that YAML has, found function "
            "int32(int32)");
  EXPECT_EQ(error_of("\xC3\xA9\xED\xA0\x80"),
            "cannot be printed as YAML: expected UTF-8, found byte 0xED at 2");
  EXPECT_EQ(
      error_of(Svar::object({{"b", Svar::object({{"a", 1}, {"\xC3", 1}})}})),
      "b: cannot be printed as YAML: expected UTF-8, found byte 0xC3 at 0 of the name of member 1");
}

TEST(YamlPrint, EveryByteAndEveryWord) {
  for (int byte = 0; byte < 0x80; ++byte) {
    for (const char* const around : {"", "a", " ", "1", "-"}) {
      const std::string text = around + std::string(1, static_cast<char>(byte)) + around;
      const Svar value = Svar::object({{text, Svar::array({text, Svar::object({{text, text}})})}});
      const std::string printed = printYaml(value);
      ASSERT_EQ(parseYaml(printed), value) << printed;
    }
  }
}

TEST(YamlRoundTrip, RandomTrees) {
  random_value::Random random(1);
  for (int i = 0; i < 1500; ++i) {
    const Svar value = random_value::anyTree(random, 6, true);
    const std::string text = printYaml(value);
    const Svar again = parseYaml(text);
    ASSERT_EQ(again, value) << text;
    ASSERT_EQ(printYaml(again), text);
  }
}

TEST(YamlRoundTrip, DoublesKeepAllTheirBits) {
  random_value::Random random(2);
  for (int i = 0; i < 5000; ++i) {
    const double value = random_value::anyDouble(random);
    const double again = parseYaml(printYaml(value)).as<double>();
    ASSERT_EQ(again, value) << printYaml(value);
    ASSERT_EQ(std::signbit(again), std::signbit(value));
  }
}

}  // namespace
