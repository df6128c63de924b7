// YAML of any size and depth: limits, aliases of aliases, cut and odd texts.
#include <gslam/svar_formats.h>
#include <gtest/gtest.h>

#include <chrono>
#include <string>

#include "parse_error.h"
#include "random_value.h"

namespace {

using gslam::parseYaml;
using gslam::Svar;
using parse_error::yamlError;

std::string repeated(const std::string& text, std::size_t count) {
  std::string all;
  for (std::size_t i = 0; i < count; ++i) all += text;
  return all;
}

std::string nestedArrays(std::size_t depth) {
  return repeated("[", depth) + repeated("]", depth);
}

TEST(YamlLimit, Depth) {
  EXPECT_NO_THROW(parseYaml(nestedArrays(400)));
  EXPECT_EQ(yamlError(nestedArrays(401)),
            "1:401: expected at most 400 arrays and objects inside one another, found one more");
  gslam::YamlOptions options;
  options.max_depth = 2;
  EXPECT_EQ(yamlError("a:\n  - b\n", options), "accepted");
  EXPECT_EQ(yamlError("a:\n  - b: 1\n", options),
            "2:5: expected at most 2 arrays and objects inside one another, found one more");
  options.max_depth = 0;
  EXPECT_EQ(yamlError("a", options), "accepted");
  EXPECT_EQ(yamlError("[]", options),
            "1:1: expected at most 0 arrays and objects inside one another, found one more");
}

TEST(YamlLimit, DepthThatNothingCanRead) {
  gslam::YamlOptions options;
  options.max_depth = 1000000;
  EXPECT_EQ(yamlError(nestedArrays(490), options), "accepted");
  const std::string error = yamlError(nestedArrays(1000000), options);
  EXPECT_NE(error.find("expected at most 490 arrays and objects inside one another, found more"),
            std::string::npos)
      << error;
}

TEST(YamlLimit, DepthCountsWhatAliasesAdd) {
  gslam::YamlOptions options;
  options.max_depth = 4;
  EXPECT_EQ(yamlError("- &a [[1]]\n- [*a]\n", options), "accepted");
  EXPECT_EQ(
      yamlError("- &a [[1]]\n- [[*a]]\n", options),
      "2:5: expected at most 4 arrays and objects inside one another, found more by this alias");
  EXPECT_EQ(
      yamlError("- &a [[1]]\n- &b [*a]\n- [*b]\n", options),
      "3:4: expected at most 4 arrays and objects inside one another, found more by this alias");
}

TEST(YamlLimit, ValuesAreCounted) {
  gslam::YamlOptions options;
  options.max_values = 4;
  EXPECT_EQ(yamlError("{a: 1, b: [2]}", options), "accepted");
  const std::string expected =
      "expected at most 4 values, found more; aliases count as what they stand for";
  EXPECT_EQ(yamlError("{a: 1, b: [2, 3]}", options), "1:15: " + expected);
  EXPECT_EQ(yamlError("- &a [1]\n- *a", options), "2:3: " + expected);
  EXPECT_EQ(
      parse_error::errorOf([&] { gslam::parseYamlDocuments("[1, 2]\n---\n[3]", "YAML", options); }),
      "3:2: " + expected);
}

// The "billion laughs": 9 levels of ten aliases would be 10^9 values.
TEST(YamlLimit, AliasesOfAliasesEndInAnError) {
  std::string text = "a0: &a0 [x, x, x, x, x, x, x, x, x, x]\n";
  for (int i = 1; i < 10; ++i) {
    const std::string inner = "*a" + std::to_string(i - 1);
    text += "a" + std::to_string(i) + ": &a" + std::to_string(i) + " [" + inner;
    for (int k = 1; k < 10; ++k) text += ", " + inner;
    text += "]\n";
  }
  gslam::YamlOptions options;
  options.max_values = 1000000;
  EXPECT_EQ(
      yamlError(text, options),
      "6:45: expected at most 1000000 values, found more; aliases count as what they stand for");
}

TEST(YamlLimit, MergesOfMergesEndInAnError) {
  std::string text = "- &a0 {k: [1, 2, 3, 4, 5, 6, 7, 8, 9]}\n";
  for (int i = 1; i < 30; ++i) {
    const std::string inner = "*a" + std::to_string(i - 1);
    const std::string number = std::to_string(i);
    text += "- &a" + number;
    text += " {<<: " + inner + ", x" + number;
    text += ": " + inner + "}\n";
  }
  gslam::YamlOptions options;
  options.max_values = 100000;
  EXPECT_NE(yamlError(text, options).find("expected at most 100000 values"), std::string::npos);
}

TEST(YamlLimit, OddTextsTakeLinearTime) {
  const char* const pieces[] = {
      "[",    "{",   "{a: ", "- ",     "? ",  ": ",   "a: ", "&a ",  "!a ",  "*a ",   "'",
      "\"",   "|\n", "> ",   ", ",     "]",   "#",    "\n",  " ",    "\t",   "---\n", "...\n",
      "%a\n", "a\n", "a ",   "a: 1\n", "- [", "[[],", "\\",  "\"\\", "<<: ", "a:",    "- ? "};
  const auto begin = std::chrono::steady_clock::now();
  for (const char* const piece : pieces) {
    const std::string error = yamlError(repeated(piece, 500000 / std::string(piece).size()));
    EXPECT_FALSE(error.empty()) << piece;
  }
  EXPECT_LT(std::chrono::steady_clock::now() - begin, std::chrono::seconds(120));
}

TEST(YamlLimit, PrintingDeepValues) {
  const Svar deep = random_value::nested(399);
  EXPECT_EQ(parseYaml(gslam::printYaml(deep)), deep);
  const std::string text = gslam::printYaml(random_value::nested(100000));
  EXPECT_LT(text.size(), 300000u);
  EXPECT_NE(yamlError(text).find("expected at most 400"), std::string::npos);
}

// Whatever is left of a text, and whatever one byte of it becomes: a value, or a ParseError.
const char kYamlSample[] =
    "%TAG ! tag:a.b,2000:\n--- # c\na: &x [1, 'it''s', \"q\\u00e9\\n\", {b: ~}]\n? c\n: *x\n"
    "d: |2-\n   text\n\ne: >+\n folded\n text\n\nf: !!int \"12\"\n<<: {g: .inf, h: 0x1F}\n"
    "m: !!opencv-matrix\n  rows: 1\n  cols: 2\n  dt: \"1f\"\n  data: [1., .5]\n...\n---\n- - x\n  "
    "- \xC3\xA9\n";

void yamlMustEnd(const std::string& text) {
  try {
    for (const Svar& value : gslam::parseYamlDocuments(text)) {
      const Svar again = parseYaml(gslam::printYaml(value));
      EXPECT_EQ(again, value) << text;
    }
  } catch (const gslam::ParseError& error) {
    EXPECT_GT(error.line(), 0u);
  }
}

TEST(YamlLimit, CutAnywhere) {
  const std::string sample = kYamlSample;
  EXPECT_EQ(gslam::parseYamlDocuments(sample).size(), 2u);
  for (std::size_t size = 0; size < sample.size(); ++size) {
    yamlMustEnd(sample.substr(0, size));
    yamlMustEnd(sample.substr(size));
    yamlMustEnd("%YAML:1.0\n" + sample.substr(size));
  }
}

TEST(YamlLimit, AnyByteBroken) {
  const std::string bytes = parse_error::bytes("\0\x04\n\t []{}:,-?&*!|>'\"%@#\x80\xFF~<0");
  for (std::size_t i = 0; i + 1 < sizeof(kYamlSample); ++i) {
    for (const char byte : bytes) {
      std::string text = kYamlSample;
      text[i] = byte;
      yamlMustEnd(text);
    }
  }
}

}  // namespace
