// Ends of subscriptions that meet each other, or the end of the messenger.
#include <gslam/messenger.h>
#include <gtest/gtest.h>

#include <atomic>
#include <chrono>
#include <functional>
#include <memory>
#include <string>
#include <thread>
#include <vector>

namespace {

using gslam::AnyMessage;
using gslam::inOwnThread;
using gslam::Messenger;
using gslam::onExecutor;
using gslam::Pending;
using gslam::Publisher;
using gslam::SubscribeOptions;
using gslam::Subscriber;
using std::chrono::milliseconds;

std::vector<SubscribeOptions> deliveriesToEnd() {
  return {SubscribeOptions(), inOwnThread(), inOwnThread().keepLast(8),
          onExecutor(std::make_shared<gslam::ThreadPool>(1))};
}

// A callback that takes its time.
class SlowCall {
 public:
  void operator()() const {
    state_->is_entered = true;
    std::this_thread::sleep_for(milliseconds(60));
    state_->is_over = true;
  }
  void waitUntilEntered() const {
    while (!state_->is_entered) std::this_thread::yield();
  }
  bool isOver() const { return state_->is_over; }

 private:
  struct State {
    std::atomic<bool> is_entered{false};
    std::atomic<bool> is_over{false};
  };
  std::shared_ptr<State> state_ = std::make_shared<State>();
};

TEST(End, OfAPatternWaitsAlsoWhenTheMessengerIsGone) {
  for (const SubscribeOptions& options : deliveriesToEnd()) {
    const SlowCall call;
    Publisher<int> publisher;
    Subscriber subscriber;
    {
      const Messenger messenger;
      publisher = messenger.advertise<int>("n");
      subscriber = messenger.subscribeAny("/**", options, [&](const AnyMessage&) { call(); });
    }
    std::thread sender([&] { publisher.publish(1); });
    call.waitUntilEntered();
    subscriber.unsubscribe();
    EXPECT_TRUE(call.isOver());
    sender.join();
    EXPECT_EQ(publisher.subscriberCount(), 0u);
  }
}

TEST(End, OfAPatternThatIsKeptComesWithTheMessenger) {
  const auto watched = std::make_shared<int>();
  {
    const Messenger messenger;
    messenger.subscribeAny("/**", [watched](const AnyMessage&) {}).keep();
    EXPECT_EQ(watched.use_count(), 2);
  }
  EXPECT_EQ(watched.use_count(), 1);
}

// The first of two ends waits; so must the second.
TEST(End, WaitsAlsoWhereAnotherIsAboutIt) {
  for (const SubscribeOptions& options : deliveriesToEnd()) {
    for (const bool any : {false, true}) {
      const Messenger messenger;
      const SlowCall call;
      Subscriber subscriber =
          any ? messenger.subscribeAny("/**", options, [&](const AnyMessage&) { call(); })
              : messenger.subscribe<int>("n", options, [&](const int&) { call(); });
      std::thread sender([&] { messenger.publish<int>("n", 1); });
      call.waitUntilEntered();
      std::thread other([&] { messenger.shutDown(Pending::discard); });
      std::this_thread::sleep_for(milliseconds(20));
      subscriber.unsubscribe();
      EXPECT_TRUE(call.isOver());
      other.join();
      sender.join();
    }
  }
}

// The first end comes from a callback and so does not wait.
TEST(End, WaitsForTheCallbackThatShutsDown) {
  for (const SubscribeOptions& options : deliveriesToEnd()) {
    const Messenger messenger;
    const SlowCall call;
    Subscriber subscriber = messenger.subscribe<int>("n", options, [&](const int&) {
      messenger.shutDown(Pending::discard);
      call();
    });
    std::thread sender([&] { messenger.publish<int>("n", 1); });
    call.waitUntilEntered();
    subscriber.unsubscribe();
    EXPECT_TRUE(call.isOver());
    sender.join();
  }
}

TEST(Shutdown, RefusesAllThatComesLater) {
  const Messenger messenger;
  const auto publisher = messenger.advertise<int>("n");
  messenger.shutDown(Pending::discard);
  int calls = 0;
  EXPECT_THROW(messenger.subscribeAny("/**", [&](const AnyMessage&) { ++calls; }).keep(),
               gslam::Error);
  EXPECT_THROW(messenger.inbox<int>("n").take(), gslam::Error);
  EXPECT_THROW((messenger.serve<int, int>("s", [](int n) { return n; }).keep()), gslam::Error);
  publisher.publish(1);
  EXPECT_EQ(calls, 0);
}

// The latched message comes between the check and the joining.
TEST(Shutdown, RefusesWhoIsJoining) {
  for (const bool any : {false, true}) {
    const Messenger messenger;
    const auto publisher = messenger.advertise<int>("n", gslam::Latch::on);
    publisher.publish(1);
    int calls = 0;
    const auto shut_down = [&] {
      ++calls;
      messenger.shutDown(Pending::discard);
    };
    EXPECT_THROW(any ? messenger.subscribeAny("/**", [&](const AnyMessage&) { shut_down(); }).keep()
                     : messenger.subscribe<int>("n", [&](const int&) { shut_down(); }).keep(),
                 gslam::Error);
    EXPECT_EQ(publisher.subscriberCount(), 0u);
    publisher.publish(2);
    EXPECT_EQ(calls, 1);
  }
}

TEST(Shutdown, LeavesNobodyWhoJoinsAtTheSameTime) {
  const std::vector<std::function<void(const Messenger&)>> joins = {
      [](const Messenger& to) { to.subscribe<int>("n", [](const int&) {}).keep(); },
      [](const Messenger& to) { to.subscribeAny("/**", [](const AnyMessage&) {}).keep(); },
      [](const Messenger& to) { to.inbox<int>("n").take(); },
      [](const Messenger& to) { to.serve<int, int>("s", [](int n) { return n; }).keep(); }};
  for (int round = 0; round < 400; ++round) {
    const Messenger messenger;
    const auto publisher = messenger.advertise<int>("n");
    std::atomic<bool> go{false};
    std::thread other([&] {
      while (!go) {
      }
      for (int i = 0; i < round % 20; ++i) messenger.topics();
      messenger.shutDown(Pending::discard);
    });
    go = true;
    try {
      for (int i = 0; i < 100; ++i)
        joins[static_cast<std::size_t>(round) % joins.size()](messenger);
    } catch (const gslam::Error&) {  // shut down, or served already
    }
    other.join();
    EXPECT_EQ(publisher.subscriberCount(), 0u);
    EXPECT_FALSE(messenger.hasService("s"));
  }
}

}  // namespace
