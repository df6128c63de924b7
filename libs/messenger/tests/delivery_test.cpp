// How messages reach a subscriber: threads, queues, inboxes, the end of a subscription.
#include <gslam/messenger.h>
#include <gtest/gtest.h>

#include <atomic>
#include <chrono>
#include <condition_variable>
#include <future>
#include <memory>
#include <mutex>
#include <numeric>
#include <string>
#include <thread>
#include <vector>

namespace {

using gslam::ArgumentError;
using gslam::Inbox;
using gslam::inOwnThread;
using gslam::Messenger;
using gslam::onExecutor;
using gslam::Pending;
using gslam::SubscribeOptions;
using gslam::Subscriber;
using gslam::ThreadPool;
using std::chrono::milliseconds;

std::vector<int> upTo(int count) {
  std::vector<int> numbers(static_cast<std::size_t>(count));
  std::iota(numbers.begin(), numbers.end(), 0);
  return numbers;
}

// Holds a callback until it is opened.
class Gate {
 public:
  void open() {
    const std::lock_guard<std::mutex> lock(mutex_);
    is_open_ = true;
    changed_.notify_all();
  }
  // Called by the callback.
  void pass() {
    std::unique_lock<std::mutex> lock(mutex_);
    is_reached_ = true;
    changed_.notify_all();
    changed_.wait(lock, [this] { return is_open_; });
  }
  void waitUntilReached() {
    std::unique_lock<std::mutex> lock(mutex_);
    changed_.wait(lock, [this] { return is_reached_; });
  }

