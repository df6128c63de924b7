// Durations of any length, where somebody waits.
#include <gslam/messenger.h>
#include <gtest/gtest.h>

#include <atomic>
#include <chrono>
#include <limits>
#include <thread>

namespace {

using gslam::Inbox;
using gslam::inOwnThread;
using gslam::Messenger;
using gslam::Pending;
using gslam::Subscriber;
using gslam::detail::waitTime;
using std::chrono::microseconds;
using std::chrono::milliseconds;

TEST(WaitTime, IsWhatItWasToldWithinACentury) {
  using Seconds = std::chrono::duration<double>;
  const auto century = std::chrono::hours(24 * 36500);
  EXPECT_EQ(waitTime(microseconds(7)), microseconds(7));
  EXPECT_EQ(waitTime(Seconds(0.5)), milliseconds(500));
  EXPECT_EQ(waitTime(std::chrono::hours(24 * 36499)), std::chrono::hours(24 * 36499));
  EXPECT_EQ(waitTime(microseconds::max()), century);
  EXPECT_EQ(waitTime(std::chrono::hours::max()), century);
  EXPECT_EQ(waitTime(Seconds(std::numeric_limits<double>::infinity())), century);
  EXPECT_EQ(waitTime(Seconds(std::numeric_limits<double>::quiet_NaN())).count(), 0);
  EXPECT_EQ(waitTime(milliseconds(-1)).count(), 0);
  EXPECT_EQ(waitTime(std::chrono::hours::min()).count(), 0);
}

TEST(WaitTime, OfAnInboxMayBeForEver) {
  const Messenger messenger;
  Inbox<int> inbox = messenger.inbox<int>("n");
  std::thread sender([&] {
    std::this_thread::sleep_for(milliseconds(20));
    messenger.publish<int>("n", 1);
    std::this_thread::sleep_for(milliseconds(20));
    messenger.publish<int>("n", 2);
  });
  const auto first = inbox.waitFor(milliseconds::max());
  const auto second = inbox.waitFor(std::chrono::duration<double>(1e300));
  sender.join();
  ASSERT_TRUE(first != nullptr && second != nullptr);
  EXPECT_EQ(*second, 2);
  EXPECT_EQ(inbox.waitFor(milliseconds::min()), nullptr);
  EXPECT_EQ(inbox.waitFor(std::chrono::hours(-1)), nullptr);
}

TEST(WaitTime, OfASpinMayBeForEver) {
  const Messenger messenger;
  std::atomic<int> sum{0};
  Subscriber subscriber = messenger.subscribe<int>("n", inOwnThread().spinFor(microseconds::max()),
                                                   [&](const int& n) { sum += n; });
  for (int i = 0; i < 100; ++i) messenger.publish<int>("n", 1);
  subscriber.unsubscribe(Pending::drain);
  EXPECT_EQ(sum, 100);
}

TEST(WaitTime, OfACallMayBeForEver) {
  const Messenger messenger;
  const Subscriber server = messenger.serve<int, int>("s", inOwnThread(), [](const int& n) {
    std::this_thread::sleep_for(milliseconds(20));
    return n;
  });
  EXPECT_EQ((messenger.call<int, int>("s", 5, milliseconds::max())), 5);
}

}  // namespace
