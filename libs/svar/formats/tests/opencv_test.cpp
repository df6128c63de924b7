// Files as OpenCV's FileStorage writes them, in YAML and in XML.
#include <gslam/svar_formats.h>
#include <gtest/gtest.h>

#include <cmath>
#include <string>

#include "parse_error.h"

namespace {

using gslam::parseJson;
using gslam::parseXml;
using gslam::parseYaml;
using gslam::Svar;
using parse_error::xmlError;
using parse_error::yamlError;

// What the tutorial of OpenCV on files shows, with the line ends and spaces of OpenCV 4.
const char kYaml[] = R"(%YAML:1.0
---
frameCount: 5
calibrationDate: "Fri Jun 17 14:09:29 2011\n"
cameraMatrix: !!opencv-matrix
   rows: 3
   cols: 3
   dt: d
   data: [ 1000., 0., 320., 0., 1000., 240., 0., 0., 1. ]
distCoeffs: !!opencv-matrix
   rows: 5
   cols: 1
   dt: d
   data: [ 1.0000000000000001e-01, 1.0000000000000000e-02,
       -1.0000000000000000e-03, 0., 0. ]
features:
   - { x:167, y:49, lbp:[ 1, 0, 0, 1, 1, 0, 1, 1 ] }
   - { x:298, y:130, lbp:[ 0, 0, 0, 1, 0, 0, 1, 1 ] }
)";

const char kXml[] = R"(<?xml version="1.0"?>
<opencv_storage>
<frameCount>5</frameCount>
<calibrationDate>"Fri Jun 17 14:09:29 2011\n"</calibrationDate>
<cameraMatrix type_id="opencv-matrix">
  <rows>3</rows>
  <cols>3</cols>
  <dt>d</dt>
  <data>
    1000. 0. 320. 0. 1000. 240. 0. 0. 1.</data></cameraMatrix>
<distCoeffs type_id="opencv-matrix">
  <rows>5</rows>
  <cols>1</cols>
  <dt>d</dt>
  <data>
    1.0000000000000001e-01 1.0000000000000000e-02
    -1.0000000000000000e-03 0. 0.</data></distCoeffs>
<features>
  <_>
    <x>167</x>
    <y>49</y>
    <lbp>
      1 0 0 1 1 0 1 1</lbp></_>
  <_>
    <x>298</x>
    <y>130</y>
    <lbp>
      0 0 0 1 0 0 1 1</lbp></_></features>
</opencv_storage>
)";

const char kJson[] = R"({
  "frameCount": 5,
  "calibrationDate": "Fri Jun 17 14:09:29 2011\n",
  "cameraMatrix": {"rows": 3, "cols": 3, "dt": "d",
                   "data": [1000.0, 0.0, 320.0, 0.0, 1000.0, 240.0, 0.0, 0.0, 1.0]},
  "distCoeffs": {"rows": 5, "cols": 1, "dt": "d", "data": [0.1, 0.01, -0.001, 0.0, 0.0]},
  "features": [{"x": 167, "y": 49, "lbp": [1, 0, 0, 1, 1, 0, 1, 1]},
               {"x": 298, "y": 130, "lbp": [0, 0, 0, 1, 0, 0, 1, 1]}]
})";

TEST(OpenCv, TheSameValueFromYamlAndXml) {
  EXPECT_EQ(parseYaml(kYaml), parseJson(kJson));
  EXPECT_EQ(parseXml(kXml), parseJson(kJson));
}

TEST(OpenCv, HeadsOfYaml) {
  const Svar expected = Svar::object({{"a", 1}, {"b", Svar::object({{"x", 2}})}});
  for (const char* const head :
       {"%YAML:1.0\n", "%YAML:1.0\n---\n", "%YAML 1.0\n---\n", "%YAML 1.0\n", "%YAML:1.0 # why\n\n",
        "\xEF\xBB\xBF%YAML:1.0\n", "%YAML:1.0\r\n---\r\n"}) {
    EXPECT_EQ(parseYaml(head + std::string("a: 1\nb: { x:2 }\n")), expected) << head;
  }
}

