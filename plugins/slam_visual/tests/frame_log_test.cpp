#include "scene/frame_log.h"

#include <gtest/gtest.h>

#include <vector>

#include "made_scene.h"

namespace {

using gslam::KeyframeId;
using gslam::SE3d;
using gslam::SO3d;
using gslam::TrackedPose;
using gslam::TrackingState;
using visual::SensorKind;

const SE3d kBeside(SO3d::exp({0.1, -0.2, 0.3}), {0.4, 0.1, -0.2});

// Three keyframes, and a frame that each of them tracked.
struct Logged {
  Logged() : journey(SensorKind::rgbd, {}, 3) {
    journey.visitCircle(made::makeRoom(4, 400), 0, 0.2, 3);
    for (std::uint32_t i = 0; i < 3; ++i) {
      visual::Tracked tracked;
      tracked.state = TrackingState::tracking;
      tracked.reference = KeyframeId(i);
      tracked.T_reference_body = kBeside;
      log.add(frame(i), tracked);
    }
    visual::Tracked lost;
    lost.state = TrackingState::lost;
    lost.reference = KeyframeId(77);  // means nothing, and must not be looked up
    log.add(frame(3), lost);
  }
  static visual::View frame(std::uint64_t id) {
    visual::View view;
    view.frame = id;
    view.stamp = 1000 - std::int64_t(id);
    return view;
  }
  visual::World& world() { return journey.world; }
  std::vector<TrackedPose> poses() { return log.poses(world().scene()); }
  SE3d at(std::uint32_t keyframe) { return world().map().at(KeyframeId(keyframe)).T_world_body; }

  made::Journey journey;
  visual::FrameLog log;
};

TEST(FrameLog, KeepsAllFramesInTheirOrder) {
  Logged logged;
  const std::vector<TrackedPose> poses = logged.poses();
  ASSERT_EQ(poses.size(), 4U);
  for (std::size_t i = 0; i < 4; ++i) {
    EXPECT_EQ(poses[i].frame, i);
    EXPECT_EQ(poses[i].stamp, 1000 - std::int64_t(i));
    EXPECT_EQ(poses[i].state, i < 3 ? TrackingState::tracking : TrackingState::lost);
  }
  EXPECT_TRUE(poses[1].T_world_body.isApprox(logged.at(1) * kBeside, 1e-12));
}

TEST(FrameLog, FollowsAKeyframeThatMoves) {
  Logged logged;
  const SE3d moved(SO3d::exp({0, 0, 1}), {3, 2, 1});
  logged.world().moveKeyframe(KeyframeId(1), moved);
  EXPECT_TRUE(logged.poses()[1].T_world_body.isApprox(moved * kBeside, 1e-12));
}

TEST(FrameLog, StretchesWithAKeyframe) {
  Logged logged;
  const SE3d moved(SO3d::exp({0, 0, 1}), {3, 2, 1});
  logged.world().moveKeyframe(KeyframeId(1), moved, 2);
  const SE3d twice(kBeside.rotation(), 2.0 * kBeside.translation());
  EXPECT_TRUE(logged.poses()[1].T_world_body.isApprox(moved * twice, 1e-12));
}

TEST(FrameLog, FollowsTheOneThatStandsForAKeyframeThatIsGone) {
  Logged logged;
  const SE3d before = logged.poses()[2].T_world_body;
  const SE3d T_first_body = logged.at(1).inverse() * before;
  logged.world().removeKeyframe(KeyframeId(2));
  EXPECT_TRUE(logged.poses()[2].T_world_body.isApprox(before, 1e-12)) << "nothing moved";
  const SE3d moved(SO3d::exp({0, 0, 1}), {3, 2, 1});
  logged.world().moveKeyframe(KeyframeId(1), moved);
  EXPECT_TRUE(logged.poses()[2].T_world_body.isApprox(moved * T_first_body, 1e-12));
  // And that one goes, too.
  const SE3d T_zero_body = logged.at(0).inverse() * moved * T_first_body;
  logged.world().removeKeyframe(KeyframeId(1));
  const SE3d zero(SO3d::exp({0, 1, 0}), {-1, 2, 1});
  logged.world().moveKeyframe(KeyframeId(0), zero);
  EXPECT_TRUE(logged.poses()[2].T_world_body.isApprox(zero * T_zero_body, 1e-12));
}

// A loop that is closed stretches a part of the map in which keyframes were removed before.
TEST(FrameLog, StretchesWithTheOneThatStandsForAKeyframeThatIsGone) {
  Logged logged;
  visual::World& world = logged.world();
  world.moveKeyframe(KeyframeId(2), logged.at(2), 0.5);  // an older loop
  const SE3d T_first_body = logged.at(1).inverse() * logged.poses()[2].T_world_body;
  world.removeKeyframe(KeyframeId(2));
  const SE3d moved(SO3d::exp({0, 0, 1}), {3, 2, 1});
  world.moveKeyframe(KeyframeId(1), moved, 2);
  SE3d T_stretched(T_first_body.rotation(), 2.0 * T_first_body.translation());
  EXPECT_TRUE(logged.poses()[2].T_world_body.isApprox(moved * T_stretched, 1e-12));
  EXPECT_EQ(world.scene().stretch(KeyframeId(2)), 1.0);
  // Through two that are gone.
  T_stretched = logged.at(0).inverse() * moved * T_stretched;
  world.removeKeyframe(KeyframeId(1));
  world.moveKeyframe(KeyframeId(0), logged.at(0), 3);
  T_stretched = SE3d(T_stretched.rotation(), 3.0 * T_stretched.translation());
  EXPECT_TRUE(logged.poses()[2].T_world_body.isApprox(logged.at(0) * T_stretched, 1e-12));
  EXPECT_EQ(world.scene().stretch(KeyframeId(2)), 3.0);
}

TEST(FrameLog, ForgetsWhatMeansNothingInANewWorld) {
  Logged logged;
  logged.log.loseAll();
  for (const TrackedPose& pose : logged.log.poses(visual::Scene())) {
    EXPECT_EQ(pose.state, TrackingState::lost);
  }
}

}  // namespace
