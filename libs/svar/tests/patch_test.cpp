// JSON patches (RFC 6902), and the differences that are written as such.
#include <gslam/svar.h>
#include <gtest/gtest.h>

#include <cmath>
#include <string>

#include "error_text.h"
#include "random_value.h"

namespace {

using gslam::parseJson;
using gslam::Svar;
using gslam::SvarError;

struct Example {
  const char* name;
  const char* before;
  const char* patch;
  const char* after;  // null: an error
};

// A.13 has one name twice, which parseJson() refuses.
const Example kExamples[] = {
    {"A.1 add a member", R"({"foo": "bar"})", R"([{"op": "add", "path": "/baz", "value": "qux"}])",
     R"({"baz": "qux", "foo": "bar"})"},
    {"A.2 add an element", R"({"foo": ["bar", "baz"]})",
     R"([{"op": "add", "path": "/foo/1", "value": "qux"}])", R"({"foo": ["bar", "qux", "baz"]})"},
    {"A.3 remove a member", R"({"baz": "qux", "foo": "bar"})",
     R"([{"op": "remove", "path": "/baz"}])", R"({"foo": "bar"})"},
    {"A.4 remove an element", R"({"foo": ["bar", "qux", "baz"]})",
     R"([{"op": "remove", "path": "/foo/1"}])", R"({"foo": ["bar", "baz"]})"},
    {"A.5 replace", R"({"baz": "qux", "foo": "bar"})",
     R"([{"op": "replace", "path": "/baz", "value": "boo"}])", R"({"baz": "boo", "foo": "bar"})"},
    {"A.6 move a member", R"({"foo": {"bar": "baz", "waldo": "fred"}, "qux": {"corge": "grault"}})",
     R"([{"op": "move", "from": "/foo/waldo", "path": "/qux/thud"}])",
     R"({"foo": {"bar": "baz"}, "qux": {"corge": "grault", "thud": "fred"}})"},
    {"A.7 move an element", R"({"foo": ["all", "grass", "cows", "eat"]})",
     R"([{"op": "move", "from": "/foo/1", "path": "/foo/3"}])",
     R"({"foo": ["all", "cows", "eat", "grass"]})"},
    {"A.8 test that holds", R"({"baz": "qux", "foo": ["a", 2, "c"]})",
     R"([{"op": "test", "path": "/baz", "value": "qux"},
         {"op": "test", "path": "/foo/1", "value": 2}])",
     R"({"baz": "qux", "foo": ["a", 2, "c"]})"},
    {"A.9 test that fails", R"({"baz": "qux"})",
     R"([{"op": "test", "path": "/baz", "value": "bar"}])", nullptr},
    {"A.10 add an object", R"({"foo": "bar"})",
     R"([{"op": "add", "path": "/child", "value": {"grandchild": {}}}])",
     R"({"foo": "bar", "child": {"grandchild": {}}})"},
    {"A.11 ignore unknown members", R"({"foo": "bar"})",
     R"([{"op": "add", "path": "/baz", "value": "qux", "xyz": 123}])",
     R"({"foo": "bar", "baz": "qux"})"},
    {"A.12 add to what is not there", R"({"foo": "bar"})",
     R"([{"op": "add", "path": "/baz/bat", "value": "qux"}])", nullptr},
    {"A.14 escapes", R"({"/": 9, "~1": 10})", R"([{"op": "test", "path": "/~01", "value": 10}])",
     R"({"/": 9, "~1": 10})"},
    {"A.15 text is no number", R"({"/": 9, "~1": 10})",
     R"([{"op": "test", "path": "/~01", "value": "10"}])", nullptr},
    {"A.16 append an array", R"({"foo": ["bar"]})",
     R"([{"op": "add", "path": "/foo/-", "value": ["abc", "def"]}])",
     R"({"foo": ["bar", ["abc", "def"]]})"},
    // Not of the RFC.
    {"add what is there", R"({"a": 1})", R"([{"op": "add", "path": "/a", "value": 2}])",
     R"({"a": 2})"},
    {"add behind the end", R"([1])", R"([{"op": "add", "path": "/1", "value": 2}])", "[1, 2]"},
    {"add too far behind", R"([1])", R"([{"op": "add", "path": "/2", "value": 2}])", nullptr},
    {"add with a zero before", R"([1, 2])", R"([{"op": "add", "path": "/01", "value": 2}])",
     nullptr},
    {"add to a number", R"({"a": 1})", R"([{"op": "add", "path": "/a/b", "value": 2}])", nullptr},
    {"add to null", R"({"a": null})", R"([{"op": "add", "path": "/a/b", "value": 2}])", nullptr},
    {"add a null", R"({})", R"([{"op": "add", "path": "/a", "value": null}])", R"({"a": null})"},
    {"add without value", R"({})", R"([{"op": "add", "path": "/a"}])", nullptr},
    {"replace the whole", R"({})", R"([{"op": "replace", "path": "", "value": 3}])", "3"},
    {"replace what is not there", R"({})", R"([{"op": "replace", "path": "/a", "value": 3}])",
     nullptr},
    {"replace behind the end", R"([])", R"([{"op": "replace", "path": "/-", "value": 3}])",
     nullptr},
    {"remove what is not there", R"({"a": 1})", R"([{"op": "remove", "path": "/b"}])", nullptr},
    {"remove the whole", R"({"a": 1})", R"([{"op": "remove", "path": ""}])", nullptr},
    {"never a dotted name", R"({"a.b": 1, "a": {"b": 2}})", R"([{"op": "remove", "path": "/a/b"}])",
     R"({"a.b": 1, "a": {}})"},
    {"no pointer", R"({"a": 1})", R"([{"op": "remove", "path": "a"}])", nullptr},
    {"malformed pointer", R"({"a~": 1})", R"([{"op": "add", "path": "/a~2", "value": 1}])",
     nullptr},
    {"unknown operation", R"({"a": 1})", R"([{"op": "append", "path": "/a", "value": 1}])",
     nullptr},
    {"operation that is no text", R"({"a": 1})", R"([{"op": 1, "path": "/a"}])", nullptr},
    {"operation that is no object", R"({"a": 1})", R"([3])", nullptr},
    {"patch that is no array", R"({"a": 1})", R"({"op": "remove", "path": "/a"})", nullptr},
    {"copy inside of itself", R"({"a": {"b": 1}})",
     R"([{"op": "copy", "from": "/a", "path": "/a/c"}])", R"({"a": {"b": 1, "c": {"b": 1}}})"},
    {"copy the whole", R"([1])", R"([{"op": "copy", "from": "", "path": "/0"}])", "[[1], 1]"},
    {"move inside of itself", R"({"a": {"b": 1}})",
     R"([{"op": "move", "from": "/a", "path": "/a/c"}])", nullptr},
    {"move to where it is", R"({"a": 1})", R"([{"op": "move", "from": "/a", "path": "/a"}])",
     R"({"a": 1})"},
    {"move nothing to where it is", R"({})", R"([{"op": "move", "from": "/a", "path": "/a"}])",
     nullptr},
    {"move to a name that begins so", R"({"a": 1})",
     R"([{"op": "move", "from": "/a", "path": "/ab"}])", R"({"ab": 1})"},
    {"move out", R"({"a": {"b": 1}})", R"([{"op": "move", "from": "/a/b", "path": "/a"}])",
     R"({"a": 1})"},
    {"one after the other", R"({})",
     R"([{"op": "add", "path": "/l", "value": []}, {"op": "add", "path": "/l/-", "value": 1},
         {"op": "copy", "from": "/l", "path": "/m"}, {"op": "remove", "path": "/l/0"}])",
     R"({"l": [], "m": [1]})"},
};

