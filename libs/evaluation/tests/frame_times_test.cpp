#include <gslam/base/error.h>
#include <gslam/core/isolated_slam.h>
#include <gslam/core/player.h>
#include <gslam/core/slam_thread.h>
#include <gslam/evaluation/allocation_counts.h>
#include <gslam/evaluation/cost.h>
#include <gslam/evaluation/frame_times.h>
#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <thread>

#include "spender_child.h"

namespace {

using gslam::Frame;
using gslam::FrameTime;
using gslam::MeasuredSlam;
using gslam::TrackedPose;
using gslam::TrackingState;

std::shared_ptr<const Frame> frame(std::uint64_t id) {
  const auto made = std::make_shared<Frame>();
  made->id = id;
  made->stamp = std::int64_t(id) * 1000;
  return made;
}

void wait(int milliseconds) {
  std::this_thread::sleep_for(std::chrono::milliseconds(milliseconds));
}

// Does in feed() what a test says.
class ToldSlam : public gslam::Slam {
 public:
  using Feed = std::function<void(const Frame&, const gslam::Publisher<TrackedPose>&)>;
  explicit ToldSlam(Feed feed) : feed_(std::move(feed)) {}
  void configure(const gslam::SlamSetup& setup) override {
    pose_ = setup.messenger.advertise<TrackedPose>("pose");
    parameters_ = setup.parameters;
    wait(20);
  }
  void feed(const std::shared_ptr<const Frame>& frame) override { feed_(*frame, pose_); }
  std::shared_ptr<const gslam::Map> map() override { return std::make_shared<const gslam::Map>(); }
  void finish() override {
    wait(10);
    is_finished_ = true;
  }

  gslam::Svar parameters_;
  bool is_finished_ = false;
  gslam::Publisher<TrackedPose> pose_;

