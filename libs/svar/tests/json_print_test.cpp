// JSON as it is printed: numbers, escapes, indentation, and what JSON has no word for.
#include <gslam/svar.h>
#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <memory>
#include <string>

#include "error_text.h"

namespace {

using gslam::parseJson;
using gslam::printJson;
using gslam::Svar;

struct PrintCase {
  const char* name;
  Svar value;
  std::string text;
};

TEST(JsonPrint, RefusesWhatJsonHasNoWordFor) {
  const auto text = [](const Svar& value) {
    return errorText([&] { printJson(Svar::object({{"a", Svar::array({1, value})}})); });
  };
  EXPECT_EQ(text(Svar::function([](int) {})),
            "a.1: cannot be printed as JSON: expected a value that JSON has, found function "
            "void(int32)");
  EXPECT_EQ(text(std::make_shared<int>(3)),
            "a.1: cannot be printed as JSON: expected a value that JSON has, found native int");
  EXPECT_EQ(text(Svar::binary("abc", 3)),
            "a.1: cannot be printed as JSON: expected a value that JSON has, found binary of 3 "
            "bytes");
}

TEST(JsonPrint, Compact) {
  const PrintCase cases[] = {
      {"null", nullptr, "null"},
      {"true", true, "true"},
      {"false", false, "false"},
      {"zero", 0, "0"},
      {"negative", -30, "-30"},
      {"int64_max", std::numeric_limits<std::int64_t>::max(), "9223372036854775807"},
      {"int64_min", std::numeric_limits<std::int64_t>::min(), "-9223372036854775808"},
      {"two_to_53_and_one", std::int64_t(9007199254740993), "9007199254740993"},
      {"half", 0.5, "0.5"},
      {"whole_double", 30.0, "30.0"},
      {"minus_zero", -0.0, "-0.0"},
      {"tenth", 0.1, "0.1"},
      {"sum_of_tenths", 0.1 + 0.2, "0.30000000000000004"},
      {"third", 1.0 / 3, "0.3333333333333333"},
      {"stamp_of_tum", 1305031102.175304, "1305031102.175304"},
      {"string", "abc", "\"abc\""},
      {"empty_string", "", "\"\""},
      {"quote_and_backslash", "\"\\", R"("\"\\")"},
      {"short_escapes", "\b\t\n\f\r", R"("\b\t\n\f\r")"},
      {"other_controls", std::string("\0\x01\x0B\x1F\x7F", 5),
       "\"\\u0000\\u0001\\u000b\\u001f\x7F\""},
      {"slash", "a/b", "\"a/b\""},
      {"beyond_ascii", "caf\xC3\xA9 \xE6\x97\xA5 \xF0\x9F\x98\x80",
       "\"caf\xC3\xA9 \xE6\x97\xA5 \xF0\x9F\x98\x80\""},
      {"escape_at_each_place", "12345678\n1234567\"", R"("12345678\n1234567\"")"},
      {"empty_array", Svar::array(), "[]"},
      {"empty_object", Svar::object(), "{}"},
      {"array", Svar::array({1, "a", nullptr, Svar::array({2.5})}), R"([1,"a",null,[2.5]])"},
      {"object", Svar::object({{"b", 1}, {"a", Svar::object({{"", true}})}}),
       R"({"b":1,"a":{"":true}})"},
      {"escapes_in_name", Svar::object({{"a\"\n", 1}}), R"({"a\"\n":1})"},
  };
  for (const PrintCase& one : cases) {
    SCOPED_TRACE(one.name);
    EXPECT_EQ(printJson(one.value), one.text);
    EXPECT_EQ(parseJson(one.text), one.value);
  }
}

TEST(JsonPrint, Pretty) {
  const Svar value = Svar::object({{"fps", 30},
                                   {"camera", Svar::object({{"k", Svar::array({1, 2.5})}})},
                                   {"none", Svar::array()},
                                   {"nothing", Svar::object()},
                                   {"list", Svar::array({Svar::array({1}), Svar::object()})}});
  EXPECT_EQ(printJson(value, 2), R"({
  "fps": 30,
  "camera": {
    "k": [
      1,
      2.5
    ]
  },
  "none": [],
  "nothing": {},
  "list": [
    [
      1
    ],
    {}
  ]
})");
  EXPECT_EQ(printJson(Svar::array({1}), 16), "[\n                1\n]");
  EXPECT_EQ(printJson(Svar(1), 4), "1");
}

TEST(JsonPrint, RefusesAnotherIndent) {
  for (const int indent : {-1, 17, 1000000}) {
    EXPECT_THROW(printJson(1, indent), gslam::ArgumentError);
  }
}

TEST(JsonPrint, SaysWhereThereIsNoNumber) {
  const double inf = std::numeric_limits<double>::infinity();
  Svar value = Svar::object({{"a", Svar::array({1, Svar::object({{"b", std::nan("")}})})}});
  EXPECT_EQ(errorText([&] { printJson(value); }),
            "a.1.b: cannot be printed as JSON: expected a finite number, found NaN");
  EXPECT_EQ(errorText([&] {
              printJson(Svar::array({0, inf}), 2);
            }),
            "1: cannot be printed as JSON: expected a finite number, found infinity");
  EXPECT_EQ(errorText([&] { printJson(-inf); }),
            "cannot be printed as JSON: expected a finite number, found -infinity");
}

TEST(JsonPrint, SaysWhereThereIsNoUtf8) {
  EXPECT_EQ(errorText([&] {
              printJson(Svar::object({{"a", Svar::array({"ab\xFF"})}}));
            }),
            "a.0: cannot be printed as JSON: expected UTF-8, found byte 0xFF at 2");
  EXPECT_EQ(errorText([&] { printJson("\xC3\xA9\xED\xA0\x80"); }),
            "cannot be printed as JSON: expected UTF-8, found byte 0xED at 2");
  EXPECT_EQ(errorText([&] {
              printJson(Svar::object({{"b", Svar::object({{"\xC3", 1}})}}));
            }),
            "b: cannot be printed as JSON: expected UTF-8, found byte 0xC3 at 0 of the name of "
            "member 0");
}

TEST(JsonPrint, EveryByteAndWhatItNeeds) {
  for (int first = 0; first < 0x80; ++first) {
    for (std::size_t place = 0; place < 17; ++place) {
      std::string text(17, 'x');
      text[place] = static_cast<char>(first);
      const std::string printed = printJson(text);
      EXPECT_EQ(parseJson(printed), Svar(text)) << printed;
      for (const char c : printed) EXPECT_GE(c, ' ') << printed;
    }
  }
}

}  // namespace
