// Callbacks that use the messenger they are called by.
#include <gslam/messenger.h>
#include <gtest/gtest.h>

#include <future>
#include <memory>
#include <stdexcept>
#include <string>
#include <vector>

namespace {

using gslam::inOwnThread;
using gslam::Messenger;
using gslam::onExecutor;
using gslam::Publisher;
using gslam::SubscribeOptions;
using gslam::Subscriber;

std::vector<SubscribeOptions> allDeliveries() {
  return {SubscribeOptions(), inOwnThread(), onExecutor(std::make_shared<gslam::ThreadPool>(2))};
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

TEST(Callback, MayEndOthers) {
  const Messenger messenger;
  const auto publisher = messenger.advertise<int>("n");
  int calls = 0;
  Subscriber second;
  const Subscriber first = messenger.subscribe<int>("n", [&](const int&) { second.unsubscribe(); });
  second = messenger.subscribe<int>("n", [&](const int&) { ++calls; });
  publisher.publish(1);
  EXPECT_EQ(calls, 0);  // ended before its turn
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
