// Reaching inside: names, indices and paths, and what is said when nothing is there.
#include <gslam/svar.h>
#include <gtest/gtest.h>

#include <cstdint>
#include <limits>
#include <string>
#include <vector>

#include "error_text.h"

namespace {

using gslam::Svar;
using gslam::SvarError;

Svar makeConfig() {
  return Svar::object({{"fps", 30},
                       {"camera", Svar::array({Svar::object({{"fx", 535.4}, {"model", "pinhole"}}),
                                               Svar::object()})},
                       {"none", nullptr}});
}

std::vector<std::string> names(const Svar& object) {
  std::vector<std::string> found;
  for (const Svar::Member& member : object.members()) found.push_back(member.first);
  return found;
}

TEST(Get, FollowsThePath) {
  const Svar config = makeConfig();
  EXPECT_EQ(config.get<int>("fps"), 30);
  EXPECT_EQ(config.get<double>("fps"), 30.0);
  EXPECT_EQ(config.get<double>("camera.0.fx"), 535.4);
  EXPECT_EQ(config.get<std::string>(std::string("camera.0.model")), "pinhole");
  EXPECT_EQ(config.get<Svar>("camera").size(), 2u);
  EXPECT_TRUE(config.get<Svar>("none").isNull());
  EXPECT_EQ(Svar::array({5, 6}).get<int>("1"), 6);
  EXPECT_EQ(Svar::object({{"7", "digits may be a name"}}).get<std::string>("7").size(), 20u);
}

TEST(Get, SaysThePathTheTypeFoundAndTheTypeAskedFor) {
  const Svar config = makeConfig();
  const auto text = [&](const char* path) { return errorText([&] { config.get<double>(path); }); };
  EXPECT_EQ(text("camera.0.model"), "camera.0.model: expected double, found string \"pinhole\"");
  EXPECT_EQ(text("camera"), "camera: expected double, found array of 2");
  EXPECT_EQ(text("none"), "none: expected double, found null");
  EXPECT_EQ(text("speed"),
            "speed: expected double, found nothing: no \"speed\" in the value (object of 3)");
  EXPECT_EQ(text("camera.0.fy"),
            "camera.0.fy: expected double, found nothing: no \"fy\" in camera.0 (object of 2)");
  EXPECT_EQ(text("camera.2.fx"),
            "camera.2.fx: expected double, found nothing: no \"2\" in camera (array of 2)");
  EXPECT_EQ(text("camera.fx"),
            "camera.fx: expected double, found nothing: no \"fx\" in camera (array of 2)");
  EXPECT_EQ(text("fps.x.y"), "fps.x.y: expected double, found nothing: no \"x\" in fps (int 30)");
  EXPECT_EQ(text("none.x"), "none.x: expected double, found nothing: no \"x\" in none (null)");
}

TEST(Get, ErrorCarriesThePath) {
  try {
    makeConfig().get<bool>("camera.0.fx");
    FAIL() << "a double is no bool";
  } catch (const SvarError& error) {
    EXPECT_EQ(error.path(), "camera.0.fx");
  }
}

TEST(GetWithDefault, IsForWhatIsMissing) {
  const Svar config = makeConfig();
  EXPECT_EQ(config.get<int>("fps", 5), 30);
  EXPECT_EQ(config.get<int>("speed", 5), 5);
  EXPECT_EQ(config.get<int>("tracker.deep.down", 5), 5);
  EXPECT_EQ(config.get<double>("camera.1.fx", 1), 1.0);
  EXPECT_EQ(config.get<double>("camera.2.fx", 1.0), 1.0);
  EXPECT_EQ(config.get<double>("camera.99999999999999999999999.fx", 1.0), 1.0);
  EXPECT_EQ(config.get<std::string>("name", "left"), "left");
  EXPECT_EQ(config.get<int>("none.x", 5), 5);
  EXPECT_EQ(Svar().get<int>("fps", 5), 5);
}

TEST(GetWithDefault, IsNotForTheWrongType) {
  const Svar config = makeConfig();
  EXPECT_EQ(errorText([&] { config.get<int>("camera.0.fx", 5); }),
            "camera.0.fx: expected int32, found double 535.4");
  EXPECT_THROW(config.get<int>("none", 5), SvarError);
  EXPECT_THROW(config.get<int>("fps.x", 5), SvarError);
  EXPECT_EQ(errorText([&] { config.get<int>("camera.fx", 5); }),
            "camera.fx: expected int32, found nothing: no \"fx\" in camera (array of 2)");
  EXPECT_THROW(config.get<int>("camera.-1", 5), SvarError);
  EXPECT_THROW(config.get<int>("camera.0x0", 5), SvarError);
  EXPECT_THROW(config.get<std::int8_t>("camera.0.fx", 5), SvarError);
}

TEST(Path, MalformedIsAlwaysAnError) {
  Svar config = makeConfig();
  EXPECT_EQ(errorText([&] { config.get<int>(""); }),
            "the path is empty, expected such as \"camera.0.fx\"");
  EXPECT_EQ(errorText([&] { config.get<int>("a..b"); }),
            "a..b: expected names with single dots between them, such as \"a.0.b\"");
  for (const char* path : {"", ".", "..", ".fps", "fps.", "a..b", "camera..0", "camera.0.fx."}) {
    EXPECT_THROW(config.get<int>(path), SvarError) << path;
    EXPECT_THROW(config.get<int>(path, 5), SvarError) << path;
    EXPECT_THROW(config.contains(path), SvarError) << path;
    EXPECT_THROW(config.set(path, 1), SvarError) << path;
    EXPECT_THROW(config.erase(path), SvarError) << path;
  }
  EXPECT_EQ(config, makeConfig());
}

TEST(Path, BadIndexFindsNothing) {
  const Svar list = Svar::array({1, 2});
  for (const char* path :
       {"2", "-1", "+1", "x", "1x", " 1", "1e0", "18446744073709551615", "18446744073709551616",
        "18446744073709551617", "99999999999999999999999999999999"}) {
    EXPECT_FALSE(list.contains(path)) << path;
    EXPECT_THROW(list.get<int>(path), SvarError) << path;
  }
  EXPECT_TRUE(list.contains("1"));
}

TEST(Contains, AsksForSomethingBeItNull) {
  const Svar config = makeConfig();
  EXPECT_TRUE(config.contains("none"));
  EXPECT_TRUE(config.contains("camera.1"));
  EXPECT_FALSE(config.contains("camera.1.fx"));
  EXPECT_FALSE(config.contains("fps.x"));
  EXPECT_FALSE(Svar().contains("a"));
  EXPECT_FALSE(Svar(3).contains("a"));
}

TEST(Index, ReadsElementsAndMembers) {
  const Svar config = makeConfig();
  EXPECT_EQ(config["camera"][0]["fx"].as<double>(), 535.4);
  EXPECT_EQ(config[std::string("fps")], Svar(30));
  EXPECT_EQ(Svar::object({{"a.b", 1}, {"", 2}})["a.b"], 1);  // no path
  EXPECT_EQ(Svar::object({{"a.b", 1}, {"", 2}})[""], 2);
  EXPECT_EQ(Svar::array({1, 2})[std::uint8_t(1)], 2);
}

TEST(Index, SaysWhatIsNotThere) {
  const Svar list = Svar::array({1, 2});
  EXPECT_EQ(errorText([&] { list[2]; }),
            "2: expected an element, found nothing: no \"2\" in the value (array of 2)");
  EXPECT_EQ(errorText([&] { list[-1]; }),
            "-1: expected an element, found nothing: no \"-1\" in the value (array of 2)");
  EXPECT_THROW(list[std::numeric_limits<std::int64_t>::min()], SvarError);
  EXPECT_THROW(list[std::numeric_limits<std::uint64_t>::max()], SvarError);
  EXPECT_EQ(errorText([&] { Svar(3)["x"]; }),
            "x: expected any value, found nothing: no \"x\" in the value (int 3)");
  EXPECT_THROW(Svar::object({{"0", 1}})[0], SvarError);
  EXPECT_THROW(Svar()["x"], SvarError);
}

TEST(Set, MakesTheObjectsOnTheWay) {
  Svar config;
  config.set("camera.left.fx", 1.5);
  config.set("camera.left.fy", 2);
  config.set("camera.0", "digits are a name in an object");
  EXPECT_EQ(config,
            Svar::object({{"camera", Svar::object({{"left", Svar::object({{"fx", 1.5}, {"fy", 2}})},
                                                   {"0",
                                                    "digits are a name in an "
                                                    "object"}})}}));
  config.set("a", nullptr);
  config.set("a.b", 1);  // a null on the way is as nothing
  EXPECT_EQ(config.get<int>("a.b"), 1);
}

TEST(Set, ReplacesInPlace) {
  Svar config = makeConfig();
  config.set("fps", "fast");
  config.set("camera.1", 7);
  config.set("camera.0.fx", Svar::array());
  EXPECT_EQ(names(config), (std::vector<std::string>{"fps", "camera", "none"}));
  EXPECT_EQ(config["fps"], "fast");
  EXPECT_EQ(config["camera"][1], 7);
  EXPECT_EQ(config["camera"][0]["fx"].size(), 0u);
}

TEST(Set, RefusesAndChangesNothing) {
  Svar config = makeConfig();
  EXPECT_EQ(errorText([&] { config.set("fps.x", 1); }),
            "fps.x: cannot be set: no \"x\" in fps (int 30)");
  EXPECT_EQ(errorText([&] { config.set("camera.2", 1); }),
            "camera.2: cannot be set: no \"2\" in camera (array of 2)");
  EXPECT_THROW(config.set("camera.2.fx", 1), SvarError);
  EXPECT_THROW(config.set("camera.fx", 1), SvarError);
  EXPECT_EQ(config, makeConfig());
  Svar number = 3;
  EXPECT_THROW(number.set("x", 1), SvarError);
  EXPECT_EQ(number, 3);
}

TEST(Set, TakesNamesAndValuesFromTheSameObject) {
  Svar config = Svar::object({{"a", 1}});
  for (int i = 0; i < 100; ++i) config.set("copy" + std::to_string(i), config["a"]);
  config.set(config.members()[0].first, "new");
  EXPECT_EQ(config["a"], "new");
  EXPECT_TRUE(config.erase(config.members()[0].first));
  EXPECT_EQ(config.size(), 100u);
  EXPECT_FALSE(config.contains("a"));
}

TEST(PushBack, AppendsToArraysAndNulls) {
  Svar list;
  list.push_back(1);
  list.push_back("two");
  list.push_back(list[0]);
  EXPECT_EQ(list, Svar::array({1, "two", 1}));
  Svar object = Svar::object();
  EXPECT_EQ(errorText([&] { object.push_back(1); }), "expected array, found object of 0");
}

TEST(Erase, RemovesMembersAndElements) {
  Svar config = makeConfig();
  EXPECT_TRUE(config.erase("camera.0"));
  EXPECT_EQ(config["camera"], Svar::array({Svar::object()}));
  EXPECT_FALSE(config.erase("camera.1"));
  EXPECT_FALSE(config.erase("fps.x"));
  EXPECT_FALSE(config.erase("nothing"));
  EXPECT_TRUE(config.erase("fps"));
  EXPECT_EQ(names(config), (std::vector<std::string>{"camera", "none"}));
}

TEST(Order, IsThatOfInsertion) {
  Svar object;
  std::vector<std::string> expected;
  for (int i = 0; i < 1000; ++i) {
    expected.push_back("n" + std::to_string(i * 7919 % 1000));
    object.set(expected.back(), i);
  }
  EXPECT_EQ(names(object), expected);
  for (std::size_t i = 0; i < 1000; i += 2) EXPECT_TRUE(object.erase(expected[i]));
  for (std::size_t i = 0; i < 1000; ++i) {
    EXPECT_EQ(object.get<int>(expected[i], -1), i % 2 == 0 ? -1 : static_cast<int>(i));
  }
  object.set(expected[0], 0);  // goes to the end
  EXPECT_EQ(object.members()[500].first, expected[0]);
  EXPECT_EQ(object.clone().members()[500].first, expected[0]);
}

TEST(Iteration, GoesThroughElements) {
  const Svar config = Svar::object({{"list", Svar::array({1, 2, 3})}});
  int sum = 0;
  for (const Svar& element : config["list"]) sum += element.as<int>();
  EXPECT_EQ(sum, 6);
  EXPECT_EQ(Svar().begin(), Svar().end());
  EXPECT_TRUE(Svar().members().empty());
  EXPECT_EQ(errorText([&] { config.begin(); }), "expected array, found object of 1");
  EXPECT_EQ(errorText([] { Svar(2).members(); }), "expected object, found int 2");
}

TEST(Size, CountsElementsAndMembers) {
  EXPECT_EQ(Svar().size(), 0u);
  EXPECT_EQ(Svar::array({1, 2}).size(), 2u);
  EXPECT_EQ(makeConfig().size(), 3u);
  EXPECT_EQ(errorText([] { Svar("abc").size(); }),
            "expected array or object, found string \"abc\"");
}

}  // namespace
