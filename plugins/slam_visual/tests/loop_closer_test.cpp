#include "loops/loop_closer.h"

#include <gtest/gtest.h>

#include <cmath>
#include <optional>
#include <string>

#include "made_scene.h"
#include "matching/pose_fitter.h"

namespace {

using gslam::KeyframeId;
using gslam::SE3d;
using made::Drift;
using made::driftOf;
using made::Journey;
using made::kStep;
using made::Room;
using visual::closeLoop;
using visual::Loop;
using visual::LoopReport;
using visual::SensorKind;

// Walks a circle until the loop is found.
struct WalkToLoop {
  WalkToLoop(SensorKind kind, const Drift& drift) : journey(kind, drift, 5) {
    const Room room = made::makeRoom(1);
    visual::PlaceIndex places(options.loop, 1);
    visual::LoopDetector detector(options, places);
    for (int i = 0; i < 75; ++i) {
      const KeyframeId id = journey.visit(room, made::cameraOnCircle(kStep * i));
      const visual::Scene& scene = journey.world.scene();
      places.add(id, scene.of(id).view);
      std::optional<Loop> found = detector.detect(scene, id);
      if (!found) continue;
      loop = *found;
      is_found = true;
      return;
    }
  }

  // The part of observations that fit.
  double fitting() const {
    const visual::Scene& scene = journey.world.scene();
    std::size_t count = 0;
    for (const auto& point : scene.map.points()) {
      for (const gslam::Observation& by : scene.map.observations(point.id)) {
        const gslam::Vec3d p = scene.T_world_camera(by.keyframe).inverse() * point.value.position;
        if (visual::fits(scene.eye, scene.view(by.keyframe), by.feature, p)) ++count;
      }
    }
    return double(count) / double(scene.map.observationCount());
  }

  visual::Options options;
  Journey journey;
  Loop loop{};
  bool is_found = false;
};

class LoopCloserTest : public testing::TestWithParam<SensorKind> {};

TEST_P(LoopCloserTest, TakesTheDriftAway) {
  WalkToLoop walk(GetParam(), driftOf(GetParam()));
  ASSERT_TRUE(walk.is_found);
  const double error = walk.journey.error(), fitting = walk.fitting();
  EXPECT_GT(error, 0.05);
  const SE3d first = walk.journey.world.map().at(KeyframeId(0)).T_world_body;
  const LoopReport report = closeLoop(walk.journey.world, walk.loop, walk.options);
  EXPECT_TRUE(report.is_closed) << report.optimizer;
  EXPECT_LT(walk.journey.error(), 0.2 * error);
  EXPECT_LT(walk.journey.error(), 0.03);
  EXPECT_GT(walk.fitting(), fitting - 0.05);
  EXPECT_GT(report.merged, 100U);
  EXPECT_GT(report.moved, 0.05);
  EXPECT_FALSE(report.optimizer.empty());
  // What was there first stays.
  EXPECT_EQ(walk.journey.world.map().at(KeyframeId(0)).T_world_body.matrix(), first.matrix());
  const gslam::Map& map = walk.journey.world.map();
  if (GetParam() == SensorKind::mono) {
    EXPECT_NEAR(report.stretched, std::pow(0.998, -double(std::uint32_t(walk.loop.here))), 0.02);
    EXPECT_EQ(walk.journey.world.stretch(walk.loop.here), report.stretched);
  } else {
    EXPECT_EQ(report.stretched, 1);
  }
  std::size_t loops = 0;
  for (const auto& edge : map.edges()) {
    if (edge.value.kind != gslam::EdgeKind::loop) continue;
    ++loops;
    EXPECT_EQ(edge.value.from, walk.loop.there);
    EXPECT_EQ(edge.value.to, walk.loop.here);
  }
  EXPECT_EQ(loops, 1U);
  // Both ends are neighbours now.
  bool is_near = false;
  for (const gslam::Covisible& other : walk.journey.world.scene().neighbours(walk.loop.here)) {
    is_near = is_near || std::uint32_t(other.keyframe) < 15;
  }
  EXPECT_TRUE(is_near);
}

// Nothing is bent where nothing is wrong.
TEST_P(LoopCloserTest, LeavesAMapWithoutDrift) {
  WalkToLoop walk(GetParam(), {});
  ASSERT_TRUE(walk.is_found);
  const LoopReport report = closeLoop(walk.journey.world, walk.loop, walk.options);
  EXPECT_TRUE(report.is_closed) << report.optimizer;
  EXPECT_LT(walk.journey.error(), 0.01);
  EXPECT_GT(walk.fitting(), 0.9);
  EXPECT_NEAR(report.stretched, 1, 0.01);
}

TEST_P(LoopCloserTest, DoesTheSameToTheSame) {
  WalkToLoop one(GetParam(), driftOf(GetParam())), other(GetParam(), driftOf(GetParam()));
  ASSERT_TRUE(one.is_found && other.is_found);
  closeLoop(one.journey.world, one.loop, one.options);
  closeLoop(other.journey.world, other.loop, other.options);
  for (const auto& keyframe : one.journey.world.map().keyframes()) {
    EXPECT_EQ(keyframe.value.T_world_body.matrix(),
              other.journey.world.map().at(keyframe.id).T_world_body.matrix());
  }
  for (const auto& point : one.journey.world.map().points()) {
    ASSERT_EQ(point.value.position, other.journey.world.map().at(point.id).position);
  }
}

// The map went on while the loop was found.
TEST_P(LoopCloserTest, ManagesWithoutWhatIsGone) {
  WalkToLoop walk(GetParam(), driftOf(GetParam()));
  ASSERT_TRUE(walk.is_found);
  visual::World& world = walk.journey.world;
  for (std::size_t i = 0; i < walk.loop.matches.size(); i += 3) {
    world.removePoint(walk.loop.matches[i].point);
  }
  world.removeKeyframe(KeyframeId(30));
  const double error = walk.journey.error();
  EXPECT_TRUE(closeLoop(world, walk.loop, walk.options).is_closed);
  EXPECT_LT(walk.journey.error(), 0.2 * error);

  world.removeKeyframe(walk.loop.there);
  const SE3d before = world.map().at(walk.loop.here).T_world_body;
  EXPECT_FALSE(closeLoop(world, walk.loop, walk.options).is_closed);
  EXPECT_EQ(world.map().at(walk.loop.here).T_world_body.matrix(), before.matrix());
}

INSTANTIATE_TEST_SUITE_P(Sensors, LoopCloserTest,
                         testing::Values(SensorKind::mono, SensorKind::stereo, SensorKind::rgbd),
                         [](const auto& test) {
                           return test.param == SensorKind::mono     ? std::string("mono")
                                  : test.param == SensorKind::stereo ? std::string("stereo")
                                                                     : std::string("rgbd");
                         });

}  // namespace