TEST(Patched, DoesWhatRfc6902Shows) {
  for (const Example& example : kExamples) {
    SCOPED_TRACE(example.name);
    const Svar before = parseJson(example.before);
    if (example.after == nullptr) {
      EXPECT_THROW(before.patched(parseJson(example.patch)), SvarError);
    } else {
      EXPECT_EQ(before.patched(parseJson(example.patch)), parseJson(example.after));
    }
    EXPECT_EQ(before, parseJson(example.before));
  }
}

TEST(Patched, ErrorsSayWhichOperation) {
  const Svar value = parseJson(R"({"a": [1]})");
  EXPECT_EQ(errorText([&] {
              value.patched(parseJson(R"([{"op": "add", "path": "/b", "value": 1},
                                          {"op": "add", "path": "/a/7", "value": 1}])"));
            }),
            "1: operation of a patch: /a/7: cannot be added to an array of 1");
  EXPECT_EQ(errorText([&] { value.patched(parseJson(R"([{"path": "/b"}])")); }),
            "0: operation of a patch: op: expected string, found nothing: no \"op\" in the value "
            "(object of 1)");
  EXPECT_EQ(errorText([&] { value.patched(3); }), "expected array, found int 3");
}

TEST(Patched, IsIndependentOfValueAndPatch) {
  const Svar value = parseJson(R"({"a": [1]})");
  const Svar patch = parseJson(R"([{"op": "add", "path": "/b", "value": {"c": 1}},
                                   {"op": "copy", "from": "/b", "path": "/d"}])");
  const Svar patch_before = patch.clone();
  Svar patched = value.patched(patch);
  patched.set("/a/-", 2);
  patched.set("b.c", 2);
  EXPECT_EQ(patched.get<int>("d.c"), 1);
  EXPECT_EQ(value, parseJson(R"({"a": [1]})"));
  EXPECT_EQ(patch, patch_before);
}

