// Where the stamps of messages are found.
#include <gmock/gmock.h>
#include <gslam/messenger.h>
#include <gtest/gtest.h>

#include <cstdint>
#include <limits>
#include <vector>

namespace {

using testing::ElementsAre;

struct InNanoseconds {
  std::int64_t stamp;
};
struct Ros1Image {
  struct {
    struct {
      std::uint32_t sec, nsec;
    } stamp;
  } header;
};
struct Ros2Image {
  struct {
    struct {
      std::int32_t sec;
      std::uint32_t nanosec;
    } stamp;
  } header;
};
struct Counted {
  std::uint64_t stamp;
};
struct InMicroseconds {
  std::int64_t time;
};

}  // namespace

namespace gslam {
template <>
struct MessageStamp<InMicroseconds> {
  static std::int64_t nanoseconds(const InMicroseconds& message) { return message.time * 1000; }
};
}  // namespace gslam

namespace {

TEST(MessageStamp, IsFound) {
  EXPECT_EQ(gslam::MessageStamp<InNanoseconds>::nanoseconds({-3}), -3);
  EXPECT_EQ(gslam::MessageStamp<Ros1Image>::nanoseconds({{{4294967295u, 999999999u}}}),
            4294967295999999999);
  EXPECT_EQ(gslam::MessageStamp<Ros2Image>::nanoseconds({{{-2, 999999999u}}}), -1000000001);
  EXPECT_EQ(gslam::MessageStamp<InMicroseconds>::nanoseconds({5}), 5000);
  EXPECT_EQ(gslam::MessageStamp<Counted>::nanoseconds({7}), 7);
  EXPECT_EQ(gslam::MessageStamp<Counted>::nanoseconds({std::uint64_t{1} << 63}),
            std::numeric_limits<std::int64_t>::max());
}

TEST(MessageStamp, TypesMayDiffer) {
  const gslam::Messenger messenger;
  std::vector<std::int64_t> seen;
  const gslam::Synchronizer<Ros2Image, InMicroseconds> synchronizer(
      messenger, {"image", "/imu"}, gslam::exactTime(), 2,
      [&seen](const Ros2Image&, const InMicroseconds& imu) { seen.push_back(imu.time); });
  messenger.advertise<InMicroseconds>("/imu").publish({1000001});
  messenger.advertise<Ros2Image>("/image").publish({{{1, 1000}}});
  EXPECT_THAT(seen, ElementsAre(1000001));
}

}  // namespace
