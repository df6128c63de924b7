#include <gmock/gmock.h>
#include <gslam/messenger.h>
#include <gtest/gtest.h>

#include <atomic>
#include <memory>
#include <stdexcept>
#include <string>
#include <thread>
#include <vector>

namespace {

using gslam::Messenger;
using gslam::Publisher;
using gslam::Subscriber;
using testing::ElementsAre;

template <class T>
using Shared = std::shared_ptr<const T>;

TEST(Messenger, DeliversInOrderToEveryone) {
  const Messenger messenger;
  std::vector<int> first, second;
  const Subscriber a = messenger.subscribe<int>(
      "/n", [&first](const Shared<int>& message) { first.push_back(*message); });
  const Subscriber b = messenger.subscribe<int>(
      "/n", [&second](const Shared<int>& message) { second.push_back(*message); });
  const Publisher<int> publisher = messenger.advertise<int>("/n");
  EXPECT_EQ(publisher.subscriberCount(), 2u);
  for (int i = 0; i < 3; ++i) publisher.publish(i);
  EXPECT_THAT(first, ElementsAre(0, 1, 2));
  EXPECT_THAT(second, ElementsAre(0, 1, 2));
}

TEST(Messenger, SharedMessageIsNotCopied) {
  const Messenger messenger;
  struct Big {
    std::vector<char> bytes;
  };
  std::vector<const void*> seen;
  std::vector<Subscriber> subscribers;
  for (int i = 0; i < 16; ++i) {
    subscribers.push_back(messenger.subscribe<Big>(
        "/big", [&seen](const Shared<Big>& message) { seen.push_back(message.get()); }));
  }
  const auto message = std::make_shared<const Big>(Big{std::vector<char>(1 << 20)});
  messenger.advertise<Big>("/big").publish(message);
  EXPECT_EQ(seen, std::vector<const void*>(16, message.get()));
}

TEST(Messenger, TakesMoveOnlyMessages) {
  const Messenger messenger;
  int got = 0;
  const Subscriber subscriber = messenger.subscribe<std::unique_ptr<int>>(
      "/m", [&got](const Shared<std::unique_ptr<int>>& message) { got = **message; });
  messenger.advertise<std::unique_ptr<int>>("/m").publish(std::unique_ptr<int>(new int(5)));
  EXPECT_EQ(got, 5);
}

TEST(Messenger, SendsByNameWhatIsCopiedMovedOrShared) {
  const Messenger messenger;
  std::vector<std::string> seen;
  const Subscriber subscriber = messenger.subscribe<std::string>(
      "/s", [&seen](const Shared<std::string>& message) { seen.push_back(*message); });
  const std::string copied(100, 'c');
  std::string moved(100, 'm');
  const char* const text = moved.data();
  messenger.publish<std::string>("/s", copied);
  messenger.publish("/s", copied);
  messenger.publish<std::string>("/s", "literal");
  messenger.publish<std::string>("/s", std::make_shared<const std::string>("shared"));
  EXPECT_THAT(seen, ElementsAre(copied, copied, "literal", "shared"));
  gslam::Inbox<std::string> inbox = messenger.inbox<std::string>("/s");
  messenger.publish("/s", std::move(moved));
  EXPECT_EQ(inbox.take()->data(), text);
}

TEST(Messenger, MessageOutlivesItsPublisher) {
  Shared<std::string> kept;
  {
    const Messenger messenger;
    const Subscriber subscriber = messenger.subscribe<std::string>(
        "/s", [&kept](const Shared<std::string>& message) { kept = message; });
    messenger.advertise<std::string>("/s").publish("text");
  }
  EXPECT_EQ(*kept, "text");
}

TEST(Messenger, RefusesAnotherTypeNamingTopicAndBoth) {
  const Messenger messenger;
  messenger.advertise<int>("/n");
  for (bool publish : {true, false}) {
    try {
      if (publish) messenger.advertise<double>("/n");
      if (!publish) messenger.subscribe<double>("/n", [](const Shared<double>&) {}).keep();
      FAIL() << "a double on a topic of int must be refused";
    } catch (const gslam::TypeMismatch& error) {
      EXPECT_STREQ(error.what(), "topic /n carries int, not double");
    }
  }
}

TEST(Messenger, LeadingSlashMayBeLeftOut) {
  const Messenger messenger;
  EXPECT_EQ(messenger.advertise<int>("sensor/imu").topic(), "/sensor/imu");
}

TEST(Messenger, RefusesImpossibleNames) {
  const Messenger messenger;
  for (const char* name : {"", "/", "//a", "/a/", "/a//b", "/a b", "/a.b", "/\xc3\xa4", "a\n"}) {
    EXPECT_THROW(messenger.advertise<int>(name), gslam::ArgumentError) << name;
  }
  EXPECT_THROW(messenger.subscribe<int>("/n", std::function<void(const int&)>()).keep(),
               gslam::ArgumentError);
  EXPECT_THROW(messenger.advertise<int>("/n").publish(nullptr), gslam::ArgumentError);
}

TEST(Messenger, EndOfTheHandleEndsTheSubscription) {
  const Messenger messenger;
  int calls = 0;
  const auto count = [&calls](const Shared<int>&) { ++calls; };
  const Publisher<int> publisher = messenger.advertise<int>("/n");
  {
    const Subscriber subscriber = messenger.subscribe<int>("/n", count);
    publisher.publish(1);
  }
  publisher.publish(2);
  EXPECT_EQ(calls, 1);
  messenger.subscribe<int>("/n", count).keep();
  publisher.publish(3);
  EXPECT_EQ(calls, 2);
}

TEST(Messenger, HandleMoves) {
  const Messenger messenger;
  int calls = 0;
  Subscriber outer;
  EXPECT_FALSE(outer);
  outer = messenger.subscribe<int>("/n", [&calls](const Shared<int>&) { ++calls; });
  EXPECT_TRUE(outer);
  EXPECT_EQ(outer.topic(), "/n");
  const Publisher<int> publisher = messenger.advertise<int>("/n");
  publisher.publish(1);
  outer = Subscriber();
  publisher.publish(2);
  EXPECT_EQ(calls, 1);
}

TEST(Messenger, CallbackThatThrowsDoesNotStopTheOthers) {
  std::vector<std::string> logged;
  gslam::setLogSink(
      [&logged](const gslam::LogRecord& record) { logged.push_back(record.message); });
  const Messenger messenger;
  int calls = 0;
  const Subscriber bad = messenger.subscribe<int>(
      "/n", [](const Shared<int>&) { throw std::runtime_error("out of film"); });
  const Subscriber worse = messenger.subscribe<int>("/n", [](const Shared<int>&) { throw 1; });
  const Subscriber good = messenger.subscribe<int>("/n", [&calls](const Shared<int>&) { ++calls; });
  EXPECT_NO_THROW(messenger.advertise<int>("/n").publish(1));
  gslam::setLogSink(nullptr);
  EXPECT_EQ(calls, 1);
  ASSERT_EQ(logged.size(), 2u);
  EXPECT_EQ(logged[0], "a subscriber of /n threw: out of film");
}

TEST(Messenger, CallbackMayPublishSubscribeAndUnsubscribeItself) {
  Messenger messenger;
  std::vector<int> order;
  Subscriber late, self;
  const Publisher<int> publisher = messenger.advertise<int>("/n");
  self = messenger.subscribe<int>("/n", [&](const Shared<int>& message) {
    order.push_back(*message);
    self.unsubscribe();
    late = messenger.subscribe<int>(
        "/n", [&order](const Shared<int>& inner) { order.push_back(10 * *inner); });
    messenger = Messenger();  // the topic outlives its messenger
    publisher.publish(2);
  });
  publisher.publish(1);
  EXPECT_THAT(order, ElementsAre(1, 20));
}

// The callback holds the last handle of what owns its subscriber.
TEST(Messenger, EndOfTheCallbackMayEndTheSubscriber) {
  struct Owner {
    Subscriber subscriber;
  };
  for (bool keep : {false, true}) {
    const Messenger messenger;
    auto owner = std::make_shared<Owner>();
    Owner* const raw = owner.get();
    raw->subscriber = messenger.subscribe<int>("/n", [owner](const Shared<int>&) {});
    owner.reset();
    if (keep) raw->subscriber.keep();
    if (!keep) raw->subscriber.unsubscribe();
  }
}

TEST(Messenger, UnsubscribedDuringDeliveryIsNotCalled) {
  const Messenger messenger;
  int calls = 0;
  Subscriber second;
  const Subscriber first =
      messenger.subscribe<int>("/n", [&second](const Shared<int>&) { second.unsubscribe(); });
  second = messenger.subscribe<int>("/n", [&calls](const Shared<int>&) { ++calls; });
  messenger.advertise<int>("/n").publish(1);
  EXPECT_EQ(calls, 0);
}

TEST(Messenger, SubscribersMayChangeWhileThreadsPublish) {
  const Messenger messenger;
  std::atomic<int> steady_calls(0);
  const Subscriber steady =
      messenger.subscribe<int>("/n", [&steady_calls](const Shared<int>&) { ++steady_calls; });
  std::vector<std::thread> threads;
  for (int t = 0; t < 3; ++t) {
    threads.emplace_back([&messenger] {
      const Publisher<int> publisher = messenger.advertise<int>("/n");
      for (int i = 0; i < 2000; ++i) publisher.publish(i);
    });
  }
  for (int i = 0; i < 500; ++i) {
    const Subscriber churn =
        messenger.subscribe<int>("/n", [](const Shared<int>& message) { (void)*message; });
  }
  for (std::thread& thread : threads) thread.join();
  EXPECT_EQ(steady_calls.load(), 6000);
}

}  // namespace
