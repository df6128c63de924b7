// The system in threads: as good as in one, whatever comes when.
#include <gslam/optimizer/backend.h>
#include <gtest/gtest.h>

#include <stdexcept>
#include <string>
#include <thread>

#include "short_run.h"

namespace {

using gslam::Svar;
using gslam::TrackingState;
using short_run::errorOf;
using short_run::expectAllAnswered;
using short_run::Frames;
using short_run::framesOf;
using short_run::kFrames;
using short_run::Played;
using short_run::rigOf;
using short_run::runOf;

Svar threaded() {
  return Svar::object({{"threaded", true}});
}

TEST(ThreadedPipeline, IsAsGoodAsTheSequentialOne) {
  for (const std::string name : {"sensors=rgbd", "sensors=stereo", "sensors=mono"}) {
    const bool is_mono = name == "sensors=mono";
    const Frames frames = framesOf(name);
    const auto sequential = runOf(rigOf(name), frames);
    const double error = errorOf(sequential->finals, name, is_mono);
    for (int i = 0; i < 2; ++i) {
      const auto run = runOf(rigOf(name), frames, threaded());
      expectAllAnswered(*run, frames);
      // When the mapper gets its turn is not the same in two runs, so neither is the result.
      EXPECT_GE(run->tracked(run->finals), is_mono ? kFrames * 5 / 10 : kFrames * 8 / 10) << name;
      EXPECT_LT(errorOf(run->finals, name, is_mono), 2 * error + 0.06) << name;
      EXPECT_GE(run->slam->map()->keyframes().size(), 2U);
    }
  }
}

TEST(ThreadedPipeline, MapsAreWholeWhileItWorks) {
  Played run(rigOf("sensors=rgbd"), threaded());
  for (const auto& frame : framesOf("sensors=rgbd")) {
    run.slam->feed(frame);
    const auto map = run.slam->map();
    for (const auto& item : map->points()) {
      ASSERT_FALSE(map->observations(item.id).empty());
      ASSERT_NE(map->find(map->observations(item.id)[0].keyframe), nullptr);
    }
  }
  run.finish();
}

TEST(ThreadedPipeline, EndsInTheMiddleOfItsWork) {
  const Frames frames = framesOf("sensors=rgbd");
  for (std::size_t count = 1; count < 24; count += 3) {
    Frames some(frames.begin(), frames.begin() + std::ptrdiff_t(count));
    const auto run = runOf(rigOf("sensors=rgbd"), some, threaded());
    expectAllAnswered(*run, some);
    // Not ended, only left.
    Played left(rigOf("sensors=rgbd"), threaded());
    left.feed(some);
  }
}

// Loses the camera again and again, so that it begins anew while keyframes are in work.
TEST(ThreadedPipeline, BeginsAnewInTheMiddleOfItsWork) {
  Frames frames = framesOf("sensors=rgbd");
  for (std::size_t i = 3; i < kFrames; i += 4) {
    short_run::change(frames, i, i, [](gslam::Frame& frame) { short_run::paint(frame, 0); });
  }
  // Every frame looks elsewhere than the one before, so that each is worth a keyframe.
  const Svar many = Svar::object({{"threaded", true}, {"keyframe_ratio", 1.0}});
  const auto run = runOf(rigOf("sensors=rgbd"), frames, many);
  expectAllAnswered(*run, frames);
  for (std::size_t i = 3; i < kFrames; i += 4) {
    EXPECT_NE(run->live[i].state, TrackingState::tracking);
    EXPECT_NE(run->finals[i].state, TrackingState::tracking);
  }
}

// What a worker throws reaches the caller, in feed() or in finish().
TEST(ThreadedPipeline, PassesOnWhatWorkersThrow) {
  gslam::OptimizerBackend broken;
  broken.name = "broken";
  broken.bundle = [](const gslam::BundleProblem&,
                     const gslam::OptimizerOptions&) -> gslam::OptimizerSummary {
    throw std::runtime_error("out of order");
  };
  gslam::registerOptimizerBackend(broken);
  const Frames frames = framesOf("sensors=rgbd");
  const Svar parameters = Svar::object({{"threaded", true}, {"backend", "broken"}});
  const auto thrownBy = [](const auto& work) {
    try {
      work();
    } catch (const std::runtime_error& error) {
      return std::string(error.what());
    }
    return std::string();
  };
  Played run(rigOf("sensors=rgbd"), parameters);
  EXPECT_EQ(thrownBy([&] { run.feed(frames), run.finish(); }), "out of order");
  // The worker throws at the last frame, where no feed() comes any more.
  Played other(rigOf("sensors=rgbd"), parameters);
  const std::string thrown = thrownBy([&] {
    std::size_t keyframes = 0;
    const gslam::Subscriber subscriber =
        other.messenger.subscribe<gslam::Map>("map", [&](const gslam::Map&) { ++keyframes; });
    for (std::size_t i = 0; i < kFrames && keyframes == 0; ++i) other.slam->feed(frames[i]);
    EXPECT_EQ(keyframes, 1U);
    other.finish();
  });
  EXPECT_EQ(thrown, "out of order");
}

}  // namespace
