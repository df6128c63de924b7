#include "loops/loop_detector.h"

#include <gtest/gtest.h>

#include <cmath>
#include <optional>
#include <string>

#include "made_scene.h"

namespace {

using gslam::KeyframeId;
using gslam::SE3d;
using gslam::SIM3d;
using gslam::Vec3d;
using made::driftOf;
using made::Journey;
using made::kStep;
using made::Room;
using visual::Loop;
using visual::SensorKind;

struct WatchedWalk {
  explicit WatchedWalk(SensorKind kind, const visual::Options& wanted = {})
      : journey(kind, driftOf(kind), 5), options(wanted) {}

  /// Adds a keyframe and asks whether it closes a loop; the first that does is kept.
  void visit(const Room& room, const SE3d& T_world_camera) {
    const KeyframeId id = journey.visit(room, T_world_camera);
    const visual::Scene& scene = journey.world.scene();
    places.add(id, scene.of(id).view);
    if (loop) return;
    loop = detector.detect(scene, id);
  }
  void visitCircle(const Room& room, int first, int count) {
    for (int i = first; i < first + count; ++i) visit(room, made::cameraOnCircle(kStep * i));
  }

  Journey journey;
  visual::Options options;
  visual::PlaceIndex places{options.loop, 1};
  visual::LoopDetector detector{options, places};
  std::optional<Loop> loop;
};

std::string nameOf(SensorKind kind) {
  return kind == SensorKind::mono ? "mono" : kind == SensorKind::stereo ? "stereo" : "rgbd";
}

class LoopDetectorTest : public testing::TestWithParam<SensorKind> {
 protected:
  const Room room = made::makeRoom(1);
};

TEST_P(LoopDetectorTest, FindsTheLoopOfACircle) {
  WatchedWalk walk(GetParam());
  walk.visitCircle(room, 0, 70);
  ASSERT_TRUE(walk.loop);
  const std::uint32_t here = std::uint32_t(walk.loop->here);
  const std::uint32_t there = std::uint32_t(walk.loop->there);
  EXPECT_GE(here, 50U);
  EXPECT_LT(there, 15U);
  const visual::Eye& eye = walk.journey.world.eye();
  const auto& truth = walk.journey.truth;
  // Between cameras, whose places do not depend on the scale of the map.
  const SIM3d found =
      SIM3d(eye.T_body_camera.inverse()) * walk.loop->S_there_here * SIM3d(eye.T_body_camera);
  const SE3d T_there_here =
      (truth[there] * eye.T_body_camera).inverse() * truth[here] * eye.T_body_camera;
  const double lengths = GetParam() == SensorKind::mono ? std::pow(0.998, double(there)) : 1;
  EXPECT_LT((found.translation() - lengths * T_there_here.translation()).norm(), 0.03);
  EXPECT_TRUE(found.rotation().isApprox(T_there_here.rotation(), 0.01));
  if (GetParam() == SensorKind::mono) {
    // Its points are some keyframes older than the keyframe itself.
    EXPECT_NEAR(found.scale(), std::pow(0.998, double(there) - double(here)), 0.02);
  } else {
    EXPECT_EQ(found.scale(), 1);
  }
  EXPECT_GE(walk.loop->matches.size(), 40U);
  for (const visual::Match& match : walk.loop->matches) {
    EXPECT_LT(std::uint32_t(walk.journey.world.map().observations(match.point)[0].keyframe), 30U);
  }
}

TEST_P(LoopDetectorTest, FindsNoneOnTheWay) {
  WatchedWalk walk(GetParam());
  walk.visitCircle(room, 0, 45);
  EXPECT_FALSE(walk.loop);
}

TEST_P(LoopDetectorTest, FindsNoneWhereAllLooksDifferent) {
  WatchedWalk walk(GetParam());
  walk.visitCircle(room, 0, 45);
  Room other = room;
  made::Random random(9);
  for (std::size_t i = 0; i < other.points.size(); ++i) other.drawDescriptor(i, random);
  walk.visitCircle(other, 45, 35);
  EXPECT_FALSE(walk.loop);
}

// The same things as at the beginning, but in other places.
TEST_P(LoopDetectorTest, RefusesWhatOnlyLooksAlike) {
  WatchedWalk walk(GetParam());
  walk.visitCircle(room, 0, 50);
  Room mixed = room;
  made::Random random(9);
  for (int i = 0; i < 200000; ++i) {
    const std::size_t a = random.below(mixed.points.size()), b = random.below(mixed.points.size());
    // Near each other, so that the same words are in a view.
    if ((mixed.points[a] - mixed.points[b]).norm() < 2) std::swap(mixed.points[a], mixed.points[b]);
  }
  walk.visitCircle(mixed, 50, 25);
  const visual::Scene& scene = walk.journey.world.scene();
  // The index does take them for the same place.
  bool looks_alike = false;
  for (const visual::SimilarPlace& place : walk.places.similar(scene.view(KeyframeId(65)), 30)) {
    looks_alike = looks_alike || std::uint32_t(place.keyframe) < 20;
  }
  EXPECT_TRUE(looks_alike);
  EXPECT_FALSE(walk.loop);
}

// A second room, furnished as the first one.
TEST_P(LoopDetectorTest, RefusesWhatIsTooFarAwayForDrift) {
  if (GetParam() == SensorKind::mono) GTEST_SKIP() << "has no lengths";
  WatchedWalk walk(GetParam());
  walk.visitCircle(room, 0, 40);
  const SE3d away({}, {0, 25, 0});
  Room twin = room;
  for (Vec3d& point : twin.points) point = away * point;
  for (int i = 0; i < 20; ++i) walk.visit(twin, away * made::cameraOnCircle(kStep * i));
  EXPECT_FALSE(walk.loop);
}

TEST_P(LoopDetectorTest, NeedsKeyframesInARow) {
  visual::Options options;
  options.loop.consistent = 100;
  WatchedWalk walk(GetParam(), options);
  walk.visitCircle(room, 0, 70);
  EXPECT_FALSE(walk.loop);
}

TEST_P(LoopDetectorTest, NeedsAsManyMatchesAsWanted) {
  visual::Options options;
  options.loop.least_matches = 5000;
  WatchedWalk walk(GetParam(), options);
  walk.visitCircle(room, 0, 70);
  EXPECT_FALSE(walk.loop);
}

TEST_P(LoopDetectorTest, SaysTheSameOfTheSame) {
  WatchedWalk one(GetParam()), other(GetParam());
  one.visitCircle(room, 0, 66);
  other.visitCircle(room, 0, 66);
  ASSERT_TRUE(one.loop && other.loop);
  EXPECT_EQ(one.loop->here, other.loop->here);
  EXPECT_EQ(one.loop->there, other.loop->there);
  EXPECT_EQ(one.loop->S_there_here.matrix(), other.loop->S_there_here.matrix());
  EXPECT_EQ(one.loop->matches.size(), other.loop->matches.size());
}

// Numbers of keyframes begin anew with each map.
TEST_P(LoopDetectorTest, FindsLoopsInTheNextMap) {
  WatchedWalk walk(GetParam());
  walk.visitCircle(room, 0, 70);
  ASSERT_TRUE(walk.loop);
  for (std::uint32_t i = 0; i < 70; ++i) walk.places.remove(KeyframeId(i));
  walk.detector.reset();
  walk.loop.reset();
  walk.journey = Journey(GetParam(), driftOf(GetParam()), 6);
  walk.visitCircle(room, 0, 70);
  EXPECT_TRUE(walk.loop);
}

INSTANTIATE_TEST_SUITE_P(Sensors, LoopDetectorTest,
                         testing::Values(SensorKind::mono, SensorKind::stereo, SensorKind::rgbd),
                         [](const auto& test) { return nameOf(test.param); });

}  // namespace
