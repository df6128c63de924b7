// Values and handles: copying, sharing, cloning, comparing, and what may contain what.
#include <gslam/svar.h>
#include <gtest/gtest.h>

#include <cmath>
#include <string>
#include <thread>
#include <utility>
#include <vector>

#include "error_text.h"
#include "nested.h"

namespace {

using gslam::Svar;
using gslam::SvarError;

TEST(Handle, ScalarsAndStringsAreValues) {
  Svar a = 1, b = a;
  b = 2;
  EXPECT_EQ(a, Svar(1));
  a = "abc";
  b = a;
  b = "x";
  EXPECT_EQ(a, Svar("abc"));
}

TEST(Handle, CopiesOfArraysAndObjectsAreShared) {
  Svar array = Svar::array({1});
  Svar same = array;
  same.push_back(2);
  EXPECT_EQ(array, Svar::array({1, 2}));

  const Svar config = Svar::object({{"camera", Svar::object({{"fx", 1.0}})}});
  Svar camera = config["camera"];
  camera.set("fx", 2.0);
  EXPECT_EQ(config.get<double>("camera.fx"), 2.0);

  same = Svar::array();  // another array from now on
  EXPECT_EQ(array.size(), 2u);
}

TEST(Handle, BinariesAreValuesWhoseBytesOutliveTheHandle) {
  std::string bytes(100, 'x');
  Svar binary = Svar::binary(bytes.data(), bytes.size());
  bytes.assign(100, 'y');
  const Svar copy = binary;
  binary = nullptr;
  EXPECT_EQ(copy.bytes()[99], 'x');
  EXPECT_EQ(copy, Svar::binary(std::string(100, 'x').data(), 100));
  EXPECT_EQ(copy.hash(), copy.clone().hash());
  EXPECT_NE(copy, Svar(std::string(100, 'x')));
}

TEST(Handle, NullSharesNothing) {
  Svar a;
  Svar b = a;
  b.set("x", 1);
  EXPECT_TRUE(a.isNull());
}

TEST(Handle, MovingLeavesNullBehind) {
  for (Svar from : {Svar(true), Svar(2), Svar(2.5), Svar("abc"), Svar::array({1})}) {
    const Svar before = from;
    const Svar to = std::move(from);
    EXPECT_TRUE(from.isNull());  // NOLINT: what a move leaves is the point
    EXPECT_EQ(to, before);
  }
  Svar array = Svar::array({1});
  Svar& self = array;
  array = self;
  EXPECT_EQ(array.size(), 1u);
}

TEST(Clone, SharesNothing) {
  Svar inner = Svar::array({1, "two"});
  const Svar original = Svar::object({{"list", inner}, {"again", inner}, {"n", nullptr}});
  Svar copy = original.clone();
  EXPECT_EQ(copy, original);
  EXPECT_EQ(copy.members()[0].first, "list");
  inner.push_back(3);
  EXPECT_EQ(copy.get<Svar>("list").size(), 2u);
  copy.set("list.0", 100);
  EXPECT_EQ(original.get<int>("list.0"), 1);
  EXPECT_EQ(copy.get<int>("again.0"), 1);  // held twice, cloned twice
  EXPECT_EQ(Svar(5).clone(), Svar(5));
}

TEST(Equality, NeedsTypeAndValue) {
  EXPECT_EQ(Svar(), Svar(nullptr));
  EXPECT_EQ(Svar(1), 1);
  EXPECT_NE(Svar(1), Svar(1.0));
  EXPECT_NE(Svar(1), Svar(true));
  EXPECT_NE(Svar(), Svar(false));
  EXPECT_NE(Svar(""), Svar());
  EXPECT_EQ(Svar(0.0), Svar(-0.0));
  EXPECT_NE(Svar("a"), Svar("b"));
  EXPECT_NE(Svar::array(), Svar::object());
}

TEST(Equality, IsDeepAndBlindToTheOrderOfMembers) {
  const auto make = [](int last) {
    return Svar::array({1, Svar::object({{"a", Svar::array({last})}, {"b", "x"}})});
  };
  EXPECT_EQ(make(1), make(1));
  EXPECT_NE(make(1), make(2));
  EXPECT_EQ(Svar::object({{"a", 1}, {"b", 2}}), Svar::object({{"b", 2}, {"a", 1}}));
  EXPECT_NE(Svar::object({{"a", 1}}), Svar::object({{"b", 1}}));
  EXPECT_NE(Svar::object({{"a", 1}}), Svar::object({{"a", 1}, {"b", 1}}));
  EXPECT_NE(Svar::array({1, 2}), Svar::array({2, 1}));
  EXPECT_NE(Svar::array({1}), Svar::array({1, 1}));
}

TEST(Equality, NanDiffersButAnArrayEqualsItself) {
  const Svar nan = std::nan("");
  EXPECT_NE(nan, nan);
  const Svar array = Svar::array({nan});
  EXPECT_EQ(array, array);
  EXPECT_NE(array, array.clone());
}

TEST(Cycle, IsRefusedAndChangesNothing) {
  Svar array = Svar::array({1});
  EXPECT_EQ(errorText([&] { array.push_back(array); }),
            "cannot be appended: the array of 1 would contain itself");
  EXPECT_EQ(array, Svar::array({1}));

  Svar object = Svar::object({{"a", Svar::object()}});
  EXPECT_EQ(errorText([&] { object.set("a.new.b", object); }),
            "a.new.b: cannot be set: the object of 1 would contain itself");
  EXPECT_THROW(object.set("self", object), SvarError);
  EXPECT_THROW(object.set("a", object), SvarError);
  EXPECT_THROW(object.set("a.b", object["a"]), SvarError);
  EXPECT_EQ(object, Svar::object({{"a", Svar::object()}}));
}

TEST(Cycle, IsFoundThroughOtherHandlesAndDeepDown) {
  Svar outer = Svar::array();
  Svar inner = Svar::object();
  outer.push_back(Svar::array({Svar::object({{"x", inner}})}));
  EXPECT_THROW(inner.set("back", outer), SvarError);
  EXPECT_THROW(inner.set("back", Svar::array({outer})), SvarError);
  EXPECT_THROW(inner.set("p.q.r", outer), SvarError);
  EXPECT_EQ(inner.size(), 0u);
  inner.set("n", nullptr);  // a null on the way, inside of what is shared
  EXPECT_THROW(inner.set("n.back", outer), SvarError);
  EXPECT_TRUE(inner["n"].isNull());
}

TEST(Cycle, SharingWithoutOneIsAllowed) {
  Svar part = Svar::array({1});
  Svar object = Svar::object({{"a", part}});
  object.set("b", part);
  object.set("a", part);  // what is there already
  object.set("c", Svar::array({part, part}));
  part.push_back(2);
  EXPECT_EQ(object.get<int>("c.1.1"), 2);
  // The move leaves null, which becomes an object around the old one.
  Svar& alias = object;
  alias.set("d", std::move(object));  // NOLINT(clang-analyzer-cplusplus.Move)
  EXPECT_EQ(alias.size(), 1u);
  EXPECT_EQ(alias.get<int>("d.a.1"), 2);
}

TEST(Cycle, CheckVisitsWhatIsHeldManyTimesOnce) {
  Svar doubled = Svar::array();
  for (int i = 0; i < 200; ++i) doubled = Svar::array({doubled, doubled});  // 2^200 ways down
  Svar target = Svar::array();
  const Svar second = target;
  target.push_back(doubled);
  EXPECT_EQ(target.size(), 1u);
}

TEST(Depth, DoesNotOverflowTheStack) {
  const int depth = 300000;
  Svar deep = nested(depth);
  const Svar copy = deep.clone();
  EXPECT_EQ(copy, deep);
  EXPECT_NE(nested(depth - 3), deep);
  Svar target = Svar::array();
  const Svar second = target;
  target.push_back(deep);
  EXPECT_THROW(target.push_back(Svar::array({target, deep})), SvarError);
  deep = Svar();
  EXPECT_EQ(second.size(), 1u);
}

TEST(Threads, ReadOneObjectAtTheSameTime) {
  Svar config = Svar::object({{"a", Svar::array({1, 2, 3})}, {"name", "left"}});
  std::vector<std::thread> threads;
  for (int t = 0; t < 4; ++t) {
    threads.emplace_back([config] {
      for (int i = 0; i < 1000; ++i) {
        const Svar list = config["a"];
        ASSERT_EQ(list.get<int>("2"), 3);
        ASSERT_EQ(config.get<std::string>("name"), "left");
        ASSERT_EQ(config.clone(), config);
      }
    });
  }
  config = Svar();  // the last thread frees it
  for (std::thread& thread : threads) thread.join();
}

}  // namespace