 private:
  Feed feed_;
};

TrackedPose poseOf(std::uint64_t id, TrackingState state = TrackingState::tracking) {
  return {id, std::int64_t(id) * 1000, gslam::SE3d(), state};
}

void publish(const Frame& fed, const gslam::Publisher<TrackedPose>& pose) {
  pose.publish(poseOf(fed.id));
}

void burnThread(double seconds) {
  timespec time = {};
  const auto now = [&time] {
    clock_gettime(CLOCK_THREAD_CPUTIME_ID, &time);
    return double(time.tv_sec) + 1e-9 * double(time.tv_nsec);
  };
  const double end = now() + seconds;
  while (now() < end) {
  }
}

TEST(MeasuredSlam, handsEverythingOn) {
  const auto inside = std::make_shared<ToldSlam>(publish);
  MeasuredSlam slam(inside);
  gslam::SlamSetup setup;
  setup.parameters = gslam::Svar::object({{"x", 5}});
  std::size_t poses = 0;
  const gslam::Subscriber subscriber =
      setup.messenger.subscribe<TrackedPose>("pose", [&](const TrackedPose&) { ++poses; });
  EXPECT_EQ(slam.configureSeconds(), 0);
  slam.configure(setup);
  slam.feed(frame(1));
  EXPECT_NE(slam.map(), nullptr);
  slam.finish();
  EXPECT_EQ(inside->parameters_["x"].as<int>(), 5);
  EXPECT_TRUE(inside->is_finished_);
  EXPECT_EQ(poses, 1u);
  EXPECT_EQ(slam.inside(), inside);
  EXPECT_GE(slam.configureSeconds(), 0.02);
  EXPECT_GE(slam.finishSeconds(), 0.01);
  EXPECT_LT(slam.finishSeconds(), slam.configureSeconds() + 1);
}

TEST(MeasuredSlam, aPoseThatIsNotFiniteIsLost) {
  MeasuredSlam slam(
      std::make_shared<ToldSlam>([](const Frame& fed, const gslam::Publisher<TrackedPose>& pose) {
        TrackedPose bad = poseOf(fed.id);
        gslam::Vec3d place{};
        if (fed.id > 0) place[fed.id - 1] = fed.id == 2 ? -INFINITY : std::nan("");
        bad.T_world_body = gslam::SE3d(gslam::SO3d(), place);
        pose.publish(bad);
      }));
  slam.configure({});
  for (std::uint64_t id = 0; id <= 3; ++id) slam.feed(frame(id));
  const std::vector<FrameTime> frames = slam.frames();
  EXPECT_EQ(frames[0].state, TrackingState::tracking);
  for (std::size_t i = 1; i <= 3; ++i) {
    EXPECT_TRUE(frames[i].has_result);
    EXPECT_EQ(frames[i].state, TrackingState::lost) << i;
  }
}

TEST(MeasuredSlam, refusesNull) {
  EXPECT_THROW(MeasuredSlam(nullptr), gslam::ArgumentError);
  MeasuredSlam slam(std::make_shared<ToldSlam>(publish));
  slam.configure({});
  EXPECT_THROW(slam.feed(nullptr), gslam::ArgumentError);
  EXPECT_TRUE(slam.frames().empty());
}

TEST(MeasuredSlam, timesFromDeliveryToThePose) {
  MeasuredSlam slam(
      std::make_shared<ToldSlam>([](const Frame& fed, const gslam::Publisher<TrackedPose>& pose) {
        wait(20);
        pose.publish(poseOf(fed.id, TrackingState::guessed));
        burnThread(0.03);
        pose.publish(poseOf(fed.id));  // a correction
      }));
  slam.configure({});
  slam.feed(frame(3));
  slam.feed(frame(4));
  const std::vector<FrameTime> frames = slam.frames();
  ASSERT_EQ(frames.size(), 2u);
  for (std::size_t i = 0; i < 2; ++i) {
    const FrameTime& f = frames[i];
    EXPECT_EQ(f.frame, 3 + i);
    EXPECT_EQ(f.stamp, std::int64_t(3 + i) * 1000);
    EXPECT_TRUE(f.has_result);
    EXPECT_FALSE(f.is_dropped);
    EXPECT_EQ(f.state, TrackingState::guessed);
    EXPECT_EQ(f.corrections, 1u);
    EXPECT_GE(f.wall_ms, 20);
    EXPECT_LE(f.wall_ms, f.feed_ms - 29);  // what comes after the pose is not in it
    EXPECT_GE(f.feed_ms, 50);
    EXPECT_GE(f.cpu_ms, 30);  // but its CPU time is
    EXPECT_LE(f.cpu_ms, 48);  // and waiting is none
  }
  EXPECT_GE(frames[0].delivered, 20000000);  // configure() comes first
  EXPECT_GE(frames[1].delivered - frames[0].delivered, 50000000);
}

TEST(MeasuredSlam, takesPosesThatComeLater) {
  const auto inside =
      std::make_shared<ToldSlam>([](const Frame&, const gslam::Publisher<TrackedPose>&) {});
  MeasuredSlam slam(inside);
  slam.configure({});
  slam.feed(frame(1));
  slam.feed(frame(2));
  std::thread worker([&] {
    burnThread(0.02);
    inside->pose_.publish(poseOf(2));
    inside->pose_.publish(poseOf(77));  // of no frame that was fed
  });
  worker.join();
  const std::vector<FrameTime> frames = slam.frames();
  ASSERT_EQ(frames.size(), 2u);
  EXPECT_FALSE(frames[0].has_result);
  EXPECT_TRUE(frames[1].has_result);
  EXPECT_GE(frames[1].wall_ms, 20);
  EXPECT_GE(frames[1].wall_ms - frames[1].feed_ms, 20);
  EXPECT_GE(frames[1].cpu_ms, 20);  // of another thread of the process
  EXPECT_LT(frames[0].cpu_ms, 10);
}

TEST(MeasuredSlam, countsThreadsInside) {
  MeasuredSlam slam(
      std::make_shared<ToldSlam>([](const Frame& fed, const gslam::Publisher<TrackedPose>& pose) {
        std::thread other([] { burnThread(0.03); });
        burnThread(0.03);
        other.join();
        pose.publish(poseOf(fed.id));
      }));
  slam.configure({});
  slam.feed(frame(1));
  EXPECT_GE(slam.frames()[0].cpu_ms, 60);
  EXPECT_LE(slam.frames()[0].cpu_ms, 75);
}

TEST(MeasuredSlam, notesDropsAndFailures) {
  MeasuredSlam slam(
      std::make_shared<ToldSlam>([](const Frame& fed, const gslam::Publisher<TrackedPose>& pose) {
        if (fed.id == 3) throw gslam::Error("no more");
        pose.publish(poseOf(fed.id));
      }));
  slam.configure({});
  slam.feed(frame(1));
  slam.noteDropped(2, 2000);
  EXPECT_THROW(slam.feed(frame(3)), gslam::Error);
  const std::vector<FrameTime> frames = slam.frames();
  ASSERT_EQ(frames.size(), 3u);
  EXPECT_TRUE(frames[1].is_dropped);
  EXPECT_EQ(frames[1].stamp, 2000);
  EXPECT_GE(frames[1].delivered, frames[0].delivered);
  EXPECT_FALSE(frames[2].is_dropped);
  EXPECT_FALSE(frames[2].has_result);
  EXPECT_GT(frames[2].feed_ms, 0);
}

// A number may come twice: poses are the later one's.
TEST(MeasuredSlam, takesANumberTwice) {
  MeasuredSlam slam(std::make_shared<ToldSlam>(publish));
  slam.configure({});
  slam.feed(frame(1));
  slam.feed(frame(1));
  ASSERT_EQ(slam.frames().size(), 2u);
  EXPECT_TRUE(slam.frames()[0].has_result);
  EXPECT_TRUE(slam.frames()[1].has_result);
  EXPECT_EQ(slam.frames()[0].corrections, 0u);
}

// Poses come from several threads while frames are fed, dropped and asked for: once a map that was
// written by two threads without a lock.
TEST(MeasuredSlam, isForThreads) {
  constexpr std::uint64_t kFrames = 2000;
  const auto inside =
      std::make_shared<ToldSlam>([](const Frame&, const gslam::Publisher<TrackedPose>&) {});
  MeasuredSlam slam(inside);
  slam.configure({});
  std::atomic<std::uint64_t> fed(0);
  std::vector<std::thread> threads;
  for (std::uint64_t i = 0; i < 3; ++i) {
    threads.emplace_back([&, i] {
      for (std::uint64_t id = 0; id < kFrames; ++id) {
        while (fed <= id) std::this_thread::yield();
        if (id % 3 == i || id % 2 == 0) inside->pose_.publish(poseOf(id));
        if (id % 100 == 0) slam.frames();
      }
    });
  }
  threads.emplace_back([&] {
    for (std::uint64_t id = 0; id < 500; ++id) slam.noteDropped(kFrames + id, 0);
  });
  for (std::uint64_t id = 0; id < kFrames; ++id) {
    slam.feed(frame(id));
    ++fed;
  }
  for (std::thread& thread : threads) thread.join();
  std::size_t dropped = 0, results = 0, corrections = 0;
  for (const FrameTime& f : slam.frames()) {
    dropped += f.is_dropped;
    results += f.has_result;
    corrections += f.corrections;
    EXPECT_GE(f.wall_ms, 0);
  }
  EXPECT_EQ(dropped, 500u);
  EXPECT_EQ(results, kFrames);
  EXPECT_EQ(corrections, kFrames / 2 * 2);  // even ones come three times
}

// With the queue inside, waiting in it is part of the time; with the queue around it, it is not.
TEST(MeasuredSlam, worksInAndAroundASlamThread) {
  const auto slow = [](const Frame& fed, const gslam::Publisher<TrackedPose>& pose) {
    wait(100);
    pose.publish(poseOf(fed.id));
  };
  MeasuredSlam around(
      std::make_shared<gslam::SlamThread>(std::make_shared<ToldSlam>(slow), std::size_t(3)));
  around.configure({});
  for (std::uint64_t id = 0; id < 3; ++id) around.feed(frame(id));
  around.finish();
  EXPECT_GE(around.frames()[2].wall_ms, 250);
  EXPECT_LT(around.frames()[2].feed_ms, 100);

  const auto inner = std::make_shared<MeasuredSlam>(std::make_shared<ToldSlam>(slow));
  gslam::SlamThread thread(inner, 3);
  thread.configure({});
  for (std::uint64_t id = 0; id < 3; ++id) thread.feed(frame(id));
  thread.finish();
  EXPECT_GE(inner->frames()[2].wall_ms, 100);
  EXPECT_LT(inner->frames()[2].wall_ms, 250);
}

class Steps : public gslam::Dataset {
 public:
  const gslam::DatasetInfo& info() const override { return info_; }
  std::shared_ptr<const Frame> next() override {
    if (next_ == 40) return nullptr;
    const auto made = std::make_shared<Frame>();
    made->id = next_;
    made->stamp = std::int64_t(next_++) * 10000000;
    return made;
  }
  void seek(std::size_t index) override { next_ = index; }

