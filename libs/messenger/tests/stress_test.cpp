// Many threads at once. Run under ThreadSanitizer, too.
#include <gslam/messenger.h>
#include <gtest/gtest.h>

#include <atomic>
#include <cstdint>
#include <cstdlib>
#include <memory>
#include <thread>
#include <utility>
#include <vector>

namespace {

using gslam::inOwnThread;
using gslam::Messenger;
using gslam::onExecutor;
using gslam::Publisher;
using gslam::SubscribeOptions;
using gslam::Subscriber;

#if defined(__SANITIZE_THREAD__) || defined(__SANITIZE_ADDRESS__)
constexpr int kMessages = 20000;  // of each publisher
#else
constexpr int kMessages = 625000;
#endif
constexpr int kPublishers = 4;

// As the environment has it, which says how many of all publishers in four runs: the full tier
// sends 1e7 under sanitizers, too.
int messagesOfEach() {
  const char* const wish = std::getenv("GSLAM_STRESS_MESSAGES");
  return wish == nullptr ? kMessages : std::atoi(wish) / (4 * kPublishers);
}

template <class Work>
void inThreads(int count, Work work) {
  std::vector<std::thread> threads;
  for (int i = 0; i < count; ++i) threads.emplace_back([=] { work(i); });
  for (std::thread& thread : threads) thread.join();
}

// Who sent a message, and its number there.
using Numbered = std::pair<int, int>;

// Counts what comes, and what comes out of order.
struct Checker {
  void operator()(const Numbered& message) {
    if (message.second != next[message.first]++) ++disorder;
    ++count;
  }
  int next[kPublishers] = {};
  int disorder = 0;
  std::int64_t count = 0;
};

TEST(Stress, NothingIsLostAndAllIsInOrder) {
  const std::vector<SubscribeOptions> ways = {
      inOwnThread(), inOwnThread().blockPublisher(16),
      onExecutor(std::make_shared<gslam::ThreadPool>(2)),
      onExecutor(std::make_shared<gslam::ThreadPool>(2)).blockPublisher(16)};
  const int messages = messagesOfEach();
  for (const SubscribeOptions& way : ways) {  // 1e7 messages in all
    const Messenger messenger;
    const Publisher<Numbered> publisher = messenger.advertise<Numbered>("n");
    Checker checker;
    Subscriber subscriber = messenger.subscribe<Numbered>(
        "n", way.drainAtEnd(), [&](const Numbered& message) { checker(message); });
    inThreads(kPublishers, [&](int who) {
      for (int i = 0; i < messages; ++i) publisher.publish(Numbered(who, i));
    });
    subscriber.unsubscribe();
    EXPECT_EQ(checker.count, std::int64_t(kPublishers) * messages);
    EXPECT_EQ(checker.disorder, 0);
    EXPECT_EQ(subscriber.dropped(), 0u);
  }
}

TEST(Stress, DroppedAndDeliveredMakeAll) {
  for (const SubscribeOptions& way :
       {inOwnThread().keepLast(1), inOwnThread().dropNewest(1), inOwnThread().keepLast(7)}) {
    const Messenger messenger;
    const auto publisher = messenger.advertise<int>("n");
    std::atomic<int> count{0};
    auto inbox = messenger.inbox<int>("n", way);
    Subscriber subscriber =
        messenger.subscribe<int>("n", way.drainAtEnd(), [&](const int&) { ++count; });
    inThreads(kPublishers, [&](int) {
      for (int i = 0; i < kMessages / 10; ++i) publisher.publish(i);
    });
    const int all = kPublishers * (kMessages / 10);
    EXPECT_EQ(inbox.dropped() + inbox.waiting(), static_cast<std::uint64_t>(all));
    while (subscriber.waiting() > 0) std::this_thread::yield();
    const auto dropped = subscriber.dropped();
    subscriber.unsubscribe();
    EXPECT_EQ(static_cast<std::uint64_t>(count) + dropped, static_cast<std::uint64_t>(all));
  }
}

// The predecessor aborted at a queue of 1 and 2e6 messages.
TEST(Stress, QueueOfOneHoldsInEachPolicy) {
  const int count = 3 * kMessages + kMessages / 5;  // 2e6, less under sanitizers
  for (const SubscribeOptions& way :
       {inOwnThread().keepLast(1), inOwnThread().dropNewest(1), inOwnThread().blockPublisher(1)}) {
    const Messenger messenger;
    const auto publisher = messenger.advertise<int>("n");
    std::int64_t handled = 0;
    int last = -1;
    bool is_in_order = true;
    Subscriber subscriber = messenger.subscribe<int>("n", way.drainAtEnd(), [&](const int& n) {
      is_in_order = is_in_order && n > last;
      last = n;
      ++handled;
    });
    for (int i = 0; i < count; ++i) publisher.publish(i);
    while (subscriber.waiting() > 0) std::this_thread::yield();
    const auto dropped = static_cast<std::int64_t>(subscriber.dropped());
    subscriber.unsubscribe();
    EXPECT_EQ(handled + dropped, count);
    EXPECT_TRUE(is_in_order);
    EXPECT_TRUE(way.overflow != gslam::Overflow::block_publisher || dropped == 0);
    EXPECT_TRUE(way.overflow != gslam::Overflow::drop_oldest || last == count - 1);
  }
}

TEST(Stress, SubscribersComeAndGoWhileMessagesFlow) {
  const Messenger messenger;
  std::atomic<bool> stop{false};
  std::atomic<std::int64_t> received{0};
  std::vector<std::thread> publishers;
  for (int i = 0; i < 2; ++i) {
    publishers.emplace_back([&] {
      const auto publisher = messenger.advertise<std::shared_ptr<int>>("n");
      while (!stop) publisher.publish(std::make_shared<int>(3));
    });
  }
  const auto pool = std::make_shared<gslam::ThreadPool>(2);
  inThreads(3, [&](int which) {
    for (int i = 0; i < 300; ++i) {
      const auto alive = std::make_shared<int>(7);  // must not be gone while a callback uses it
      const SubscribeOptions ways[] = {SubscribeOptions(), inOwnThread().keepLast(2),
                                       onExecutor(pool).keepLast(2)};
      int* const raw = alive.get();
      const Subscriber subscriber = messenger.subscribe<std::shared_ptr<int>>(
          "n", ways[which],
          [raw, &received](const std::shared_ptr<int>& n) { received += *n + *raw; });
      const Subscriber any = messenger.subscribeAny(
          "/*",
          [&received](const gslam::AnyMessage& message) { received += message.typeSize() > 0; });
      if (i % 16 == 0) messenger.topics();
      if (i % 50 == 0) std::this_thread::yield();
    }
  });
  stop = true;
  for (std::thread& publisher : publishers) publisher.join();
  EXPECT_GT(received, 0);
  EXPECT_TRUE(messenger.topics()[1].subscribers.empty());
}

TEST(Stress, ManyTopicsAreMadeAtOnce) {
  const Messenger messenger;
  std::atomic<int> received{0};
  const Subscriber any =
      messenger.subscribeAny("/t/**", [&](const gslam::AnyMessage&) { ++received; });
  inThreads(4, [&](int thread) {
    for (int i = 0; i < 200; ++i) {
      messenger.advertise<int>("t/n" + std::to_string((i * 7 + thread) % 50)).publish(i);
    }
  });
  EXPECT_EQ(received, 800);
  EXPECT_EQ(messenger.topics().size(), 51u);
}

}  // namespace
