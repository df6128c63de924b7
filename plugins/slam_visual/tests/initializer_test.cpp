#include "tracking/initializer.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <string>
#include <vector>

#include "made_scene.h"

namespace {

using gslam::KeyframeId;
using gslam::SE3d;
using gslam::SO3d;
using gslam::Vec3d;
using made::Room;
using made::Seen;
using visual::Initializer;
using visual::Options;
using visual::SensorKind;

constexpr double kAngle = 0.3;

SE3d moved(const Vec3d& by, const Vec3d& turned = {0.01, 0.02, 0.03}) {
  return made::cameraOnCircle(kAngle) * SE3d(SO3d::exp(turned), by);
}

// Feeds what a camera sees from some places.
struct Start {
  explicit Start(SensorKind kind, std::size_t points = 4000)
      : room(made::makeRoom(3, points, 8)), world(made::makeEye(kind)) {}

  bool feed(const SE3d& camera) {
    seen.push_back(made::look(room, world.eye(), camera, {0.4, 0.005, 8}, random, seen.size()));
    reason.clear();
    return initializer.begin(seen.back().view, world, reason);
  }
  double medianDepth() const {
    std::vector<double> depths;
    const SE3d T_camera_world = world.scene().T_world_camera(KeyframeId(0)).inverse();
    for (const auto& item : world.map().points()) {
      depths.push_back((T_camera_world * item.value.position)[2]);
    }
    std::sort(depths.begin(), depths.end());
    return depths[depths.size() / 2];
  }

