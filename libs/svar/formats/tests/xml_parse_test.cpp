// XML by its convention, and XML that must be refused.
#include <gslam/svar_formats.h>
#include <gtest/gtest.h>

#include <string>

#include "parse_error.h"

namespace {

using gslam::parseJson;
using gslam::parseXml;
using gslam::Svar;
using parse_error::bytes;
using parse_error::xmlError;

struct XmlAsJson {
  const char* name;
  const char* xml;
  const char* json;
};

TEST(XmlParse, Convention) {
  const XmlAsJson cases[] = {
      {"int", "<fps>30</fps>", "30"},
      {"double", "<a>-1.5e3</a>", "-1500.0"},
      {"bool", "<a>true</a>", "true"},
      {"null", "<a/>", "null"},
      {"null_of_two_tags", "<a></a>", "null"},
      {"null_of_space", "<a> \n </a>", "null"},
      {"null_word", "<a>~</a>", "null"},
      {"text", "<a>left camera</a>", "\"left camera\""},
      {"text_in_space", "<a>\n  left  camera\t</a>", "\"left  camera\""},
      {"octal", "<a>0o17</a>", "15"},
      {"object", "<a><b>1</b><c>x</c></a>", R"({"b": 1, "c": "x"})"},
      {"nested", "<a><b><c><d>1</d></c></b></a>", R"({"b": {"c": {"d": 1}}})"},
      {"repeated", "<a><k>1</k><x/><k>b</k><k/></a>", R"({"k": [1, "b", null], "x": null})"},
      {"repeated_objects", "<a><k><b>1</b></k><k><b>2</b></k></a>",
       R"({"k": [{"b": 1}, {"b": 2}]})"},
      {"attribute", "<a unit=\"m\" n='2'/>", R"({"@unit": "m", "@n": 2})"},
      {"attribute_keeps_its_space", "<a b=' 2 '/>", R"({"@b": " 2 "})"},
      {"attribute_and_text", "<a unit=\"m\"> 5 </a>", R"({"@unit": "m", "#text": 5})"},
      {"attribute_and_element", "<a b=\"1\"><b>2</b></a>", R"({"@b": 1, "b": 2})"},
      {"text_and_element", "<a>some <b>bold</b> text</a>",
       R"({"b": "bold", "#text": "some  text"})"},
      {"cdata", "<a><![CDATA[<b> & ]]></a>", "\"<b> &\""},
      {"cdata_is_text", "<a>1<![CDATA[2]]>3</a>", "123"},
      {"comments", "<!-- a --><a><!-- <b> -->1<!-- & --></a><!-- c -->", "1"},
      {"instructions", "<?xml version=\"1.0\"?><?b & ?><a>1<?c d?></a>", "1"},
      {"doctype", "<!DOCTYPE a [\n<!ELEMENT a (#PCDATA)>\n<!-- it's -->]>\n<a>1</a>", "1"},
      {"references", "<a b=\"&lt;&#65;&#x42;\">&amp;&quot;&apos;&gt;&#x263A;</a>",
       "{\"@b\": \"<AB\", \"#text\": \"&\\\"'>\\u263A\"}"},
      {"line_ends", "<a>b\r\nc\rd</a>", R"("b\nc\nd")"},
      {"names", "<a><x-y.z/><_/><n:m/></a>", R"({"x-y.z": null, "_": null, "n:m": null})"},
      {"namespaces", "<x:a xmlns:x=\"urn:x\"><x:b/></x:a>",
       R"({"@xmlns:x": "urn:x", "x:b": null})"},
      {"greater_in_attribute", "<a b='>'/>", R"({"@b": ">"})"},
      {"quotes_in_quotes", "<a b='\"' c=\"'&apos;\"/>", R"({"@b": "\"", "@c": "''"})"},
      {"text_of_quotes", "<a>it's \"so\"</a>", R"("it's \"so\"")"},
      {"byte_order_mark", "\xEF\xBB\xBF<a>1</a>", "1"},
      {"beyond_ascii", "<n\xC3\xA4>\xC3\xA9</n\xC3\xA4>", "\"\xC3\xA9\""},
  };
  for (const XmlAsJson& one : cases) {
    SCOPED_TRACE(one.name);
    EXPECT_EQ(parseXml(one.xml), parseJson(one.json));
  }
}

TEST(XmlParse, Marks) {
  const auto inside = [](const std::string& text) {
    return parseXml("<s xmlns:svar=\"urn:gslam:svar\">" + text + "</s>");
  };
  EXPECT_EQ(
      inside(
          "<a svar:type=\"string\">12</a><b svar:type=\"string\"> x\n</b><c svar:type='string'/>"),
      parseJson(R"({"a": "12", "b": " x\n", "c": ""})"));
  EXPECT_EQ(inside("<a svar:type=\"binary\">\n aGVs\n bG8= </a><b svar:type='binary'/>"),
            Svar::object({{"a", Svar::binary("hello", 5)}, {"b", Svar::binary("", 0)}}));
  EXPECT_EQ(inside("<a svar:type=\"array\"/><b svar:type=\"array\"><x>1</x><y/></b>"),
            parseJson(R"({"a": [], "b": [1, null]})"));
  EXPECT_EQ(inside("<a svar:type=\"object\"/><b svar:type=\"object\">x</b>"),
            parseJson(R"({"a": {}, "b": {"#text": "x"}})"));
  EXPECT_EQ(
      inside("<item svar:name=\"a b\">1</item><item svar:name=\"\">2</item><i svar:name='a b'/>"),
      parseJson(R"({"a b": [1, null], "": 2})"));
  EXPECT_EQ(parseXml("<s svar:type=\"array\" xmlns:svar=\"urn:gslam:svar\"><item>1</item></s>"),
            Svar::array({1}));
  EXPECT_EQ(parseXml("<s svar:type=\"array\">1</s>"),
            parseJson(R"({"@svar:type": "array", "#text": 1})"))
      << "no mark without the namespace";
  EXPECT_EQ(parseXml("<s xmlns:svar=\"urn:other\" svar:type=\"array\"/>"),
            parseJson(R"({"@xmlns:svar": "urn:other", "@svar:type": "array"})"));
}

TEST(XmlParse, MarksThatAreWrong) {
  const auto error = [](const std::string& text) {
    return xmlError("<s xmlns:svar=\"urn:gslam:svar\">\n" + text + "</s>");
  };
  EXPECT_EQ(
      error("<a svar:type=\"int\"/>"),
      "2:2: expected the mark svar:type=\"string\", \"binary\", \"array\" or \"object\", found "
      "svar:type=\"int\"");
  EXPECT_EQ(
      error("<a svar:x=\"array\"/>"),
      "2:2: expected the mark svar:type=\"string\", \"binary\", \"array\" or \"object\", found "
      "svar:x=\"array\"");
  EXPECT_EQ(error("<a svar:type=\"string\"><b/></a>"),
            "2:2: expected text only in what is marked as a string, found more");
  EXPECT_EQ(error("<a svar:type=\"binary\"><b/></a>"),
            "2:2: expected text only in what is marked as a binary, found more");
  EXPECT_EQ(error("<a svar:type=\"binary\">aGk</a>"), "2:2: expected base64, found \"aGk\"");
  EXPECT_EQ(error("<a svar:type=\"array\">x</a>"),
            "2:2: expected elements only in what is marked as an array, found more");
  EXPECT_EQ(error("<a svar:type=\"array\" b=\"\"/>"),
            "2:2: expected elements only in what is marked as an array, found more");
}

TEST(XmlReject, Structure) {
  const parse_error::Case cases[] = {
      {"empty", "", "1:1: expected an element, found nothing"},
      {"only_comment", "<!-- a -->\n", "2:1: expected an element, found nothing"},
      {"text", "abc", "1:1: expected an element, found text outside of it"},
      {"text_before", "a<b/>", "1:1: expected an element, found text outside of it"},
      {"text_after", "<b/>\na", "2:1: expected an element, found text outside of it"},
      {"two_roots", "<a/>\n<b/>", "2:2: expected one root element, found a second one"},
      {"mismatch", "<a>\n<b></a>",
       "2:6: expected the end of the element that was begun last, found something else"},
      {"no_end", "<a><b>",
       "1:6: expected the end of the element that was begun last, found the end of the text"},
      {"lone_end", "</a>",
       "1:3: expected the end of the element that was begun last, found something else"},
      {"no_name", "<a>< b/></a>", "1:5: expected an element, found something else"},
      {"no_greater", "<a",
       "1:2: expected the name of an element, and '>' or '/>' after it, found the end of the text"},
      {"no_quotes", "<a b=1/>",
       "1:6: expected an attribute with its value in quotes, found something else"},
      {"less_in_attribute", "<a b='<'/>", "1:7: expected &lt; inside of quotes, found '<'"},
      {"attribute_twice", "<a>\n<b c='1' c='2'/></a>",
       "2:2: expected each attribute once, found \"c\" twice"},
      {"comment", "<a><!-- b</a>",
       "1:13: expected a comment and its end, found the end of the text"},
      {"cdata", "<a><![CDATA[ b</a>",
       "1:13: expected a CDATA section and its end, found something else"},
      {"doctype", "<!DOCTYPE a [",
       "1:13: expected a DOCTYPE and its end, found the end of the text"},
      {"number", "<a>\n<b>1e400</b></a>",
       "2:2: expected a number that a double can hold, found \"1e400\""},
      {"number_in_attribute", "<a b='9223372036854775809'/>",
       "1:2: expected an integer that int64 or double can hold exactly, found "
       "\"9223372036854775809\""},
  };
  for (const parse_error::Case& one : cases) {
    SCOPED_TRACE(one.name);
    EXPECT_EQ(xmlError(one.text), one.error);
  }
}

TEST(XmlReject, CharactersAndReferences) {
  const std::string expected =
      "expected one of &lt; &gt; &amp; &quot; &apos; or the number of a character, found ";
  const parse_error::Case cases[] = {
      {"unknown", "<a>\n&foo;</a>", "2:1: " + expected + "\"&foo;\""},
      {"lone", "<a>b & c</a>", "1:6: " + expected + "\"&\""},
      {"in_attribute", "<a b='&c;'/>", "1:7: " + expected + "\"&c;\""},
      {"zero", "<a>&#0;</a>", "1:4: " + expected + "\"&#0;\""},
      {"control", "<a>&#x1F;</a>", "1:4: " + expected + "\"&#x1F;\""},
      {"surrogate", "<a>&#xD800;</a>", "1:4: " + expected + "\"&#xD800;\""},
      {"beyond", "<a>&#x110000;</a>", "1:4: " + expected + "\"&#x110000;\""},
      {"far_beyond", "<a>&#99999999999;</a>", "1:4: " + expected + "\"&#99999999999;\""},
      {"no_character", "<a>&#xFFFE;</a>", "1:4: " + expected + "\"&#xFFFE;\""},
      {"no_digits", "<a>&#;&#x;</a>", "1:4: " + expected + "\"&#;\""},
      {"entities_of_entities", "<!DOCTYPE a [<!ENTITY b 'x'><!ENTITY c '&b;&b;'>]><a>&c;</a>",
       "1:41: " + expected + "\"&b;\""},
      {"bad_utf8", "<a>\n\xFF</a>", "2:1: expected UTF-8, found byte 0xFF"},
      {"zero_byte", bytes("<a>\0</a>"), "1:4: expected no control character, found byte 0x00"},
      {"utf16", bytes("<\0a\0/\0>\0"), "1:2: expected no control character, found byte 0x00"},
      {"no_character_itself", "<a>\xEF\xBF\xBE</a>",
       "1:4: expected characters, found U+FFFE, which is none"},
  };
  for (const parse_error::Case& one : cases) {
    SCOPED_TRACE(one.name);
    EXPECT_EQ(xmlError(one.text), one.error);
  }
}

}  // namespace
