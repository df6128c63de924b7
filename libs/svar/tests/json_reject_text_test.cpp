// Numbers and strings that must be refused, and what the error says: line, column, what was
// expected and found.
#include <gslam/svar.h>
#include <gtest/gtest.h>

#include <string>

#include "bytes.h"
#include "json_reject.h"

namespace {

using json_reject::Case;
using json_reject::check;

TEST(JsonRejectText, Numbers) {
  const Case cases[] = {
      {"plus", bytes("+1"), "1:1: expected a value, found \"+1\""},
      {"plus_plus", bytes("[++1]"), "1:2: expected a value or ']', found \"++1\""},
      {"minus_alone", bytes("-"), "1:2: expected a digit, found the end of the text"},
      {"minus_minus", bytes("[--1]"), "1:3: expected a digit, found \"-1\""},
      {"minus_space", bytes("[- 1]"), "1:3: expected a digit, found ' '"},
      {"minus_word", bytes("[-foo]"), "1:3: expected a digit, found \"foo\""},
      {"leading_zero", bytes("[01]"),
       "1:3: expected ',' or ']', found '1' (no number begins with a 0 and a digit)"},
      {"two_zeros", bytes("00"),
       "1:2: expected the end of the text, found '0' (no number begins with a 0 and a digit)"},
      {"minus_leading_zero", bytes("[-01]"),
       "1:4: expected ',' or ']', found '1' (no number begins with a 0 and a digit)"},
      {"leading_zero_fraction", bytes("012.5"),
       "1:2: expected the end of the text, found '1' (no number begins with a 0 and a digit)"},
      {"point_first", bytes("[.5]"), "1:2: expected a value or ']', found \".5\""},
      {"minus_point", bytes("[-.5]"), "1:3: expected a digit, found \".5\""},
      {"point_last", bytes("[1.]"), "1:4: expected a digit, found ']'"},
      {"point_last_at_end", bytes("1."), "1:3: expected a digit, found the end of the text"},
      {"point_then_exponent", bytes("[1.e5]"), "1:4: expected a digit, found \"e5\""},
      {"two_points", bytes("[1.2.3]"), "1:5: expected ',' or ']', found \".3\""},
      {"exponent_alone", bytes("[1e]"), "1:4: expected a digit, found ']'"},
      {"exponent_alone_at_end", bytes("1e"), "1:3: expected a digit, found the end of the text"},
      {"exponent_plus_alone", bytes("[1e+]"), "1:5: expected a digit, found ']'"},
      {"exponent_minus_alone", bytes("[1E-]"), "1:5: expected a digit, found ']'"},
      {"exponent_with_fraction", bytes("[1e2.5]"), "1:5: expected ',' or ']', found \".5\""},
      {"exponent_twice", bytes("[1e2e3]"), "1:5: expected ',' or ']', found \"e3\""},
      {"exponent_first", bytes("[e5]"), "1:2: expected a value or ']', found \"e5\""},
      {"zero_exponent_alone", bytes("[0e]"), "1:4: expected a digit, found ']'"},
      {"hexadecimal", bytes("[0x1F]"), "1:3: expected ',' or ']', found \"x1F\""},
      {"octal", bytes("[0o17]"), "1:3: expected ',' or ']', found \"o17\""},
      {"underscore", bytes("[1_000]"), "1:3: expected ',' or ']', found \"_000\""},
      {"thousands", bytes("[1'000]"), "1:3: expected ',' or ']', found '''"},
      {"decimal_comma", bytes("{\"a\": 0,5}"), "1:9: expected a name in quotes, found \"5\""},
      {"unit", bytes("[30fps]"), "1:4: expected ',' or ']', found \"fps\""},
      {"float_suffix", bytes("[1.5f]"), "1:5: expected ',' or ']', found \"f\""},
      {"minus_between", bytes("[1-2]"), "1:3: expected ',' or ']', found \"-2\""},
      {"expression", bytes("[1+2]"), "1:3: expected ',' or ']', found \"+2\""},
      {"full_width_digit", bytes("[\xEF\xBC\x91]"),
       "1:2: expected a value or ']', found byte 0xEF"},
      {"letter_in_number", bytes("[1a2]"), "1:3: expected ',' or ']', found \"a2\""},
      {"fraction_letter", bytes("[1.a]"), "1:4: expected a digit, found \"a\""},
  };
  check(cases);
}

TEST(JsonRejectText, Ranges) {
  const Case cases[] = {
      {"too_large", bytes("1e400"), "1:1: expected a number that a double can hold, found 1e400"},
      {"too_large_negative", bytes("[-1e400]"),
       "1:2: expected a number that a double can hold, found -1e400"},
      {"too_large_by_digits", bytes("1.8e308"),
       "1:1: expected a number that a double can hold, found 1.8e308"},
      {"too_large_just", bytes("1.7976931348623159e308"),
       "1:1: expected a number that a double can hold, found 1.7976931348623159e308"},
      {"too_large_exponent", bytes("1e99999999999999999999"),
       "1:1: expected a number that a double can hold, found 1e99999999999999999999"},
      {"int64_max_and_one_and_one", bytes("9223372036854775809"),
       "1:1: expected an integer that int64 or double can hold exactly, found 9223372036854775809"},
      {"int64_min_less_one", bytes("[-9223372036854775809]"),
       "1:2: expected an integer that int64 or double can hold exactly, found "
       "-9223372036854775809"},
      {"uint64_max", bytes("18446744073709551615"),
       "1:1: expected an integer that int64 or double can hold exactly, found "
       "18446744073709551615"},
      {"ten_to_23", bytes("100000000000000000000000"),
       "1:1: expected an integer that int64 or double can hold exactly, found "
       "100000000000000000000000"},
      {"twenty_digits", bytes("[12345678901234567890]"),
       "1:2: expected an integer that int64 or double can hold exactly, found "
       "12345678901234567890"},
  };
  check(cases);
}

TEST(JsonRejectText, Strings) {
  const Case cases[] = {
      {"string_without_end", bytes("\"abc"),
       "1:1: expected '\"' at the end of this string, found the end of the text"},
      {"quote_alone", bytes("\""),
       "1:1: expected '\"' at the end of this string, found the end of the text"},
      {"string_without_end_in_array", bytes("[1, \"a]"),
       "1:5: expected '\"' at the end of this string, found the end of the text"},
      {"string_over_two_lines", bytes("\"a\nb\""),
       "1:3: expected an escape such as \\n or \\u0000, found a control character, byte 0x0A"},
      {"tab_in_string", bytes("\"a\tb\""),
       "1:3: expected an escape such as \\n or \\u0000, found a control character, byte 0x09"},
      {"zero_byte_in_string", bytes("\"a\0b\""),
       "1:3: expected an escape such as \\n or \\u0000, found a control character, byte 0x00"},
      {"last_control_in_string", bytes("\"\x1F\""),
       "1:2: expected an escape such as \\n or \\u0000, found a control character, byte 0x1F"},
      {"control_after_eight_bytes", bytes("\"12345678\x01\""),
       "1:10: expected an escape such as \\n or \\u0000, found a control character, byte 0x01"},
      {"escape_alone", bytes("\"\\\""),
       "1:1: expected '\"' at the end of this string, found the end of the text"},
      {"escape_at_end", bytes("\"\\"),
       "1:3: expected one of \" \\ / b f n r t u after a backslash, found the end of the text"},
      {"escape_x", bytes("\"\\x41\""),
       "1:3: expected one of \" \\ / b f n r t u after a backslash, found \"x41\""},
      {"escape_a", bytes("\"\\a\""),
       "1:3: expected one of \" \\ / b f n r t u after a backslash, found \"a\""},
      {"escape_v", bytes("\"\\v\""),
       "1:3: expected one of \" \\ / b f n r t u after a backslash, found \"v\""},
      {"escape_zero", bytes("\"\\0\""),
       "1:3: expected one of \" \\ / b f n r t u after a backslash, found \"0\""},
      {"escape_single_quote", bytes("\"\\'\""),
       "1:3: expected one of \" \\ / b f n r t u after a backslash, found '''"},
      {"escape_line_end", bytes("\"\\\n\""),
       "1:3: expected one of \" \\ / b f n r t u after a backslash, found byte 0x0A"},
      {"escape_capital_n", bytes("\"\\N\""),
       "1:3: expected one of \" \\ / b f n r t u after a backslash, found \"N\""},
      {"escape_capital_u", bytes("\"\\U0041\""),
       "1:3: expected one of \" \\ / b f n r t u after a backslash, found \"U0041\""},
      {"escape_emoji", bytes("\"\\\xF0\x9F\x98\x80\""),
       "1:3: expected one of \" \\ / b f n r t u after a backslash, found byte 0xF0"},
      {"escape_zero_byte", bytes("\"\\\0\""),
       "1:3: expected one of \" \\ / b f n r t u after a backslash, found byte 0x00"},
      {"u_alone", bytes("\"\\u\""), "1:2: expected four hexadecimal digits after \\u"},
      {"u_at_end", bytes("\"\\u"), "1:2: expected four hexadecimal digits after \\u"},
      {"u_one_digit", bytes("\"\\u1\""), "1:2: expected four hexadecimal digits after \\u"},
      {"u_three_digits", bytes("\"\\u123\""), "1:2: expected four hexadecimal digits after \\u"},
      {"u_three_digits_at_end", bytes("\"\\u123"),
       "1:2: expected four hexadecimal digits after \\u"},
      {"u_no_digit", bytes("\"\\u00g0\""), "1:2: expected four hexadecimal digits after \\u"},
      {"u_sign", bytes("\"\\u+123\""), "1:2: expected four hexadecimal digits after \\u"},
      {"u_space", bytes("\"\\u 123\""), "1:2: expected four hexadecimal digits after \\u"},
      {"u_braces", bytes("\"\\u{41}\""), "1:2: expected four hexadecimal digits after \\u"},
      {"high_surrogate_alone", bytes("\"\\ud800\""),
       "1:2: expected a second half, \\uDC00 to \\uDFFF, after the first half of a surrogate pair, "
       "\\ud800"},
      {"high_surrogate_then_text", bytes("\"\\uD83Dabc\""),
       "1:2: expected a second half, \\uDC00 to \\uDFFF, after the first half of a surrogate pair, "
       "\\uD83D"},
      {"high_surrogate_then_escape", bytes("\"\\uD83D\\n\""),
       "1:2: expected a second half, \\uDC00 to \\uDFFF, after the first half of a surrogate pair, "
       "\\uD83D"},
      {"high_surrogate_then_character", bytes("\"\\uD83D\\u0041\""),
       "1:2: expected a second half, \\uDC00 to \\uDFFF, after the first half of a surrogate pair, "
       "\\uD83D"},
      {"high_surrogate_twice", bytes("\"\\uD83D\\uD83D\""),
       "1:2: expected a second half, \\uDC00 to \\uDFFF, after the first half of a surrogate pair, "
       "\\uD83D"},
      {"high_surrogate_then_half", bytes("\"\\uD83D\\uDE\""),
       "1:8: expected four hexadecimal digits after \\u"},
      {"high_surrogate_at_end", bytes("\"\\uD83D"),
       "1:2: expected a second half, \\uDC00 to \\uDFFF, after the first half of a surrogate pair, "
       "\\uD83D"},
      {"low_surrogate_alone", bytes("\"\\udc00\""),
       "1:2: expected a character, found the second half of a surrogate pair, \\udc00"},
      {"surrogates_in_wrong_order", bytes("\"\\uDE00\\uD83D\""),
       "1:2: expected a character, found the second half of a surrogate pair, \\uDE00"},
      {"surrogate_in_name", bytes("{\"\\uD83D\":1}"),
       "1:3: expected a second half, \\uDC00 to \\uDFFF, after the first half of a surrogate pair, "
       "\\uD83D"},
  };
  check(cases);
}

TEST(JsonRejectText, Utf8) {
  const Case cases[] = {
      {"continuation_alone", bytes("\"\x80\""), "1:2: expected UTF-8, found byte 0x80"},
      {"lead_alone", bytes("\"\xC3\""), "1:2: expected UTF-8, found byte 0xC3"},
      {"lead_then_ascii", bytes("\"\xC3z\""), "1:2: expected UTF-8, found byte 0xC3"},
      {"lead_of_three_then_one", bytes("\"\xE2\x82\""),
       "1:2: expected UTF-8, found byte 0xE2 0x82"},
      {"lead_of_four_then_two", bytes("\"\xF0\x9F\x98\""),
       "1:2: expected UTF-8, found byte 0xF0 0x9F 0x98"},
      {"lead_at_end", bytes("\"\xE2\x82"), "1:2: expected UTF-8, found byte 0xE2 0x82"},
      {"overlong_slash", bytes("\"\xC0\xAF\""), "1:2: expected UTF-8, found byte 0xC0 0xAF"},
      {"overlong_zero", bytes("\"\xC0\x80\""), "1:2: expected UTF-8, found byte 0xC0 0x80"},
      {"overlong_c1", bytes("\"\xC1\xBF\""), "1:2: expected UTF-8, found byte 0xC1 0xBF"},
      {"overlong_three_bytes", bytes("\"\xE0\x9F\xBF\""),
       "1:2: expected UTF-8, found byte 0xE0 0x9F 0xBF"},
      {"overlong_four_bytes", bytes("\"\xF0\x8F\xBF\xBF\""),
       "1:2: expected UTF-8, found byte 0xF0 0x8F 0xBF 0xBF"},
      {"surrogate_in_utf8", bytes("\"\xED\xA0\x80\""),
       "1:2: expected UTF-8, found byte 0xED 0xA0 0x80"},
      {"surrogate_pair_in_utf8", bytes("\"\xED\xA0\xBD\xED\xB8\x80\""),
       "1:2: expected UTF-8, found byte 0xED 0xA0 0xBD"},
      {"beyond_the_last", bytes("\"\xF4\x90\x80\x80\""),
       "1:2: expected UTF-8, found byte 0xF4 0x90 0x80 0x80"},
      {"lead_f5", bytes("\"\xF5\x80\x80\x80\""),
       "1:2: expected UTF-8, found byte 0xF5 0x80 0x80 0x80"},
      {"five_bytes", bytes("\"\xF8\x88\x80\x80\x80\""),
       "1:2: expected UTF-8, found byte 0xF8 0x88 0x80 0x80"},
      {"byte_fe", bytes("\"\xFE\""), "1:2: expected UTF-8, found byte 0xFE"},
      {"byte_ff", bytes("\"\xFF\""), "1:2: expected UTF-8, found byte 0xFF"},
      {"latin1",
       bytes("[\"Gr\xF6\xDF"
             "e\"]"),
       "1:5: expected UTF-8, found byte 0xF6"},
      {"utf8_in_name", bytes("{\"\xFF\":1}"), "1:3: expected UTF-8, found byte 0xFF"},
      {"second_of_two_characters", bytes("\"\xC3\xA9\xC3\""),
       "1:4: expected UTF-8, found byte 0xC3"},
      {"bad_utf8_on_line_three", bytes("[\n\"a\",\n  \"\xE9\"]"),
       "3:4: expected UTF-8, found byte 0xE9"},
  };
  check(cases);
}

}  // namespace
