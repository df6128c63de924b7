// JSON that must be refused, and what the error says: line, column, what was expected and found.
#include "json_reject.h"

#include <gslam/svar.h>
#include <gtest/gtest.h>

#include <string>

#include "bytes.h"

namespace {

using json_reject::Case;
using json_reject::check;
using json_reject::errorOf;

gslam::JsonOptions withComments() {
  gslam::JsonOptions options;
  options.comments = true;
  return options;
}

TEST(JsonReject, Structure) {
  const Case cases[] = {
      {"empty_text", bytes(""), "1:1: the text is empty, expected a value"},
      {"only_space", bytes(" \n\t"), "2:2: expected a value, found the end of the text"},
      {"only_byte_order_mark", bytes("\xEF\xBB\xBF"), "1:1: the text is empty, expected a value"},
      {"two_byte_order_marks", bytes("\xEF\xBB\xBF\xEF\xBB\xBF[]"),
       "1:1: expected a value, found byte 0xEF"},
      {"half_a_byte_order_mark", bytes("\xEF\xBB[]"), "1:1: expected a value, found byte 0xEF"},
      {"utf16_byte_order_mark", bytes("\xFF\xFE[\0]\0"), "1:1: expected a value, found byte 0xFF"},
      {"utf16_without_mark", bytes("[\0]\0"), "1:2: expected a value or ']', found byte 0x00"},
      {"two_values", bytes("1 2"), "1:3: expected the end of the text, found \"2\""},
      {"two_arrays", bytes("[][]"), "1:3: expected the end of the text, found '['"},
      {"text_after_object", bytes("{\"a\":1} x"), "1:9: expected the end of the text, found \"x\""},
      {"text_after_string", bytes("\"a\"b"), "1:4: expected the end of the text, found \"b\""},
      {"comma_after_value", bytes("1,"), "1:2: expected the end of the text, found ','"},
      {"bracket_too_many", bytes("[1]]"), "1:4: expected the end of the text, found ']'"},
      {"brace_too_many", bytes("{}}"), "1:3: expected the end of the text, found '}'"},
      {"zero_byte_after_value", bytes("1\0"), "1:2: expected the end of the text, found byte 0x00"},
      {"zero_byte_alone", bytes("\0"), "1:1: expected a value, found byte 0x00"},
      {"form_feed", bytes("[\f1]"), "1:2: expected a value or ']', found byte 0x0C"},
      {"vertical_tab", bytes("[1\v]"), "1:3: expected ',' or ']', found byte 0x0B"},
      {"no_break_space", bytes("[\xC2\xA0]"), "1:2: expected a value or ']', found byte 0xC2"},
      {"word_joiner", bytes("\xE2\x81\xA0[]"), "1:1: expected a value, found byte 0xE2"},
      {"unicode_word", bytes("\xE2\x88\x9E"), "1:1: expected a value, found byte 0xE2"},
      {"asterisk", bytes("*"), "1:1: expected a value, found '*'"},
      {"angle", bytes("<null>"), "1:1: expected a value, found '<'"},
      {"colon", bytes(":"), "1:1: expected a value, found ':'"},
      {"comma", bytes(","), "1:1: expected a value, found ','"},
      {"single_quote", bytes("'a'"), "1:1: expected a value, found '''"},
      {"backslash", bytes("[\\n]"), "1:2: expected a value or ']', found '\\'"},
      {"semicolon", bytes("[1;2]"), "1:3: expected ',' or ']', found ';'"},
      {"equals", bytes("{\"a\"=1}"), "1:5: expected ':' after the name, found '='"},
  };
  check(cases);
}

TEST(JsonReject, Arrays) {
  const Case cases[] = {
      {"array_without_end", bytes("["), "1:2: expected a value or ']', found the end of the text"},
      {"array_without_end_after_value", bytes("[1"),
       "1:3: expected ',' or ']', found the end of the text; the array begins at line 1, column 1"},
      {"array_without_end_after_comma", bytes("[1,"),
       "1:4: expected a value, found the end of the text"},
      {"array_without_end_in_lines", bytes("{\n  \"a\": [\n    1,\n    2\n"),
       "5:1: expected ',' or ']', found the end of the text; the array begins at line 2, column 8"},
      {"array_with_comma_at_end", bytes("[1,]"), "1:4: expected a value, found ']'"},
      {"array_with_comma_at_end_and_space", bytes("[1, ]"), "1:5: expected a value, found ']'"},
      {"array_with_two_commas", bytes("[1,,2]"), "1:4: expected a value, found ','"},
      {"array_with_comma_first", bytes("[,1]"), "1:2: expected a value or ']', found ','"},
      {"array_of_comma", bytes("[,]"), "1:2: expected a value or ']', found ','"},
      {"array_without_comma", bytes("[1 2]"), "1:4: expected ',' or ']', found \"2\""},
      {"array_without_comma_after_string", bytes("[\"a\" \"b\"]"),
       "1:6: expected ',' or ']', found '\"'"},
      {"array_without_comma_before_array", bytes("[3[4]]"), "1:3: expected ',' or ']', found '['"},
      {"array_with_colon", bytes("[1:2]"), "1:3: expected ',' or ']', found ':'"},
      {"array_with_member", bytes("[\"a\":1]"), "1:5: expected ',' or ']', found ':'"},
      {"array_ended_by_brace", bytes("[1}"), "1:3: expected ',' or ']', found '}'"},
      {"array_in_array_without_end", bytes("[[1]"),
       "1:5: expected ',' or ']', found the end of the text; the array begins at line 1, column 1"},
      {"array_after_comma_of_nested", bytes("[[],"),
       "1:5: expected a value, found the end of the text"},
      {"end_of_array_alone", bytes("]"), "1:1: expected a value, found ']'"},
      {"ellipsis", bytes("[1,...]"), "1:4: expected a value, found \"...\""},
  };
  check(cases);
}

TEST(JsonReject, Objects) {
  const Case cases[] = {
      {"object_without_end", bytes("{"),
       "1:2: expected a name in quotes or '}', found the end of the text"},
      {"object_without_end_after_name", bytes("{\"a\""),
       "1:5: expected ':' after the name, found the end of the text"},
      {"object_without_end_after_colon", bytes("{\"a\":"),
       "1:6: expected a value, found the end of the text"},
      {"object_without_end_after_value", bytes("{\"a\":1"),
       "1:7: expected ',' or '}', found the end of the text; the object begins at line 1, column "
       "1"},
      {"object_without_end_after_comma", bytes("{\"a\":1,"),
       "1:8: expected a name in quotes, found the end of the text"},
      {"object_with_comma_at_end", bytes("{\"a\":1,}"),
       "1:8: expected a name in quotes, found '}'"},
      {"object_with_two_commas", bytes("{\"a\":1,,\"b\":2}"),
       "1:8: expected a name in quotes, found ','"},
      {"object_with_comma_first", bytes("{,\"a\":1}"),
       "1:2: expected a name in quotes or '}', found ','"},
      {"object_without_comma", bytes("{\"a\":1 \"b\":2}"), "1:8: expected ',' or '}', found '\"'"},
      {"object_without_colon", bytes("{\"a\" 1}"), "1:6: expected ':' after the name, found \"1\""},
      {"object_with_two_colons", bytes("{\"a\"::1}"), "1:6: expected a value, found ':'"},
      {"object_with_comma_for_colon", bytes("{\"a\",1}"),
       "1:5: expected ':' after the name, found ','"},
      {"object_without_value", bytes("{\"a\":}"), "1:6: expected a value, found '}'"},
      {"object_without_value_before_comma", bytes("{\"a\":,\"b\":2}"),
       "1:6: expected a value, found ','"},
      {"object_without_name", bytes("{:1}"), "1:2: expected a name in quotes or '}', found ':'"},
      {"object_with_value_only", bytes("{\"a\"}"), "1:5: expected ':' after the name, found '}'"},
      {"object_with_number_as_name", bytes("{1:2}"),
       "1:2: expected a name in quotes or '}', found \"1\""},
      {"object_with_word_as_name", bytes("{a:1}"),
       "1:2: expected a name in quotes or '}', found \"a\""},
      {"object_with_null_as_name", bytes("{null:1}"),
       "1:2: expected a name in quotes or '}', found \"null\""},
      {"object_with_single_quotes", bytes("{'a':1}"),
       "1:2: expected a name in quotes or '}', found '''"},
      {"object_with_array_as_name", bytes("{[]:1}"),
       "1:2: expected a name in quotes or '}', found '['"},
      {"object_ended_by_bracket", bytes("{\"a\":1]"), "1:7: expected ',' or '}', found ']'"},
      {"object_with_name_without_end", bytes("{\"a:1}"),
       "1:2: expected '\"' at the end of this string, found the end of the text"},
      {"object_in_object_without_end", bytes("{\"a\":{}"),
       "1:8: expected ',' or '}', found the end of the text; the object begins at line 1, column "
       "1"},
      {"end_of_object_alone", bytes("}"), "1:1: expected a value, found '}'"},
      {"name_twice", bytes("{\"a\": 1, \"b\": 2, \"a\": 3}"),
       "1:18: expected each name once, found \"a\" also at line 1, column 2"},
      {"name_twice_in_lines", bytes("{\n  \"fps\": 30,\n  \"x\": [],\n  \"fps\": 30\n}"),
       "4:3: expected each name once, found \"fps\" also at line 2, column 3"},
      {"name_twice_with_escape", bytes("{\"a\":1,\"\\u0061\":1}"),
       "1:8: expected each name once, found \"\\u0061\" also at line 1, column 2"},
      {"name_twice_empty", bytes("{\"\":1,\"\":1}"),
       "1:7: expected each name once, found \"\" also at line 1, column 2"},
      {"name_thrice", bytes("{\"b\":1,\"c\":1,\"c\":2,\"b\":2,\"b\":3}"),
       "1:14: expected each name once, found \"c\" also at line 1, column 8"},
      {"name_twice_inside", bytes("[{\"x\":{\"a\":1,\"a\":1}}]"),
       "1:14: expected each name once, found \"a\" also at line 1, column 8"},
      {"name_twice_among_many",
       bytes("{\"a\":1,\"b\":2,\"c\":3,\"d\":4,\"e\":5,\"f\":6,\"g\":7,\"h\":8,\"i\":9,\"c\":10,"
             "\"a\":11}"),
       "1:56: expected each name once, found \"c\" also at line 1, column 14"},
  };
  check(cases);
}

TEST(JsonReject, Words) {
  const Case cases[] = {
      {"nul", bytes("nul"), "1:1: expected a value, found \"nul\""},
      {"nul_in_array", bytes("[nul]"), "1:2: expected a value or ']', found \"nul\""},
      {"tru", bytes("tru"), "1:1: expected a value, found \"tru\""},
      {"fals", bytes("[fals]"), "1:2: expected a value or ']', found \"fals\""},
      {"nulll", bytes("nulll"), "1:1: expected a value, found \"nulll\""},
      {"truefalse", bytes("[truefalse]"), "1:2: expected a value or ']', found \"truefalse\""},
      {"capital_true", bytes("True"), "1:1: expected a value, found \"True\""},
      {"capital_null", bytes("NULL"), "1:1: expected a value, found \"NULL\""},
      {"none", bytes("[None]"), "1:2: expected a value or ']', found \"None\""},
      {"undefined", bytes("undefined"), "1:1: expected a value, found \"undefined\""},
      {"word_and_digit", bytes("true1"), "1:1: expected a value, found \"true1\""},
      {"null_and_underscore", bytes("null_"), "1:1: expected a value, found \"null_\""},
      {"word_longer_than_twenty", bytes("abcdefghijklmnopqrstuvwxyz"),
       "1:1: expected a value, found \"abcdefghijklmnopqrst\""},
      {"nan", bytes("NaN"), "1:1: expected a value, found \"NaN\""},
      {"nan_in_array", bytes("[nan]"), "1:2: expected a value or ']', found \"nan\""},
      {"infinity", bytes("[Infinity]"), "1:2: expected a value or ']', found \"Infinity\""},
      {"minus_infinity", bytes("[-Infinity]"), "1:3: expected a digit, found \"Infinity\""},
      {"inf", bytes("inf"), "1:1: expected a value, found \"inf\""},
  };
  check(cases);
}

TEST(JsonReject, Comments) {
  const Case cases[] = {
      {"line_comment", bytes("[1] // a"),
       "1:5: expected the end of the text, found '/' (comments are accepted on request only)"},
      {"block_comment", bytes("/* a */ [1]"),
       "1:1: expected a value, found '/' (comments are accepted on request only)"},
      {"comment_in_array", bytes("[1, /* 2 */ 3]"),
       "1:5: expected a value, found '/' (comments are accepted on request only)"},
      {"hash_comment", bytes("# a\n1"), "1:1: expected a value, found '#'"},
  };
  check(cases);
}

TEST(JsonReject, CommentsThatAreWrong) {
  const Case cases[] = {
      {"slash_alone", bytes("/"), "1:2: expected \"//\" or \"/*\", found the end of the text"},
      {"slash_in_array", bytes("[1, / 2]"), "1:6: expected \"//\" or \"/*\", found ' '"},
      {"block_without_end", bytes("1 /* a"),
       "1:3: expected \"*/\" at the end of this comment, found the end of the text"},
      {"block_ended_by_half", bytes("1 /* a *"),
       "1:3: expected \"*/\" at the end of this comment, found the end of the text"},
      {"block_of_three_characters", bytes("/*/ 1"),
       "1:1: expected \"*/\" at the end of this comment, found the end of the text"},
      {"block_inside_block", bytes("/* /* */ */ 1"), "1:10: expected a value, found '*'"},
      {"only_comment", bytes("// a"), "1:5: expected a value, found the end of the text"},
      {"only_comment_and_line_end", bytes("// a\n"),
       "2:1: expected a value, found the end of the text"},
      {"hash_still_is_none", bytes("# a\n1"), "1:1: expected a value, found '#'"},
      {"comment_inside_number", bytes("[1/**/2]"), "1:7: expected ',' or ']', found \"2\""},
      {"comment_inside_word", bytes("nu/**/ll"), "1:1: expected a value, found \"nu\""},
      {"error_after_comment", bytes("/* a\n b */ // c\n  x"), "3:3: expected a value, found \"x\""},
  };
  check(cases, withComments());
}

TEST(JsonReject, NamesTheSource) {
  try {
    gslam::parseJson("[1,\n 2,\n}", "camera.json");
    FAIL();
  } catch (const gslam::ParseError& error) {
    EXPECT_STREQ(error.what(), "camera.json:3:1: expected a value, found '}'");
    EXPECT_EQ(error.source(), "camera.json");
    EXPECT_EQ(error.line(), 3u);
    EXPECT_EQ(error.column(), 1u);
  }
}

TEST(JsonReject, ColumnsCountBytesFromTheMarkOn) {
  EXPECT_EQ(errorOf("\xEF\xBB\xBF[x]", gslam::JsonOptions()),
            "1:2: expected a value or ']', found \"x\"");
  EXPECT_EQ(errorOf("[\"\xC3\xA9\", x]", gslam::JsonOptions()),
            "1:8: expected a value, found \"x\"");
}

TEST(JsonReject, LongNamesAreCutInMessages) {
  const std::string name = std::string(39, 'x') + "\xC3\xA9 and more";
  EXPECT_EQ(errorOf("{\"" + name + "\":1,\"" + name + "\":2}", gslam::JsonOptions()),
            "1:57: expected each name once, found \"" + std::string(39, 'x') +
                "\" also at line 1, column 2");
}

}  // namespace
