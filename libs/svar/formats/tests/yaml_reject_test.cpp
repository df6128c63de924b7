// YAML that must be refused, and where the error is said to be.
#include <gslam/svar_formats.h>
#include <gtest/gtest.h>

#include <string>

#include "parse_error.h"

namespace {

using parse_error::bytes;
using parse_error::Case;
using parse_error::yamlError;

TEST(YamlReject, Structure) {
  const std::string prefix = "cannot be read as YAML: ";
  const Case cases[] = {
      {"bad_indent", "a:\n  - b\n c: 1\n", "3:2: " + prefix + "end of map not found"},
      {"two_colons", "a: b: c", "1:5: " + prefix + "illegal map value"},
      {"lone_end", "]", "1:1: " + prefix + "illegal flow end"},
      {"wrong_end", "a: [1, 2}", "1:9: " + prefix + "illegal flow end"},
      {"no_end_of_array", "a: [1, 2\nb: 3\n", "2:2: " + prefix + "end of sequence flow not found"},
      {"no_end_of_root", "[1, {a: 2}",
       "1:1: expected ']' at the end of an array, found the end of the text"},
      {"no_end_of_root_object", "{a: 1",
       "1:1: expected '}' at the end of an object, found the end of the text"},
      {"no_end_of_quotes", "a: \"b", "1:6: " + prefix + "illegal EOF in scalar"},
      {"unknown_escape", "a: \"\\q\"", "1:7: " + prefix + "unknown escape character: q"},
      {"half_a_surrogate_pair", "\"\\ud800\"", "1:8: " + prefix + "invalid unicode: 55296"},
      {"at_sign", "a: @b", "1:4: " + prefix + "unknown token"},
      {"two_anchors", "&a &b c",
       "1:4: " + prefix + "cannot assign multiple anchors to the same node"},
      {"two_tags", "!a !b c", "1:4: " + prefix + "cannot assign multiple tags to the same node"},
      {"future_version", "%YAML 2.0\n---\na", "1:1: " + prefix + "YAML major version too large"},
      {"no_value_between_commas", "[1,,2]", "1:4: expected a value, found ','"},
      {"no_value_first", "[ , 1]", "1:3: expected a value, found ','"},
      {"no_member_first", "{, a: 1}", "1:2: expected a value, found ','"},
      {"lone_comma", ", a", "1:1: expected a value, found ','"},
      {"comma_as_document", "--- ,\n", "1:5: expected a value, found ','"},
      {"text_after_array", "[1] 2",
       "1:5: expected the end of the document, found something after its value"},
      {"text_after_quotes", "\"a\"\n\"b\"",
       "2:1: expected the end of the document, found something after its value"},
      {"object_after_text", "- a\nb: c\n",
       "2:1: expected the end of the document, found something after its value"},
  };
  for (const Case& one : cases) {
    SCOPED_TRACE(one.name);
    EXPECT_EQ(yamlError(one.text), one.error);
  }
}

TEST(YamlReject, Names) {
  const Case cases[] = {
      {"array", "? [a]\n: b", "1:3: expected a scalar as a name, found an array"},
      {"object", "{a: 1}: b", "1:1: expected a scalar as a name, found an object"},
      {"object_in_array", "- ? {a: 1}\n  : b", "1:5: expected a scalar as a name, found an object"},
      {"alias_of_array", "- &x []\n- *x : b",
       "2:3: expected a scalar as a name, found an alias of more"},
  };
  for (const Case& one : cases) {
    SCOPED_TRACE(one.name);
    EXPECT_EQ(yamlError(one.text), one.error);
  }
}

TEST(YamlReject, Aliases) {
  const std::string around =
      "expected an alias of a finished value, found one of a value around it";
  const Case cases[] = {
      {"unknown", "a: *x", "1:4: cannot be read as YAML: the referenced anchor is not defined"},
      {"later", "- *x\n- &x 1",
       "1:3: cannot be read as YAML: the referenced anchor is not defined"},
      {"around_array", "&x [1, *x]", "1:8: " + around},
      {"around_object", "&x {a: {b: *x}}", "1:12: " + around},
      {"around_merge", "&x {<<: *x}", "1:9: " + around},
      {"as_name", "&x {*x : 1}", "1:5: " + around},
  };
  for (const Case& one : cases) {
    SCOPED_TRACE(one.name);
    EXPECT_EQ(yamlError(one.text), one.error);
  }
}

TEST(YamlReject, Characters) {
  const Case cases[] = {
      {"bad_utf8", "a: 1\nb: x\xFF", "2:5: expected UTF-8, found byte 0xFF"},
      {"overlong", "\xC0\x80", "1:1: expected UTF-8, found byte 0xC0"},
      {"surrogate", "a\xED\xA0\x80", "1:2: expected UTF-8, found byte 0xED"},
      {"cut", "# \xE2\x82", "1:3: expected UTF-8, found byte 0xE2"},
      {"utf16",
       bytes("\xFF\xFE"
             "a\0"),
       "1:1: expected UTF-8, found byte 0xFF"},
      {"utf16_without_mark", bytes("a\0b\0"),
       "1:2: expected no control character, found byte 0x00"},
      {"zero", bytes("a: b\0c"), "1:5: expected no control character, found byte 0x00"},
      {"end_of_yaml_cpp", "a: 1\n\x04\nb: 2",
       "2:1: expected no control character, found byte 0x04"},
      {"escape", "a: '\x1B'", "1:5: expected no control character, found byte 0x1B"},
      {"no_character", "\xEF\xBF\xBF", "1:1: expected characters, found U+FFFF, which is none"},
      {"no_character_either", "\xEF\xBF\xBE",
       "1:1: expected characters, found U+FFFE, which is none"},
  };
  for (const Case& one : cases) {
    SCOPED_TRACE(one.name);
    EXPECT_EQ(yamlError(one.text), one.error);
  }
}

TEST(YamlReject, NamesTheSource) {
  EXPECT_EQ(parse_error::errorOf([] { gslam::parseYaml("a: [", "camera.yaml"); }).substr(0, 5),
            "1:5: ");
  try {
    gslam::parseYaml("a: b: c", "camera.yaml");
    FAIL();
  } catch (const gslam::ParseError& error) {
    EXPECT_STREQ(error.what(), "camera.yaml:1:5: cannot be read as YAML: illegal map value");
  }
}

}  // namespace