TEST(Diff, IsShortWherePartsAreTheSame) {
  EXPECT_EQ(parseJson(R"({"a": 1, "b": {"c": [1, 2, 3]}})")
                .diff(parseJson(R"({"b": {"c": [1, 7, 3]}, "d": null})")),
            parseJson(R"([{"op": "remove", "path": "/a"},
                          {"op": "add", "path": "/d", "value": null},
                          {"op": "replace", "path": "/b/c/1", "value": 7}])"));
  EXPECT_EQ(parseJson("[1, 2, 3, 4]").diff(parseJson("[1, 4]")).size(), 2u);
  EXPECT_EQ(parseJson("[1, 4]").diff(parseJson("[1, 2, 3, 4]")).size(), 2u);
  EXPECT_EQ(parseJson("{}").diff(parseJson("[]")),
            parseJson(R"([{"op": "replace", "path": "", "value": []}])"));
  EXPECT_EQ(Svar(1).diff(1.0).size(), 1u);
}

TEST(Diff, OfRandomValuesMakesOneOfTheOther) {
  RandomValues random(2);
  for (int i = 0; i < 5000; ++i) {
    const Svar a = random.value(4);
    const Svar b = random.value(4);
    const Svar patch = a.diff(b);
    ASSERT_EQ(a.patched(patch), b) << printJson(a) << printJson(b) << printJson(patch);
    ASSERT_EQ(a.diff(a), Svar::array());
    ASSERT_EQ(a.diff(a.clone()), Svar::array());
    ASSERT_EQ(patch.size() == 0, a == b);
    ASSERT_EQ(parseJson(printJson(patch)), patch);
  }
}

TEST(Diff, OfArraysMakesOneOfTheOther) {
  RandomValues random(3);
  for (int i = 0; i < 5000; ++i) {
    Svar a = Svar::array(), b = Svar::array();
    for (int k = random.below(8); k > 0; --k) a.push_back(random.below(3));
    for (int k = random.below(8); k > 0; --k) b.push_back(random.below(3));
    ASSERT_EQ(a.patched(a.diff(b)), b) << printJson(a) << printJson(b);
  }
}

}  // namespace
