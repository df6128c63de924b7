#include <gmock/gmock.h>
#include <gslam/core/player.h>

#include <chrono>
#include <cmath>
#include <limits>
#include <memory>
#include <stdexcept>
#include <thread>

#include "scripted_slam.h"

namespace {

using gslam::Frame;
using gslam::Messenger;
using gslam::Pace;
using gslam::PlayEnd;
using gslam::Player;
using gslam::PlayOptions;
using gslam::PlayReport;
using gslam::RunStatus;

scripted::Slam configured() {
  scripted::Slam slam;
  slam.configure({});
  return slam;
}

TEST(Player, GivesEachFrameToTheSystemAndTheTopics) {
  const auto dataset = scripted::dataset(10);
  const Messenger messenger;
  std::vector<std::uint64_t> published;
  std::vector<std::int64_t> imu;
  std::vector<gslam::StampedPose> truth;
  scripted::Slam slam = configured();
  const auto frames = messenger.subscribe<Frame>("/sensor/frame", [&](const Frame& frame) {
    EXPECT_EQ(slam.frames.size(), published.size()) << "published before the system gets it";
    published.push_back(frame.id);
  });
  const auto samples = messenger.subscribe<gslam::ImuSample>(
      "/sensor/imu", [&](const gslam::ImuSample& sample) { imu.push_back(sample.stamp); });
  const auto poses = messenger.subscribe<gslam::StampedPose>(
      "/sensor/groundtruth", [&](const gslam::StampedPose& pose) { truth.push_back(pose); });

  Player player(*dataset, messenger);
  const PlayReport report = player.play(slam);
  EXPECT_EQ(report.end, PlayEnd::finished);
  EXPECT_EQ(report.played, 10U);
  EXPECT_EQ(report.dropped, 0U);
  EXPECT_EQ(report.last_frame, 9U);
  EXPECT_EQ(slam.frames.size(), 10U);
  EXPECT_EQ(published.size(), 10U);
  EXPECT_EQ(imu.size(), 40U);
  EXPECT_TRUE(std::is_sorted(imu.begin(), imu.end()));
  ASSERT_EQ(truth.size(), 10U);
  for (const gslam::StampedPose& pose : truth) {
    EXPECT_TRUE(pose.pose.isApprox(scripted::poseAt(pose.stamp), 1e-15));
  }
}

TEST(Player, CopiesNoPixel) {
  const auto dataset = scripted::dataset(3);
  const Messenger messenger;
  std::vector<const std::uint8_t*> seen;
  std::vector<gslam::Subscriber> subscribers;
  for (int i = 0; i < 4; ++i) {
    subscribers.push_back(messenger.subscribe<Frame>("/sensor/frame", [&](const Frame& frame) {
      seen.push_back(frame.images[0].image.bytes());
    }));
  }
  Player(*dataset, messenger).play();
  ASSERT_EQ(seen.size(), 12U);
  dataset->seek(0);
  for (std::size_t i = 0; i < seen.size(); i += 4) {
    const auto frame = dataset->next();
    for (std::size_t s = i; s < i + 4; ++s) EXPECT_EQ(seen[s], frame->images[0].image.bytes());
  }
}

TEST(Player, PlaysAPart) {
  const auto dataset = scripted::dataset(10);
  scripted::Slam slam = configured();
  PlayOptions options;
  options.first = 3;
  options.count = 4;
  const PlayReport report = Player(*dataset, Messenger()).play(slam, options);
  EXPECT_EQ(report.played, 4U);
  ASSERT_EQ(slam.frames.size(), 4U);
  EXPECT_EQ(slam.frames.front()->id, 3U);
  EXPECT_EQ(report.last_frame, 6U);
  options.first = 11;
  EXPECT_THROW(Player(*dataset, Messenger()).play(slam, options), gslam::ArgumentError);
}

TEST(Player, StopsFromACallback) {
  const auto dataset = scripted::dataset(100);
  const Messenger messenger;
  scripted::Slam slam = configured();
  Player player(*dataset, messenger);
  const auto frames = messenger.subscribe<Frame>("/sensor/frame", [&](const Frame& frame) {
    if (frame.id == 4) player.stop();
  });
  const PlayReport report = player.play(slam);
  EXPECT_EQ(report.end, PlayEnd::stopped);
  EXPECT_EQ(slam.frames.size(), 5U);
  EXPECT_EQ(player.play(slam).end, PlayEnd::stopped);
}

TEST(Player, ReportsWhatTheSystemThrows) {
  for (const Pace pace : {Pace::every_frame, Pace::real_time}) {
    const auto dataset = scripted::dataset(10);
    const Messenger messenger;
    scripted::Slam slam = configured();
    slam.on_frame = [](const Frame& frame) {
      if (frame.id >= 2) throw std::domain_error("no features");
    };
    PlayOptions options;
    options.pace = pace;
    options.speed = 10;
    Player player(*dataset, messenger);
    const PlayReport report = player.play(slam, options);
    EXPECT_EQ(report.end, PlayEnd::failed);
    EXPECT_EQ(report.failure, "no features");
    EXPECT_LE(slam.frames.size(), 2U) << "in real time some may be dropped";
    RunStatus last;
    const auto status =
        messenger.subscribe<RunStatus>("/run/status", [&](const RunStatus& now) { last = now; });
    EXPECT_EQ(last.state, RunStatus::State::failed);
    EXPECT_EQ(last.message, "no features");
    EXPECT_EQ(last.frame_count, 10U);
  }
}

TEST(Player, RealTimeKeepsToTheStamps) {
  const auto dataset = scripted::dataset(6);
  scripted::Slam slam = configured();
  PlayOptions options;
  options.pace = Pace::real_time;
  const auto begin = std::chrono::steady_clock::now();
  const PlayReport report = Player(*dataset, Messenger()).play(slam, options);
  const std::chrono::duration<double> time = std::chrono::steady_clock::now() - begin;
  EXPECT_EQ(report.end, PlayEnd::finished);
  EXPECT_GE(time.count(), 0.05) << "five periods of 10 ms";
  EXPECT_GE(report.seconds, 0.05);
  EXPECT_EQ(slam.frames.size() + report.dropped, 6U);
}

TEST(Player, RealTimeDropsFramesButNoSamples) {
  const auto dataset = scripted::dataset(20);
  scripted::Slam slam = configured();
  slam.on_frame = [](const Frame&) { std::this_thread::sleep_for(std::chrono::milliseconds(25)); };
  PlayOptions options;
  options.pace = Pace::real_time;
  const PlayReport report = Player(*dataset, Messenger()).play(slam, options);
  EXPECT_EQ(report.played, 20U);
  EXPECT_GT(report.dropped, 0U);
  EXPECT_EQ(slam.frames.size() + report.dropped, 20U);
  EXPECT_EQ(slam.frames.back()->id, 19U) << "the newest is never the one that is dropped";
  std::vector<std::int64_t> stamps;
  for (const auto& frame : slam.frames) {
    for (const gslam::ImuSample& sample : frame->imu) stamps.push_back(sample.stamp);
  }
  ASSERT_EQ(stamps.size(), 80U);
  for (std::size_t i = 1; i < stamps.size(); ++i) {
    EXPECT_EQ(stamps[i] - stamps[i - 1], scripted::kImuPeriod);
  }
}

TEST(Player, PausesAndGoesOn) {
  for (const Pace pace : {Pace::every_frame, Pace::real_time}) {
    const auto dataset = scripted::dataset(5);
    const Messenger messenger;
    scripted::Slam slam = configured();
    Player player(*dataset, messenger);
    std::thread resumer;
    const auto status = messenger.subscribe<RunStatus>("/run/status", [&](const RunStatus& now) {
      if (now.state == RunStatus::State::playing && now.frame == 2) player.pause();
      if (now.state == RunStatus::State::paused) {
        EXPECT_EQ(now.frame, 2U);
        resumer = std::thread([&] {
          std::this_thread::sleep_for(std::chrono::milliseconds(300));
          player.resume();
        });
      }
    });
    PlayOptions options;
    options.pace = pace;
    const PlayReport report = player.play(slam, options);
    ASSERT_TRUE(resumer.joinable());
    resumer.join();
    EXPECT_EQ(report.played, 5U);
    EXPECT_EQ(report.end, PlayEnd::finished);
  }
}

TEST(Player, StopsWhilePaused) {
  const auto dataset = scripted::dataset(5);
  Player player(*dataset, Messenger());
  player.pause();
  std::thread stopper([&] {
    std::this_thread::sleep_for(std::chrono::milliseconds(20));
    player.stop();
  });
  EXPECT_EQ(player.play().end, PlayEnd::stopped);
  stopper.join();
}

// Some frames cannot be read, or none.
class BadDataset : public gslam::Dataset {
 public:
  explicit BadDataset(bool all) : all_(all) {}
  const gslam::DatasetInfo& info() const override { return info_; }
  std::shared_ptr<const Frame> next() override {
    const std::uint64_t id = next_++;
    if (all_ || id == 3 || id == 4) throw gslam::FileError("4.png", "is truncated");
    if (id == 8) return nullptr;
    const auto frame = std::make_shared<Frame>();
    frame->id = id;
    return frame;
  }
  void seek(std::size_t index) override { next_ = index; }

