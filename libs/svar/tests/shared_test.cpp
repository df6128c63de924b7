// A tree that threads share: changes as a whole, bound variables, callbacks.
#include <gslam/svar.h>
#include <gtest/gtest.h>

#include <atomic>
#include <cmath>
#include <cstdint>
#include <limits>
#include <map>
#include <memory>
#include <stdexcept>
#include <string>
#include <thread>
#include <vector>

#include "error_text.h"

namespace {

using gslam::Bound;
using gslam::SharedSvar;
using gslam::Svar;
using gslam::SvarError;

Svar camera(double f) {
  return Svar::object({{"fx", f}, {"fy", f}});
}

TEST(SharedSvar, ReadsWhatWasWritten) {
  SharedSvar tree;
  tree.set("camera.fx", 500);
  tree.set("camera.model", "pinhole");
  EXPECT_EQ(tree.get<double>("camera.fx"), 500);
  EXPECT_EQ(tree.get<std::string>("camera/model"), "pinhole");
  EXPECT_EQ(tree.get<int>("fps", 30), 30);
  EXPECT_TRUE(tree.contains("camera"));
  EXPECT_EQ(tree["camera"]["fx"], 500);
  tree.merge(Svar::object({{"camera", camera(2)}, {"fps", 25}}));
  EXPECT_EQ(tree.get<std::string>("camera.model"), "pinhole");
  EXPECT_EQ(tree.get<double>("camera.fy"), 2);
  EXPECT_TRUE(tree.erase("camera"));
  EXPECT_FALSE(tree.erase("camera"));
  EXPECT_EQ(tree.snapshot(), Svar::object({{"fps", 25}}));
  EXPECT_EQ(errorText([&] { tree.get<int>("camera.fx"); }),
            "camera.fx: expected int32, found nothing: no \"camera\" in the value (object of 1)");
}

TEST(SharedSvar, SnapshotStaysAsItWas) {
  SharedSvar tree(Svar::object({{"a", Svar::array({1, Svar::object({{"b", 2}})})}}));
  const Svar before = tree.snapshot();
  tree.set("a.1.b", 3);
  tree.set("c", 4);
  EXPECT_EQ(before, Svar::object({{"a", Svar::array({1, Svar::object({{"b", 2}})})}}));
  EXPECT_EQ(tree.get<int>("a.1.b"), 3);
  Svar copy = before;
  EXPECT_THROW(copy.set("c", 1), SvarError);
}

TEST(SharedSvar, SharesWhatAChangeLeavesAlone) {
  SharedSvar tree(Svar::object({{"big", Svar::array({1, 2, 3})}, {"small", 1}}));
  const Svar before = tree["big"];
  tree.set("small", 2);
  EXPECT_EQ(before.begin(), tree["big"].begin());
}

TEST(SharedSvar, KeepsNothingOfTheWriter) {
  Svar mine = camera(1);
  SharedSvar tree(Svar::object({{"camera", mine}}));
  tree.set("second", mine);
  mine.set("fx", 2);
  EXPECT_EQ(tree.get<double>("camera.fx"), 1);
  EXPECT_EQ(tree.get<double>("second.fx"), 1);
}

TEST(Bind, FollowsTheValue) {
  SharedSvar tree;
  const Bound<double>& fps = tree.bind<double>("player.fps", 30);
  EXPECT_EQ(fps, 30);
  EXPECT_EQ(tree.get<double>("player.fps"), 30);
  tree.set("player.fps", 25);
  EXPECT_EQ(fps.get(), 25);
  tree.set("player", Svar::object({{"fps", 12.5}}));
  EXPECT_EQ(fps, 12.5);
  tree.merge(Svar::object({{"player", Svar::object({{"fps", 1}})}}));
  EXPECT_EQ(fps, 1);
  const auto& same = tree.bind<double>("player.fps");
  EXPECT_EQ(&same, &fps);
  EXPECT_EQ(tree.bind<int>("player.fps"), 1);
}

TEST(Bind, TakesStringsContainersAndObjects) {
  SharedSvar tree;
  const auto& name = tree.bind<std::string>("name", "left");
  const auto& list = tree.bind<std::vector<int>>("list", {1, 2});
  const auto& part = tree.bind<Svar>("part", Svar::object({{"x", 1}}));
  tree.set("name", "right");
  tree.set("list.0", 7);
  tree.set("part.x", 2);
  EXPECT_EQ(name.get(), "right");
  EXPECT_EQ(list.get(), (std::vector<int>{7, 2}));
  EXPECT_EQ(part.get(), Svar::object({{"x", 2}}));
}

// The predecessor's reference dangled once another type was stored.
TEST(Bind, RefusesWhatTheVariableCannotTake) {
  SharedSvar tree(Svar::object({{"fps", 30}, {"camera", camera(1)}}));
  const Bound<int>& fps = tree.bind<int>("fps");
  const Bound<double>& fx = tree.bind<double>("camera.fx");
  const Svar before = tree.snapshot();
  EXPECT_EQ(errorText([&] { tree.set("fps", "fast"); }),
            "fps: expected int32, found string \"fast\"");
  EXPECT_EQ(errorText([&] { tree.set("fps", 2.75); }), "fps: expected int32, found double 2.75");
  EXPECT_EQ(errorText([&] { tree.set("camera", Svar::object()); }),
            "camera.fx: cannot be removed: it is in use");
  EXPECT_THROW(tree.set("camera", 1), SvarError);
  EXPECT_THROW(tree.erase("fps"), SvarError);
  EXPECT_THROW(tree.merge(Svar::object({{"new", 1}, {"fps", nullptr}})), SvarError);
  EXPECT_EQ(tree.snapshot(), before);
  EXPECT_EQ(fps, 30);
  EXPECT_EQ(fx, 1);
  EXPECT_THROW(tree.bind<bool>("fps"), SvarError);
  EXPECT_THROW(tree.bind<int>("nothing"), SvarError);
  EXPECT_THROW(tree.bind<int>("camera.fy.z", 1), SvarError);
  tree.set("camera.fy", "anything: nobody is bound to it");
}

TEST(Bind, CopyOutlivesTheTree) {
  const auto copy = [] {
    SharedSvar tree;
    Bound<int> made = tree.bind<int>("x", 1);
    tree.set("x", 2);
    return made;
  }();
  EXPECT_EQ(copy, 2);
}

TEST(Bind, VersionGrowsWithChangesOnly) {
  SharedSvar tree(Svar::object({{"x", 1}}));
  const Bound<int>& x = tree.bind<int>("x");
  const std::uint64_t first = x.version();
  tree.set("y", 1);
  tree.set("x", 1);
  EXPECT_EQ(x.version(), first);
  tree.set("x", 2);
  EXPECT_GT(x.version(), first);
}

TEST(Bind, KnowsZeroesAndNaNsApart) {
  SharedSvar tree;
  const Bound<double>& x = tree.bind<double>("x", 0.0);
  const auto& list = tree.bind<std::vector<double>>("list", {0.0});
  tree.set("x", -0.0);
  tree.set("list", Svar::array({-0.0}));
  EXPECT_TRUE(std::signbit(x.get()));
  EXPECT_TRUE(std::signbit(list.get()[0]));
  int calls = 0;
  tree.set("x", std::nan(""));
  const std::uint64_t version = x.version();
  const gslam::Watch watch = tree.watch("x", [&](const Svar&) { ++calls; });
  tree.set("y", 1);
  tree.set("x", std::nan(""));
  EXPECT_EQ(calls, 0);
  EXPECT_EQ(x.version(), version);
}

// Becomes a Svar and back, but not every time.
struct Fussy {
  static bool& refuses() {
    static bool flag = false;
    return flag;
  }
  int value;
};

}  // namespace
namespace gslam {
template <>
struct SvarTraits<Fussy> {
  static Svar toSvar(const Fussy& from) { return from.value; }
  static Fussy fromSvar(const Svar& value) {
    if (Fussy::refuses()) throw std::runtime_error("not now");
    return {value.as<int>()};
  }
};
}  // namespace gslam
namespace {

TEST(Bind, ChangesNothingWhereAVariableCannotTakeIt) {
  SharedSvar tree(Svar::object({{"a", 1}, {"b", 1}}));
  const Bound<int>& a = tree.bind<int>("a");
  const Bound<Fussy>& b = tree.bind<Fussy>("b");
  int calls = 0;
  const gslam::Watch watch = tree.watch("a", [&](const Svar&) { ++calls; });
  Fussy::refuses() = true;
  EXPECT_THROW(tree.merge(Svar::object({{"a", 2}, {"b", 2}})), std::runtime_error);
  EXPECT_THROW(tree.bind<Fussy>("c", Fussy{1}), std::runtime_error);
  Fussy::refuses() = false;
  EXPECT_FALSE(tree.contains("c"));
  EXPECT_EQ(a, 1);
  EXPECT_EQ(b.get().value, 1);
  tree.set("other", 1);
  EXPECT_EQ(calls, 0);
}

TEST(Bind, LeavesNoRuleWhereItFails) {
  SharedSvar tree(Svar::object({{"sizes", Svar::object()}, {"list", Svar::array()}}));
  tree.bind<std::map<std::string, int>>("sizes");
  EXPECT_THROW(tree.bind<std::string>("sizes.name", "x"), SvarError);
  EXPECT_THROW(tree.bind<int>("list/-", 1), SvarError);
  EXPECT_EQ(tree.get<Svar>("list").size(), 0u);
  EXPECT_NO_THROW(tree.set("other", 1));
}

TEST(Bind, PutsItsValueInOneStep) {
  SharedSvar tree;
  const gslam::Watch thief = tree.watch("x", [&](const Svar&) {
    EXPECT_THROW(tree.erase("x"), SvarError);  // it is bound already
  });
  EXPECT_EQ(tree.bind<int>("x", 1), 1);
}

TEST(Bind, FollowsOneValueUnderAllItsPaths) {
  SharedSvar tree;
  const Bound<int>& dots = tree.bind<int>("a.b", 1);
  const Bound<int>& slashes = tree.bind<int>("a/b");
  const Bound<int>& pointer = tree.bind<int>("/a/b");
  tree.set("a/b", 2);
  EXPECT_EQ(dots + slashes + pointer, 6);
  tree.set("/a.b", 3);  // a member of that name comes first
  EXPECT_EQ(dots, tree.get<int>("a.b"));
  EXPECT_EQ(slashes, 2);
  EXPECT_THROW(tree.set("/a.b", "text"), SvarError);
  EXPECT_TRUE(tree.erase("/a.b"));
  EXPECT_EQ(dots, 2);
}

TEST(Watch, IsToldOfChanges) {
  SharedSvar tree(Svar::object({{"camera", camera(1)}, {"fps", 30}}));
  std::vector<Svar> seen;
  gslam::Watch watch = tree.watch("camera", [&](const Svar& value) { seen.push_back(value); });
  tree.set("fps", 25);
  tree.set("camera.fx", 1.0);  // what it is already
  EXPECT_TRUE(seen.empty());
  tree.set("camera.fx", 2);
  tree.erase("camera");
  tree.set("camera", 3);
  EXPECT_EQ(seen, (std::vector<Svar>{Svar::object({{"fx", 2}, {"fy", 1.0}}), Svar(), 3}));
  watch.reset();
  tree.set("camera", 4);
  EXPECT_EQ(seen.size(), 3u);
}

TEST(Watch, MayWriteAndEndItself) {
  SharedSvar tree(Svar::object({{"a", 0}, {"b", 0}}));
  std::vector<int> seen;
  gslam::Watch a = tree.watch("a", [&](const Svar& value) {
    tree.set("b", value.as<int>() * 10);
    seen.push_back(value.as<int>());
    if (value == 2) a.reset();
  });
  gslam::Watch b = tree.watch("b", [&](const Svar& value) { seen.push_back(value.as<int>()); });
  for (int i = 1; i < 4; ++i) tree.set("a", i);
  EXPECT_EQ(seen, (std::vector<int>{1, 10, 2, 20}));
  EXPECT_EQ(tree.get<int>("b"), 20);
}

TEST(Watch, HandsOnWhatACallbackThrowsAfterTheOthers) {
  SharedSvar tree;
  int calls = 0;
  const gslam::Watch bad = tree.watch("x", [](const Svar&) { throw std::runtime_error("no"); });
  const gslam::Watch good = tree.watch("x", [&](const Svar&) { ++calls; });
  EXPECT_THROW(tree.set("x", 1), std::runtime_error);
  EXPECT_EQ(calls, 1);
  EXPECT_EQ(tree.get<int>("x"), 1);
  EXPECT_THROW(tree.set("x", 2), std::runtime_error);
  EXPECT_EQ(calls, 2);
}

TEST(Watch, OutlivesTheTree) {
  gslam::Watch watch;
  {
    SharedSvar tree;
    watch = tree.watch("x", [](const Svar&) {});
    watch = tree.watch("y", [](const Svar&) {});
  }
  watch.reset();
  EXPECT_THROW(watch = SharedSvar().watch("a..b", [](const Svar&) {}), SvarError);
}

// Uses the tree as it goes.
struct Farewell {
  ~Farewell() { tree.set("gone", tree.get<int>("gone", 0) + 1); }
  SharedSvar& tree;
};

TEST(SharedSvar, DestroysWhatItHeldWithoutItsLock) {
  SharedSvar tree;
  tree.set("object", std::shared_ptr<Farewell>(new Farewell{tree}));
  tree.bind<std::shared_ptr<Farewell>>("object");
  tree.set("object", std::shared_ptr<Farewell>());
  EXPECT_EQ(tree.get<int>("gone"), 1);
}

TEST(Watch, DestroysItsCallbackWhenItEnds) {
  SharedSvar tree;
  gslam::Watch watch;
  for (int i = 0; i < 3; ++i) {
    const std::shared_ptr<Farewell> captured(new Farewell{tree});
    watch = tree.watch("x", [captured](const Svar&) {});
  }
  EXPECT_EQ(tree.get<int>("gone"), 2);
  tree.set("x", 1);
  watch.reset();
  EXPECT_EQ(tree.get<int>("gone"), 3);
}

TEST(Watch, MayUseAllOfTheTree) {
  SharedSvar tree(Svar::object({{"x", 0}}));
  std::vector<gslam::Watch> watches;
  gslam::Watch watch = tree.watch("x", [&](const Svar& value) {
    const int x = value.as<int>();
    EXPECT_EQ(tree.bind<int>("bound", 7), 7 + x - 1);
    tree.set("bound", 7 + x);
    watches.push_back(tree.watch("bound", [](const Svar&) {}));
    if (x == 2) watch = tree.watch("y", [](const Svar&) {});  // in place of itself
    watches.erase(watches.begin());
  });
  for (int i = 1; i < 4; ++i) tree.set("x", i);
  EXPECT_EQ(tree.get<int>("bound"), 9);
}

// --- many threads

template <class Work>
void inThreads(int count, Work work) {
  std::vector<std::thread> threads;
  for (int i = 0; i < count; ++i) threads.emplace_back([=] { work(i); });
  for (std::thread& thread : threads) thread.join();
}

TEST(SharedSvarThreads, ReadAndWriteTheSameTree) {
  SharedSvar tree(Svar::object({{"pair", camera(0)}, {"other", Svar::object()}}));
  const Bound<double>& fx = tree.bind<double>("pair.fx");
  std::atomic<int> torn{0};
  inThreads(4, [&](int thread) {
    for (int i = 1; i <= 300; ++i) {
      if (thread % 2 == 0) {
        tree.set("pair", camera(i));
        tree.set("other.n" + std::to_string(thread), i);
      } else {
        const Svar all = tree.snapshot();
        torn += all.get<double>("pair.fx") != all.get<double>("pair.fy") ? 1 : 0;
        torn += all.get<int>("other.n0", 0) > 300 || fx > 300 ? 1 : 0;
      }
    }
  });
  EXPECT_EQ(torn, 0);
  EXPECT_EQ(tree.get<int>("other.n0"), 300);  // no write was lost
  EXPECT_EQ(tree.get<int>("other.n2"), 300);
  EXPECT_EQ(fx, tree.get<double>("pair.fx"));
}

TEST(SharedSvarThreads, CallBackInTheOrderOfChanges) {
  SharedSvar tree;
  Svar last;
  std::atomic<int> calls{0};
  std::atomic<int> inside{0};
  std::atomic<bool> overlapped{false};
  const gslam::Watch watch = tree.watch("x", [&](const Svar& value) {
    if (++inside != 1) overlapped = true;
    last = value;
    ++calls;
    --inside;
  });
  inThreads(3, [&](int thread) {
    for (int i = 0; i < 200; ++i) tree.set("x", thread * 1000 + i);
  });
  EXPECT_EQ(calls, 600);
  EXPECT_FALSE(overlapped);
  EXPECT_EQ(last, tree["x"]);
}

TEST(SharedSvarThreads, RulesMayComeWhileOthersWrite) {
  SharedSvar tree;
  inThreads(4, [&](int thread) {
    for (int i = 0; i < 100; ++i) {
      const std::string name = "n" + std::to_string(i);
      if (thread < 2) {
        EXPECT_GE(tree.bind<int>(name, 0).get(), 0);
      } else {
        tree.set(name, thread * 1000 + i);
      }
    }
  });
  for (int i = 0; i < 100; ++i) {
    const std::string name = "n" + std::to_string(i);
    EXPECT_EQ(tree.bind<int>(name), tree.get<int>(name));
  }
}

TEST(SharedSvarThreads, NoCallbackRunsAfterItsWatchEnded) {
  SharedSvar tree;
  std::atomic<bool> stop{false};
  std::thread writer([&] {
    for (int i = 0; !stop; ++i) tree.set("x", i);
  });
  for (int i = 0; i < 200; ++i) {
    bool alive = true;
    gslam::Watch watch = tree.watch("x", [&alive](const Svar&) { EXPECT_TRUE(alive); });
    std::this_thread::yield();
    watch.reset();
    alive = false;
  }
  stop = true;
  writer.join();
}

TEST(SharedSvarThreads, StringsAreReadWhole) {
  SharedSvar tree;
  const Bound<std::string> name = tree.bind<std::string>("name", std::string(100, 'a'));
  inThreads(3, [&](int thread) {
    for (int i = 0; i < 300; ++i) {
      if (thread == 0) tree.set("name", std::string(100, static_cast<char>('a' + i % 26)));
      const std::string read = name.get();
      EXPECT_EQ(read, std::string(100, read[0]));
    }
  });
}

}  // namespace
