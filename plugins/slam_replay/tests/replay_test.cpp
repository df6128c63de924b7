#include "replay.h"

#include <gmock/gmock.h>
#include <gslam/core/trajectory_file.h>
#include <gtest/gtest.h>
#include <unistd.h>

#include <chrono>
#include <cmath>
#include <csignal>
#include <cstdio>
#include <cstdlib>
#include <ctime>
#include <fstream>
#include <memory>
#include <mutex>
#include <string>
#include <vector>

#include "fault.h"
#include "known_cost.h"
#include "losses.h"
#include "options.h"
#include "poses.h"

namespace {

using gslam::SE3d;
using gslam::SO3d;
using gslam::TrackedPose;
using gslam::TrackingState;
using gslam::Vec3d;
using std::chrono::milliseconds;

constexpr std::int64_t kStep = 100000000;  // 0.1 s
constexpr double kPi = 3.14159265358979323846;

// A way that bends in all directions.
gslam::Trajectory madeTruth(int poses) {
  gslam::Trajectory truth;
  for (int i = 0; i < poses; ++i) {
    const double t = 0.1 * i;
    truth.add(i * kStep, {SO3d::exp({{0.1 * t, 0.2 * std::sin(t), 0.3 * t}}),
                          {{3 * std::sin(t), 2 * t, std::cos(0.7 * t)}}});
  }
  return truth;
}

// A file that goes with it.
class File {
 public:
  File(const std::string& name, const std::string& text)
      : path_(testing::TempDir() + "slam_replay_" + std::to_string(getpid()) + "_" + name) {
    std::ofstream(path_) << text;
  }
  File(const File&) = delete;
  File& operator=(const File&) = delete;
  ~File() { std::remove(path_.c_str()); }
  const std::string& path() const { return path_; }

 private:
  std::string path_;
};

class Replay : public testing::Test {
 protected:
  // A system with the defaults but for these.
  void begin(const gslam::Svar& given) {
    slam_ = replay::replayFactory().make();
    subscriber_ = messenger_.subscribe<TrackedPose>("pose", [this](const TrackedPose& pose) {
      const std::lock_guard<std::mutex> lock(mutex_);
      poses_.push_back(pose);
    });
    gslam::SlamSetup setup;
    setup.parameters = replay::defaultParameters()
                           .merged(gslam::Svar::object({{"trajectory", truth_file_.path()}}))
                           .merged(given);
    setup.messenger = messenger_;
    slam_->configure(setup);
  }
  void feed(std::uint64_t id) {
    const auto frame = std::make_shared<gslam::Frame>();
    frame->id = id;
    frame->stamp = std::int64_t(id) * kStep;
    slam_->feed(frame);
  }
  void run(const gslam::Svar& given, std::uint64_t frames = 50) {
    poses_.clear();
    begin(given);
    for (std::uint64_t i = 0; i < frames; ++i) feed(i);
    slam_->finish();
  }
  std::vector<TrackingState> states() const {
    std::vector<TrackingState> states;
    for (const TrackedPose& pose : poses_) states.push_back(pose.state);
    return states;
  }

