// Structs that ROS 1 generates are payloads as they are. Uses Debian's libstd-msgs-dev,
// libgeometry-msgs-dev and libsensor-msgs-dev; where these are not installed the test says so. They
// do not compile as C++20, which has taken std::allocator::rebind away.
#include <gtest/gtest.h>

#if defined(__has_include) && __cplusplus < 202002L
#if __has_include(<sensor_msgs/Imu.h>) && __has_include(<geometry_msgs/PoseStamped.h>)
#define HAS_ROS_MESSAGES 1
#endif
#endif

#ifndef HAS_ROS_MESSAGES

TEST(RosMessages, ArePayloads) {
  GTEST_SKIP()
      << "the headers of sensor_msgs and geometry_msgs are not installed, or this is C++20";
}

#else

#include <geometry_msgs/PoseStamped.h>
#include <gslam/messenger.h>
#include <sensor_msgs/Image.h>
#include <sensor_msgs/Imu.h>
#include <std_msgs/String.h>

#include <cstdint>
#include <memory>
#include <string>
#include <utility>
#include <vector>

namespace {

using gslam::AnyMessage;
using gslam::Messenger;
using gslam::Subscriber;

template <class T>
T at(std::int64_t nanoseconds) {
  T message;
  message.header.stamp.sec = static_cast<std::uint32_t>(nanoseconds / 1000000000);
  message.header.stamp.nsec = static_cast<std::uint32_t>(nanoseconds % 1000000000);
  return message;
}

TEST(RosMessages, ArePayloads) {
  const Messenger messenger;
  const auto publisher = messenger.advertise<geometry_msgs::PoseStamped>("pose");
  std::vector<double> seen;
  const Subscriber here = messenger.subscribe<geometry_msgs::PoseStamped>(
      "pose",
      [&](const geometry_msgs::PoseStamped& pose) { seen.push_back(pose.pose.position.x); });
  auto inbox = messenger.inbox<geometry_msgs::PoseStamped>("pose");
  geometry_msgs::PoseStamped pose = at<geometry_msgs::PoseStamped>(5);
  pose.pose.position.x = 1.5;
  publisher.publish(pose);
  pose.pose.position.x = 2.5;
  publisher.publish(std::move(pose));
  EXPECT_EQ(seen, (std::vector<double>{1.5, 2.5}));
  EXPECT_EQ(inbox.take()->pose.position.x, 1.5);
  EXPECT_EQ(inbox.take()->header.stamp.nsec, 5u);
  EXPECT_THROW(messenger.advertise<std_msgs::String>("pose"), gslam::TypeMismatch);
}

TEST(RosMessages, GoToManyWithoutACopy) {
  const Messenger messenger;
  std::vector<const void*> seen;
  std::vector<Subscriber> subscribers;
  for (int i = 0; i < 16; ++i) {
    subscribers.push_back(messenger.subscribe<sensor_msgs::Image>(
        "image", [&](const std::shared_ptr<const sensor_msgs::Image>& image) {
          seen.push_back(image->data.data());
        }));
  }
  sensor_msgs::Image image;
  image.data.resize(1 << 20);
  const void* const pixels = image.data.data();
  messenger.advertise<sensor_msgs::Image>("image").publish(std::move(image));
  EXPECT_EQ(seen, std::vector<const void*>(16, pixels));
}

// What ROS hands out is held by a boost::shared_ptr.
TEST(RosMessages, ThatRosOwnsAreNotCopied) {
  const Messenger messenger;
  auto inbox = messenger.inbox<sensor_msgs::Imu>("imu");
  const sensor_msgs::Imu::ConstPtr owned(new sensor_msgs::Imu);
  const std::shared_ptr<const sensor_msgs::Imu> shared(owned.get(),
                                                       [owned](const sensor_msgs::Imu*) {});
  messenger.advertise<sensor_msgs::Imu>("imu").publish(shared);
  EXPECT_EQ(inbox.take().get(), owned.get());
}

TEST(RosMessages, AreSynchronisedByTheirHeaders) {
  const Messenger messenger;
  std::vector<std::pair<std::int64_t, std::int64_t>> seen;
  const auto see = [&](const sensor_msgs::Image& image, const sensor_msgs::Imu& imu) {
    seen.emplace_back(gslam::MessageStamp<sensor_msgs::Image>::nanoseconds(image),
                      gslam::MessageStamp<sensor_msgs::Imu>::nanoseconds(imu));
  };
  const gslam::Synchronizer<sensor_msgs::Image, sensor_msgs::Imu> exact(
      messenger, {"image", "imu"}, gslam::exactTime(), 10, see);
  const gslam::Synchronizer<sensor_msgs::Image, sensor_msgs::Imu> close(
      messenger, {"left", "imu"}, gslam::approximateTime(1000000), 10, see);
  const std::int64_t time = 4000000000123456789;  // beyond 2038, where int32 seconds end
  const auto imu = messenger.advertise<sensor_msgs::Imu>("imu");
  imu.publish(at<sensor_msgs::Imu>(time));
  messenger.advertise<sensor_msgs::Image>("image").publish(at<sensor_msgs::Image>(time));
  messenger.advertise<sensor_msgs::Image>("left").publish(at<sensor_msgs::Image>(time + 500000));
  imu.publish(at<sensor_msgs::Imu>(time + 5000000));
  EXPECT_EQ(seen, (std::vector<std::pair<std::int64_t, std::int64_t>>{{time, time},
                                                                      {time + 500000, time}}));
}

// What a bridge and a recorder need.
TEST(RosMessages, AreToldByTypeName) {
  const Messenger messenger;
  std::string name;
  std::string text;
  const Subscriber any = messenger.subscribeAny("/**", [&](const AnyMessage& message) {
    name = message.typeName();
    text = message.as<std_msgs::String>()->data;
  });
  std_msgs::String message;
  message.data = "text";
  messenger.publish<std_msgs::String>("chat", message);
  EXPECT_EQ(text, "text");
  EXPECT_EQ(name.find("std_msgs::String_<"), 0u) << name;
  EXPECT_EQ(messenger.topics()[0].type, name);
}

}  // namespace

#endif  // HAS_ROS_MESSAGES
