// Laying one value over another.
#include <gslam/svar.h>
#include <gtest/gtest.h>

#include <string>

#include "random_value.h"

namespace {

using gslam::parseJson;
using gslam::Svar;

TEST(Merged, IsMemberByMember) {
  const Svar defaults =
      parseJson(R"({"fps": 30, "camera": {"fx": 1, "k": [1, 2]}, "x": {"y": 1}})");
  const Svar user = parseJson(R"({"camera": {"k": [3], "new": {"z": 1}}, "x": 5, "more": null})");
  const Svar merged = defaults.merged(user);
  EXPECT_EQ(merged, parseJson(R"({"fps": 30, "camera": {"fx": 1, "k": [3], "new": {"z": 1}},
                                  "x": 5, "more": null})"));
  EXPECT_EQ(merged.members()[0].first, "fps");
  EXPECT_EQ(merged.members()[3].first, "more");
  EXPECT_EQ(Svar::object({{"a", 1}}).merged(parseJson(R"({"a": {"b": 2}})")),
            parseJson(R"({"a": {"b": 2}})"));
}

TEST(Merged, ReplacesWhatIsNoObject) {
  const Svar object = Svar::object({{"a", 1}});
  EXPECT_EQ(object.merged(nullptr), Svar());
  EXPECT_EQ(object.merged(3), Svar(3));
  EXPECT_EQ(Svar().merged(object), object);
  EXPECT_EQ(Svar::array({1}).merged(Svar::array({2, 3})), Svar::array({2, 3}));
  EXPECT_EQ(object.merged(parseJson(R"({"a": null})")), parseJson(R"({"a": null})"));
}

TEST(Merged, IsIndependentOfBoth) {
  const Svar below = parseJson(R"({"a": {"x": 1}, "b": [1]})");
  const Svar over = parseJson(R"({"a": {"y": 2}, "c": {"z": [3]}})");
  const Svar below_before = below.clone();
  const Svar over_before = over.clone();
  Svar merged = below.merged(over);
  merged.set("a.x", 7);
  merged.set("a.y", 7);
  merged.set("/b/-", 7);
  merged.set("/c/z/-", 7);
  EXPECT_EQ(below, below_before);
  EXPECT_EQ(over, over_before);
}

TEST(Merged, TakesOneObjectTwice) {
  const Svar part = Svar::object({{"x", 1}});
  const Svar config = Svar::object({{"a", part}, {"b", part}});
  EXPECT_EQ(config.merged(parseJson(R"({"a": {"x": 2}})")),
            parseJson(R"({"a": {"x": 2}, "b": {"x": 1}})"));
  EXPECT_EQ(config.merged(config), config);
}

TEST(Merged, HasItsPropertiesForRandomValues) {
  RandomValues random(1);
  for (int i = 0; i < 2000; ++i) {
    const Svar a = random.value(4);
    const Svar b = random.value(4);
    ASSERT_EQ(a.merged(a), a);
    ASSERT_EQ(a.merged(b).merged(b), a.merged(b));
    ASSERT_EQ(a.merged(7).merged(b), b);
    const Svar x = random.object(4);
    const Svar y = random.object(2);
    ASSERT_EQ(Svar::object().merged(x), x);
    ASSERT_EQ(x.merged(Svar::object()), x);
    const Svar both = x.merged(y);
    for (const Svar::Member& member : y.members()) {
      const std::string path = "/" + gslam::detail::escapeName(member.first);
      ASSERT_EQ(both[path], x.get<Svar>(path, nullptr).merged(member.second));
    }
    for (const Svar::Member& member : x.members()) {
      const std::string path = "/" + gslam::detail::escapeName(member.first);
      ASSERT_TRUE(y.contains(path) || both[path] == member.second);
    }
  }
}

}  // namespace
