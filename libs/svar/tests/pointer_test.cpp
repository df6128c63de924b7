// Paths with slashes: JSON pointers (RFC 6901) and the same without their first slash.
#include <gslam/svar.h>
#include <gtest/gtest.h>

#include <string>
#include <vector>

#include "error_text.h"

namespace {

using gslam::Svar;
using gslam::SvarError;

TEST(Pointer, FindsWhatTheTableOfRfc6901Says) {
  const Svar document = gslam::parseJson(R"({
      "foo": ["bar", "baz"], "": 0, "a/b": 1, "c%d": 2, "e^f": 3, "g|h": 4, "i\\j": 5,
      "k\"l": 6, " ": 7, "m~n": 8})");
  EXPECT_EQ(document["/foo"], Svar::array({"bar", "baz"}));
  EXPECT_EQ(document["/foo/0"], "bar");
  EXPECT_EQ(document["/"], 0);
  EXPECT_EQ(document["/a~1b"], 1);
  EXPECT_EQ(document["/c%d"], 2);
  EXPECT_EQ(document["/e^f"], 3);
  EXPECT_EQ(document["/g|h"], 4);
  EXPECT_EQ(document["/i\\j"], 5);
  EXPECT_EQ(document["/k\"l"], 6);
  EXPECT_EQ(document["/ "], 7);
  EXPECT_EQ(document["/m~0n"], 8);
}

TEST(Pointer, MayLeaveOutItsFirstSlash) {
  const Svar config = gslam::parseJson(R"({"camera": [{"fx": 1}], "files": {"left.png": 2}})");
  EXPECT_EQ(config["camera/0/fx"], 1);
  EXPECT_EQ(config["/camera/0/fx"], 1);
  EXPECT_EQ(config["camera.0.fx"], 1);
  EXPECT_EQ(config["files/left.png"], 2);
  EXPECT_EQ(config["/files/left.png"], 2);
  EXPECT_FALSE(config.contains("files.left.png"));
  EXPECT_FALSE(config.contains("/camera.0.fx"));
  EXPECT_FALSE(config.contains("camera.0/fx"));
}

TEST(Pointer, ReachesEveryNameByItsEscapes) {
  const char* const names[] = {
      "",  "/",  "~",     "~0",   "~1",    "~01", "a.b",
      ".", "..", "//",    "~~//", "/a",    "a/",  "-",
      "0", " ",  "a~1.b", "x\ty", "\xFF~", "a~",  "long/name~with.all/of~it"};
  for (const std::string name : names) {
    SCOPED_TRACE(name);
    std::string escaped = "/";
    for (const char c : name) {
      escaped += c == '~' ? "~0" : c == '/' ? "~1" : std::string(1, c);
    }
    Svar value;
    value.set(escaped, 1);
    value.set("/outer" + escaped + "/inner", 2);
    ASSERT_EQ(value.size(), 2u);
    EXPECT_EQ(value.members()[0].first, name);
    EXPECT_EQ(value.get<int>(escaped), 1);
    EXPECT_EQ(value["outer"].members()[0].first, name);
    EXPECT_EQ(value["/outer" + escaped + "/inner"], 2);
    EXPECT_TRUE(value.erase("/outer" + escaped));
    EXPECT_TRUE(value.erase(escaped));
    EXPECT_FALSE(value.contains(escaped));
    EXPECT_EQ(value.size(), 1u);
  }
}

TEST(Pointer, EmptyNamesStandBehindAFirstSlashOnly) {
  const Svar value = gslam::parseJson(R"({"": {"": 1, "a": 2}, "a": {"": 3}})");
  EXPECT_EQ(value["//"], 1);
  EXPECT_EQ(value["//a"], 2);
  EXPECT_EQ(value["/a/"], 3);
  EXPECT_FALSE(value.contains("///"));
  EXPECT_EQ(errorText([&] { value.contains("a/"); }),
            "a/: expected names with single slashes between them, such as \"a/0/b\"");
  EXPECT_THROW(value.contains("a//b"), SvarError);
}

TEST(Pointer, TildesNeedASlashSomewhereToMeanAnything) {
  const Svar value = Svar::object({{"a~1b", 1}, {"a/b", 2}, {"~", 3}});
  EXPECT_EQ(value["a~1b"], 1);
  EXPECT_EQ(value["/a~1b"], 2);
  EXPECT_EQ(value["~"], 3);
}

TEST(Pointer, MalformedIsAlwaysAnError) {
  const Svar before = gslam::parseJson(R"({"a": {"b": 1, "~": 3}, "": 2, "~": 4, "a~": 5})");
  Svar value = before.clone();
  EXPECT_EQ(errorText([&] { value.get<int>("/a~2"); }),
            "/a~2: expected ~0 or ~1, as which ~ and / are written in a path");
  for (const char* path :
       {"/~", "/a~", "/a~2", "/~/a", "a/~", "a/b~", "/a/~x", "a/", "a//b", "/a/b/~~0"}) {
    EXPECT_THROW(value.get<int>(path), SvarError) << path;
    EXPECT_THROW(value.get<int>(path, 5), SvarError) << path;
    EXPECT_THROW(value.contains(path), SvarError) << path;
    EXPECT_THROW(value.set(path, 1), SvarError) << path;
    EXPECT_THROW(value.erase(path), SvarError) << path;
  }
  EXPECT_EQ(value, before);
}

