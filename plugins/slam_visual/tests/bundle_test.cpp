#include "mapping/bundle.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <vector>

#include "made_scene.h"
#include "mapping/adjusted_scene.h"

namespace {

using gslam::KeyframeId;
using gslam::Observation;
using gslam::PointId;
using gslam::SE3d;
using gslam::SO3d;
using gslam::Vec3d;
using made::Drift;
using made::Journey;
using visual::AdjustedScene;
using visual::Bundle;
using visual::SensorKind;

// Six keyframes that see a wall, all but the first at a wrong place, and points that are off.
struct Shaken {
  explicit Shaken(SensorKind kind) : journey(kind, {}, 3, {0.4, 0.004, 8}) {
    journey.visitCircle(made::makeRoom(4, 1500), 0, 0.08, 6);
    made::Random random(9);
    const auto off = [&](double size) {
      return size * Vec3d{random.normal(), random.normal(), random.normal()};
    };
    for (std::uint32_t i = 1; i < 6; ++i) {
      const SE3d& truth = journey.truth[i];
      world().moveKeyframe(KeyframeId(i), SE3d(truth.rotation() * SO3d::exp(off(0.003)),
                                               truth.translation() + off(0.02)));
    }
    const gslam::Map before = world().map();
    for (const auto& item : before.points()) {
      points.push_back(item.id);
      world().movePoint(item.id, item.value.position + off(0.05));
    }
    for (const auto& item : world().map().keyframes()) keyframes.push_back(item.id);
  }
  visual::World& world() { return journey.world; }
  const visual::Scene& scene() { return journey.world.scene(); }
  double rotationError() const {
    double worst = 0;
    for (const auto& item : journey.world.map().keyframes()) {
      const SE3d& truth = journey.truth[std::uint32_t(item.id)];
      worst = std::max(
          worst, (truth.rotation().inverse() * item.value.T_world_body.rotation()).log().norm());
    }
    return worst;
  }