  Room room;
  visual::World world;
  Options options;
  Initializer initializer{options};
  made::Random random{4};
  std::vector<Seen> seen;
  std::string reason;
};

// The motion from the first to the second keyframe against the truth, and points in their unit.
void expectTruth(const Start& start, const SE3d& first, const SE3d& second, double slack) {
  const visual::Scene& scene = start.world.scene();
  ASSERT_EQ(scene.map.keyframes().size(), 2U);
  EXPECT_EQ(scene.map.at(KeyframeId(0)).T_world_body.matrix(), SE3d().matrix());
  const SE3d found =
      scene.T_world_camera(KeyframeId(0)).inverse() * scene.T_world_camera(scene.newest());
  const SE3d truth = first.inverse() * second;
  const double unit = found.translation().norm() / truth.translation().norm();
  EXPECT_LT((found.rotation().inverse() * truth.rotation()).log().norm(), slack);
  EXPECT_LT(((1 / unit) * found.translation() - truth.translation()).norm(),
            10 * slack * truth.translation().norm());
  EXPECT_NEAR(start.medianDepth(), 1, 1e-9);
  std::size_t wrong = 0;
  for (const auto& item : scene.map.points()) {
    const gslam::Observation by = scene.map.observations(item.id)[0];
    ASSERT_EQ(by.keyframe, KeyframeId(0));
    // Which look the first keyframe is of: the one with its frame number.
    const Seen& seen = start.seen[std::size_t(scene.map.at(KeyframeId(0)).frame)];
    const Vec3d p = first.inverse() * start.room.points[seen.points[by.feature]];
    const Vec3d q = scene.T_world_camera(KeyframeId(0)).inverse() * item.value.position;
    wrong += ((1 / unit) * q - p).norm() > 0.15 * p.norm() ? 1 : 0;
  }
  EXPECT_LE(wrong, scene.map.points().size() / 20);
}

TEST(Initializer, FindsTheMotionOfASingleCamera) {
  Start start(SensorKind::mono);
  const SE3d first = moved({}, {}), second = moved({0.5, 0.1, 0.05});
  EXPECT_FALSE(start.feed(first));
  EXPECT_FALSE(start.reason.empty());
  EXPECT_TRUE(start.world.map().keyframes().empty());
  ASSERT_TRUE(start.feed(second)) << start.reason;
  EXPECT_GT(start.world.map().points().size(), 100U);
  expectTruth(start, first, second, 0.005);
  EXPECT_EQ(start.world.map().at(start.world.newest()).frame, 1U);
  EXPECT_EQ(start.world.parent(start.world.newest()), KeyframeId(0));
  EXPECT_FALSE(start.world.scene().neighbours(KeyframeId(0)).empty());
}

// All is on one plane, and two motions explain it equally well: whatever was begun with would be
// wrong as often as not.
TEST(Initializer, WaitsBeforeAPlaneThatTwoMotionsExplain) {
  Start start(SensorKind::mono);
  made::Random random(5);
  const SE3d camera = moved({}, {});
  for (Vec3d& point : start.room.points) {
    const double x = random.uniform(-3, 3), y = random.uniform(-2, 2);
    point = camera * Vec3d{x, y, 6 + 0.5 * x + 0.3 * y};
  }
  start.feed(camera);
  for (int i = 1; i <= 6; ++i) {
    if (start.feed(moved({0.2 * i, 0.05 * i, -0.1 * i}, {0.01 * i, -0.03 * i, 0.01}))) {
      FAIL() << "it cannot know which";
    }
    EXPECT_NE(start.reason.find("plane"), std::string::npos) << start.reason;
  }
}

TEST(Initializer, WaitsWhileTheCameraOnlyTurns) {
  Start start(SensorKind::mono);
  start.feed(moved({}, {}));
  for (int i = 1; i <= 5; ++i) {
    EXPECT_FALSE(start.feed(moved({}, {0.01 * i, 0.02 * i, 0.01 * i}))) << i;
    EXPECT_FALSE(start.reason.empty());
    EXPECT_TRUE(start.world.map().keyframes().empty());
  }
}

TEST(Initializer, WaitsForAParallax) {
  Start start(SensorKind::mono);
  start.feed(moved({}, {}));
  EXPECT_FALSE(start.feed(moved({0.02, 0, 0})));
  EXPECT_FALSE(start.reason.empty());
  EXPECT_TRUE(start.feed(moved({0.5, 0, 0}))) << start.reason;
  EXPECT_EQ(start.world.map().at(KeyframeId(0)).frame, 0U) << "from the first view on";
}

TEST(Initializer, TakesAnotherReferenceWhenTheFirstIsOutOfSight) {
  Start start(SensorKind::mono);
  start.feed(made::cameraOnCircle(0));
  EXPECT_FALSE(start.feed(made::cameraOnCircle(made::kPi)));
  EXPECT_NE(start.reason.find("in both views"), std::string::npos) << start.reason;
  EXPECT_TRUE(start.feed(made::cameraOnCircle(made::kPi) * SE3d(SO3d(), {0.5, 0.1, 0})))
      << start.reason;
  EXPECT_EQ(start.world.map().at(KeyframeId(0)).frame, 1U);
}

TEST(Initializer, ForgetsItsReference) {
  Start start(SensorKind::mono);
  start.feed(moved({}, {}));
  start.initializer.reset();
  EXPECT_FALSE(start.feed(moved({0.5, 0.1, 0.05})));
  EXPECT_NE(start.reason.find("second view"), std::string::npos) << start.reason;
}

TEST(Initializer, SaysThatThereIsTooLittleToSee) {
  Start start(SensorKind::mono, 300);
  for (int i = 0; i < 3; ++i) {
    EXPECT_FALSE(start.feed(moved({0.5 * i, 0, 0})));
    EXPECT_NE(start.reason.find("features, 100 are needed"), std::string::npos) << start.reason;
  }
}

class InitializerWithDepth : public testing::TestWithParam<SensorKind> {};

TEST_P(InitializerWithDepth, BeginsWithOneFrame) {
  Start start(GetParam());
  ASSERT_TRUE(start.feed(moved({}, {}))) << start.reason;
  ASSERT_EQ(start.world.map().keyframes().size(), 1U);
  EXPECT_EQ(start.world.map().at(KeyframeId(0)).T_world_body.matrix(), SE3d().matrix());
  EXPECT_GT(start.world.map().points().size(), 100U);
  for (const auto& item : start.world.map().points()) {
    const gslam::Observation by = start.world.map().observations(item.id)[0];
    const Vec3d p = moved({}, {}).inverse() * start.room.points[start.seen[0].points[by.feature]];
    const Vec3d q =
        start.world.scene().T_world_camera(KeyframeId(0)).inverse() * item.value.position;
    ASSERT_LT((p - q).norm(), 0.05 * p.norm());
  }
}

TEST_P(InitializerWithDepth, SaysThatTooFewFeaturesHaveADepth) {
  Start start(GetParam(), 300);
  EXPECT_FALSE(start.feed(moved({}, {})));
  EXPECT_NE(start.reason.find("depth"), std::string::npos) << start.reason;
  EXPECT_NE(start.reason.find("100"), std::string::npos) << start.reason;
  EXPECT_TRUE(start.world.map().keyframes().empty());
}

INSTANTIATE_TEST_SUITE_P(Sensors, InitializerWithDepth,
                         testing::Values(SensorKind::stereo, SensorKind::rgbd));

}  // namespace