TEST(Pointer, IndicesHaveNoZeroBeforeThem) {
  const Svar list = Svar::array({1, 2});
  EXPECT_EQ(list["/0"], 1);
  for (const char* path : {"/00", "/01", "/-", "/-1", "/2", "/", "/1 ", "/18446744073709551616"}) {
    EXPECT_FALSE(list.contains(path)) << path;
  }
}

TEST(Pointer, WithoutAFirstSlashMeansTheWholeNameFirst) {
  const Svar value = gslam::parseJson(R"({
      "a.b": 1, "a": {"b": 2, "c.d": 3}, "x/y": 4, "x": {"y": 5}, "/a/b": 6})");
  EXPECT_EQ(value["a.b"], 1);
  EXPECT_EQ(value["/a/b"], 2);  // never the member "/a/b"
  EXPECT_EQ(value["a/b"], 2);
  EXPECT_EQ(value["x/y"], 4);
  EXPECT_EQ(value["/x/y"], 5);
  EXPECT_EQ(value["x.y"], 5);
  EXPECT_EQ(value["/~1a~1b"], 6);
  EXPECT_EQ(value["a/c.d"], 3);
  EXPECT_FALSE(value.contains("a.c.d"));  // only the whole path is taken as a name
}

TEST(Pointer, WritingAndErasingMeanTheWholeNameFirst) {
  Svar value = gslam::parseJson(R"({"a.b": 1, "a": {"b": 2}})");
  value.set("a.b", 10);
  value.set("/a/b", 20);
  EXPECT_EQ(value, gslam::parseJson(R"({"a.b": 10, "a": {"b": 20}})"));
  EXPECT_TRUE(value.erase("a.b"));
  EXPECT_EQ(value, gslam::parseJson(R"({"a": {"b": 20}})"));
  EXPECT_TRUE(value.erase("a.b"));
  EXPECT_EQ(value, gslam::parseJson(R"({"a": {}})"));
  EXPECT_FALSE(value.erase("a.b"));
  value.set("a.b", 3);  // no such name any more: a path
  EXPECT_EQ(value["a"]["b"], 3);
}

TEST(Pointer, NamesInOpenCvFilesAreFound) {
  const Svar value = Svar::object({{"Camera.fx", 535.4}, {"Camera.fy", 539.2}});
  EXPECT_EQ(value.get<double>("Camera.fx"), 535.4);
  EXPECT_EQ(value.get<double>("Camera.cx", 1.0), 1.0);
}

TEST(Pointer, EndingInADashAppends) {
  Svar value = gslam::parseJson(R"({"list": [1], "map": {}})");
  value.set("/list/-", 2);
  value.set("list/-", 3);
  EXPECT_EQ(value["list"], Svar::array({1, 2, 3}));
  Svar list = value["list"];
  list.set("/-", 4);
  EXPECT_EQ(list.size(), 4u);
  value.set("/map/-", 5);  // a name as any other
  EXPECT_EQ(value["map"], Svar::object({{"-", 5}}));
  EXPECT_THROW(value.set("/list/-/x", 1), SvarError);
  EXPECT_THROW(value.set("list.-", 1), SvarError);
  EXPECT_THROW(list.set("-", 1), SvarError);
  EXPECT_THROW(value.set("/list/-", value), SvarError);  // would contain itself
  EXPECT_THROW(value.get<int>("/list/-"), SvarError);
  EXPECT_THROW(value.get<int>("/list/-", 5), SvarError);
  EXPECT_FALSE(value.erase("/list/-"));
  EXPECT_EQ(value["list"].size(), 4u);
}

TEST(Pointer, MayBeANameInTheObjectThatIsWritten) {
  for (int others = 0; others < 20; ++others) {
    for (const char* name : {"/x", "/x/y/z", "/n0/y", "/~1x"}) {
      SCOPED_TRACE(name);
      Svar value = Svar::object({{name, "as it is"}});
      for (int i = 0; i < others; ++i) value.set("n" + std::to_string(i), nullptr);
      const Svar before = value.clone();
      value.set(value.members()[0].first, 5);
      EXPECT_EQ(value.get<int>(name), 5);
      EXPECT_EQ(value.merged(before).members()[0].first, name);
      EXPECT_TRUE(value.erase(value.members()[0].first));
      EXPECT_FALSE(value.contains(name));
    }
  }
}

TEST(Pointer, ErrorsNameItAsItWasWritten) {
  const Svar value = gslam::parseJson(R"({"camera": [{"f/x": "a"}]})");
  EXPECT_EQ(errorText([&] { value.get<int>("/camera/0/f~1x"); }),
            "/camera/0/f~1x: expected int32, found string \"a\"");
  EXPECT_EQ(errorText([&] { value.get<int>("/camera/0/fy"); }),
            "/camera/0/fy: expected int32, found nothing: no \"fy\" in /camera/0 (object of 1)");
  EXPECT_EQ(errorText([&] { value.get<int>("/x"); }),
            "/x: expected int32, found nothing: no \"x\" in the value (object of 1)");
}

}  // namespace
