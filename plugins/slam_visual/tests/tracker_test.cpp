#include "tracking/tracker.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <vector>

#include "made_scene.h"

namespace {

using gslam::KeyframeId;
using gslam::SE3d;
using gslam::SO3d;
using gslam::TrackingState;
using made::Journey;
using made::kStep;
using made::Room;
using visual::KeyframeRequest;
using visual::SensorKind;
using visual::Tracked;

// A map of a part of the room, and a tracker that begins at its newest keyframe.
struct Followed {
  explicit Followed(SensorKind kind, int keyframes = 16)
      : journey(kind, {}, 5, {0.4, 0.004, 8}), places(options.loop, 1) {
    journey.visitCircle(room, 0, kStep, keyframes);
    for (std::uint32_t i = 0; i < std::uint32_t(keyframes); ++i) {
      places.add(KeyframeId(i), scene().of(KeyframeId(i)).view);
    }
    tracker.begin(scene().of(scene().newest()).view, scene());
  }
  const visual::Scene& scene() const { return journey.world.scene(); }
  Tracked track(const SE3d& camera, bool is_mapper_idle = true) {
    return tracker.track(journey.lookFrom(room, camera, ++frame).view, scene(), is_mapper_idle);
  }
  double errorOf(const Tracked& tracked, const SE3d& camera) const {
    return (camera.inverse() * tracked.T_world_body * scene().eye.T_body_camera)
        .translation()
        .norm();
  }

