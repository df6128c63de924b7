#include "mapping/triangulator.h"

#include <gtest/gtest.h>

#include <set>
#include <vector>

#include "made_scene.h"

namespace {

using gslam::KeyframeId;
using gslam::PointId;
using gslam::SE3d;
using gslam::SO3d;
using gslam::Vec3d;
using made::Noise;
using made::Room;
using made::Seen;
using visual::SensorKind;

// Two keyframes at true poses that see no point yet.
struct Two {
  Two(SensorKind kind, const SE3d& first, const SE3d& second, const Noise& noise = {0.3, 0.005, 8})
      : world(made::makeEye(kind)) {
    made::Random random(4);
    for (const SE3d& camera : {first, second}) {
      seen.push_back(made::look(room, world.eye(), camera, noise, random, seen.size()));
    }
    ids = {world.addKeyframe(seen[0].view, first * world.eye().T_body_camera.inverse()),
           world.addKeyframe(seen[1].view, second * world.eye().T_body_camera.inverse())};
  }
  std::vector<PointId> triangulate() {
    std::vector<PointId> added;
    visual::Triangulator().addPoints(world, ids[0], ids[1], added);
    return added;
  }
  /// Points of the room that both see.
  std::size_t shared() const {
    const std::set<std::size_t> first(seen[0].points.begin(), seen[0].points.end());
    std::size_t count = 0;
    for (const std::size_t point : seen[1].points) count += first.count(point);
    return count;
  }

  Room room = made::makeRoom(3, 4000);
  visual::World world;
  std::vector<Seen> seen;
  std::vector<KeyframeId> ids;
};

SE3d beside(double metres) {
  return made::cameraOnCircle(0.3) * SE3d(SO3d::exp({0.01, 0.02, 0.03}), {metres, 0.02, 0.01});
}

class TriangulatorTest : public testing::TestWithParam<SensorKind> {};

TEST_P(TriangulatorTest, FindsPointsWhereTheyAre) {
  Two two(GetParam(), made::cameraOnCircle(0.3), beside(0.4));
  const std::vector<PointId> added = two.triangulate();
  EXPECT_GT(added.size(), two.shared() / 2);
  std::size_t wrong = 0;
  for (const PointId id : added) {
    const gslam::Span<const gslam::Observation> seen = two.world.map().observations(id);
    ASSERT_EQ(seen.size(), 2U);
    const std::size_t first = two.seen[0].points[seen[0].feature];
    const std::size_t second = two.seen[1].points[seen[1].feature];
    const Vec3d truth = two.room.points[first];
    const double off = (two.world.map().at(id).position - truth).norm();
    // A pixel at 0.4 m of baseline is some 3 % of the distance at the far wall.
    wrong += first != second || off > 0.15 * (truth - beside(0).translation()).norm() ? 1 : 0;
    EXPECT_NE(two.world.map().descriptor(id), nullptr);
  }
  EXPECT_LE(wrong, added.size() / 50);
}

TEST_P(TriangulatorTest, AddsNothingTwice) {
  Two two(GetParam(), made::cameraOnCircle(0.3), beside(0.4));
  const std::size_t first = two.triangulate().size();
  ASSERT_GT(first, 100U);
  // What is left was refused before; little of it passes when its rivals are gone.
  EXPECT_LT(two.triangulate().size(), first / 10);
}

TEST_P(TriangulatorTest, ParallaxIsNeededUnlessDepthWasMeasured) {
  Two two(GetParam(), made::cameraOnCircle(0.3), beside(0.03));
  ASSERT_GT(two.shared(), 300U);
  const std::size_t added = two.triangulate().size();
  if (GetParam() == SensorKind::mono) {
    EXPECT_LE(added, two.shared() / 50);
  } else {
    EXPECT_GT(added, two.shared() / 3);
  }
}

TEST(Triangulator, AddsNothingWithoutAMotion) {
  const SE3d camera = made::cameraOnCircle(0.3);
  Two two(SensorKind::mono, camera, camera);
  EXPECT_TRUE(two.triangulate().empty());
  Two turned(SensorKind::mono, camera, camera * SE3d(SO3d::exp({0.02, 0.1, 0.05}), {}));
  EXPECT_TRUE(turned.triangulate().empty());
}

// A thing that is as near in both images cannot be four times as large in one of them.
TEST(Triangulator, RefusesThingsOfAnotherSize) {
  Two two(SensorKind::mono, made::cameraOnCircle(0.3), beside(0.4));
  const auto larger = std::make_shared<visual::View>(*two.seen[1].view);
  const auto content = std::make_shared<gslam::KeyframeContent>(*larger->content);
  for (gslam::Feature& feature : content->features) feature.octave = 7;
  larger->content = content;
  const auto smaller = std::make_shared<visual::View>(*two.seen[0].view);
  const auto other = std::make_shared<gslam::KeyframeContent>(*smaller->content);
  for (gslam::Feature& feature : other->features) feature.octave = 0;
  smaller->content = other;
  const SE3d T_camera_body = two.world.eye().T_body_camera.inverse();
  two.ids = {two.world.addKeyframe(smaller, made::cameraOnCircle(0.3) * T_camera_body),
             two.world.addKeyframe(larger, beside(0.4) * T_camera_body)};
  EXPECT_TRUE(two.triangulate().empty());
}

INSTANTIATE_TEST_SUITE_P(Sensors, TriangulatorTest,
                         testing::Values(SensorKind::mono, SensorKind::rgbd));

}  // namespace
