// XML as it is printed, that it is read as what was printed, and XML of any size.
#include <gslam/svar_formats.h>
#include <gtest/gtest.h>

#include <chrono>
#include <cmath>
#include <string>

#include "parse_error.h"
#include "random_value.h"

namespace {

using gslam::parseXml;
using gslam::printXml;
using gslam::Svar;
using parse_error::xmlError;

const std::string kHead = "<?xml version=\"1.0\" encoding=\"UTF-8\"?>\n";
const std::string kMarked = " xmlns:svar=\"urn:gslam:svar\"";

struct PrintedXml {
  const char* name;
  Svar value;
  std::string text;  // without the head
};

TEST(XmlPrint, Values) {
  const PrintedXml cases[] = {
      {"null", nullptr, "<svar/>"},
      {"bool", true, "<svar>true</svar>"},
      {"int", 30, "<svar>30</svar>"},
      {"double", 30.0, "<svar>30.0</svar>"},
      {"infinity", -HUGE_VAL, "<svar>-.inf</svar>"},
      {"text", "left camera", "<svar>left camera</svar>"},
      {"markup", "<a> & \"b\"", "<svar>&lt;a&gt; &amp; \"b\"</svar>"},
      {"text_of_a_number", "12", "<svar" + kMarked + " svar:type=\"string\">12</svar>"},
      {"empty_text", "", "<svar" + kMarked + " svar:type=\"string\"></svar>"},
      {"space_around", " a\r\n", "<svar" + kMarked + " svar:type=\"string\"> a&#13;\n</svar>"},
      {"only_space", " \n", "<svar" + kMarked + " svar:type=\"string\">&#32;&#10;</svar>"},
      {"binary", Svar::binary("hello", 5),
       "<svar" + kMarked + " svar:type=\"binary\">aGVsbG8=</svar>"},
      {"binary_attribute", Svar::object({{"@a", Svar::binary("", 0)}}),
       "<svar" + kMarked + ">\n  <item svar:name=\"@a\" svar:type=\"binary\"></item>\n</svar>"},
      {"empty_array", Svar::array(), "<svar" + kMarked + " svar:type=\"array\"/>"},
      {"empty_object", Svar::object(), "<svar" + kMarked + " svar:type=\"object\"/>"},
      {"array", Svar::array({1, Svar::array({"a", nullptr})}),
       "<svar" + kMarked +
           " svar:type=\"array\">\n  <item>1</item>\n  <item svar:type=\"array\">\n"
           "    <item>a</item>\n    <item/>\n  </item>\n</svar>"},
      {"object", Svar::object({{"a", 1}, {"b", Svar::object({{"c", "x"}})}}),
       "<svar>\n  <a>1</a>\n  <b>\n    <c>x</c>\n  </b>\n</svar>"},
      {"repeated", Svar::object({{"k", Svar::array({1, Svar::object({{"l", 2}})})}}),
       "<svar>\n  <k>1</k>\n  <k>\n    <l>2</l>\n  </k>\n</svar>"},
      {"array_of_one", Svar::object({{"k", Svar::array({1})}}),
       "<svar" + kMarked + ">\n  <k svar:type=\"array\">\n    <item>1</item>\n  </k>\n</svar>"},
      {"attributes", Svar::object({{"@unit", "m"}, {"@n", 2}, {"#text", 5}}),
       "<svar unit=\"m\" n=\"2\">5</svar>"},
      {"attribute_text", Svar::object({{"@a", "\"<\n\t>\""}}),
       "<svar a=\"&quot;&lt;&#10;&#9;&gt;&quot;\"/>"},
      {"attribute_text_of_a_number", Svar::object({{"@a", "2"}}),
       "<svar" + kMarked + ">\n  <item svar:name=\"@a\" svar:type=\"string\">2</item>\n</svar>"},
      {"only_text", Svar::object({{"#text", "x"}}),
       "<svar" + kMarked + " svar:type=\"object\">x</svar>"},
      {"odd_names", Svar::object({{"a b", 1}, {"", 2}, {"svar:type", 3}, {"@xmlns:svar", "x"}}),
       "<svar" + kMarked +
           ">\n  <item svar:name=\"a b\">1</item>\n  <item svar:name=\"\">2</item>\n"
           "  <item svar:name=\"svar:type\">3</item>\n  <item "
           "svar:name=\"@xmlns:svar\">x</item>\n</svar>"},
      {"mixed", Svar::object({{"#text", "a b"}, {"c", 1}}), "<svar>a b\n  <c>1</c>\n</svar>"},
  };
  for (const PrintedXml& one : cases) {
    SCOPED_TRACE(one.name);
    EXPECT_EQ(printXml(one.value), kHead + one.text);
    EXPECT_EQ(parseXml(one.text), one.value);
  }
  EXPECT_EQ(printXml(std::nan("")), kHead + "<svar>.nan</svar>");
}

TEST(XmlPrint, SaysWhatXmlCannotHold) {
  const auto error_of = [](const Svar& value) -> std::string {
    try {
      printXml(value);
    } catch (const gslam::SvarError& error) {
      return error.what();
    }
    return "(no error)";
  };
  const std::string prefix = "cannot be printed as XML: expected ";
  EXPECT_EQ(error_of(Svar::object({{"a", Svar::array({1, "b\x01"})}})),
            "a.1: " + prefix + "no control character, found byte 0x01 at 1");
  EXPECT_EQ(error_of(Svar::object({{"a", Svar::function([](int i) { return i; })}})),
            "a: " + prefix + "a value that XML has, found function int32(int32)");
  EXPECT_EQ(error_of(Svar::object({{"a", Svar::array({"\xFF"})}})),
            "a.0: " + prefix + "UTF-8, found byte 0xFF at 0");
  EXPECT_EQ(error_of(Svar::object({{"a", Svar::object({{"@b", "\xEF\xBF\xBF"}})}})),
            "a.@b: " + prefix + "characters, found U+FFFF, which is none at 0");
  EXPECT_EQ(error_of(Svar::object({{"a", Svar::object({{"#text", "x\x02"}})}})),
            "a.#text: " + prefix + "no control character, found byte 0x02 at 1");
  EXPECT_EQ(error_of(Svar::object({{"a", Svar::object({{"b", 1}, {"c\x1B", 1}})}})),
            "a: " + prefix + "no control character, found byte 0x1B at 1 of the name of member 1");
}

TEST(XmlPrint, EveryByteInEveryPlace) {
  for (int byte = 0; byte < 0x80; ++byte) {
    const bool is_held = byte >= 0x20 || byte == '\t' || byte == '\n' || byte == '\r';
    for (const char* const around : {"", "a", " ", "1"}) {
      const std::string text = around + std::string(1, static_cast<char>(byte)) + around;
      const Svar value = Svar::object({{"a", text},
                                       {"@b", text},
                                       {"#text", text},
                                       {"@" + text + "c", 1},
                                       {text + "d", Svar::array({text, text})}});
      if (is_held) {
        ASSERT_EQ(parseXml(printXml(value)), value) << printXml(value);
      } else {
        EXPECT_THROW(printXml(value), gslam::SvarError);
      }
    }
  }
}

TEST(XmlRoundTrip, RandomTrees) {
  random_value::Random random(1);
  for (int i = 0; i < 3000; ++i) {
    const Svar value = random_value::anyTree(random, 6, false);
    const std::string text = printXml(value);
    ASSERT_EQ(parseXml(text), value) << text;
  }
}

TEST(XmlLimit, Depth) {
  const auto nested = [](std::size_t depth) {
    std::string text;
    for (std::size_t i = 0; i < depth; ++i) text += "<a>";
    for (std::size_t i = 0; i < depth; ++i) text += "</a>";
    return text;
  };
  EXPECT_EQ(xmlError(nested(1000)), "accepted");
  EXPECT_EQ(xmlError(nested(1001)),
            "1:3002: expected at most 1000 elements inside one another, found one more");
  gslam::XmlOptions options;
  options.max_depth = 1000000;
  EXPECT_EQ(xmlError(nested(1000000), options), "accepted");
  EXPECT_EQ(xmlError(nested(1000001), options),
            "1:3000002: expected at most 1000000 elements inside one another, found one more");
  options.max_depth = 0;
  EXPECT_EQ(xmlError("<a/>", options),
            "1:2: expected at most 0 elements inside one another, found one more");
}

TEST(XmlLimit, PrintingDeepValues) {
  gslam::XmlOptions options;
  options.max_depth = 20001;
  const Svar deep = random_value::nested(20000);
  const std::string text = printXml(deep);
  EXPECT_EQ(parseXml(text, "XML", options), deep);
}

TEST(XmlLimit, OddTextsTakeLinearTime) {
  const char* const pieces[] = {"<a>",      "<a", "<",    ">",         "&",  "&amp;",
                                "&#",       "<!", "<!--", "<![CDATA[", "<?", "<!DOCTYPE a [",
                                "<a b='",   "\"", "</a>", "]]>",       "a ", "<a/>",
                                "<a b='1' "};
  const auto begin = std::chrono::steady_clock::now();
  for (const char* const piece : pieces) {
    std::string text = "<r>";
    while (text.size() < 500000) text += piece;
    for (const std::string& odd : {text, text.substr(3), text + "</r>"}) {
      EXPECT_FALSE(xmlError(odd).empty()) << piece;
    }
  }
  std::string attributes = "<a";
  for (int i = 0; i < 100000; ++i) attributes += " a" + std::to_string(i) + "='1'";
  EXPECT_EQ(xmlError(attributes + "/>"), "accepted");
  EXPECT_LT(std::chrono::steady_clock::now() - begin, std::chrono::seconds(120));
}

// Whatever is left of a text, and whatever one byte of it becomes: a value, or a ParseError.
const char kXmlSample[] =
    "<?xml version=\"1.0\"?>\n<!DOCTYPE a [<!ELEMENT a ANY>]>\n"
    "<a xmlns:svar=\"urn:gslam:svar\" b='&lt;1' c=\"x\">t<!-- c --><d "
    "svar:type=\"array\"><i>1</i></d>\n"
    "<e svar:name=\"f g\">&#65;</e><h/><h> 2.5 </h><![CDATA[<&]]>\xC3\xA9</a>\n";

void xmlMustEnd(const std::string& text) {
  try {
    const Svar value = parseXml(text);
    EXPECT_EQ(parseXml(printXml(value)), value) << text;
  } catch (const gslam::ParseError& error) {
    EXPECT_GT(error.line(), 0u);
  }
}

TEST(XmlLimit, CutAnywhere) {
  const std::string sample = kXmlSample;
  EXPECT_EQ(xmlError(sample), "accepted");
  for (std::size_t size = 0; size < sample.size(); ++size) {
    xmlMustEnd(sample.substr(0, size));
    xmlMustEnd(sample.substr(size));
    xmlMustEnd("<opencv_storage type_id=\"opencv-matrix\">" + sample.substr(size) +
               "</opencv_storage>");
  }
}

TEST(XmlLimit, AnyByteBroken) {
  const std::string bytes = parse_error::bytes("\0\n []<>/&;#'\"=!?-:\x80\xFF~0a");
  for (std::size_t i = 0; i + 1 < sizeof(kXmlSample); ++i) {
    for (const char byte : bytes) {
      std::string text = kXmlSample;
      text[i] = byte;
      xmlMustEnd(text);
    }
  }
}

}  // namespace