 private:
  gslam::DatasetInfo info_;
  bool all_;
  std::uint64_t next_ = 0;
};

TEST(Player, LeavesOutFramesThatCannotBeRead) {
  BadDataset dataset(false);
  const PlayReport report = Player(dataset, Messenger()).play();
  EXPECT_EQ(report.end, PlayEnd::finished);
  EXPECT_EQ(report.played, 6U);
  EXPECT_EQ(report.unreadable, 2U);
}

TEST(Player, GivesUpADatasetThatFailsForEver) {
  BadDataset dataset(true);
  const PlayReport report = Player(dataset, Messenger()).play();
  EXPECT_EQ(report.end, PlayEnd::failed);
  EXPECT_EQ(report.unreadable, 100U);
  EXPECT_THAT(report.failure, testing::HasSubstr("4.png: is truncated"));
}

TEST(Player, BeginsAgainAtTheFirstFrame) {
  const auto dataset = scripted::dataset(10);
  Player player(*dataset, Messenger());
  PlayOptions part;
  part.first = 3;
  part.count = 4;
  EXPECT_EQ(player.play(part).played, 4U);
  EXPECT_EQ(player.play().played, 10U);
  EXPECT_EQ(player.play().played, 10U);
}

TEST(Player, SaysAtWhichFrameTheSystemFailedInRealTime) {
  const auto dataset = scripted::dataset(20);
  scripted::Slam slam = configured();
  std::uint64_t failed_at = 0;
  slam.on_frame = [&](const Frame& frame) {
    if (frame.id < 2) return;
    failed_at = frame.id;
    std::this_thread::sleep_for(std::chrono::milliseconds(60));
    throw std::domain_error("no features");
  };
  PlayOptions options;
  options.pace = Pace::real_time;
  const PlayReport report = Player(*dataset, Messenger()).play(slam, options);
  EXPECT_EQ(report.end, PlayEnd::failed);
  EXPECT_EQ(report.last_frame, failed_at);
  EXPECT_EQ(slam.frames.size() + 1 + report.dropped, report.played) << "each is accounted for";
}

TEST(Player, SurvivesStampsThatMakeNoSense) {
  std::vector<std::shared_ptr<const Frame>> frames;
  for (const std::int64_t stamp : {INT64_MAX, INT64_MIN, INT64_MIN + 1}) {
    const auto frame = std::make_shared<Frame>();
    frame->id = frames.size();
    frame->stamp = stamp;
    frames.push_back(frame);
  }
  gslam::MemoryDataset dataset(gslam::DatasetInfo(), std::move(frames));
  PlayOptions options;
  options.pace = Pace::real_time;
  options.speed = 1e-3;
  EXPECT_EQ(Player(dataset, Messenger()).play(options).played, 3U);
}

TEST(Player, RefusesImpossibleSpeeds) {
  const auto dataset = scripted::dataset(2);
  Player player(*dataset, Messenger());
  PlayOptions options;
  for (const double speed : {0.0, -1.0, std::nan(""), std::numeric_limits<double>::infinity()}) {
    options.speed = speed;
    EXPECT_THROW(player.play(options), gslam::ArgumentError) << speed;
  }
}

}  // namespace
