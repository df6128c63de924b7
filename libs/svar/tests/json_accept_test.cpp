// JSON that must be read, by the grammar of RFC 8259 or by choice where the RFC leaves one, and the
// value that it stands for.
#include <gslam/svar.h>
#include <gtest/gtest.h>

#include <limits>
#include <string>

#include "bytes.h"
#include "int64_limits.h"

namespace {

using gslam::JsonOptions;
using gslam::parseJson;
using gslam::Svar;

struct AcceptCase {
  const char* name;
  std::string text;
  Svar value;
};

void check(const AcceptCase* cases, std::size_t count, const JsonOptions& options = JsonOptions()) {
  for (std::size_t i = 0; i < count; ++i) {
    SCOPED_TRACE(cases[i].name);
    try {
      const Svar value = parseJson(cases[i].text, "JSON", options);
      EXPECT_EQ(value, cases[i].value) << gslam::printJson(value);
      EXPECT_EQ(parseJson(gslam::printJson(value)), value);
      EXPECT_EQ(parseJson(gslam::printJson(value, 2)), value);
    } catch (const gslam::Error& error) {
      ADD_FAILURE() << error.what();
    }
  }
}

template <std::size_t count>
void check(const AcceptCase (&cases)[count], const JsonOptions& options = JsonOptions()) {
  check(cases, count, options);
}

Svar list(std::initializer_list<Svar> elements) {
  return Svar::array(elements);
}
Svar named(std::initializer_list<Svar::Member> members) {
  return Svar::object(members);
}

TEST(JsonAccept, Structure) {
  const AcceptCase cases[] = {
      {"null", "null", nullptr},
      {"true", "true", true},
      {"false", "false", false},
      {"lone_integer", "42", 42},
      {"lone_negative", "-7", -7},
      {"lone_double", "0.5", 0.5},
      {"lone_string", "\"abc\"", "abc"},
      {"lone_empty_string", "\"\"", ""},
      {"empty_array", "[]", Svar::array()},
      {"empty_object", "{}", Svar::object()},
      {"empty_array_with_space", "[ \n]", Svar::array()},
      {"empty_object_with_space", "{\t}", Svar::object()},
      {"space_around", " \t\r\n1 \t\r\n", 1},
      {"space_around_array", "\n[\n1\n,\n2\n]\n", list({1, 2})},
      {"space_around_members", " { \"a\" : 1 , \"b\" : 2 } ", named({{"a", 1}, {"b", 2}})},
      {"no_space", "{\"a\":[1,{\"b\":null}]}", named({{"a", list({1, named({{"b", nullptr}})})}})},
      {"nested_arrays", "[[[]],[[],[]]]", list({list({list({})}), list({list({}), list({})})})},
      {"array_of_empty_objects", "[{},{}]", list({named({}), named({})})},
      {"object_of_empty_arrays", "{\"a\":[],\"b\":[]}", named({{"a", list({})}, {"b", list({})}})},
      {"all_types", "[null,true,false,1,1.5,\"s\",[],{}]",
       list({nullptr, true, false, 1, 1.5, "s", list({}), named({})})},
      {"words_in_array", "[true,false,null]", list({true, false, nullptr})},
      {"heterogeneous_depth", "[1,[2,[3]],4]", list({1, list({2, list({3})}), 4})},
      {"carriage_returns", "[1,\r\n2]\r\n", list({1, 2})},
      {"deep_after_shallow", "{\"a\":{\"b\":{\"c\":1}},\"d\":2}",
       named({{"a", named({{"b", named({{"c", 1}})}})}, {"d", 2}})},
      {"trailing_line_end", "[]\n", list({})},
  };
  check(cases);
}

TEST(JsonAccept, Names) {
  const AcceptCase cases[] = {
      {"empty_name", "{\"\":0}", named({{"", 0}})},
      {"name_with_dot", "{\"a.b\":0}", named({{"a.b", 0}})},
      {"name_with_escapes", "{\"\\u0061\\n\\\"\":0}", named({{"a\n\"", 0}})},
      {"name_with_zero_byte", "{\"a\\u0000b\":0}", named({{bytes("a\0b"), 0}})},
      {"name_in_utf8", "{\"caf\xC3\xA9\":0}", named({{"caf\xC3\xA9", 0}})},
      {"name_in_quotes_only", "{\"\\\"\":0}", named({{"\"", 0}})},
      {"long_name", "{\"a name that is longer than sixteen bytes\":0}",
       named({{"a name that is longer than sixteen bytes", 0}})},
      {"same_name_in_other_objects", "{\"a\":{\"a\":{\"a\":1}}}",
       named({{"a", named({{"a", named({{"a", 1}})}})}})},
      {"names_that_differ_in_case", "{\"a\":1,\"A\":2}", named({{"a", 1}, {"A", 2}})},
      {"names_that_are_prefixes", "{\"aa\":1,\"a\":2,\"\":3}",
       named({{"aa", 1}, {"a", 2}, {"", 3}})},
  };
  check(cases);
}

TEST(JsonAccept, Integers) {
  const AcceptCase cases[] = {
      {"zero", "0", 0},
      {"minus_zero", "-0", -0.0},
      {"one_digit", "[7]", list({7})},
      {"int32_max", "2147483647", 2147483647},
      {"int32_min", "-2147483648", std::int64_t(-2147483647) - 1},
      {"uint32_max", "4294967295", std::int64_t(4294967295)},
      {"two_to_53_and_one", "9007199254740993", std::int64_t(9007199254740993)},
      {"int64_max", "9223372036854775807", kMax64},
      {"int64_min", "-9223372036854775808", kMin64},
      {"eighteen_digits", "123456789012345678", std::int64_t(123456789012345678)},
      {"nanoseconds_of_a_stamp", "1305031102175304123", std::int64_t(1305031102175304123)},
      {"minus_one", "-1", -1},
      {"ten", "10", 10},
      {"hundred_in_array", "[100,-100]", list({100, -100})},
  };
  check(cases);
}

TEST(JsonAccept, Doubles) {
  const double inf = std::numeric_limits<double>::infinity();
  const AcceptCase cases[] = {
      {"zero_point_zero", "0.0", 0.0},
      {"minus_zero_point_zero", "-0.0", -0.0},
      {"half", "0.5", 0.5},
      {"tenth", "0.1", 0.1},
      {"exponent", "1e2", 100.0},
      {"big_exponent_letter", "1E2", 100.0},
      {"exponent_with_plus", "1e+2", 100.0},
      {"exponent_with_minus", "1e-2", 0.01},
      {"exponent_with_leading_zeros", "1e0002", 100.0},
      {"zero_with_exponent", "0e1", 0.0},
      {"zero_with_plus_exponent", "0e+1", 0.0},
      {"zero_with_huge_exponent", "0e999999999999", 0.0},
      {"fraction_and_exponent", "123.456e78", 123.456e78},
      {"fraction_and_minus_exponent", "-1.5E-3", -0.0015},
      {"whole_with_exponent_is_double", "20e1", 200.0},
      {"whole_with_fraction_is_double", "3.0", 3.0},
      {"many_zeros", "1.000000000000000000000000000000000000000000000", 1.0},
      {"close_to_zero", "-0.000000000000000000000000000000000000000000000000000000001", -1e-57},
      {"seventeen_digits", "0.30000000000000004", 0.30000000000000004},
      {"largest", "1.7976931348623157e308", std::numeric_limits<double>::max()},
      {"lowest", "-1.7976931348623157e308", std::numeric_limits<double>::lowest()},
      {"smallest_normal", "2.2250738585072014e-308", std::numeric_limits<double>::min()},
      {"smallest", "4.9406564584124654e-324", std::numeric_limits<double>::denorm_min()},
      {"largest_subnormal", "2.2250738585072009e-308", 2.2250738585072009e-308},
      {"rounds_to_even_below", "9007199254740993.0", 9007199254740992.0},
      {"rounds_up_beyond_half", "9007199254740993.00000000000000000000000001", 9007199254740994.0},
      {"stamp_of_tum", "1305031102.175304", 1305031102.175304},
      {"stamp_of_tum_long", "1311868164.3630850", 1311868164.363085},
  };
  check(cases);
  EXPECT_GT(inf, parseJson("1.7976931348623157e308").as<double>());
  EXPECT_EQ(1 / parseJson("-0.0").as<double>(), -inf);
}

TEST(JsonAccept, Strings) {
  const AcceptCase cases[] = {
      {"short_escapes", R"("\"\\\/\b\f\n\r\t")", "\"\\/\b\f\n\r\t"},
      {"backslash_before_n", R"("\\n")", "\\n"},
      {"two_backslashes_before_n", R"("\\\\n")", "\\\\n"},
      {"backslash_then_escape", R"("\\\n")", "\\\n"},
      {"backslash_before_u", R"("\\u0061")", "\\u0061"},
      {"backslash_before_quote", R"("\\\"")", "\\\""},
      {"backslash_at_the_end", R"("a\\")", "a\\"},
      {"path_of_windows", R"("C:\\data\\new\\table")", "C:\\data\\new\\table"},
      {"slash_needs_no_escape", R"("a/b")", "a/b"},
      {"single_quote", R"("it's")", "it's"},
      {"comment_in_string", R"("a /* b */ // c")", "a /* b */ // c"},
      {"brackets_in_string", R"("[{]},:")", "[{]},:"},
      {"u_lower_hex", R"("\u00e9")", "\xC3\xA9"},
      {"u_upper_hex", R"("\u00E9")", "\xC3\xA9"},
      {"u_ascii", R"("\u0041\u005a")", "AZ"},
      {"u_quote", R"("\u0022")", "\""},
      {"u_backslash", R"("\u005C")", "\\"},
      {"u_zero", R"("\u0000")", bytes("\0")},
      {"u_zero_inside", R"("a\u0000b")", bytes("a\0b")},
      {"u_control", R"("\u001f\u007F")", "\x1F\x7F"},
      {"u_last_of_one_byte", R"("\u007f")", "\x7F"},
      {"u_first_of_two_bytes", R"("\u0080")", "\xC2\x80"},
      {"u_last_of_two_bytes", R"("\u07ff")", "\xDF\xBF"},
      {"u_first_of_three_bytes", R"("\u0800")", "\xE0\xA0\x80"},
      {"u_euro", R"("\u20ac")", "\xE2\x82\xAC"},
      {"u_before_surrogates", R"("\ud7ff")", "\xED\x9F\xBF"},
      {"u_after_surrogates", R"("\ue000")", "\xEE\x80\x80"},
      {"u_no_character_fffe", R"("\uFFFE")", "\xEF\xBF\xBE"},
      {"u_no_character_ffff", R"("\uFFFF")", "\xEF\xBF\xBF"},
      {"u_byte_order_mark", R"("\uFEFF")", "\xEF\xBB\xBF"},
      {"u_pair", R"("\ud83d\ude00")", "\xF0\x9F\x98\x80"},
      {"u_pair_first", R"("\uD800\uDC00")", "\xF0\x90\x80\x80"},
      {"u_pair_last", R"("\uDBFF\uDFFF")", "\xF4\x8F\xBF\xBF"},
      {"u_two_pairs", R"("\ud83d\ude00\uD834\uDD1E")", "\xF0\x9F\x98\x80\xF0\x9D\x84\x9E"},
      {"u_then_digit", R"("\u00412")", "A2"},
      {"utf8_two_bytes", "\"\xC3\xA9\"", "\xC3\xA9"},
      {"utf8_three_bytes", "\"\xE2\x82\xAC\"", "\xE2\x82\xAC"},
      {"utf8_four_bytes", "\"\xF0\x9F\x98\x80\"", "\xF0\x9F\x98\x80"},
      {"utf8_first_of_two_bytes", "\"\xC2\x80\"", "\xC2\x80"},
      {"utf8_first_of_three_bytes", "\"\xE0\xA0\x80\"", "\xE0\xA0\x80"},
      {"utf8_first_of_four_bytes", "\"\xF0\x90\x80\x80\"", "\xF0\x90\x80\x80"},
      {"utf8_before_surrogates", "\"\xED\x9F\xBF\"", "\xED\x9F\xBF"},
      {"utf8_last", "\"\xF4\x8F\xBF\xBF\"", "\xF4\x8F\xBF\xBF"},
      {"utf8_line_separators", "\"\xE2\x80\xA8\xE2\x80\xA9\"", "\xE2\x80\xA8\xE2\x80\xA9"},
      {"utf8_in_a_row", "\"\xE6\x97\xA5\xE6\x9C\xAC\xE8\xAA\x9E\xC3\xA9z\"",
       "\xE6\x97\xA5\xE6\x9C\xAC\xE8\xAA\x9E\xC3\xA9z"},
      {"delete_is_no_control", "\"\x7F\"", "\x7F"},
      {"seven_bytes", "\"1234567\"", "1234567"},
      {"eight_bytes", "\"12345678\"", "12345678"},
      {"nine_bytes", "\"123456789\"", "123456789"},
      {"escape_after_eight_bytes", R"("12345678\n")", "12345678\n"},
      {"escape_as_the_eighth_byte", R"("1234567\n890")", "1234567\n890"},
      {"long_text", "\"" + std::string(1000, 'x') + "\"", std::string(1000, 'x')},
  };
  check(cases);
}

// Where RFC 8259 leaves a choice, this is ours; the other choices are among what is rejected.
TEST(JsonAccept, ByChoice) {
  const AcceptCase cases[] = {
      {"byte_order_mark", "\xEF\xBB\xBF[1]", list({1})},
      {"too_small_is_zero", "1e-400", 0.0},
      {"far_too_small_is_zero", "-123.456e-99999999999999999999", -0.0},
      {"two_to_63", "9223372036854775808", 9223372036854775808.0},
      {"below_int64_min_and_exact", "-18446744073709551616", -18446744073709551616.0},
      {"ten_to_20", "100000000000000000000", 1e20},
      {"ten_to_22", "10000000000000000000000", 1e22},
      {"many_digits_of_a_double", "0.1000000000000000055511151231257827021181583404541015625", 0.1},
  };
  check(cases);
}

TEST(JsonAccept, CommentsOnRequest) {
  JsonOptions options;
  options.comments = true;
  const AcceptCase cases[] = {
      {"line_before", "// fps\n1", 1},
      {"line_after", "1 // fps", 1},
      {"line_with_carriage_return", "[1, // fps\r\n2]", list({1, 2})},
      {"block_before", "/* fps */1", 1},
      {"block_after", "1/**/", 1},
      {"block_of_lines", "[1, /* 2,\n 3, */ 4]", list({1, 4})},
      {"block_of_stars", "/***/[/****/]", list({})},
      {"block_with_slashes", "/* // */ 1", 1},
      {"line_with_block", "// /*\n1", 1},
      {"several", "// a\n// b\n/* c */ /* d */ 1 // e\n// f", 1},
      {"everywhere", "/**/{/**/\"a\"/**/:/**/1/**/,/**/\"b\"/**/:/**/[/**/]/**/}/**/",
       named({{"a", 1}, {"b", list({})}})},
      {"in_a_string_it_is_text", "\"/* a */ // b\"", "/* a */ // b"},
  };
  check(cases, options);
}

TEST(JsonAccept, DuplicateNamesOnRequest) {
  JsonOptions options;
  options.allow_duplicate_names = true;
  const Svar once = parseJson(R"({"a": 1, "b": 2, "a": 3, "c": 4, "b": 5, "a": 6})", "", options);
  EXPECT_EQ(gslam::printJson(once), R"({"a":6,"b":5,"c":4})");
  const Svar escaped = parseJson(R"([{"a": 1, "\u0061": {"x": 1, "x": 2}}])", "", options);
  EXPECT_EQ(gslam::printJson(escaped), R"([{"a":{"x":2}}])");

  std::string text = "{";  // more than a few, in no order
  for (int i = 0; i < 1000; ++i) {
    text += "\"" + std::to_string(i * 37 % 100) + "\":" + std::to_string(i) + ",";
  }
  const Svar many = parseJson(text + "\"end\":0}", "", options);
  ASSERT_EQ(many.size(), 101u);
  for (int i = 900; i < 1000; ++i) EXPECT_EQ(many.get<int>(std::to_string(i * 37 % 100)), i);
  EXPECT_EQ(many.members()[1].first, "37");
}

TEST(JsonAccept, TextNeedsNoZeroAtItsEnd) {
  const std::string text = "[1, 2]3";
  EXPECT_EQ(parseJson({text.data(), 6}), list({1, 2}));
  EXPECT_EQ(parseJson({text.data() + 6, 1}), Svar(3));
  EXPECT_EQ(parseJson({text.data() + 1, 1}), Svar(1));
}

TEST(JsonAccept, MembersKeepTheirOrderAndAreFound) {
  std::string text = "{";
  for (int i = 0; i < 500; ++i) {
    text += (i == 0 ? "\"n" : ",\"n") + std::to_string(i * 7919 % 500) + "\":" + std::to_string(i);
  }
  Svar value = parseJson(text + "}");
  for (int i = 0; i < 500; ++i) {
    const std::string name = "n" + std::to_string(i * 7919 % 500);
    EXPECT_EQ(value.get<int>(name), i);
    EXPECT_EQ(value.members()[static_cast<std::size_t>(i)].first, name);
  }
  value.set("new", 1);
  EXPECT_TRUE(value.erase("n7"));
  EXPECT_EQ(value.get<int>("n8"), parseJson(text + "}").get<int>("n8"));
  EXPECT_EQ(value.size(), 500u);
}

// Below and above the size from which objects keep an index.
TEST(JsonAccept, ObjectsOfAllSizesCanBeChanged) {
  for (int size = 0; size < 20; ++size) {
    Svar expected = Svar::object();
    for (int i = 0; i < size; ++i) expected.set("n" + std::to_string(i * 7 % 20), i);
    Svar value = parseJson(gslam::printJson(expected));
    EXPECT_EQ(value, expected);
    value.set("m", 1);
    EXPECT_NE(value, expected);
    EXPECT_TRUE(value.erase("m"));
    EXPECT_EQ(value, expected);
    for (int i = size; i-- > 0;) {
      EXPECT_EQ(value.get<int>("n" + std::to_string(i * 7 % 20)), i);
      EXPECT_TRUE(value.erase("n" + std::to_string(i * 7 % 20)));
    }
    EXPECT_EQ(value, Svar::object());
  }
}

}  // namespace
