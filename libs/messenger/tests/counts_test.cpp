// What is told of messages that wait and of those that were dropped.
#include <gslam/messenger.h>
#include <gtest/gtest.h>

#include <atomic>
#include <cstdint>
#include <memory>
#include <thread>
#include <utility>
#include <vector>

namespace {

using gslam::Inbox;
using gslam::inOwnThread;
using gslam::Messenger;
using gslam::onExecutor;
using gslam::Pending;
using gslam::SubscribeOptions;
using gslam::Subscriber;

std::vector<SubscribeOptions> countedQueues() {
  return {inOwnThread(), inOwnThread().keepLast(1000),
          onExecutor(std::make_shared<gslam::ThreadPool>(1))};
}

// Lets through as many messages as it is told.
class Turnstile {
 public:
  void pass() {
    ++entered_;
    while (entered_ > allowed_) std::this_thread::yield();
  }
  void allow(int count) { allowed_ = count; }
  void waitUntilEntered(int count) const {
    while (entered_ < count) std::this_thread::yield();
  }

 private:
  std::atomic<int> entered_{0};
  std::atomic<int> allowed_{0};
};

TEST(Counts, OfAQueueSayWhatWaitsBehindTheCallback) {
  for (const SubscribeOptions& options : countedQueues()) {
    const Messenger messenger;
    Turnstile turnstile;
    Subscriber subscriber =
        messenger.subscribe<int>("n", options, [&](const int&) { turnstile.pass(); });
    messenger.publish<int>("n", 0);
    turnstile.waitUntilEntered(1);
    for (int i = 1; i <= 10; ++i) messenger.publish<int>("n", i);
    for (int i = 1; i <= 10; ++i) {
      EXPECT_EQ(subscriber.waiting(), static_cast<std::size_t>(11 - i));
      turnstile.allow(i);
      turnstile.waitUntilEntered(i + 1);
    }
    EXPECT_EQ(subscriber.waiting(), 0u);
    turnstile.allow(100);
  }
}

// Two that wait go at once to the consumer without bound, where the end drops one of them.
TEST(Counts, OfWhatWasDroppedStayAfterTheEnd) {
  for (const SubscribeOptions& options : countedQueues()) {
    const Messenger messenger;
    Turnstile turnstile;
    Subscriber subscriber =
        messenger.subscribe<int>("n", options, [&](const int&) { turnstile.pass(); });
    messenger.publish<int>("n", 0);
    turnstile.waitUntilEntered(1);
    for (int i = 0; i < 5; ++i) messenger.publish<int>("n", i);
    turnstile.allow(1);
    turnstile.waitUntilEntered(2);
    messenger.publish<int>("n", 9);
    std::thread opener([&] {
      while (subscriber.dropped() == 0) std::this_thread::yield();
      turnstile.allow(100);
    });
    messenger.shutDown(Pending::discard);  // a handle is not for two threads at once
    opener.join();
    subscriber.unsubscribe();
    EXPECT_EQ(subscriber.dropped(), 5u);
    EXPECT_EQ(subscriber.waiting(), 0u);
    const Subscriber moved = std::move(subscriber);
    EXPECT_EQ(moved.dropped(), 5u);
  }
  EXPECT_EQ(Subscriber().dropped(), 0u);
}

TEST(Counts, OfAFullQueueStayAfterTheEnd) {
  for (const SubscribeOptions& options : countedQueues()) {
    const Messenger messenger;
    Turnstile turnstile;
    Subscriber subscriber =
        messenger.subscribe<int>("n", options.keepLast(2), [&](const int&) { turnstile.pass(); });
    messenger.publish<int>("n", 0);
    turnstile.waitUntilEntered(1);
    for (int i = 0; i < 9; ++i) messenger.publish<int>("n", i);
    EXPECT_EQ(subscriber.dropped(), 7u);
    turnstile.allow(100);
    subscriber.unsubscribe(Pending::drain);
    EXPECT_EQ(subscriber.dropped(), 7u);
  }
}

TEST(Counts, OfAnInboxStayAfterTheEnd) {
  const Messenger messenger;
  for (const bool drain : {false, true}) {
    const SubscribeOptions options = SubscribeOptions().keepLast(2);
    Inbox<int> inbox = messenger.inbox<int>("n", drain ? options.drainAtEnd() : options);
    for (int i = 0; i < 5; ++i) messenger.publish<int>("n", i);
    EXPECT_EQ(inbox.dropped(), 3u);
    inbox.unsubscribe();
    EXPECT_EQ(inbox.dropped(), drain ? 3u : 5u);
    EXPECT_EQ(inbox.waiting(), drain ? 2u : 0u);
    EXPECT_EQ(inbox.take() != nullptr, drain);
  }
}

}  // namespace
