// Frozen values: nobody can change them, so threads may share them.
#include <gslam/svar.h>
#include <gtest/gtest.h>

#include <memory>
#include <string>
#include <thread>
#include <utility>
#include <vector>

#include "error_text.h"
#include "nested.h"

namespace {

using gslam::Svar;
using gslam::SvarError;

Svar thawed() {
  return Svar::object({{"fps", 30},
                       {"a.b", 1},
                       {"none", nullptr},
                       {"camera", Svar::array({Svar::object({{"fx", 535.4}}), Svar::array()})}});
}

TEST(Frozen, IsAnEqualCopy) {
  Svar config = thawed();
  const Svar frozen = config.frozen();
  EXPECT_EQ(frozen, config);
  EXPECT_EQ(frozen.hash(), config.hash());
  EXPECT_EQ(frozen.members()[0].first, "fps");
  EXPECT_TRUE(frozen.isFrozen());
  EXPECT_FALSE(config.isFrozen());
  config.set("fps", 60);
  config.set("camera.0.fx", 1);
  EXPECT_EQ(frozen, thawed());
}

TEST(Frozen, AreAllButArraysAndObjectsFromTheBeginning) {
  for (const Svar& value : {Svar(), Svar(true), Svar(1), Svar(1.5), Svar("a"), Svar::binary("a", 1),
                            Svar::function([] {}), Svar(std::make_shared<int>(1))}) {
    EXPECT_TRUE(value.isFrozen()) << value.typeName();
    EXPECT_EQ(value.frozen(), value);
  }
  EXPECT_FALSE(Svar::array().isFrozen());
  EXPECT_FALSE(Svar::object().isFrozen());
  EXPECT_TRUE(Svar::array().frozen().isFrozen());
}

TEST(Frozen, RefusesAllWrites) {
  Svar frozen = thawed().frozen();
  EXPECT_EQ(errorText([&] { frozen.set("fps", 1); }),
            "fps: cannot be changed: the object of 4 is frozen; clone() it first");
  EXPECT_EQ(errorText([&] { frozen.set("/camera/-", 1); }),
            "/camera/-: cannot be changed: the array of 2 is frozen; clone() it first");
  EXPECT_EQ(errorText([&] { frozen.erase("camera.0.fx"); }),
            "camera.0.fx: cannot be changed: the object of 1 is frozen; clone() it first");
  for (const char* path : {"fps", "new", "a.b", "a.c", "none", "none.x", "camera", "camera.0",
                           "camera.0.fx", "camera.0.new.deep", "/camera/-", "/camera/1/-"}) {
    EXPECT_THROW(frozen.set(path, 1), SvarError) << path;
    EXPECT_THROW(frozen.set(path, frozen), SvarError) << path;
  }
  for (const char* path : {"fps", "a.b", "none", "camera", "camera.0", "camera.0.fx"}) {
    EXPECT_THROW(frozen.erase(path), SvarError) << path;
  }
  EXPECT_FALSE(frozen.erase("new"));
  EXPECT_EQ(frozen, thawed());
}

TEST(Frozen, RefusesWritesThroughHandlesOfItsParts) {
  const Svar frozen = thawed().frozen();
  Svar camera = frozen["camera"];
  EXPECT_TRUE(camera.isFrozen());
  EXPECT_EQ(errorText([&] { camera.push_back(1); }),
            "cannot be changed: the array of 2 is frozen; clone() it first");
  EXPECT_THROW(camera.set("0", 1), SvarError);
  EXPECT_THROW(camera.erase("0"), SvarError);
  for (const Svar& element : frozen["camera"]) EXPECT_TRUE(element.isFrozen());
  camera = 7;  // only this handle
  EXPECT_EQ(frozen, thawed());
}

TEST(Frozen, MayStandInWhatIsNot) {
  const Svar part = Svar::object({{"x", 1}}).frozen();
  Svar config = Svar::object({{"part", part}, {"list", Svar::array({part})}});
  EXPECT_FALSE(config.isFrozen());
  EXPECT_THROW(config.set("part.x", 2), SvarError);
  EXPECT_THROW(config.set("part.y.z", 2), SvarError);
  EXPECT_THROW(config.erase("list.0.x"), SvarError);
  config.set("part", 2);  // replaced, not changed
  config.set("list.0", 3);
  config.set("again", part);
  EXPECT_TRUE(config.erase("again"));
  EXPECT_EQ(config, Svar::object({{"part", 2}, {"list", Svar::array({3})}}));
  EXPECT_EQ(part, Svar::object({{"x", 1}}));
}

TEST(Frozen, SharesWhatIsFrozenAlready) {
  const Svar part = Svar::array({1, 2}).frozen();
  const Svar again = part.frozen();
  EXPECT_EQ(again.begin(), part.begin());
  const Svar whole = Svar::object({{"a", part}, {"b", Svar::array({3})}}).frozen();
  EXPECT_EQ(whole["a"].begin(), part.begin());
  EXPECT_TRUE(whole["b"].isFrozen());
}

TEST(Frozen, CloneCanBeWritten) {
  const Svar frozen = thawed().frozen();
  Svar copy = frozen.clone();
  EXPECT_FALSE(copy.isFrozen());
  copy.set("camera.0.fx", 1.5);
  copy.set("/camera/1/-", 2);
  copy.set("none.x", 3);
  EXPECT_TRUE(copy.erase("a.b"));
  EXPECT_EQ(copy.get<double>("camera.0.fx"), 1.5);
  EXPECT_EQ(frozen, thawed());
  Svar merged = frozen.merged(Svar::object({{"fps", 60}}).frozen());
  merged.set("camera.0.fx", 1);
  Svar patched = frozen.patched(Svar::array());
  patched.set("fps", 1);
  EXPECT_EQ(frozen, thawed());
}

TEST(Frozen, CannotContainItself) {
  const Svar frozen = Svar::array({1}).frozen();
  Svar other = Svar::array({frozen, frozen});
  other.push_back(frozen);
  EXPECT_THROW(other.push_back(other), SvarError);
  EXPECT_EQ(other.frozen(), other);
}

TEST(Frozen, DeepValuesDoNotOverflowTheStack) {
  const int depth = 1000000;
  const Svar deep = nested(depth).frozen();
  EXPECT_TRUE(deep.isFrozen());
  Svar copy = deep.clone();
  EXPECT_EQ(copy, deep);
  EXPECT_EQ(copy.hash(), deep.hash());
  EXPECT_EQ(deep.frozen(), deep);
  EXPECT_EQ(copy.merged(deep), deep);
  EXPECT_EQ(deep.diff(deep).size(), 0u);
  copy = Svar::function([copy] { return copy; });
}

TEST(FrozenThreads, ReadCopyAndDestroyOneValue) {
  Svar config = thawed().frozen();
  std::vector<std::thread> threads;
  for (int t = 0; t < 8; ++t) {
    threads.emplace_back([config] {
      for (int i = 0; i < 500; ++i) {
        Svar mine = config;
        Svar camera = mine["camera"];
        mine = nullptr;
        ASSERT_EQ(camera.get<double>("0.fx"), 535.4);
        ASSERT_THROW(camera.push_back(1), SvarError);
        std::vector<Svar> handles(10, camera["0"]);
        ASSERT_EQ(handles.back(), camera[0]);
        ASSERT_EQ(config.frozen().hash(), config.hash());
        Svar own = config.clone();
        own.set("camera.0.fx", i);
        ASSERT_EQ(config.merged(own), own);
        ASSERT_EQ(config.patched(config.diff(own)), own);
        ASSERT_EQ(gslam::printJson(config).size(), gslam::printJson(thawed()).size());
      }
    });
  }
  config = Svar();  // the last thread frees it
  for (std::thread& thread : threads) thread.join();
}

TEST(FrozenThreads, EachMayPutItIntoItsOwnValues) {
  const Svar part = thawed().frozen();
  std::vector<std::thread> threads;
  for (int t = 0; t < 4; ++t) {
    threads.emplace_back([&part] {
      Svar mine = Svar::object();
      for (int i = 0; i < 500; ++i) {
        mine.set("part", part);
        mine.set("list", Svar::array({part["camera"], mine["part"]}));
        ASSERT_THROW(mine.set("part.fps", 1), SvarError);
        ASSERT_TRUE(mine.erase("list.0"));
      }
      ASSERT_EQ(mine["part"], part);
    });
  }
  for (std::thread& thread : threads) thread.join();
}

}  // namespace