  Room room = made::makeRoom(1, 4000);
  visual::Options options;
  Journey journey;
  visual::PlaceIndex places;
  visual::Relocalizer relocalizer{options, places};
  visual::Tracker tracker{options, relocalizer};
  std::uint64_t frame = 0;
};

// From the newest keyframe back towards the first one.
SE3d pathAt(double steps) {
  return made::cameraOnCircle((15 - steps) * kStep) *
         SE3d(SO3d::exp({0.02 * std::sin(steps), 0, 0.03 * std::sin(2 * steps)}), {});
}

class TrackerTest : public testing::TestWithParam<SensorKind> {};

TEST_P(TrackerTest, FollowsACamera) {
  Followed followed(GetParam());
  for (int i = 1; i <= 30; ++i) {
    const SE3d camera = pathAt(0.3 * i);
    const Tracked tracked = followed.track(camera);
    ASSERT_EQ(tracked.state, TrackingState::tracking) << i << ": " << tracked.reason;
    EXPECT_TRUE(tracked.reason.empty());
    EXPECT_LT(followed.errorOf(tracked, camera), 0.03) << i;
    EXPECT_GT(tracked.matches.size(), 100U);
    const SE3d reference = followed.scene().map.at(tracked.reference).T_world_body;
    EXPECT_TRUE((reference * tracked.T_reference_body).isApprox(tracked.T_world_body, 1e-9));
  }
}

TEST_P(TrackerTest, FollowsACameraThatJumps) {
  Followed followed(GetParam());
  ASSERT_EQ(followed.track(pathAt(0)).state, TrackingState::tracking);
  const SE3d jumped = pathAt(1.5) * SE3d(SO3d::exp({0.05, 0.1, 0.2}), {0.1, 0, 0});
  const Tracked tracked = followed.track(jumped);
  ASSERT_EQ(tracked.state, TrackingState::tracking) << tracked.reason;
  EXPECT_LT(followed.errorOf(tracked, jumped), 0.03);
}

TEST_P(TrackerTest, WantsAKeyframeWhenTheViewChanges) {
  Followed followed(GetParam());
  // Where the map has all that is seen nothing is due.
  for (int i = 0; i < 5; ++i) EXPECT_FALSE(followed.track(pathAt(1)).is_keyframe_due) << i;
  // Beyond its end there is less and less.
  int due_at = 0;
  for (int i = 1; i < 60 && due_at == 0; ++i) {
    const Tracked tracked = followed.track(pathAt(1 - 0.25 * i));
    ASSERT_EQ(tracked.state, TrackingState::tracking) << i << ": " << tracked.reason;
    if (tracked.is_keyframe_due) due_at = i;
  }
  EXPECT_GT(due_at, 0);
  const KeyframeRequest request = followed.tracker.takeKeyframe();
  EXPECT_EQ(request.view->frame, 1000000 + followed.frame);
  EXPECT_FALSE(request.matches.empty());
  EXPECT_GT(request.expected.size(), request.found.size());
  EXPECT_GT(request.found.size(), 100U);
  EXPECT_EQ(request.stretch, 1);
  // What was learnt of points is said once.
  EXPECT_TRUE(followed.tracker.takeKeyframe().found.empty());
  // No second one for the same view.
  EXPECT_FALSE(followed.track(pathAt(1 - 0.25 * due_at)).is_keyframe_due);
}

TEST_P(TrackerTest, SpareKeyframesWaitForTheMapper) {
  Followed idle(GetParam()), busy(GetParam());
  int first_idle = 0, first_busy = 0;
  for (int i = 1; i < 20; ++i) {
    const SE3d camera = pathAt(1 - 0.25 * i);
    if (idle.track(camera, true).is_keyframe_due && first_idle == 0) first_idle = i;
    if (busy.track(camera, false).is_keyframe_due && first_busy == 0) first_busy = i;
  }
  ASSERT_GT(first_idle, 0);
  EXPECT_TRUE(first_busy == 0 || first_busy > first_idle) << first_busy << ' ' << first_idle;
}

TEST_P(TrackerTest, IsLostWhereNothingIsSeenAndFoundAgain) {
  Followed followed(GetParam());
  ASSERT_EQ(followed.track(pathAt(0)).state, TrackingState::tracking);
  const auto nothing = std::make_shared<visual::View>();
  nothing->content = std::make_shared<const gslam::KeyframeContent>();
  for (int i = 0; i < 3; ++i) {
    const Tracked lost = followed.tracker.track(nothing, followed.scene(), true);
    EXPECT_EQ(lost.state, TrackingState::lost);
    EXPECT_NE(lost.reason.find("0 features"), std::string::npos) << lost.reason;
    EXPECT_FALSE(lost.is_keyframe_due);
  }
  // Far from where it was lost.
  const Tracked found = followed.track(pathAt(9.4));
  ASSERT_EQ(found.state, TrackingState::tracking) << found.reason;
  EXPECT_LT(followed.errorOf(found, pathAt(9.4)), 0.03);
  const Tracked next = followed.track(pathAt(9.6));
  EXPECT_EQ(next.state, TrackingState::tracking);
}

TEST_P(TrackerTest, IsLostInAnotherRoom) {
  Followed followed(GetParam());
  ASSERT_EQ(followed.track(pathAt(0)).state, TrackingState::tracking);
  const Room other = made::makeRoom(99, 4000);
  const Tracked lost = followed.tracker.track(followed.journey.lookFrom(other, pathAt(0.2), 7).view,
                                              followed.scene(), true);
  EXPECT_EQ(lost.state, TrackingState::lost);
  EXPECT_NE(lost.reason.find("fits"), std::string::npos) << lost.reason;
}

// The map changes between two frames: keyframes move, with their points, and go.
TEST_P(TrackerTest, FollowsInAMapThatMoves) {
  Followed followed(GetParam());
  ASSERT_EQ(followed.track(pathAt(0)).state, TrackingState::tracking);
  ASSERT_EQ(followed.track(pathAt(0.1)).state, TrackingState::tracking);
  visual::World& world = followed.journey.world;
  const SE3d shift(SO3d::exp({0, 0, 0.5}), {1, -2, 0.5});
  const gslam::Map before = world.map();
  for (const auto& item : before.keyframes()) {
    world.moveKeyframe(item.id, shift * item.value.T_world_body);
  }
  for (const auto& item : before.points()) {
    world.movePoint(item.id, shift * item.value.position);
    world.refresh(item.id);
  }
  const Tracked tracked = followed.track(pathAt(0.2));
  ASSERT_EQ(tracked.state, TrackingState::tracking) << tracked.reason;
  EXPECT_LT(followed.errorOf(tracked, shift * pathAt(0.2)), 0.03);
  const KeyframeId reference = tracked.reference;
  if (reference != KeyframeId(0)) world.removeKeyframe(reference);
  const Tracked next = followed.track(pathAt(0.3));
  ASSERT_EQ(next.state, TrackingState::tracking) << next.reason;
  EXPECT_NE(next.reference, reference);
  EXPECT_LT(followed.errorOf(next, shift * pathAt(0.3)), 0.03);
}

// A dataset that counts its frames wrongly: the newest keyframe has the number of the frame before,
// but another view.
TEST_P(TrackerTest, TakesNoOtherViewForItsOwn) {
  Followed followed(GetParam());
  const auto same_number = [&](const SE3d& camera) {
    const auto view = std::make_shared<visual::View>(
        *followed.journey.lookFrom(followed.room, camera, ++followed.frame).view);
    view->frame = followed.scene().map.at(followed.scene().newest()).frame;
    return view;
  };
  for (int i = 1; i < 8; ++i) {
    const SE3d camera = pathAt(0.3 * i);
    const Tracked tracked = followed.tracker.track(same_number(camera), followed.scene(), true);
    ASSERT_EQ(tracked.state, TrackingState::tracking) << i << ": " << tracked.reason;
    EXPECT_LT(followed.errorOf(tracked, camera), 0.03);
  }
}

INSTANTIATE_TEST_SUITE_P(Sensors, TrackerTest, testing::Values(SensorKind::mono, SensorKind::rgbd));

}  // namespace
