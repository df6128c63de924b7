// Names, name spaces, patterns, types, services and what can be seen of all that.
#include <gslam/messenger.h>
#include <gtest/gtest.h>

#include <chrono>
#include <cstring>
#include <memory>
#include <string>
#include <thread>
#include <vector>

struct anonymous_vote {};  // NOLINT(readability-identifier-naming)

namespace {

using gslam::AnyMessage;
using gslam::Messenger;
using gslam::ServiceError;
using gslam::SubscribeOptions;
using gslam::Subscriber;
using gslam::TopicInfo;
using gslam::detail::matchesPattern;
using gslam::detail::PayloadType;
using std::chrono::milliseconds;

TEST(Names, LieInNameSpaces) {
  const Messenger messenger;
  const Messenger orb = messenger.inNamespace("orb");
  EXPECT_EQ(orb.advertise<int>("pose").topic(), "/orb/pose");
  EXPECT_EQ(orb.advertise<int>("/pose").topic(), "/pose");
  EXPECT_EQ(orb.inNamespace("left").advertise<int>("image").topic(), "/orb/left/image");
  EXPECT_EQ(orb.inNamespace("/left").advertise<int>("image").topic(), "/left/image");
  EXPECT_THROW(messenger.inNamespace("a b"), gslam::ArgumentError);
  int got = 0;
  const Subscriber subscriber =
      messenger.subscribe<int>("orb/pose", [&](const int& n) { got = n; });
  orb.advertise<int>("pose").publish(3);
  EXPECT_EQ(got, 3);
}

TEST(Names, MayBeMapped) {
  const Messenger messenger;
  const Messenger mapped = messenger.remapped({{"image", "/camera/left"}, {"/a", "b"}});
  EXPECT_EQ(mapped.advertise<int>("image").topic(), "/camera/left");
  EXPECT_EQ(mapped.advertise<int>("/a").topic(), "/b");
  EXPECT_EQ(mapped.advertise<int>("b").topic(), "/b");
  EXPECT_EQ(messenger.advertise<int>("image").topic(), "/image");
  const Messenger more = mapped.inNamespace("orb").remapped({{"image", "image"}, {"pose", "/p"}});
  EXPECT_EQ(more.advertise<int>("image").topic(), "/orb/image");
  EXPECT_EQ(more.advertise<int>("pose").topic(), "/p");
  EXPECT_EQ(more.advertise<int>("/image").topic(), "/camera/left");
}

// All that a pattern may stand for, tried one by one.
bool matchesByDefinition(const std::string& pattern, const std::string& name) {
  if (pattern.empty()) return name.empty();
  if (pattern[0] != '*') {
    return !name.empty() && name[0] == pattern[0] &&
           matchesByDefinition(pattern.substr(1), name.substr(1));
  }
  const bool any = pattern.compare(0, 2, "**") == 0;
  for (std::size_t i = 0;; ++i) {
    if (matchesByDefinition(pattern.substr(any ? 2 : 1), name.substr(i))) return true;
    if (i == name.size() || (!any && name[i] == '/')) return false;
  }
}

TEST(Patterns, MatchAsTheyAreDefined) {
  EXPECT_TRUE(matchesPattern("/sensor/*", "/sensor/imu"));
  EXPECT_FALSE(matchesPattern("/sensor/*", "/sensor/left/image"));
  EXPECT_TRUE(matchesPattern("/**", "/sensor/left/image"));
  std::vector<std::string> patterns = {""};
  std::vector<std::string> names = {""};
  for (std::size_t i = 0; i < patterns.size() && patterns[i].size() < 5; ++i) {
    for (const char c : {'a', '/', '*'}) patterns.push_back(patterns[i] + c);
  }
  for (std::size_t i = 0; i < names.size() && names[i].size() < 5; ++i) {
    for (const char c : {'a', '/'}) names.push_back(names[i] + c);
  }
  for (const std::string& pattern : patterns) {
    for (const std::string& name : names) {
      ASSERT_EQ(matchesPattern(pattern, name), matchesByDefinition(pattern, name))
          << pattern << " " << name;
    }
  }
}

TEST(AnyTopic, GetsMessagesOfAllTypesNowAndLater) {
  const Messenger messenger;
  const auto before = messenger.advertise<int>("a/n");
  std::vector<std::string> seen;
  Subscriber subscriber = messenger.subscribeAny("/a/*", [&](const AnyMessage& message) {
    seen.push_back(message.topic() + " " + message.typeName());
    if (message.is<int>()) seen.push_back(std::to_string(*message.as<int>()));
    if (!message.is<int>()) {
      EXPECT_THROW(message.as<int>(), gslam::TypeMismatch);
    }
  });
  const auto after = messenger.advertise<double>("a/x");
  const auto other = messenger.advertise<int>("b/n");
  before.publish(1);
  after.publish(2.5);
  other.publish(3);
  EXPECT_EQ(seen, (std::vector<std::string>{"/a/n int", "1", "/a/x double"}));
  subscriber.unsubscribe();
  before.publish(4);
  EXPECT_EQ(seen.size(), 3u);
  EXPECT_EQ(before.subscriberCount(), 0u);
  EXPECT_EQ(AnyMessage().topic(), "");
  EXPECT_FALSE(AnyMessage().is<int>());
}

TEST(AnyTopic, MayBeQueuedAndKept) {
  int count = 0;
  {
    const Messenger messenger;
    messenger
        .subscribeAny("/**", gslam::inOwnThread().drainAtEnd(), [&](const AnyMessage&) { ++count; })
        .keep();
    for (int i = 0; i < 100; ++i) messenger.advertise<int>("n" + std::to_string(i % 3)).publish(i);
  }
  EXPECT_EQ(count, 100);
}

TEST(Types, AreEqualAcrossLibrariesByNameUnlessUnnamed) {
  EXPECT_TRUE(PayloadType::of<int>() == PayloadType::of<int>());
  EXPECT_TRUE(PayloadType::of<int>() != PayloadType::of<unsigned>());
  PayloadType larger = PayloadType::of<std::string>();
  larger.size += 8;
  EXPECT_TRUE(larger == PayloadType::of<std::string>());  // one type_info: one type
  struct Local {};
  EXPECT_TRUE(gslam::detail::isLocalToLibrary(typeid(Local).name()));  // in an unnamed namespace
  EXPECT_FALSE(gslam::detail::isLocalToLibrary(typeid(std::string).name()));
  EXPECT_FALSE(gslam::detail::isLocalToLibrary(typeid(anonymous_vote).name()));
  EXPECT_TRUE(gslam::detail::isLocalToLibrary("(anonymous namespace)::Pose"));
  EXPECT_TRUE(gslam::detail::isLocalToLibrary("{anonymous}::Pose"));
}

TEST(Info, TellsWhoPublishesAndListens) {
  const Messenger messenger;
  const auto publisher = messenger.advertise<int>("n");
  const auto copy = publisher;  // NOLINT(performance-unnecessary-copy-initialization)
  const auto second = messenger.advertise<int>("n", gslam::Latch::on);
  const Subscriber viewer =
      messenger.subscribe<int>("n", SubscribeOptions().named("viewer"), [](const int&) {});
  const Subscriber recorder = messenger.subscribeAny("/**", [](const AnyMessage&) {});
  auto inbox = messenger.inbox<int>("n", SubscribeOptions().keepLast(2));
  const TopicInfo before = messenger.topics()[1];
  for (int i = 0; i < 5; ++i) publisher.publish(i);
  const TopicInfo info = messenger.topics()[1];
  EXPECT_EQ(info.name, "/n");
  EXPECT_EQ(info.type, "int");
  EXPECT_EQ(info.publishers, 2u);
  EXPECT_EQ(info.messages, 5u);
  EXPECT_EQ(info.bytes, 5 * sizeof(int));
  EXPECT_TRUE(info.is_latched);
  ASSERT_EQ(info.subscribers.size(), 3u);
  EXPECT_EQ(info.subscribers[0].name, "viewer");
  EXPECT_EQ(info.subscribers[1].pattern, "/**");
  EXPECT_TRUE(info.subscribers[1].takes_any);
  EXPECT_EQ(info.subscribers[2].waiting, 2u);
  EXPECT_EQ(info.subscribers[2].dropped, 3u);
  EXPECT_GT(gslam::messageRate(before, info), 0);
  EXPECT_EQ(gslam::messageRate(info, info), 0);
}

TEST(Info, TellsOfChanges) {
  const Messenger messenger;
  std::vector<std::string> seen;
  const Subscriber watcher = messenger.subscribe<gslam::TopicChange>(
      "/messenger/changes", [&](const gslam::TopicChange& change) {
        seen.push_back(std::to_string(change.kind) + change.topic + " " + change.type);
      });
  seen.clear();
  {
    const auto publisher = messenger.advertise<int>("n");
    const Subscriber subscriber = messenger.subscribe<int>("n", [](const int&) {});
  }
  EXPECT_EQ(seen, (std::vector<std::string>{"0/n int", "2/n int", "3/n int", "1/n int"}));
}

TEST(Info, TellsOfPatternsWhereTheyMatch) {
  const Messenger messenger;
  const auto a = messenger.advertise<int>("a/n");
  const auto b = messenger.advertise<int>("b/n");
  std::vector<std::string> seen;
  const Subscriber watcher = messenger.subscribe<gslam::TopicChange>(
      "/messenger/changes", [&](const gslam::TopicChange& change) {
        seen.push_back(std::to_string(change.kind) + change.topic);
      });
  messenger.subscribeAny("/a/*", [](const AnyMessage&) {}).unsubscribe();
  EXPECT_EQ(seen, (std::vector<std::string>{"2/a/n", "3/a/n"}));
}

TEST(Service, Answers) {
  for (const SubscribeOptions& options : {SubscribeOptions(), gslam::inOwnThread()}) {
    const Messenger messenger;
    EXPECT_FALSE(messenger.hasService("half"));
    Subscriber server = messenger.serve<int, double>("half", options, [](const int& n) {
      if (n < 0) throw gslam::ArgumentError("n", "is negative");
      return n / 2.0;
    });
    EXPECT_TRUE(messenger.hasService("/half"));
    EXPECT_EQ((messenger.call<int, double>("half", 5, milliseconds(60000))), 2.5);
    EXPECT_THROW((messenger.call<int, double>("half", -5, milliseconds(60000))),
                 gslam::ArgumentError);
    EXPECT_THROW((messenger.call<int, int>("half", 5, milliseconds(1))), gslam::TypeMismatch);
    EXPECT_THROW((messenger.serve<int, double>("half", [](const int&) { return 1.0; }).keep()),
                 gslam::ArgumentError);
    server.unsubscribe();
    EXPECT_FALSE(messenger.hasService("half"));
  }
}

TEST(Service, SaysWhyThereIsNoAnswer) {
  const Messenger messenger;
  const auto reason = [&](int request) {
    try {
      messenger.call<int, int>("s", request, milliseconds(20));
    } catch (const ServiceError& error) {
      return static_cast<int>(error.reason());
    }
    return -1;
  };
  EXPECT_EQ(reason(1), ServiceError::unavailable);
  int handled = 0;
  Subscriber server =
      messenger.serve<int, int>("s", gslam::inOwnThread().dropNewest(1), [&](const int& n) {
        ++handled;
        std::this_thread::sleep_for(milliseconds(100));
        return n;
      });
  EXPECT_EQ(reason(1), ServiceError::timeout);  // being handled
  EXPECT_EQ(reason(2), ServiceError::timeout);  // waits
  EXPECT_EQ(reason(3), ServiceError::dropped);
  server.unsubscribe(gslam::Pending::drain);
  EXPECT_EQ(handled, 1);  // nobody waited for the second any more
}

TEST(Service, EndOfTheServerFreesWhoWaits) {
  const Messenger messenger;
  Subscriber server = messenger.serve<int, int>("s", gslam::inOwnThread(), [](const int& n) {
    std::this_thread::sleep_for(milliseconds(50));
    return n;
  });
  std::vector<std::thread> callers;
  std::atomic<int> answers{0};
  std::atomic<int> dropped{0};
  for (int i = 0; i < 4; ++i) {
    callers.emplace_back([&] {
      try {
        messenger.call<int, int>("s", 1, milliseconds(60000));
        ++answers;
      } catch (const ServiceError&) {
        ++dropped;
      }
    });
  }
  std::this_thread::sleep_for(milliseconds(20));
  server.unsubscribe();
  for (std::thread& caller : callers) caller.join();
  EXPECT_EQ(answers + dropped, 4);
  EXPECT_GE(dropped, 1);
}

TEST(DefaultMessenger, IsOneUntilTheHostHandsOverIts) {
  int got = 0;
  const Subscriber subscriber =
      gslam::defaultMessenger().subscribe<int>("d", [&](const int& n) { got = n; });
  gslam::defaultMessenger().advertise<int>("d").publish(3);
  EXPECT_EQ(got, 3);
  const Messenger host;
  gslam::setDefaultMessenger(host);
  host.advertise<int>("host");
  EXPECT_EQ(gslam::defaultMessenger().topics().size(), 2u);
}

}  // namespace