 private:
  std::mutex mutex_;
  std::condition_variable changed_;
  bool is_open_ = false;
  bool is_reached_ = false;
};

// All ways to have a callback run elsewhere.
std::vector<SubscribeOptions> queues() {
  return {inOwnThread(), inOwnThread().spinFor(std::chrono::microseconds(50)),
          onExecutor(std::make_shared<ThreadPool>(2))};
}

TEST(Queued, DeliversAllInOrderOutsideThePublisher) {
  for (const SubscribeOptions& options : queues()) {
    const Messenger messenger;
    const auto publisher = messenger.advertise<int>("n");
    std::vector<int> seen;
    std::atomic<bool> elsewhere{true};
    const auto here = std::this_thread::get_id();
    Subscriber subscriber = messenger.subscribe<int>("n", options.drainAtEnd(), [&](const int& n) {
      seen.push_back(n);
      if (std::this_thread::get_id() == here) elsewhere = false;
    });
    for (int i = 0; i < 10000; ++i) publisher.publish(i);
    subscriber.unsubscribe();
    EXPECT_EQ(seen, upTo(10000));
    EXPECT_TRUE(elsewhere);
  }
}

TEST(Queued, SharesOneMessageWithAll) {
  const Messenger messenger;
  const auto publisher = messenger.advertise<std::vector<char>>("big");
  std::mutex mutex;
  std::vector<const void*> seen;
  std::vector<Subscriber> subscribers;
  for (int i = 0; i < 16; ++i) {
    subscribers.push_back(messenger.subscribe<std::vector<char>>(
        "big", i % 2 == 0 ? inOwnThread().drainAtEnd() : SubscribeOptions(),
        [&](const std::shared_ptr<const std::vector<char>>& message) {
          const std::lock_guard<std::mutex> lock(mutex);
          seen.push_back(message.get());
        }));
  }
  const auto message = std::make_shared<const std::vector<char>>(1 << 20);
  publisher.publish(message);
  subscribers.clear();
  EXPECT_EQ(seen, std::vector<const void*>(16, message.get()));
  EXPECT_EQ(message.use_count(), 1);
}

TEST(Queued, CopiesAValueOnceAtMost) {
  struct Counted {
    explicit Counted(int* its_copies) : copies(its_copies) {}
    Counted(const Counted& other) : copies(other.copies) { ++*copies; }
    Counted(Counted&& other) noexcept : copies(other.copies) {}
    int* copies;
  };
  const Messenger messenger;
  const auto publisher = messenger.advertise<Counted>("c");
  int copies = 0;
  const Counted message(&copies);
  std::vector<Subscriber> subscribers;
  for (int i = 0; i < 3; ++i) {
    subscribers.push_back(messenger.subscribe<Counted>("c", [](const Counted&) {}));
  }
  publisher.publish(message);
  EXPECT_EQ(copies, 0);  // seen where it is
  for (int i = 0; i < 3; ++i) {
    subscribers.push_back(messenger.subscribe<Counted>("c", inOwnThread(), [](const Counted&) {}));
  }
  publisher.publish(message);
  EXPECT_EQ(copies, 1);
  publisher.publish(Counted(&copies));
  EXPECT_EQ(copies, 1);
}

TEST(Overflow, DropsTheOldest) {
  for (const SubscribeOptions& options : queues()) {
    const Messenger messenger;
    const auto publisher = messenger.advertise<int>("n");
    Gate gate;
    std::vector<int> seen;
    Subscriber subscriber =
        messenger.subscribe<int>("n", options.keepLast(3).drainAtEnd(), [&](const int& n) {
          if (n == -1) return gate.pass();
          seen.push_back(n);
        });
    publisher.publish(-1);
    gate.waitUntilReached();
    for (int i = 0; i < 1000; ++i) publisher.publish(i);
    EXPECT_EQ(subscriber.waiting(), 3u);
    EXPECT_EQ(subscriber.dropped(), 997u);
    gate.open();
    subscriber.unsubscribe();
    EXPECT_EQ(seen, (std::vector<int>{997, 998, 999}));
  }
}

TEST(Overflow, DropsTheNewest) {
  for (const SubscribeOptions& options : queues()) {
    const Messenger messenger;
    const auto publisher = messenger.advertise<int>("n");
    Gate gate;
    std::vector<int> seen;
    Subscriber subscriber =
        messenger.subscribe<int>("n", options.dropNewest(3).drainAtEnd(), [&](const int& n) {
          if (n == -1) return gate.pass();
          seen.push_back(n);
        });
    publisher.publish(-1);
    gate.waitUntilReached();
    for (int i = 0; i < 1000; ++i) publisher.publish(i);
    EXPECT_EQ(subscriber.dropped(), 997u);
    gate.open();
    subscriber.unsubscribe();
    EXPECT_EQ(seen, upTo(3));
  }
}

TEST(Overflow, HoldsThePublisherBack) {
  for (const SubscribeOptions& options : queues()) {
    const Messenger messenger;
    const auto publisher = messenger.advertise<int>("n");
    Gate gate;
    std::vector<int> seen;
    Subscriber subscriber =
        messenger.subscribe<int>("n", options.blockPublisher(2).drainAtEnd(), [&](const int& n) {
          if (n == 0) gate.pass();
          seen.push_back(n);
        });
    std::atomic<int> sent{0};
    std::thread sender([&] {
      for (int i = 0; i < 1000; ++i) {
        publisher.publish(i);
        ++sent;
      }
    });
    gate.waitUntilReached();
    while (sent < 3) std::this_thread::yield();
    std::this_thread::sleep_for(milliseconds(20));
    EXPECT_EQ(sent, 3);  // one in the callback, two in the queue
    gate.open();
    sender.join();
    subscriber.unsubscribe();
    EXPECT_EQ(seen, upTo(1000));
    EXPECT_EQ(subscriber.dropped(), 0u);
  }
}

TEST(Overflow, EndOfTheSubscriptionLetsThePublisherGo) {
  const Messenger messenger;
  const auto publisher = messenger.advertise<int>("n");
  Inbox<int> inbox = messenger.inbox<int>("n", SubscribeOptions().blockPublisher(1));
  std::thread sender([&] {
    for (int i = 0; i < 3; ++i) publisher.publish(i);
  });
  while (inbox.waiting() == 0) std::this_thread::yield();
  inbox.unsubscribe();
  sender.join();
}

TEST(Overflow, CallbackIsNotHeldBackByItsOwnQueue) {
  for (const SubscribeOptions& options : queues()) {
    const Messenger messenger;
    const auto publisher = messenger.advertise<int>("n");
    std::vector<int> seen;
    std::promise<void> done;
    Subscriber subscriber =
        messenger.subscribe<int>("n", options.blockPublisher(1), [&](const int& n) {
          seen.push_back(n);
          if (n == 0) {
            for (int i = 1; i < 6; ++i) publisher.publish(i);
          }
          if (n == 5) done.set_value();
        });
    publisher.publish(0);
    done.get_future().wait();
    EXPECT_EQ(seen, upTo(6));
  }
}

TEST(Overflow, LateMessageTakesNothingFromAQueueThatIsDrained) {
  gslam::detail::MessageQueue<int> queue(inOwnThread().keepLast(1));
  queue.push(1);
  queue.close(Pending::drain);
  queue.push(2);
  int item = 0;
  EXPECT_TRUE(queue.tryPop(item));
  EXPECT_EQ(item, 1);
  EXPECT_FALSE(queue.tryPop(item));
  EXPECT_EQ(queue.counts().dropped, 1u);
}

TEST(Overflow, NeedsRoomForOne) {
  EXPECT_THROW(inOwnThread().keepLast(0), ArgumentError);
  EXPECT_THROW(inOwnThread().dropNewest(0), ArgumentError);
  EXPECT_THROW(inOwnThread().blockPublisher(0), ArgumentError);
  EXPECT_THROW(onExecutor(nullptr), ArgumentError);
}

TEST(End, DiscardsOrDrainsWhatWaits) {
  for (const SubscribeOptions& options : queues()) {
    for (const Pending pending : {Pending::discard, Pending::drain}) {
      const Messenger messenger;
      const auto publisher = messenger.advertise<int>("n");
      Gate gate;
      int calls = 0;
      Subscriber subscriber = messenger.subscribe<int>("n", options, [&](const int&) {
        gate.pass();
        ++calls;
      });
      for (int i = 0; i < 10; ++i) publisher.publish(i);
      gate.waitUntilReached();
      std::thread opener([&] {
        std::this_thread::sleep_for(milliseconds(20));
        gate.open();
      });
      subscriber.unsubscribe(pending);
      const int after = calls;
      EXPECT_EQ(after, pending == Pending::drain ? 10 : 1);
      opener.join();
      publisher.publish(11);
      EXPECT_EQ(calls, after);
    }
  }
}

TEST(End, WaitsForACallbackInAnotherThread) {
  const Messenger messenger;
  const auto publisher = messenger.advertise<int>("n");
  Gate gate;
  std::atomic<bool> is_over{false};
  Subscriber subscriber = messenger.subscribe<int>("n", [&](const int&) {
    gate.pass();
    std::this_thread::sleep_for(milliseconds(20));
    is_over = true;
  });
  std::thread sender([&] { publisher.publish(1); });
  gate.waitUntilReached();
  gate.open();
  subscriber.unsubscribe();
  EXPECT_TRUE(is_over);
  sender.join();
}

TEST(End, ShutdownEndsAllAndRefusesMore) {
  Messenger messenger;
  const auto publisher = messenger.advertise<int>("n");
  std::vector<int> seen;
  int others = 0;
  Subscriber queued =
      messenger.subscribe<int>("n", inOwnThread(), [&](const int& n) { seen.push_back(n); });
  messenger.subscribe<int>("n", [&](const int&) { ++others; }).keep();
  Subscriber any = messenger.subscribeAny("/**", [&](const gslam::AnyMessage&) { ++others; });
  for (int i = 0; i < 100; ++i) publisher.publish(i);
  messenger.shutDown(Pending::drain);
  EXPECT_EQ(seen, upTo(100));
  publisher.publish(1);
  EXPECT_EQ(others, 200);
  EXPECT_EQ(seen.size(), 100u);
  EXPECT_THROW(messenger.advertise<int>("m"), gslam::Error);
  EXPECT_THROW(messenger.subscribe<int>("n", [](const int&) {}).keep(), gslam::Error);
}

TEST(InboxOf, GivesMessagesWhenAsked) {
  const Messenger messenger;
  const auto publisher = messenger.advertise<int>("n");
  Inbox<int> inbox = messenger.inbox<int>("n", SubscribeOptions().keepLast(3));
  EXPECT_EQ(inbox.take(), nullptr);
  EXPECT_EQ(inbox.waitFor(milliseconds(1)), nullptr);
  for (int i = 0; i < 5; ++i) publisher.publish(i);
  EXPECT_EQ(inbox.waiting(), 3u);
  EXPECT_EQ(*inbox.take(), 2);
  EXPECT_EQ(*inbox.waitFor(milliseconds(0)), 3);
  publisher.publish(5);
  EXPECT_EQ(*inbox.takeLatest(), 5);
  EXPECT_EQ(inbox.dropped(), 3u);
  EXPECT_EQ(inbox.takeLatest(), nullptr);
  EXPECT_EQ(Inbox<int>().take(), nullptr);
}

TEST(InboxOf, WakesAllWhoWait) {
  const Messenger messenger;
  const auto publisher = messenger.advertise<int>("n");
  Inbox<int> inbox = messenger.inbox<int>("n");
  std::atomic<int> sum{0};
  std::vector<std::thread> threads;
  for (int i = 0; i < 4; ++i) {
    threads.emplace_back([&] { sum += *inbox.waitFor(std::chrono::seconds(60)); });
  }
  std::this_thread::sleep_for(milliseconds(20));
  for (int i = 1; i < 5; ++i) publisher.publish(i);
  for (std::thread& thread : threads) thread.join();
  EXPECT_EQ(sum, 10);
}

TEST(LatchedTopic, GivesTheLastMessageToThoseWhoComeLate) {
  const Messenger messenger;
  const auto plain = messenger.advertise<int>("plain");
  const auto latched = messenger.advertise<int>("latched", gslam::Latch::on);
  std::vector<int> seen;
  const auto see = [&](const int& n) { seen.push_back(n); };
  const Subscriber before = messenger.subscribe<int>("latched", see);
  EXPECT_TRUE(seen.empty());
  for (int i = 1; i < 4; ++i) {
    plain.publish(i);
    latched.publish(i);
  }
  seen.clear();
  const Subscriber a = messenger.subscribe<int>("plain", see);
  const Subscriber b = messenger.subscribe<int>("latched", see);
  EXPECT_EQ(seen, std::vector<int>{3});
  Inbox<int> inbox = messenger.inbox<int>("latched");
  EXPECT_EQ(*inbox.take(), 3);
}

TEST(LatchedTopic, NeverGivesAMessageTwiceOrOutOfOrder) {
  const Messenger messenger;
  const auto publisher = messenger.advertise<int>("n", gslam::Latch::on);
  std::atomic<bool> stop{false};
  std::thread sender([&] {
    for (int i = 0; !stop; ++i) publisher.publish(i);
  });
  std::atomic<bool> good{true};
  for (int i = 0; i < 200; ++i) {
    int last = -1;
    const Subscriber subscriber = messenger.subscribe<int>("n", [&](const int& n) {
      if (n <= last) good = false;
      last = n;
    });
  }
  stop = true;
  sender.join();
  EXPECT_TRUE(good);
}

}  // namespace
