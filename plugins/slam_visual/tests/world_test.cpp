#include "scene/world.h"

#include <gtest/gtest.h>

#include "made_scene.h"
#include "matching/descriptors.h"

namespace {

using gslam::KeyframeId;
using gslam::kNoPoint;
using gslam::PointId;
using gslam::SE3d;
using made::Journey;
using visual::SensorKind;

// Three keyframes beside each other that see the same wall.
struct Wall {
  explicit Wall(SensorKind kind) : journey(kind, {}, 3) { journey.visitCircle(room, 0, 0.02, 3); }

  PointId sharedPoint() const {
    for (const auto& item : journey.world.map().points()) {
      if (journey.world.map().observations(item.id).size() == 3) return item.id;
    }
    return kNoPoint;
  }

  made::Room room = made::makeRoom(4, 800);
  Journey journey;
};

TEST(World, ForgetsAPointWithTheLastThatSaysWhereItIs) {
  for (const SensorKind kind : {SensorKind::mono, SensorKind::rgbd}) {
    Wall wall(kind);
    visual::World& world = wall.journey.world;
    const PointId point = wall.sharedPoint();
    ASSERT_NE(point, kNoPoint);
    const auto forgetIn = [&](std::uint32_t keyframe) {
      const std::int64_t feature = visual::featureOf(world.map(), point, KeyframeId(keyframe));
      ASSERT_GE(feature, 0);
      world.forget(KeyframeId(keyframe), std::uint32_t(feature));
    };
    forgetIn(0);
    EXPECT_NE(world.map().find(point), nullptr);
    forgetIn(1);
    EXPECT_EQ(world.map().find(point) != nullptr, kind == SensorKind::rgbd) << "one view is left";
  }
}

TEST(World, MergesPointsAndKeepsOneFeatureAKeyframe) {
  Wall wall(SensorKind::rgbd);
  visual::World& world = wall.journey.world;
  const PointId kept = wall.sharedPoint();
  // Another one that only the last keyframe sees, by a feature of its own.
  const KeyframeId last = world.newest();
  std::uint32_t feature = 0;
  while (world.map().pointSeen(last, feature) != kNoPoint &&
         world.map().observations(world.map().pointSeen(last, feature)).size() != 1) {
    ++feature;
  }
  PointId gone = world.map().pointSeen(last, feature);
  if (gone == kNoPoint) gone = world.addPoint({1, 2, 3}, last, feature);
  world.merge(kept, gone);
  EXPECT_EQ(world.map().find(gone), nullptr);
  EXPECT_EQ(world.map().observations(kept).size(), 3U);
  EXPECT_EQ(world.map().pointSeen(last, feature), kNoPoint) << "it saw the one that stays already";
}

TEST(World, SaysWhereAKeyframeWentThatIsNoMore) {
  Wall wall(SensorKind::rgbd);
  visual::World& world = wall.journey.world;
  const SE3d before = world.map().at(KeyframeId(1)).T_world_body;
  world.removeKeyframe(KeyframeId(1));
  EXPECT_EQ(world.parent(KeyframeId(2)), KeyframeId(0)) << "children get its parent";
  SE3d T_stand_in_body;
  const KeyframeId stand_in = world.scene().standIn(KeyframeId(1), T_stand_in_body);
  EXPECT_EQ(stand_in, KeyframeId(0));
  EXPECT_TRUE((world.map().at(stand_in).T_world_body * T_stand_in_body).isApprox(before, 1e-12));
  for (const auto& item : world.map().points()) {
    EXPECT_FALSE(world.map().observations(item.id).empty());
  }
}

TEST(World, ChoosesTheDescriptorInTheMiddle) {
  Wall wall(SensorKind::rgbd);
  visual::World& world = wall.journey.world;
  const PointId point = wall.sharedPoint();
  world.refresh(point);
  const gslam::Image& chosen = *world.map().descriptor(point);
  const auto row = [&](const gslam::Observation& by) {
    return world.map().at(by.keyframe).content->descriptors.view(0, int(by.feature), 32, 1);
  };
  const auto sum = [&](const gslam::Image& of) {
    float total = 0;
    for (const gslam::Observation& by : world.map().observations(point)) {
      total += visual::distanceOf(of.bytes(), row(by).bytes(), of);
    }
    return total;
  };
  for (const gslam::Observation& by : world.map().observations(point)) {
    EXPECT_LE(sum(chosen), sum(row(by)) + 1e-6F);
  }
}

TEST(Scene, ExpectsPointsAsFarAwayAsTheyWereSeen) {
  Wall wall(SensorKind::rgbd);
  const visual::Scene& scene = wall.journey.world.scene();
  const PointId point = wall.sharedPoint();
  const visual::Visibility visible = visibilityOf(scene, point);
  EXPECT_GT(visible.seen_at, visible.nearest);
  EXPECT_LT(visible.seen_at, visible.farthest);
}

}  // namespace
