#include <gmock/gmock.h>
#include <gslam/core/registry.h>
#include <gslam/core/run.h>
#include <gslam/svar/json.h>

#include <cmath>
#include <memory>
#include <stdexcept>
#include <vector>

#include "scripted_slam.h"

namespace {

using gslam::Frame;
using gslam::Map;
using gslam::Messenger;
using gslam::PlayEnd;
using gslam::Player;
using gslam::Recorder;
using gslam::RunResult;
using gslam::SE3d;
using gslam::Svar;
using gslam::TrackedPose;
using gslam::TrackingState;

RunResult run(scripted::Slam& slam, gslam::Dataset& dataset,
              const Messenger& messenger = Messenger()) {
  Player player(dataset, messenger);
  gslam::RunSetup setup;
  setup.name = "mine";
  return gslam::runSlam(slam, player, dataset, setup, messenger);
}

TEST(Run, FromDatasetToTrajectory) {
  const auto dataset = scripted::dataset(12);
  scripted::Slam slam;
  const RunResult result = run(slam, *dataset);
  EXPECT_EQ(result.play.end, PlayEnd::finished);
  EXPECT_THAT(slam.calls, testing::ElementsAre("configure", "finish", "map"));
  ASSERT_EQ(result.trajectory.size(), 12U);
  for (std::size_t i = 0; i < 12; ++i) {
    EXPECT_EQ(result.poses[i].frame, i);
    EXPECT_TRUE(result.trajectory[i].pose.isApprox(
        scripted::poseAt(std::int64_t(i) * scripted::kFramePeriod), 1e-15));
  }
}

TEST(Run, GroundTruthNeverReachesTheSystem) {
  const auto dataset = scripted::dataset(3);
  scripted::Slam slam;
  std::vector<std::string> heard;
  gslam::Subscriber spy;
  slam.on_configure = [&](const gslam::SlamSetup& setup) {
    spy = setup.messenger.subscribeAny(
        "/**", [&](const gslam::AnyMessage& message) { heard.push_back(message.topic()); });
  };
  run(slam, *dataset);
  EXPECT_THAT(heard, testing::Each("/mine/pose"));
  EXPECT_EQ(heard.size(), 3U);
}

TEST(Run, OthersHearItsPosesAndMaps) {
  const auto dataset = scripted::dataset(3);
  const Messenger messenger;
  scripted::Slam slam;
  gslam::Publisher<Map> maps;
  slam.on_configure = [&](const gslam::SlamSetup& setup) {
    maps = setup.messenger.advertise<Map>("map");
  };
  const auto sent = std::make_shared<const Map>();
  slam.on_finish = [&] { maps.publish(sent); };
  int poses = 0;
  std::shared_ptr<const Map> received;
  const auto pose =
      messenger.subscribe<TrackedPose>("/mine/pose", [&](const TrackedPose&) { ++poses; });
  const auto map = messenger.subscribe<Map>(
      "/mine/map", [&](const std::shared_ptr<const Map>& message) { received = message; });
  run(slam, *dataset, messenger);
  EXPECT_EQ(poses, 3);
  EXPECT_EQ(received, sent) << "the same map, not a copy";
}

TEST(Run, KeepsWhatCameBeforeAFailure) {
  const auto dataset = scripted::dataset(10);
  scripted::Slam slam;
  slam.on_frame = [](const Frame& frame) {
    if (frame.id == 6) throw std::domain_error("no features");
  };
  const RunResult result = run(slam, *dataset);
  EXPECT_EQ(result.play.end, PlayEnd::failed);
  EXPECT_EQ(result.play.failure, "no features");
  EXPECT_EQ(result.play.last_frame, 6U);
  EXPECT_EQ(result.trajectory.size(), 6U);
}

TEST(Run, AFailureAtTheEndIsAFailure) {
  const auto dataset = scripted::dataset(4);
  scripted::Slam slam;
  slam.on_finish = [] { throw std::domain_error("did not converge"); };
  const RunResult result = run(slam, *dataset);
  EXPECT_EQ(result.play.end, PlayEnd::failed);
  EXPECT_EQ(result.play.failure, "did not converge");
  EXPECT_EQ(result.trajectory.size(), 4U);
}

TEST(Run, AFailureToConfigureIsAFailure) {
  const auto dataset = scripted::dataset(4);
  scripted::Slam slam;
  slam.on_configure = [](const gslam::SlamSetup&) { throw gslam::Error("no vocabulary"); };
  const RunResult result = run(slam, *dataset);
  EXPECT_EQ(result.play.end, PlayEnd::failed);
  EXPECT_EQ(result.play.failure, "no vocabulary");
  EXPECT_EQ(result.play.played, 0U);
  EXPECT_THAT(slam.calls, testing::ElementsAre("configure"));
}

TEST(Run, WhatIsThrownMayBeAnything) {
  for (const std::string where : {"configure", "feed", "finish"}) {
    const auto dataset = scripted::dataset(4);
    scripted::Slam slam;
    if (where == "configure") slam.on_configure = [](const gslam::SlamSetup&) { throw 7; };
    if (where == "feed") slam.on_frame = [](const Frame&) { throw 7; };
    if (where == "finish") slam.on_finish = [] { throw 7; };
    const RunResult result = run(slam, *dataset);
    EXPECT_EQ(result.play.end, PlayEnd::failed) << where;
    EXPECT_THAT(result.play.failure, testing::HasSubstr("no std::exception")) << where;
  }
}

TEST(Run, PosesCanBeKeptBeforeTheEnd) {
  const auto dataset = scripted::dataset(4);
  scripted::Slam slam;
  const Messenger messenger;
  Player player(*dataset, messenger);
  gslam::RunSetup setup;
  std::size_t poses = 0;
  setup.on_played = [&](const RunResult& result) {
    poses = result.trajectory.size();
    EXPECT_THAT(slam.calls, testing::ElementsAre("configure"));
  };
  gslam::runSlam(slam, player, *dataset, setup, messenger);
  EXPECT_EQ(poses, 4U);
}

TEST(Run, ADatasetCanBePlayedAgain) {
  const auto dataset = scripted::dataset(4);
  for (int i = 0; i < 2; ++i) {
    scripted::Slam slam;
    EXPECT_EQ(run(slam, *dataset).trajectory.size(), 4U);
  }
}

TEST(Registry, RefusesWhatCannotBeUsed) {
  gslam::Registry registry;
  gslam::SlamFactory factory;
  factory.make = [] { return std::unique_ptr<gslam::Slam>(new scripted::Slam); };
  for (const std::string name : {"", "my SLAM", "orb-slam", "a/b", "caf\xC3\xA9"}) {
    factory.name = name;
    EXPECT_THROW(registry.add(factory), gslam::ArgumentError) << name;
  }
  factory.name = "ORB_3";
  registry.add(factory);
  EXPECT_THROW(registry.add(factory), gslam::ArgumentError) << "twice";
  factory.name = "other";
  factory.make = nullptr;
  EXPECT_THROW(registry.add(factory), gslam::ArgumentError);
  EXPECT_EQ(registry.slams().size(), 1U);
}

TEST(Registry, HelpIsOfParametersThatThereAre) {
  gslam::SlamFactory factory;
  factory.name = "explained";
  factory.make = [] { return std::unique_ptr<gslam::Slam>(); };
  factory.parameters = Svar::object({{"rate", 2.5}, {"seed", 1}});
  const std::vector<Svar> wrong = {"text", Svar::object({{"rate", 3}}),
                                   Svar::object({{"speed", "m/s"}})};
  for (const Svar& help : wrong) {
    factory.help = help;
    gslam::Registry registry;
    EXPECT_THROW(registry.add(factory), gslam::ArgumentError) << gslam::printJson(help);
  }
  factory.help = Svar::object({{"rate", "poses a second"}});
  gslam::Registry registry;
  registry.add(factory);
  EXPECT_EQ(registry.slams()[0].help.get<std::string>("rate"), "poses a second");
  factory.name = "without_parameters";
  factory.parameters = Svar();
  EXPECT_THROW(registry.add(factory), gslam::ArgumentError);
}

TEST(Registry, AFactoryThatMakesNoneIsAnError) {
  gslam::SlamFactory factory;
  factory.name = "none";
  factory.make = [] { return std::unique_ptr<gslam::Slam>(); };
  EXPECT_THROW(gslam::makeSlam(factory), gslam::Error);
}

TEST(Recorder, TheLastWordOnAFrameCounts) {
  const Messenger messenger;
  const Recorder recorder("mine", messenger);
  const SE3d first(gslam::SO3d(), {{1, 0, 0}}), second(gslam::SO3d(), {{2, 0, 0}});
  messenger.publish("/mine/pose", TrackedPose{5, 50, first, TrackingState::tracking});
  messenger.publish("/mine/pose", TrackedPose{4, 40, first, TrackingState::guessed});
  messenger.publish("/mine/pose", TrackedPose{6, 60, first, TrackingState::lost});
  messenger.publish("/mine/pose", TrackedPose{3, 30, first, TrackingState::starting});
  messenger.publish("/mine/pose", TrackedPose{5, 50, second, TrackingState::tracking});
  const gslam::Trajectory trajectory = recorder.trajectory();
  ASSERT_EQ(trajectory.size(), 2U);
  EXPECT_EQ(trajectory[0].stamp, 40);
  EXPECT_EQ(trajectory[1].pose.translation()[0], 2);
  ASSERT_EQ(recorder.poses().size(), 4U);
  EXPECT_EQ(recorder.poses()[0].frame, 3U);
  EXPECT_EQ(recorder.invalidCount(), 0U);
}

TEST(Recorder, APoseThatIsNotFiniteIsNone) {
  const Messenger messenger;
  const Recorder recorder("mine", messenger);
  for (std::size_t i = 0; i < 3; ++i) {
    SE3d pose;
    gslam::Vec3d t{};
    t[i] = i == 1 ? std::nan("") : HUGE_VAL;
    pose.setTranslation(t);
    messenger.publish("/mine/pose", TrackedPose{i, std::int64_t(i), pose, TrackingState::tracking});
  }
  EXPECT_TRUE(recorder.trajectory().empty());
  EXPECT_EQ(recorder.invalidCount(), 3U);
  ASSERT_EQ(recorder.poses().size(), 3U);
  EXPECT_EQ(recorder.poses()[0].state, TrackingState::lost);
}

TEST(Recorder, OfTwoFramesWithOneStampTheLaterCounts) {
  const Messenger messenger;
  const Recorder recorder("mine", messenger);
  messenger.publish("/mine/pose", TrackedPose{1, 50, SE3d(), TrackingState::tracking});
  const SE3d pose(gslam::SO3d(), {{2, 0, 0}});
  messenger.publish("/mine/pose", TrackedPose{2, 50, pose, TrackingState::tracking});
  const gslam::Trajectory trajectory = recorder.trajectory();
  ASSERT_EQ(trajectory.size(), 1U);
  EXPECT_EQ(trajectory[0].pose.translation()[0], 2);
}

TEST(MemoryDataset, ChecksItsFrames) {
  using Frames = std::vector<std::shared_ptr<const Frame>>;
  EXPECT_THROW(gslam::MemoryDataset(gslam::DatasetInfo(), Frames{nullptr}), gslam::ArgumentError);
  const auto frame = std::make_shared<Frame>();
  frame->id = 1;
  EXPECT_THROW(gslam::MemoryDataset(gslam::DatasetInfo(), Frames{frame}), gslam::ArgumentError);
}

TEST(MemoryDataset, SeeksAndEnds) {
  const auto dataset = scripted::dataset(3);
  EXPECT_EQ(dataset->info().frame_count, 3U);
  dataset->seek(2);
  EXPECT_EQ(dataset->next()->id, 2U);
  EXPECT_EQ(dataset->next(), nullptr);
  EXPECT_EQ(dataset->next(), nullptr);
  dataset->seek(3);
  EXPECT_EQ(dataset->next(), nullptr);
  dataset->seek(0);
  EXPECT_EQ(dataset->next()->id, 0U);
  EXPECT_THROW(dataset->seek(4), gslam::ArgumentError);
}

}  // namespace
