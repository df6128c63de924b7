// Synchronizers whose topics are published by several threads.
#include <gslam/messenger.h>
#include <gtest/gtest.h>

#include <atomic>
#include <cstdint>
#include <memory>
#include <string>
#include <thread>
#include <vector>

#include "synchronizer_rig.h"

namespace {

using gslam::approximateTime;
using gslam::exactTime;
using gslam::Messenger;
using gslam::Publisher;
using gslam::Synchronizer;
using namespace synchronizer_rig;

// Each in a thread of its own.
std::vector<std::thread> publishFromThreads(const Messenger& messenger, int topics, int count) {
  std::vector<std::thread> threads;
  for (int t = 0; t < topics; ++t) {
    threads.emplace_back([messenger, t, count] {
      const Publisher<Stamped> publisher = messenger.advertise<Stamped>("/t" + std::to_string(t));
      for (int i = 0; i < count; ++i) publisher.publish(Stamped{i});
    });
  }
  return threads;
}

TEST(SynchronizerThreads, OneCallbackAtATimeInOrder) {
  const int count = 3000;
  const Messenger messenger;
  std::int64_t last = -1;  // not atomic: callbacks never meet
  int sets = 0;
  std::atomic<int> inside(0);
  const Synchronizer<Stamped, Stamped, Stamped> synchronizer(
      messenger, {"/t0", "/t1", "/t2"}, approximateTime(), count,
      [&](const Stamped& a, const Stamped& b, const Stamped& c) {
        EXPECT_EQ(++inside, 1);
        EXPECT_EQ(a.stamp, b.stamp);
        EXPECT_EQ(a.stamp, c.stamp);
        EXPECT_EQ(a.stamp, last + 1);
        last = a.stamp;
        ++sets;
        --inside;
      });
  for (std::thread& one : publishFromThreads(messenger, 3, count)) one.join();
  EXPECT_EQ(sets, count);
  EXPECT_EQ(synchronizer.dropped(0), 0u);
}

TEST(SynchronizerThreads, EachMessageIsDeliveredOrDroppedOrWaits) {
  const int count = 5000;
  const Messenger messenger;
  std::uint64_t sets = 0;
  const Synchronizer<Stamped, Stamped> synchronizer(
      messenger, {"/t0", "/t1"}, exactTime(), 4,
      [&sets](const Stamped&, const Stamped&) { ++sets; });
  std::thread reader([&synchronizer] {
    for (int i = 0; i < 1000; ++i) EXPECT_LE(synchronizer.waiting(0), 8u);
  });
  for (std::thread& one : publishFromThreads(messenger, 2, count)) one.join();
  reader.join();
  for (std::size_t topic : {0u, 1u}) {
    EXPECT_EQ(sets + synchronizer.dropped(topic) + synchronizer.waiting(topic),
              static_cast<std::uint64_t>(count));
  }
}

TEST(SynchronizerThreads, MayEndWhileTheyPublish) {
  const Messenger messenger;
  std::vector<std::thread> threads = publishFromThreads(messenger, 2, 20000);
  for (int i = 0; i < 300; ++i) {
    const auto alive = std::make_shared<std::atomic<bool>>(true);
    {
      const Synchronizer<Stamped, Stamped> synchronizer(
          messenger, {"/t0", "/t1"}, approximateTime(), 10,
          [alive](const Stamped&, const Stamped&) { EXPECT_TRUE(alive->load()); });
      std::this_thread::yield();
    }
    *alive = false;
  }
  for (std::thread& one : threads) one.join();
}

// The thread whose callback is running takes over what others complete.
TEST(SynchronizerThreads, WhoCallsBackDeliversWhatOthersComplete) {
  const Messenger messenger;
  const Publisher<Stamped> publisher = messenger.advertise<Stamped>("/a");
  std::vector<std::thread::id> callers;
  const Synchronizer<Stamped, Stamped> synchronizer(
      messenger, {"/a", "/a"}, exactTime(), 10, [&](const Stamped& a, const Stamped&) {
        callers.push_back(std::this_thread::get_id());
        if (a.stamp == 1) std::thread([&publisher] { publisher.publish(Stamped{2}); }).join();
      });
  publisher.publish(Stamped{1});
  EXPECT_EQ(callers, std::vector<std::thread::id>(2, std::this_thread::get_id()));
}

}  // namespace
