#include <gmock/gmock.h>
#include <gslam/core/slam_thread.h>

#include <future>
#include <memory>
#include <stdexcept>

#include "scripted_slam.h"

namespace {

using gslam::Frame;
using gslam::SlamThread;
using gslam::WhenBusy;

// Holds a SLAM system in feed() until it is let go.
class Gate {
 public:
  void pass() {
    entered_.set_value();
    open_.get_future().wait();
  }
  void waitUntilEntered() { entered_.get_future().wait(); }
  void open() { open_.set_value(); }

 private:
  std::promise<void> entered_;
  std::promise<void> open_;
};

std::shared_ptr<const Frame> frameWithSample(std::uint64_t id) {
  const auto frame = std::make_shared<Frame>();
  frame->id = id;
  frame->imu.push_back({std::int64_t(id), {}, {}});
  return frame;
}

std::vector<std::uint64_t> idsOf(const scripted::Slam& slam) {
  std::vector<std::uint64_t> ids;
  for (const auto& frame : slam.frames) ids.push_back(frame->id);
  return ids;
}

TEST(SlamThread, CallsTheSystemFromOneThreadInOrder) {
  const auto slam = std::make_shared<scripted::Slam>();
  {
    SlamThread thread(slam, 3);
    thread.configure({});
    for (std::uint64_t i = 0; i < 20; ++i) thread.feed(frameWithSample(i));
    thread.finish();
    EXPECT_EQ(slam->frames.size(), 20U);
    EXPECT_EQ(thread.map(), nullptr);
    EXPECT_TRUE(thread.isIdle());
    EXPECT_EQ(thread.dropped(), 0U);
  }
  std::vector<std::uint64_t> expected;
  for (std::uint64_t i = 0; i < 20; ++i) expected.push_back(i);
  EXPECT_EQ(idsOf(*slam), expected);
  EXPECT_THAT(slam->calls, testing::ElementsAre("configure", "finish", "map"));
  for (const std::thread::id& id : slam->threads) {
    EXPECT_EQ(id, slam->threads[0]);
    EXPECT_NE(id, std::this_thread::get_id());
  }
}

TEST(SlamThread, DropsTheOldestAndKeepsItsSamples) {
  const auto slam = std::make_shared<scripted::Slam>();
  Gate gate;
  slam->on_frame = [&](const Frame& frame) {
    if (frame.id == 0) gate.pass();
  };
  SlamThread thread(slam, 2, WhenBusy::drop_oldest);
  thread.configure({});
  thread.feed(frameWithSample(0));
  gate.waitUntilEntered();
  EXPECT_FALSE(thread.isIdle());
  for (std::uint64_t i = 1; i <= 5; ++i) thread.feed(frameWithSample(i));
  gate.open();
  thread.waitUntilIdle();
  EXPECT_EQ(thread.dropped(), 3U);
  EXPECT_THAT(idsOf(*slam), testing::ElementsAre(0, 4, 5));
  std::vector<std::int64_t> stamps;
  for (const auto& frame : slam->frames) {
    for (const gslam::ImuSample& sample : frame->imu) stamps.push_back(sample.stamp);
  }
  EXPECT_THAT(stamps, testing::ElementsAre(0, 1, 2, 3, 4, 5));
}

TEST(SlamThread, DropsWithRoomForOne) {
  const auto slam = std::make_shared<scripted::Slam>();
  Gate gate;
  slam->on_frame = [&](const Frame& frame) {
    if (frame.id == 0) gate.pass();
  };
  SlamThread thread(slam, 1, WhenBusy::drop_oldest);
  thread.configure({});
  thread.feed(frameWithSample(0));
  gate.waitUntilEntered();
  for (std::uint64_t i = 1; i <= 3; ++i) thread.feed(frameWithSample(i));
  gate.open();
  thread.waitUntilIdle();
  EXPECT_THAT(idsOf(*slam), testing::ElementsAre(0, 3));
  ASSERT_EQ(slam->frames.size(), 2U);
  EXPECT_EQ(slam->frames[1]->imu.size(), 3U);
}

TEST(SlamThread, HandsOnWhatTheSystemThrows) {
  const auto slam = std::make_shared<scripted::Slam>();
  slam->on_frame = [](const Frame& frame) {
    if (frame.id == 2) throw std::domain_error("no features");
  };
  SlamThread thread(slam, 8);
  thread.configure({});
  for (std::uint64_t i = 0; i < 3; ++i) thread.feed(frameWithSample(i));
  EXPECT_THROW(thread.waitUntilIdle(), std::domain_error);
  EXPECT_THROW(thread.feed(frameWithSample(3)), std::domain_error);
  EXPECT_THROW(thread.map(), std::domain_error);
  EXPECT_THROW(thread.finish(), std::domain_error);
  EXPECT_THAT(idsOf(*slam), testing::ElementsAre(0, 1));
  EXPECT_THAT(slam->calls, testing::ElementsAre("configure"));
}

TEST(SlamThread, FailureWakesWhoWaitsForRoom) {
  const auto slam = std::make_shared<scripted::Slam>();
  Gate gate;
  slam->on_frame = [&](const Frame&) {
    gate.pass();
    throw std::domain_error("no features");
  };
  SlamThread thread(slam, 1);
  thread.configure({});
  thread.feed(frameWithSample(0));
  gate.waitUntilEntered();
  thread.feed(frameWithSample(1));
  std::thread opener([&] { gate.open(); });
  EXPECT_THROW(thread.feed(frameWithSample(2)), std::domain_error);
  opener.join();
}

TEST(SlamThread, ThrowsWhatConfigureThrows) {
  const auto slam = std::make_shared<scripted::Slam>();
  slam->on_configure = [](const gslam::SlamSetup&) { throw gslam::Error("no vocabulary"); };
  SlamThread thread(slam);
  EXPECT_THROW(thread.configure({}), gslam::Error);
}

TEST(SlamThread, EndsWithFramesThatWait) {
  const auto slam = std::make_shared<scripted::Slam>();
  Gate gate;
  slam->on_frame = [&](const Frame&) { gate.pass(); };
  std::thread opener;
  {
    SlamThread thread(slam, 10);
    thread.configure({});
    for (std::uint64_t i = 0; i < 5; ++i) thread.feed(frameWithSample(i));
    gate.waitUntilEntered();
    opener = std::thread([&] {
      std::this_thread::sleep_for(std::chrono::milliseconds(20));  // the destructor runs by then
      gate.open();
    });
  }
  opener.join();
  EXPECT_LE(slam->frames.size(), 5U);
}

TEST(SlamThread, RefusesNothingAndNoRoom) {
  EXPECT_THROW(SlamThread(nullptr), gslam::ArgumentError);
  EXPECT_THROW(SlamThread(std::make_shared<scripted::Slam>(), 0), gslam::ArgumentError);
  SlamThread thread(std::make_shared<scripted::Slam>());
  EXPECT_THROW(thread.feed(nullptr), gslam::ArgumentError);
}

}  // namespace