TEST(OpenCv, ColonsWithoutASpace) {
  const std::string text =
      "%YAML:1.0\nCamera.fx:458.654 # fx:1\nCamera.fy: 457\nname:\"a:b {c:d\"\nlist:[ 1, 2 ]\n"
      "map: { x:1, y-z:'q:r', in:{ k:[ a:b, \"c:d\" ] } }\nseq:\n   - k:1\n   -  l:2\n"
      "url: http://h:80/p\nhttp://h/p: 1\n# c:d\nlast:x";
  EXPECT_EQ(parseYaml(text), parseJson(R"({
      "Camera.fx": 458.654, "Camera.fy": 457, "name": "a:b {c:d", "list": [1, 2],
      "map": {"x": 1, "y-z": "q:r", "in": {"k": ["a:b", "c:d"]}},
      "seq": [{"k": 1}, {"l": 2}], "url": "http://h:80/p", "http://h/p": 1, "last": "x"})"));
  EXPECT_EQ(parseYaml("a:1"), Svar("a:1")) << "not without the head of OpenCV";
}

TEST(OpenCv, PlacesAreThoseOfTheFile) {
  EXPECT_EQ(yamlError("%YAML:1.0\na:1\nb: { x:1, y:2, x:3 }\n"),
            "3:16: expected each name once, found \"x\" also at line 3, column 6");
  EXPECT_EQ(yamlError("%YAML:1.0\na:1\nb:2: 3\n"),
            "3:4: cannot be read as YAML: illegal map value");
}

TEST(OpenCv, NumbersAsItWritesThem) {
  const Svar list =
      parseYaml("%YAML:1.0\na: [ 1., -1., .5, 1.0e+03, .Inf, -.Inf, .Nan, 0x10 ]")["a"];
  EXPECT_EQ(list[0], Svar(1.0));
  EXPECT_EQ(list[1], Svar(-1.0));
  EXPECT_EQ(list[2], Svar(0.5));
  EXPECT_EQ(list[3], Svar(1000.0));
  EXPECT_EQ(list[4], Svar(HUGE_VAL));
  EXPECT_EQ(list[5], Svar(-HUGE_VAL));
  EXPECT_TRUE(std::isnan(list[6].as<double>()));
}

std::string matrix(const std::string& rows, const std::string& cols, const std::string& type,
                   const std::string& data) {
  return "m: !!opencv-matrix\n  rows: " + rows + "\n  cols: " + cols + "\n  dt: " + type +
         "\n  data: " + data;
}

TEST(OpenCv, MatricesThatFit) {
  for (const char* const type : {"u", "c", "w", "s", "i", "f", "d", "h", "1d"}) {
    EXPECT_EQ(yamlError(matrix("1", "2", type, "[1, 2.5]")), "accepted") << type;
  }
  EXPECT_EQ(yamlError(matrix("1", "2", "\"2f\"", "[1, 2, 3, .Nan]")), "accepted");
  EXPECT_EQ(yamlError(matrix("0", "0", "\"512d\"", "[ ]")), "accepted");
  EXPECT_EQ(yamlError(matrix("0", "9223372036854775807", "d", "[]")), "accepted");
  EXPECT_EQ(parseYaml("!!opencv-nd-matrix {sizes: [1, 2, 1], dt: \"2f\", data: [1, 2, 3, 4]}"),
            parseJson(R"({"sizes": [1, 2, 1], "dt": "2f", "data": [1, 2, 3, 4]})"));
  EXPECT_EQ(
      parseYaml("!<tag:yaml.org,2002:opencv-matrix> {rows: 0, cols: 0, dt: d, data: [], more: 1}")
          ["more"],
      Svar(1));
}

