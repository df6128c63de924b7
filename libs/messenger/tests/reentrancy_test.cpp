// Callbacks that use the messenger they are called by.
#include <gslam/messenger.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <atomic>
#include <future>
#include <memory>
#include <stdexcept>
#include <string>
#include <thread>
#include <vector>

namespace {

using gslam::Delivery;
using gslam::inOwnThread;
using gslam::Messenger;
using gslam::onExecutor;
using gslam::Pending;
using gslam::Publisher;
using gslam::SubscribeOptions;
using gslam::Subscriber;

std::vector<SubscribeOptions> allDeliveries() {
  return {SubscribeOptions(), inOwnThread(), onExecutor(std::make_shared<gslam::ThreadPool>(2)),
          onExecutor(std::make_shared<gslam::ThreadPool>(1))};
}

TEST(Callback, MayPublishSubscribeAndLookAround) {
  for (const SubscribeOptions& options : allDeliveries()) {
    const Messenger messenger;
    const auto a = messenger.advertise<int>("a");
    const auto b = messenger.advertise<int>("b");
    std::promise<int> done;
    Subscriber inner;
    const Subscriber end = messenger.subscribe<int>("b", [&](const int& n) {
      if (n == 3) done.set_value(n);
    });
    Subscriber outer = messenger.subscribe<int>("a", options, [&](const int& n) {
      inner = messenger.subscribe<int>("a", [](const int&) {});
      EXPECT_EQ(messenger.topics().size(), 3u);
      b.publish(n);
      if (n < 3) a.publish(n + 1);
    });
    a.publish(0);
    EXPECT_EQ(done.get_future().get(), 3);
  }
}

TEST(Callback, MayEndItsOwnSubscription) {
  for (const SubscribeOptions& options : allDeliveries()) {
    const Messenger messenger;
    const auto publisher = messenger.advertise<int>("n");
    int calls = 0;
    std::promise<void> done;
    std::unique_ptr<Subscriber> subscriber(new Subscriber);
    *subscriber = messenger.subscribe<int>("n", options, [&](const int&) {
      ++calls;
      subscriber.reset();
      done.set_value();
    });
    publisher.publish(1);
    done.get_future().wait();
    publisher.publish(2);
    EXPECT_EQ(publisher.subscriberCount(), 0u);
    EXPECT_EQ(calls, 1);
  }
}

TEST(Callback, MayEndOthersBeforeTheirTurn) {
  const Messenger messenger;
  const auto publisher = messenger.advertise<int>("n");
  int calls = 0;
  Subscriber second;
  const Subscriber first = messenger.subscribe<int>("n", [&](const int&) { second.unsubscribe(); });
  second = messenger.subscribe<int>("n", [&](const int&) { ++calls; });
  publisher.publish(1);
  EXPECT_EQ(calls, 0);  // ended before its turn
}

// B has a message that waits, on an executor for the very worker that ends B.
TEST(Callback, MayEndOthers) {
  for (const SubscribeOptions& options : allDeliveries()) {
    for (const Pending pending : {Pending::discard, Pending::drain}) {
      const Messenger messenger;
      Subscriber b;
      std::promise<void> sent;
      std::promise<void> done;
      const Subscriber a = messenger.subscribe<int>("a", options, [&](const int&) {
        if (options.delivery != Delivery::synchronous) sent.get_future().wait();
        b.unsubscribe(pending);
        done.set_value();
      });
      b = messenger.subscribe<int>("b", options, [](const int&) {});
      messenger.publish<int>("a", 1);
      for (int i = 0; i < 100; ++i) messenger.publish<int>("b", i);
      sent.set_value();
      done.get_future().wait();
      EXPECT_EQ(messenger.advertise<int>("b").subscriberCount(), 0u);
    }
  }
}

// Each is in its callback when the other ends it.
TEST(Callback, MayEndTheOneThatEndsIt) {
  for (const SubscribeOptions& options :
       {SubscribeOptions(), inOwnThread(), onExecutor(std::make_shared<gslam::ThreadPool>(2))}) {
    const Messenger messenger;
    Subscriber a;
    Subscriber b;
    std::atomic<int> inside{0};
    std::promise<void> done[2];
    const auto end = [&](Subscriber& other, std::promise<void>& its_done) {
      ++inside;
      while (inside < 2) std::this_thread::yield();
      other.unsubscribe();
      its_done.set_value();
    };
    a = messenger.subscribe<int>("a", options, [&](const int&) { end(b, done[0]); });
    b = messenger.subscribe<int>("b", options, [&](const int&) { end(a, done[1]); });
    std::thread sender([&] { messenger.publish<int>("a", 1); });
    messenger.publish<int>("b", 1);
    for (std::promise<void>& one : done) one.get_future().wait();
    sender.join();
  }
}

// Whatever the callback destroys must last until it has returned.
TEST(Callback, MayDestroyEverything) {
  for (const SubscribeOptions& options : allDeliveries()) {
    struct All {
      Messenger messenger;
      Publisher<std::string> publisher;
      Subscriber subscriber;
      Subscriber second;
    };
    auto all = std::make_shared<All>();
    std::weak_ptr<All> watched = all;
    std::promise<std::string> done;
    All& inside = *all;
    inside.publisher = inside.messenger.advertise<std::string>("n");
    inside.subscriber =
        inside.messenger.subscribe<std::string>("n", options, [&](const std::string& text) {
          const std::string copy(text.begin(), text.end());
          all.reset();
          done.set_value(text + copy);
        });
    inside.second = inside.messenger.subscribe<std::string>("n", [](const std::string&) {});
    const Publisher<std::string> publisher = inside.publisher;  // publish() needs its own object
    publisher.publish(std::string(100, 'x'));
    EXPECT_EQ(done.get_future().get(), std::string(200, 'x'));
    EXPECT_TRUE(watched.expired());
  }
}

TEST(Callback, WhatItGivesUpEndsWithIt) {
  for (const SubscribeOptions& options : allDeliveries()) {
    const Messenger messenger;
    const auto counted = std::make_shared<int>();
    std::atomic<long> most{0};
    std::promise<void> done;
    Subscriber subscriber = messenger.subscribe<int>("n", options, [&](const int& n) {
      const Messenger local;
      local.subscribe<int>("n", [counted](const int&) {}).keep();
      most = std::max(most.load(), counted.use_count());
      if (n == 99) done.set_value();
    });
    for (int i = 0; i < 100; ++i) messenger.publish<int>("n", i);
    done.get_future().wait();
    EXPECT_LE(most, 2);
  }
}

TEST(Callback, MayDestroyThePublisherThatIsSending) {
  const Messenger messenger;
  auto publisher =
      std::unique_ptr<Publisher<int>>(new Publisher<int>(messenger.advertise<int>("n")));
  int calls = 0;
  const Subscriber first = messenger.subscribe<int>("n", [&](const int&) { publisher.reset(); });
  const Subscriber second = messenger.subscribe<int>("n", [&](const int&) { ++calls; });
  publisher->publish(1);
  EXPECT_EQ(calls, 1);
}

TEST(Callback, MayThrowAndOthersStillGetTheMessage) {
  for (const SubscribeOptions& options : allDeliveries()) {
    const Messenger messenger;
    const auto publisher = messenger.advertise<int>("n");
    std::promise<std::string> told;
    messenger.onError([&](const std::string& topic, const std::exception_ptr& error) {
      try {
        std::rethrow_exception(error);
      } catch (const std::exception& problem) {
        told.set_value(topic + ": " + problem.what());
      }
    });
    std::promise<int> got;
    const Subscriber bad =
        messenger.subscribe<int>("n", options, [](const int&) { throw std::runtime_error("no"); });
    const Subscriber good =
        messenger.subscribe<int>("n", options, [&](const int& n) { got.set_value(n); });
    publisher.publish(5);
    EXPECT_EQ(told.get_future().get(), "/n: no");
    EXPECT_EQ(got.get_future().get(), 5);
  }
}

TEST(Callback, HandlerOfErrorsMayThrow) {
  const Messenger messenger;
  messenger.onError(
      [](const std::string&, const std::exception_ptr& error) { std::rethrow_exception(error); });
  const auto publisher = messenger.advertise<int>("n");
  const Subscriber bad = messenger.subscribe<int>("n", [](const int&) { throw 7; });
  EXPECT_NO_THROW(publisher.publish(1));
}

TEST(Callback, OfAMemberFunction) {
  struct View {
    void byReference(const int& n) { sum += n; }
    void byPointer(const std::shared_ptr<const int>& n) { sum += *n; }
    void constant(int n) const { *other += n; }
    int sum = 0;
    int* other = nullptr;
  };
  const Messenger messenger;
  const auto publisher = messenger.advertise<int>("n");
  View view;
  int other = 0;
  view.other = &other;
  const auto shared = std::make_shared<View>();
  const Subscriber a = messenger.subscribe<int>("n", &View::byReference, &view);
  const Subscriber b = messenger.subscribe<int>("n", SubscribeOptions(), &View::byPointer, &view);
  const Subscriber c = messenger.subscribe<int>("n", &View::constant, &view);
  const Subscriber d = messenger.subscribe<int>("n", &View::byReference, shared);
  publisher.publish(3);
  EXPECT_EQ(view.sum, 6);
  EXPECT_EQ(other, 3);
  EXPECT_EQ(shared->sum, 3);
  EXPECT_THROW(
      messenger.subscribe<int>("n", &View::byReference, static_cast<View*>(nullptr)).keep(),
      gslam::ArgumentError);
}

#if __cplusplus >= 201402L
TEST(Callback, ThatIsGenericGetsAReference) {
  struct Pose {
    int x;
  };
  const Messenger messenger;
  int sum = 0;
  const Subscriber a = messenger.subscribe<Pose>("p", [&](const auto& pose) { sum += pose.x; });
  messenger.publish<Pose>("p", Pose{3});
  EXPECT_EQ(sum, 3);
}
#endif

}  // namespace