  Journey journey;
  visual::Options options;
  std::vector<KeyframeId> keyframes;
  std::vector<PointId> points;
};

class BundleTest : public testing::TestWithParam<SensorKind> {};

TEST_P(BundleTest, BringsAllToWhereItIs) {
  Shaken shaken(GetParam());
  const double before = shaken.journey.error(), turned = shaken.rotationError();
  const AdjustedScene adjusted = adjustAll(shaken.scene(), shaken.options);
  ASSERT_TRUE(adjusted.is_usable) << adjusted.report;
  EXPECT_FALSE(adjusted.report.empty());
  EXPECT_NEAR(shaken.journey.error(), before, 1e-12) << "it only reads";
  const SE3d first = shaken.world().map().at(KeyframeId(0)).T_world_body;
  apply(adjusted, shaken.world());
  EXPECT_EQ(shaken.world().map().at(KeyframeId(0)).T_world_body.matrix(), first.matrix());
  EXPECT_LT(shaken.rotationError(), turned / 1.5);
  // A single camera leaves the length open, which is near what it was.
  EXPECT_LT(shaken.journey.error(), GetParam() == SensorKind::mono ? before : before / 3);
}

TEST_P(BundleTest, DropsWhatDoesNotFit) {
  Shaken shaken(GetParam());
  // Some features see the point of another one.
  std::vector<Observation> wrong;
  const gslam::Map before = shaken.world().map();
  const gslam::Span<const PointId> seen = before.pointsSeen(KeyframeId(2));
  for (std::uint32_t i = 0; i + 20 < seen.size() && wrong.size() < 10; i += 12) {
    if (seen[i] == gslam::kNoPoint || before.observations(seen[i]).size() < 4) continue;
    if (seen[i + 1] == gslam::kNoPoint) continue;
    const double apart = (shaken.scene().view(KeyframeId(2)).pixel(i) -
                          shaken.scene().view(KeyframeId(2)).pixel(i + 1))
                             .norm();
    if (apart < 60) continue;
    shaken.world().forget(KeyframeId(2), i);
    shaken.world().forget(KeyframeId(2), i + 1);
    if (shaken.world().map().find(seen[i]) == nullptr) continue;
    shaken.world().observe(seen[i], KeyframeId(2), i + 1);
    wrong.push_back({KeyframeId(2), i + 1});
  }
  ASSERT_GE(wrong.size(), 5U);
  std::vector<PointId> points;
  for (const auto& item : shaken.world().map().points()) points.push_back(item.id);
  Bundle bundle;
  bundle.gather(shaken.scene(), shaken.keyframes, points);
  ASSERT_TRUE(bundle.adjust(shaken.scene(), shaken.options)) << bundle.report();
  for (const Observation& one : wrong) {
    EXPECT_EQ(std::count(bundle.outliers().begin(), bundle.outliers().end(), one), 1);
  }
  EXPECT_LT(bundle.outliers().size(), wrong.size() + shaken.world().map().observationCount() / 6);
}

TEST_P(BundleTest, MovesOnlyWhatItMay) {
  Shaken shaken(GetParam());
  const std::vector<KeyframeId> moving = {KeyframeId(4), KeyframeId(5)};
  Bundle bundle;
  bundle.gather(shaken.scene(), moving, shaken.points);
  ASSERT_TRUE(bundle.adjust(shaken.scene(), shaken.options)) << bundle.report();
  ASSERT_EQ(bundle.movingCount(), 2U);
  EXPECT_EQ(bundle.keyframe(0), KeyframeId(4));
  EXPECT_EQ(bundle.keyframe(1), KeyframeId(5));
  EXPECT_FALSE(
      bundle.T_world_body(0).isApprox(shaken.world().map().at(KeyframeId(4)).T_world_body, 1e-6));
}

TEST(Bundle, SaysThatThereIsNothingToAdjust) {
  Shaken shaken(SensorKind::rgbd);
  Bundle bundle;
  bundle.gather(shaken.scene(), shaken.keyframes, std::vector<PointId>());
  EXPECT_FALSE(bundle.adjust(shaken.scene(), shaken.options));
  visual::World empty(made::makeEye(SensorKind::rgbd));
  const AdjustedScene adjusted = adjustAll(empty.scene(), shaken.options);
  EXPECT_FALSE(adjusted.is_usable);
  apply(adjusted, empty);
  EXPECT_TRUE(empty.map().keyframes().empty());
}

TEST_P(BundleTest, SaysTheSameForAnyNumberOfWorkers) {
  Shaken shaken(GetParam());
  const AdjustedScene one = adjustAll(shaken.scene(), shaken.options);
  for (const int workers : {2, 4}) {
    shaken.options.workers = workers;
    const AdjustedScene other = adjustAll(shaken.scene(), shaken.options);
    ASSERT_EQ(one.positions.size(), other.positions.size());
    for (std::size_t i = 0; i < one.positions.size(); ++i) {
      ASSERT_EQ(one.positions[i], other.positions[i]);
    }
    for (std::size_t i = 0; i < one.T_world_body.size(); ++i) {
      EXPECT_EQ(one.T_world_body[i].matrix(), other.T_world_body[i].matrix());
    }
  }
}

// What was added while the adjustment was computed goes with the keyframe beside which it was
// added, and what is gone stays gone.
TEST_P(BundleTest, CarriesAlongWhatWasAddedMeanwhile) {
  Shaken shaken(GetParam());
  visual::World& world = shaken.world();
  const AdjustedScene adjusted = adjustAll(world.scene(), shaken.options);
  ASSERT_TRUE(adjusted.is_usable);
  const KeyframeId parent = KeyframeId(5);
  const auto view = world.scene().of(parent).view;
  const SE3d T_parent_body(SO3d::exp({0.1, 0, 0.1}), {0.2, 0.1, 0});
  const SE3d before = world.map().at(parent).T_world_body;
  const KeyframeId child = world.addKeyframe(view, before * T_parent_body);
  world.setParent(child, parent);
  const KeyframeId grandchild = world.addKeyframe(view, before * T_parent_body * T_parent_body);
  world.setParent(grandchild, child);
  world.forget(parent, 0);
  const PointId point = world.addPoint(before * Vec3d{1, 2, 3}, parent, 0);
  const PointId of_child = world.addPoint(before * Vec3d{3, 2, 3}, child, 0);
  world.removeKeyframe(KeyframeId(3));
  const PointId gone = adjusted.points[7];
  if (world.map().find(gone) != nullptr) world.removePoint(gone);
  apply(adjusted, world);
  const SE3d after = world.map().at(parent).T_world_body;
  EXPECT_FALSE(after.isApprox(before, 1e-6));
  EXPECT_TRUE(world.map().at(child).T_world_body.isApprox(after * T_parent_body, 1e-9));
  EXPECT_TRUE(world.map()
                  .at(grandchild)
                  .T_world_body.isApprox(after * T_parent_body * T_parent_body, 1e-9));
  EXPECT_LT((world.map().at(point).position - after * Vec3d{1, 2, 3}).norm(), 1e-9);
  EXPECT_LT((world.map().at(of_child).position - after * Vec3d{3, 2, 3}).norm(), 1e-9);
  EXPECT_EQ(world.map().find(gone), nullptr);
  EXPECT_EQ(world.map().find(KeyframeId(3)), nullptr);
}

INSTANTIATE_TEST_SUITE_P(Sensors, BundleTest, testing::Values(SensorKind::mono, SensorKind::rgbd));

}  // namespace
