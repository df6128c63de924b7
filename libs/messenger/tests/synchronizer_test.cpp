// Messages with the same stamp, and what holds for synchronizers of any policy.
#include <gmock/gmock.h>
#include <gslam/messenger.h>
#include <gtest/gtest.h>

#include <cstdint>
#include <functional>
#include <limits>
#include <memory>
#include <stdexcept>
#include <string>
#include <vector>

#include "synchronizer_rig.h"

namespace {

using gslam::exactTime;
using gslam::Messenger;
using gslam::Publisher;
using gslam::Synchronizer;
using testing::ElementsAre;
using namespace synchronizer_rig;

// --- exact time

TEST(ExactTime, SameStampsMakeASet) {
  Two two(exactTime());
  Three three(exactTime());
  Four four(exactTime());
  for (std::int64_t stamp : {-5, 0, 7}) {
    for (std::size_t topic = 0; topic < 4; ++topic) {
      if (topic < 2) two.publish({topic, stamp});
      if (topic < 3) three.publish({topic, stamp});
      four.publish({topic, stamp});
    }
  }
  EXPECT_THAT(two.set_stamps,
              ElementsAre(ElementsAre(-5, -5), ElementsAre(0, 0), ElementsAre(7, 7)));
  EXPECT_EQ(three.sets.size(), 3u);
  EXPECT_EQ(four.sets.size(), 3u);
  four.expectBalance();
}

TEST(ExactTime, TopicsMayComeInAnyOrder) {
  Three rig(exactTime());
  for (std::int64_t stamp : {1, 2, 3}) rig.publish({2, stamp});
  for (std::int64_t stamp : {2, 1, 3}) rig.publish({0, stamp});
  EXPECT_EQ(rig.synchronizer().waiting(0), 3u);
  for (std::int64_t stamp : {1, 2, 3}) rig.publish({1, stamp});
  EXPECT_THAT(rig.set_stamps,
              ElementsAre(ElementsAre(1, 1, 1), ElementsAre(2, 2, 2), ElementsAre(3, 3, 3)));
}

TEST(ExactTime, OlderIncompleteSetsAreDropped) {
  Two rig(exactTime());
  for (std::int64_t stamp : {1, 2, 3}) rig.publish({0, stamp});
  rig.publish({1, 2});
  EXPECT_THAT(rig.set_stamps, ElementsAre(ElementsAre(2, 2)));
  EXPECT_EQ(rig.synchronizer().dropped(0), 1u);
  rig.publish({1, 1});  // late, as is another of the last set
  rig.publish({1, 2});
  EXPECT_EQ(rig.synchronizer().dropped(1), 2u);
  rig.publish({1, 3});
  EXPECT_EQ(rig.sets.size(), 2u);
  rig.expectBalance();
}

TEST(ExactTime, OfTwoWithOneStampTheLaterCounts) {
  Two rig(exactTime());
  for (std::int64_t stamp : {1, 1}) rig.publish({0, stamp});
  rig.publish({1, 1});
  EXPECT_THAT(rig.sets, ElementsAre(ElementsAre(1, 0)));
  EXPECT_EQ(rig.synchronizer().dropped(0), 1u);
}

TEST(ExactTime, IncompleteSetsAreBounded) {
  Two rig(exactTime(), 3);
  for (std::int64_t stamp : {1, 2, 3, 4}) rig.publish({0, stamp});
  EXPECT_EQ(rig.synchronizer().waiting(0), 3u);
  EXPECT_EQ(rig.synchronizer().dropped(0), 1u);
  for (std::int64_t stamp : {0, 1, 2}) rig.publish({1, stamp});  // 0 and 1 are the oldest
  EXPECT_EQ(rig.synchronizer().dropped(1), 2u);
  EXPECT_THAT(rig.set_stamps, ElementsAre(ElementsAre(2, 2)));
  rig.expectBalance();
}

TEST(ExactTime, SourceThatStartsOverIsHeardAfterReset) {
  Two rig(exactTime());
  for (std::int64_t stamp : {std::numeric_limits<std::int64_t>::max(), std::int64_t{1}}) {
    for (std::size_t topic : {0u, 1u}) rig.publish({topic, stamp});
  }
  EXPECT_EQ(rig.sets.size(), 1u);
  rig.synchronizer().reset();
  for (std::size_t topic : {0u, 1u}) rig.publish({topic, std::numeric_limits<std::int64_t>::min()});
  EXPECT_EQ(rig.sets.size(), 2u);
  rig.expectBalance();
}

struct Other {
  std::int64_t stamp;
};

// --- handles

TEST(Synchronizer, MessagesAreNotCopied) {
  const Messenger messenger;
  std::vector<const void*> seen;
  const Synchronizer<Stamped, Other> synchronizer(
      messenger, {"/a", "/b"}, exactTime(), 2,
      [&seen](const std::shared_ptr<const Stamped>& a, const std::shared_ptr<const Other>& b) {
        seen = {a.get(), b.get()};
      });
  const auto a = std::make_shared<const Stamped>(Stamped{1});
  const auto b = std::make_shared<const Other>(Other{1});
  messenger.advertise<Stamped>("/a").publish(a);
  messenger.advertise<Other>("/b").publish(b);
  EXPECT_THAT(seen, ElementsAre(a.get(), b.get()));
}

TEST(Synchronizer, RefusesWhatCannotBe) {
  using Pair = Synchronizer<Stamped, Stamped>;
  const Messenger messenger;
  const auto nothing = [](const Stamped&, const Stamped&) {};
  EXPECT_THROW(Pair(messenger, {"/a", "/b"}, exactTime(), 0, nothing), gslam::ArgumentError);
  EXPECT_THROW(Pair(messenger, {"/a"}, exactTime(), 1, nothing), gslam::ArgumentError);
  EXPECT_THROW(Pair(messenger, {"/a", "/b"}, exactTime(), 1,
                    std::function<void(const Stamped&, const Stamped&)>()),
               gslam::ArgumentError);
  messenger.advertise<int>("/n");
  EXPECT_THROW(Pair(messenger, {"/a", "/n"}, exactTime(), 1, nothing), gslam::TypeMismatch);
  EXPECT_EQ(messenger.advertise<Stamped>("/a").subscriberCount(), 0u);
  const Pair good(messenger, {"/a", "/b"}, exactTime(), 1, nothing);
  EXPECT_THROW(good.dropped(2), gslam::ArgumentError);
  EXPECT_THROW(good.waiting(2), gslam::ArgumentError);
}

TEST(Synchronizer, MovesAndEnds) {
  const Messenger messenger = Messenger().inNamespace("robot");
  int calls = 0;
  const Publisher<Stamped> publisher = messenger.advertise<Stamped>("a");
  Synchronizer<Stamped, Stamped> outer;
  EXPECT_FALSE(outer);
  EXPECT_EQ(outer.dropped(0), 0u);
  outer.reset();
  outer = Synchronizer<Stamped, Stamped>(messenger, {"a", "a"}, exactTime(), 1,
                                         [&calls](const Stamped&, const Stamped&) { ++calls; });
  EXPECT_TRUE(outer);
  EXPECT_EQ(outer.topic(1), "/robot/a");
  publisher.publish({1});
  EXPECT_EQ(calls, 1);  // the message is its own partner
  outer.unsubscribe();
  EXPECT_FALSE(outer);
  publisher.publish({2});
  EXPECT_EQ(calls, 1);
  EXPECT_EQ(publisher.subscriberCount(), 0u);
}

TEST(Synchronizer, LatchedMessagesCount) {
  const Messenger messenger;
  messenger.advertise<Stamped>("/a", gslam::Latch::on).publish({4});
  messenger.advertise<Stamped>("/b", gslam::Latch::on).publish({4});
  int calls = 0;
  const Synchronizer<Stamped, Stamped> late(messenger, {"/a", "/b"}, exactTime(), 1,
                                            [&calls](const Stamped&, const Stamped&) { ++calls; });
  EXPECT_EQ(calls, 1);
}

// --- callbacks

TEST(Synchronizer, CallbackMayPublish) {
  const Messenger messenger;
  std::vector<std::int64_t> order;
  const Publisher<Stamped> publisher = messenger.advertise<Stamped>("/a");
  bool is_inside = false;
  const Synchronizer<Stamped, Stamped> synchronizer(messenger, {"/a", "/a"}, exactTime(), 5,
                                                    [&](const Stamped& a, const Stamped&) {
                                                      EXPECT_FALSE(is_inside);
                                                      is_inside = true;
                                                      if (a.stamp < 9)
                                                        publisher.publish({a.stamp + 3});
                                                      order.push_back(a.stamp);
                                                      is_inside = false;
                                                    });
  publisher.publish({1});
  EXPECT_THAT(order, ElementsAre(1, 4, 7, 10));
}

// The set is complete, but must not come, once the callback of the one before has ended all.
TEST(Synchronizer, CallbackMayDestroyIt) {
  const Messenger messenger;
  const Publisher<Stamped> publisher = messenger.advertise<Stamped>("/a");
  int calls = 0;
  std::unique_ptr<Synchronizer<Stamped, Stamped>> synchronizer;
  synchronizer.reset(new Synchronizer<Stamped, Stamped>(messenger, {"/a", "/a"}, exactTime(), 5,
                                                        [&](const Stamped&, const Stamped&) {
                                                          ++calls;
                                                          publisher.publish({2});
                                                          synchronizer.reset();
                                                        }));
  publisher.publish({1});
  publisher.publish({3});
  EXPECT_EQ(calls, 1);
}

// The callback holds the last handle of what owns the synchronizer.
TEST(Synchronizer, EndOfTheCallbackMayEndIt) {
  struct Owner {
    Synchronizer<Stamped, Stamped> synchronizer;
  };
  const Messenger messenger;
  auto owner = std::make_shared<Owner>();
  Owner* const raw = owner.get();
  raw->synchronizer = Synchronizer<Stamped, Stamped>(messenger, {"/a", "/b"}, exactTime(), 1,
                                                     [owner](const Stamped&, const Stamped&) {});
  const std::weak_ptr<Owner> watch = owner;
  owner.reset();
  raw->synchronizer.unsubscribe();
  EXPECT_TRUE(watch.expired());
}

TEST(Synchronizer, WhatCallbacksThrowIsReportedAndTheNextSetsCome) {
  const Messenger messenger;
  std::vector<std::string> errors;
  messenger.onError([&errors](const std::string& topic, std::exception_ptr) {  // NOLINT
    errors.push_back(topic);
  });
  std::vector<std::int64_t> seen;
  const Publisher<Stamped> a = messenger.advertise<Stamped>("/a");
  const Publisher<Stamped> b = messenger.advertise<Stamped>("/b");
  const Synchronizer<Stamped, Stamped> synchronizer(messenger, {"/a", "/b"}, exactTime(), 5,
                                                    [&](const Stamped& message, const Stamped&) {
                                                      seen.push_back(message.stamp);
                                                      if (message.stamp == 1) {
                                                        for (std::int64_t stamp : {2, 3}) {
                                                          b.publish({stamp});
                                                          a.publish({stamp});
                                                        }
                                                      }
                                                      if (message.stamp != 3)
                                                        throw std::runtime_error("out of film");
                                                    });
  a.publish({1});
  EXPECT_NO_THROW(b.publish({1}));
  EXPECT_THAT(seen, ElementsAre(1, 2, 3));
  EXPECT_THAT(errors, ElementsAre("/b", "/a"));
}

// While a callback runs, no more sets wait than the queue may hold.
TEST(Synchronizer, CompleteSetsAreBounded) {
  const Messenger messenger;
  std::vector<std::int64_t> seen;
  const Publisher<Stamped> publisher = messenger.advertise<Stamped>("/a");
  const Synchronizer<Stamped, Stamped> synchronizer(
      messenger, {"/a", "/a"}, exactTime(), 2, [&](const Stamped& a, const Stamped&) {
        seen.push_back(a.stamp);
        for (std::int64_t i = 1; a.stamp == 0 && i < 10; ++i) publisher.publish({i});
      });
  publisher.publish(Stamped{0});
  EXPECT_THAT(seen, ElementsAre(0, 8, 9));
  EXPECT_EQ(synchronizer.dropped(0), 7u);
  EXPECT_EQ(synchronizer.dropped(1), 7u);
}

}  // namespace