TEST(OpenCv, MatricesThatDoNot) {
  const parse_error::Case cases[] = {
      {"rows", matrix("-1", "1", "d", "[1]"), "2:3: expected rows of 0 or more, found -1"},
      {"cols", matrix("1", "1.", "d", "[1]"),
       "3:3: expected cols of 0 or more, found a value of type double"},
      {"type", matrix("1", "1", "x", "[1]"),
       "4:3: expected a type such as d, f, u or 3f as dt, found \"x\""},
      {"type_is_number", matrix("1", "1", "3", "[1]"),
       "4:3: expected a type such as d, f, u or 3f as dt, found 3"},
      {"no_channels", matrix("1", "1", "0d", "[1]"),
       "4:3: expected a type such as d, f, u or 3f as dt, found \"0d\""},
      {"channels", matrix("1", "1", "513d", "[1]"),
       "4:3: expected a type such as d, f, u or 3f as dt, found \"513d\""},
      {"two_types", matrix("1", "1", "2i1f", "[1]"),
       "4:3: expected a type such as d, f, u or 3f as dt, found \"2i1f\""},
      {"no_array", matrix("1", "1", "d", "1"), "5:3: expected an array as data, found 1"},
      {"no_number", matrix("1", "1", "d", "[a]"), "5:3: expected numbers as data, found \"a\""},
      {"too_few", matrix("2", "2", "3f", "[1, 2]"),
       "5:3: expected 12 numbers as data, as of the size and type of the matrix, found 2"},
      {"huge", matrix("9223372036854775807", "9223372036854775807", "9d", "[1]"),
       "5:3: expected far more numbers as data, as of the size and type of the matrix, found 1"},
      {"missing", "a: 1\nm: !!opencv-matrix {rows: 1}",
       "2:4: expected cols of 0 or more, found a value of type null"},
      {"no_object", "m: !!opencv-matrix [1]",
       "1:4: expected what the tag !!opencv-matrix stands for, found an array"},
      {"sizes", "!!opencv-nd-matrix {sizes: 2, dt: d, data: [1, 2]}",
       "1:21: expected an array of sizes, found 2"},
      {"size", "!!opencv-nd-matrix {sizes: [2, -1], dt: d, data: []}",
       "1:21: expected sizes of 0 or more, found -1"},
  };
  for (const parse_error::Case& one : cases) {
    SCOPED_TRACE(one.name);
    EXPECT_EQ(yamlError(one.text), one.error);
  }
}

TEST(OpenCv, Xml) {
  const auto inside = [](const std::string& text) {
    return parseXml("<opencv_storage>" + text + "</opencv_storage>");
  };
  EXPECT_EQ(inside("<a>1</a><b>x</b><c>\"1 2\"</c><d/><e>\"\"</e>"),
            parseJson(R"({"a": 1, "b": "x", "c": "1 2", "d": null, "e": ""})"));
  EXPECT_EQ(inside("<a>1 2.5 x \"y z\" .Inf</a>"),
            Svar::object({{"a", Svar::array({1, 2.5, "x", "y z", HUGE_VAL})}}));
  EXPECT_EQ(inside("<a><_>1</_></a><b><_>1 2</_><_><k>3</k></_></b>"),
            parseJson(R"({"a": [1], "b": [[1, 2], {"k": 3}]})"));
  EXPECT_EQ(
      inside(
          "<m type_id=\"opencv-matrix\"><rows>1</rows><cols>1</cols><dt>f</dt><data>5.</data></m>"),
      parseJson(R"({"m": {"rows": 1, "cols": 1, "dt": "f", "data": [5.0]}})"));
  EXPECT_EQ(
      inside(
          "<m "
          "type_id=\"opencv-matrix\"><rows>0</rows><cols>0</cols><dt>\"3f\"</dt><data></data></m>"),
      parseJson(R"({"m": {"rows": 0, "cols": 0, "dt": "3f", "data": []}})"));
  EXPECT_EQ(
      inside("<m type_id=\"opencv-nd-matrix\"><sizes>1 2</sizes><dt>d</dt><data>1. 2.</data></m>"),
      parseJson(R"({"m": {"sizes": [1, 2], "dt": "d", "data": [1.0, 2.0]}})"));
  EXPECT_EQ(inside("<a>\"q\\\"r\\\\ &lt;s&gt;\"</a>"), Svar::object({{"a", "q\"r\\ <s>"}}));
  EXPECT_EQ(parseXml("<a><_>1</_><_>2 3</_></a>"), parseJson(R"({"_": [1, "2 3"]})"))
      << "not in other files";
}

TEST(OpenCv, XmlThatIsWrong) {
  EXPECT_EQ(xmlError("<opencv_storage>\n<m type_id=\"opencv-matrix\"><rows>1</rows><cols>2</cols>\n"
                     "<dt>f</dt><data>5.</data></m></opencv_storage>"),
            "3:12: expected 2 numbers as data, as of the size and type of the matrix, found 1");
  EXPECT_EQ(xmlError("<opencv_storage><m type_id=\"opencv-matrix\"/></opencv_storage>"),
            "1:18: expected rows of 0 or more, found a value of type null");
  EXPECT_EQ(xmlError("<opencv_storage><a>\"b</a></opencv_storage>"),
            "1:18: expected '\"' at the end of this string");
}

}  // namespace