  const gslam::Trajectory truth_ = madeTruth(60);
  const File truth_file_{"truth.txt", gslam::printTrajectory(truth_)};
  gslam::Messenger messenger_;
  std::mutex mutex_;
  std::vector<TrackedPose> poses_;
  gslam::Subscriber subscriber_;
  std::unique_ptr<gslam::Slam> slam_;
};

TEST_F(Replay, AnswersWithThePosesOfTheFile) {
  run(gslam::Svar::object());
  ASSERT_EQ(poses_.size(), 50U);
  for (std::size_t i = 0; i < poses_.size(); ++i) {
    EXPECT_EQ(poses_[i].frame, i);
    EXPECT_EQ(poses_[i].state, TrackingState::tracking);
    EXPECT_LT((poses_[i].T_world_body.translation() - truth_[i].pose.translation()).norm(), 1e-12);
  }
}

TEST_F(Replay, ReadsAllFormatsAndKittiByNumber) {
  const File kitti("kitti.txt", gslam::printTrajectory(truth_, gslam::TrajectoryFormat::kitti));
  run(gslam::Svar::object({{"trajectory", kitti.path()}}));
  ASSERT_EQ(poses_.size(), 50U);
  EXPECT_LT((poses_[33].T_world_body.translation() - truth_[33].pose.translation()).norm(), 1e-9);
}

TEST_F(Replay, IsLostWhereTheFileSaysNothing) {
  run(gslam::Svar::object(), 70);
  EXPECT_EQ(poses_[59].state, TrackingState::tracking);
  EXPECT_EQ(poses_[60].state, TrackingState::lost);
  gslam::Trajectory holes;
  for (const gslam::StampedPose& pose : truth_) {
    if (pose.stamp < 10 * kStep || pose.stamp > 20 * kStep) holes.add(pose.stamp, pose.pose);
  }
  const File file("holes.txt", gslam::printTrajectory(holes));
  run(gslam::Svar::object({{"trajectory", file.path()}, {"max_gap_s", 0.5}}));
  EXPECT_EQ(poses_[9].state, TrackingState::tracking);
  EXPECT_EQ(poses_[15].state, TrackingState::lost);
  run(gslam::Svar::object({{"trajectory", file.path()}}));
  EXPECT_EQ(poses_[15].state, TrackingState::tracking);
}

TEST_F(Replay, NoiseHasItsSizeAndItsSeed) {
  replay::PoseOptions options;
  options.file = truth_file_.path();
  options.noise_m = 0.2;
  options.noise_rad = 0.05;
  options.seed = 7;
  const replay::Poses poses(options);
  constexpr int kCount = 20000;
  Vec3d mean{};
  double move = 0, turn = 0;
  for (std::uint64_t i = 0; i < kCount; ++i) {
    const SE3d pose = poses.withNoise(SE3d(), i);
    mean = mean + pose.translation();
    move += pose.translation().squaredNorm();
    turn += pose.rotation().log().squaredNorm();
  }
  // Relative standard deviation of a root mean square of 3 n normal numbers: 1 / sqrt(6 n).
  const double bound = 5 / std::sqrt(6.0 * kCount);
  EXPECT_NEAR(std::sqrt(move / (3 * kCount)) / 0.2, 1, bound);
  EXPECT_NEAR(std::sqrt(turn / (3 * kCount)) / 0.05, 1, bound);
  EXPECT_LT(mean.norm() / kCount, 5 * 0.2 * std::sqrt(3.0 / kCount));
  // The same frame has the same noise, another seed has another.
  EXPECT_EQ(poses.withNoise(SE3d(), 5).translation(), poses.withNoise(SE3d(), 5).translation());
  options.seed = 8;
  EXPECT_GT((replay::Poses(options).withNoise(SE3d(), 5).translation() -
             poses.withNoise(SE3d(), 5).translation())
                .norm(),
            1e-6);
}

// The way between two poses of the truth.
double wayBetween(const gslam::Trajectory& truth, std::size_t from, std::size_t to) {
  double way = 0;
  for (std::size_t i = from; i < to; ++i) {
    way += (truth[i + 1].pose.translation() - truth[i].pose.translation()).norm();
  }
  return way;
}

SE3d relativeError(const gslam::Trajectory& truth, const gslam::Trajectory& drifted,
                   std::size_t from, std::size_t to) {
  const SE3d true_motion = truth[from].pose.inverse() * truth[to].pose;
  return (drifted[from].pose.inverse() * drifted[to].pose).inverse() * true_motion;
}

TEST_F(Replay, DriftIsExactOverAnyPartOfTheWay) {
  replay::PoseOptions options;
  options.drift = 0.03;
  gslam::Trajectory drifted = replay::withDrift(truth_, options);
  for (const auto& [from, to] : {std::pair<std::size_t, std::size_t>{0, 59}, {10, 40}, {20, 21}}) {
    const SE3d error = relativeError(truth_, drifted, from, to);
    EXPECT_NEAR(error.translation().norm(), 0.03 * wayBetween(truth_, from, to), 1e-9);
    EXPECT_LT(error.rotation().log().norm(), 1e-9);
  }
  options.drift = 0;
  options.drift_rad_per_m = 0.02;
  drifted = replay::withDrift(truth_, options);
  for (const auto& [from, to] : {std::pair<std::size_t, std::size_t>{0, 59}, {10, 40}, {20, 21}}) {
    const SE3d error = relativeError(truth_, drifted, from, to);
    EXPECT_NEAR(error.rotation().log().norm(), 0.02 * wayBetween(truth_, from, to), 1e-9);
  }
  options.drift_rad_per_m = 0;
  options.scale = 2.5;
  drifted = replay::withDrift(truth_, options);
  EXPECT_NEAR(drifted.length(), 2.5 * truth_.length(), 1e-9);
}

TEST_F(Replay, LosesTrackWhereItIsTold) {
  run(gslam::Svar::object({{"losses", "5-6, 8:guessed, 1s-1.2s:none"}, {"start_after", 2}}), 15);
  using S = TrackingState;
  EXPECT_THAT(states(), testing::ElementsAre(S::starting, S::starting, S::tracking, S::tracking,
                                             S::tracking, S::lost, S::lost, S::tracking, S::guessed,
                                             S::tracking, S::tracking, S::tracking));
  EXPECT_EQ(poses_[9].frame, 9U);
  EXPECT_EQ(poses_[10].frame, 13U);
}

TEST_F(Replay, SaysWhatIsNotToBeBelieved) {
  run(gslam::Svar::object({{"losses", "1:nan"}, {"strays", 2}, {"stamp_error_s", 0.5}}), 3);
  ASSERT_EQ(poses_.size(), 9U);
  for (std::size_t i = 0; i < 9; ++i) {
    EXPECT_EQ(poses_[i].stamp,
              std::int64_t(i / 3) * kStep + 500000000 + std::int64_t(i % 3) * 1000000);
    EXPECT_EQ(poses_[i].frame < 3, i % 3 == 0);
    EXPECT_EQ(std::isnan(poses_[i].T_world_body.translation()[0]), i / 3 == 1) << i;
    EXPECT_EQ(poses_[i].state, TrackingState::tracking);
  }
}

TEST_F(Replay, BeginsAnewWhenItIsConfiguredAgain) {
  run(gslam::Svar::object({{"keyframe_every", 1}, {"corrects", true}, {"start_after", 1}}), 3);
  poses_.clear();
  gslam::SlamSetup setup;
  setup.parameters = replay::defaultParameters().merged(gslam::Svar::object(
      {{"trajectory", truth_file_.path()}, {"keyframe_every", 1}, {"start_after", 1}}));
  setup.messenger = messenger_;
  slam_->configure(setup);
  feed(0);
  slam_->finish();
  ASSERT_EQ(poses_.size(), 1U);  // nothing of before is corrected
  EXPECT_EQ(poses_[0].state, TrackingState::starting);
  EXPECT_EQ(slam_->map()->keyframes().size(), 0U);
}

TEST_F(Replay, FailsInItsConstructor) {
  ASSERT_EQ(setenv("GSLAM_REPLAY_FAULT", "throw", 1), 0);
  EXPECT_THROW(replay::replayFactory().make(), gslam::Error);
  ASSERT_EQ(setenv("GSLAM_REPLAY_FAULT", "laugh", 1), 0);
  EXPECT_THROW(replay::replayFactory().make(), gslam::ArgumentError);
  ASSERT_EQ(unsetenv("GSLAM_REPLAY_FAULT"), 0);
  EXPECT_NE(replay::replayFactory().make(), nullptr);
}

TEST(Losses, AreRefusedWhereTheyMeanNothing) {
  for (const char* const text : {"x", "5-", "-5", "9-5", "5:sleeping", "5-6s", "5,,6", "1s-2", ",",
                                 "99999999999999999999", "nans", "5-6:"}) {
    try {
      replay::Losses losses(text);
      ADD_FAILURE() << text;
    } catch (const gslam::ArgumentError& error) {
      EXPECT_THAT(error.what(), testing::HasSubstr("expected intervals such as"));
    }
  }
}

TEST_F(Replay, AnswersLateFromAThread) {
  begin(gslam::Svar::object({{"latency_ms", 60.0}}));
  const auto begin_time = std::chrono::steady_clock::now();
  for (std::uint64_t i = 0; i < 5; ++i) feed(i);
  slam_->finish();
  EXPECT_GE(std::chrono::steady_clock::now() - begin_time, milliseconds(60));
  ASSERT_EQ(poses_.size(), 5U);  // all, and in order
  for (std::size_t i = 0; i < 5; ++i) EXPECT_EQ(poses_[i].frame, i);
}

TEST_F(Replay, EndsWhileAnswersWait) {
  begin(gslam::Svar::object({{"latency_ms", 100000.0}}));
  feed(0);
  slam_.reset();
  EXPECT_TRUE(poses_.empty());
}

TEST_F(Replay, DelaysTheAnswer) {
  begin(gslam::Svar::object({{"delay_ms", 30.0}}));
  const auto begin_time = std::chrono::steady_clock::now();
  feed(0);
  EXPECT_GE(std::chrono::steady_clock::now() - begin_time, milliseconds(30));
}

TEST_F(Replay, CorrectsAndMapsWithoutNoise) {
  run(gslam::Svar::object({{"noise_m", 1.0}, {"corrects", true}, {"keyframe_every", 10}}));
  ASSERT_EQ(poses_.size(), 100U);
  EXPECT_GT((poses_[20].T_world_body.translation() - truth_[20].pose.translation()).norm(), 0.01);
  EXPECT_EQ(poses_[70].frame, 20U);
  EXPECT_LT((poses_[70].T_world_body.translation() - truth_[20].pose.translation()).norm(), 1e-12);
  const std::shared_ptr<const gslam::Map> map = slam_->map();
  ASSERT_NE(map, nullptr);
  EXPECT_EQ(map->keyframes().size(), 5U);
  EXPECT_EQ(map->points().size(), 5U);
  EXPECT_EQ(map->edges().size(), 4U);
  const gslam::Keyframe& second = map->at(gslam::KeyframeId(1));
  EXPECT_EQ(second.frame, 10U);
  EXPECT_LT((second.T_world_body.translation() - truth_[10].pose.translation()).norm(), 1e-12);
  run(gslam::Svar::object());
  EXPECT_EQ(slam_->map(), nullptr);
}

TEST(KnownCost, BurnsWhatItIsTold) {
  const auto cpu = [] { return double(std::clock()) / CLOCKS_PER_SEC; };
  replay::CostOptions options;
  options.cpu = milliseconds(50);
  options.cpu_threads = 2;
  replay::KnownCost cost(options);
  const double before = cpu();
  cost.spend();
  EXPECT_GE(cpu() - before, 0.099);
  EXPECT_LT(cpu() - before, 0.2);
}

TEST(KnownCost, ThrowsWhereThereIsNoMemory) {
#if defined(__SANITIZE_ADDRESS__) || defined(__SANITIZE_THREAD__)
  GTEST_SKIP() << "the sanitizer ends the program instead";
#endif
  replay::CostOptions options;
  options.allocations = 1;
  options.allocation_bytes = std::size_t(1) << 60;
  EXPECT_THROW(replay::KnownCost(options).spend(), std::bad_alloc);
}

TEST(Fault, IsThatOfItsCallAndFrame) {
  using replay::FaultOptions;
  FaultOptions fault;
  fault.kind = FaultOptions::Kind::exception;
  fault.frame = 5;
  replay::failIfAsked(fault, FaultOptions::Call::configure);
  replay::failIfAsked(fault, FaultOptions::Call::finish);
  replay::failIfAsked(fault, FaultOptions::Call::feed, 4);
  EXPECT_THROW(replay::failIfAsked(fault, FaultOptions::Call::feed, 5), gslam::Error);
  EXPECT_THROW(replay::failIfAsked(fault, FaultOptions::Call::feed, 6), gslam::Error);
  fault.call = FaultOptions::Call::finish;
  EXPECT_THROW(replay::failIfAsked(fault, FaultOptions::Call::finish), gslam::Error);
}

TEST(FaultDeathTest, EndsTheProcess) {
#if !defined(__SANITIZE_THREAD__)
  using replay::FaultOptions;
  FaultOptions fault;
  fault.kind = FaultOptions::Kind::exit;
  EXPECT_EXIT(replay::failIfAsked(fault, fault.call), testing::ExitedWithCode(replay::kExitStatus),
              "");
  fault.kind = FaultOptions::Kind::abort;
  EXPECT_EXIT(replay::failIfAsked(fault, fault.call), testing::KilledBySignal(SIGABRT), "");
#if !defined(__SANITIZE_ADDRESS__)  // which makes an exit of it
  fault.kind = FaultOptions::Kind::signal;
  EXPECT_EXIT(replay::failIfAsked(fault, fault.call), testing::KilledBySignal(SIGSEGV), "");
#endif
#endif
}

TEST(Options, NameWhatIsWrong) {
  const auto fails = [](const gslam::Svar& given, const char* text) {
    const gslam::Svar whole = replay::defaultParameters()
                                  .merged(gslam::Svar::object({{"trajectory", "x.txt"}}))
                                  .merged(given);
    try {
      replay::readOptions(whole);
      ADD_FAILURE() << text;
    } catch (const gslam::ArgumentError& error) {
      EXPECT_THAT(error.what(), testing::HasSubstr(text));
    }
  };
  using gslam::Svar;
  fails(Svar::object({{"trajectory", ""}}), "gslam info DATASET --ground-truth");
  fails(Svar::object({{"noise_m", -1.0}}), "noise_m is -1");
  fails(Svar::object({{"noise_deg", std::nan("")}}), "noise_deg is nan");
  fails(Svar::object({{"scale", 0.0}}), "scale is 0");
  fails(Svar::object({{"seed", -1}}), "seed is -1");
  fails(Svar::object({{"cpu_threads", 0}}), "cpu_threads is 0");
  fails(Svar::object({{"fault", "sleep"}}), "none, signal, abort, exit, throw, hang");
  fails(Svar::object({{"fault_in", "map"}}), "configure, feed, finish");
  fails(Svar::object({{"losses", "5-3"}}), "'5-3'");
  EXPECT_NEAR(replay::readOptions(replay::defaultParameters().merged(Svar::object(
                                      {{"trajectory", "x.txt"}, {"noise_deg", 180.0}})))
                  .poses.noise_rad,
              kPi, 1e-12);
}

TEST_F(Replay, RefusesFilesThatAreNone) {
  EXPECT_THROW(run(gslam::Svar::object({{"trajectory", "/nowhere/x.txt"}})), gslam::FileError);
  const File words("words.txt", "no poses here\n");
  EXPECT_THROW(run(gslam::Svar::object({{"trajectory", words.path()}})), gslam::Error);
  const File empty("empty.txt", "");
  EXPECT_THROW(run(gslam::Svar::object({{"trajectory", empty.path()}})), gslam::Error);
}

TEST(Options, EachParameterIsExplained) {
  const gslam::Svar defaults = replay::defaultParameters(), help = replay::parameterHelp();
  EXPECT_EQ(help.size(), defaults.size());
  for (const gslam::Svar::Member& parameter : defaults.members()) {
    EXPECT_FALSE(help.get<std::string>(parameter.first, "").empty()) << parameter.first;
  }
}

}  // namespace