 private:
  gslam::DatasetInfo info_;
  std::uint64_t next_ = 0;
};

// In real time the player drops frames and lets them wait outside.
TEST(MeasuredSlam, knowsWhatThePlayerDropsInRealTime) {
  Steps dataset;
  const gslam::Messenger messenger;
  MeasuredSlam slam(
      std::make_shared<ToldSlam>([](const Frame& fed, const gslam::Publisher<TrackedPose>& pose) {
        wait(25);
        pose.publish(poseOf(fed.id));
      }));
  slam.configure({});
  const gslam::Subscriber played = messenger.subscribe<Frame>(
      "/sensor/frame", [&slam](const Frame& given) { slam.noteDelivered(given.id, given.stamp); });
  gslam::Player player(dataset, messenger);
  gslam::PlayOptions options;
  options.pace = gslam::Pace::real_time;
  const gslam::PlayReport report = player.play(slam, options);
  slam.finish();
  gslam::CostSource source;
  source.frames = slam.frames();
  const gslam::Cost cost = gslam::costOf(source);
  EXPECT_EQ(report.played, 40u);
  EXPECT_GT(report.dropped, 10u);
  EXPECT_EQ(cost.dropped, report.dropped);
  EXPECT_EQ(cost.delivered, report.played - report.dropped);
  // Each but the first waits for the one before it: for about 5 of 25 ms, or more on a busy
  // machine.
  EXPECT_GT(cost.frame_ms.mean, cost.feed_ms.mean + 2);
  std::uint64_t next = 0;
  for (const FrameTime& f : source.frames) EXPECT_EQ(f.frame, next++);
}

TEST(MeasuredSlam, dropsWhatIsOvertakenOrNeverComes) {
  MeasuredSlam slam(std::make_shared<ToldSlam>(publish));
  slam.configure({});
  slam.noteDelivered(1, 10);
  slam.noteDelivered(2, 20);
  wait(30);
  slam.feed(frame(5));  // of which nobody told: it overtakes none
  slam.feed(frame(2));
  slam.noteDelivered(7, 70);
  slam.dropWaiting();
  slam.noteDelivered(8, 80);
  slam.finish();
  const std::vector<FrameTime> frames = slam.frames();
  ASSERT_EQ(frames.size(), 5u);
  const std::uint64_t ids[] = {5, 1, 2, 7, 8};
  for (std::size_t i = 0; i < 5; ++i) {
    EXPECT_EQ(frames[i].frame, ids[i]);
    EXPECT_EQ(frames[i].is_dropped, ids[i] != 5 && ids[i] != 2);
  }
  EXPECT_EQ(frames[4].stamp, 80);
  EXPECT_LT(frames[0].wall_ms, 25);
  EXPECT_GE(frames[2].wall_ms, 30);  // since it was delivered
  EXPECT_LE(frames[2].feed_ms, frames[2].wall_ms - 25);
  EXPECT_LT(frames[1].delivered, frames[0].delivered);
}

// A queue inside: each piece of work is in the figures of all frames that wait, and once in the
// figure for each frame.
TEST(MeasuredSlam, countsOverlappingFramesOnce) {
  constexpr std::size_t kFrames = 20;
  MeasuredSlam slam(std::make_shared<gslam::SlamThread>(
      std::make_shared<ToldSlam>([](const Frame& fed, const gslam::Publisher<TrackedPose>& pose) {
        burnThread(0.005);
        pose.publish(poseOf(fed.id));
      }),
      std::size_t(8)));
  slam.configure({});
  for (std::uint64_t id = 0; id < kFrames; ++id) slam.feed(frame(id));
  slam.finish();
  gslam::CostSource source;
  source.frames = slam.frames();
  const gslam::Cost cost = gslam::costOf(source);
  EXPECT_GT(cost.cpu_ms.mean, 15);
  EXPECT_GE(cost.cpu_ms_per_frame, 5);
  EXPECT_LT(cost.cpu_ms_per_frame, 7);
  EXPECT_GE(cost.overlapping, kFrames - 3);
}

// What is told last of a frame is how it is: once its pose was missing there, when it came as
// feed() returned.
TEST(MeasuredSlam, tellsOfEachFrameInOrder) {
  constexpr std::uint64_t kFrames = 20000;
  const auto inside =
      std::make_shared<ToldSlam>([](const Frame&, const gslam::Publisher<TrackedPose>&) {});
  std::vector<char> has_result(kFrames, 0);
  gslam::MeasureOptions options;
  options.on_frame = [&](const FrameTime& told) { has_result[told.frame] = told.has_result; };
  MeasuredSlam slam(inside, options);
  slam.configure({});
  std::atomic<std::uint64_t> fed(0);
  std::thread worker([&] {
    for (std::uint64_t id = 0; id < kFrames; ++id) {
      while (fed <= id) {
      }
      for (volatile std::uint64_t i = 0; i < id * 37 % 1000; i = i + 1) {
      }
      inside->pose_.publish(poseOf(id));
    }
  });
  for (std::uint64_t id = 0; id < kFrames; ++id) {
    fed = id + 1;
    slam.feed(frame(id));
  }
  worker.join();
  for (const FrameTime& f : slam.frames()) {
    ASSERT_EQ(f.has_result, has_result[f.frame] != 0) << f.frame;
  }
}

TEST(MeasuredSlam, mayGoBeforeItsMessenger) {
  gslam::SlamSetup setup;
  const auto inside = std::make_shared<ToldSlam>(publish);
  {
    MeasuredSlam slam(inside);
    slam.configure(setup);
    slam.feed(frame(1));
  }
  inside->pose_.publish(poseOf(1));  // reaches nobody
}

// The child's CPU time and allocations, not this process's.
TEST(MeasuredSlam, measuresAnIsolatedOneAlone) {
  ASSERT_TRUE(gslam::countAllocationsOfChildren());
  gslam::IsolationOptions options;
  options.slam = "spender";
  options.worker = GSLAM_TEST_SPENDER;
  options.folders = {"/nonexistent"};
  const auto isolated = std::make_shared<gslam::IsolatedSlam>(options);
  gslam::ProcessTreeOptions of_child;
  of_child.root = isolated->processNumber();
  const auto tree = std::make_shared<gslam::ProcessTree>(of_child);
  MeasuredSlam slam(isolated, {tree});
  gslam::SlamSetup setup;
  setup.parameters = gslam::Svar::object({{"blocks", 5000}, {"seconds", 0.03}});
  slam.configure(setup);
  std::atomic<bool> is_over(false);
  std::thread busy([&] {  // this process's own, which does not count
    while (!is_over) burnThread(0.001);
  });
  for (std::uint64_t id = 0; id < 5; ++id) slam.feed(frame(id));
  slam.finish();
  is_over = true;
  busy.join();
  ASSERT_EQ(slam.frames().size(), 5u);
  for (const FrameTime& f : slam.frames()) {
    EXPECT_TRUE(f.has_result);
    EXPECT_GE(f.wall_ms, 30);
    EXPECT_GE(f.cpu_ms, 30);
    EXPECT_LE(f.cpu_ms, 45);
    EXPECT_EQ(f.has_allocations, spender::canCount());
    if (!spender::canCount()) continue;
    EXPECT_GE(f.allocations, 5000u);
    EXPECT_LE(f.allocations, 5200u);
    EXPECT_GE(f.allocated_bytes, 500000u);
  }
}

TEST(FrameTimesCsv, writesWhatThereIs) {
  FrameTime done, dropped, lost;
  done.frame = 7;
  done.stamp = -5;
  done.delivered = 1000;
  done.has_result = true;
  done.wall_ms = 1.5;
  done.feed_ms = 1234.0000015;
  done.cpu_ms = 0.000001;
  done.allocations = 3;
  done.allocated_bytes = 400;
  done.has_allocations = true;
  done.cpu_ms_before = 2.5;
  done.allocations_before = 11;
  done.allocated_bytes_before = 12;
  done.state = TrackingState::tracking;
  done.corrections = 2;
  dropped.frame = 8;
  dropped.is_dropped = true;
  lost.frame = 9;
  lost.feed_ms = 2;
  EXPECT_EQ(gslam::frameTimesCsv({done, dropped, lost}),
            "frame,stamp_ns,delivered_ns,dropped,wall_ms,feed_ms,cpu_ms,allocations,"
            "allocated_bytes,state,corrections,cpu_ms_before,allocations_before,"
            "allocated_bytes_before\n"
            "7,-5,1000,0,1.500000,1234.000002,0.000001,3,400,tracking,2,2.500000,11,12\n"
            "8,0,0,1,,,,,,,,,,\n"
            "9,0,0,0,,2.000000,0.000000,,,,0,0.000000,,\n");
  EXPECT_EQ(gslam::frameTimesCsv({}).find('\n') + 1, gslam::frameTimesCsv({}).size());
}

}  // namespace
