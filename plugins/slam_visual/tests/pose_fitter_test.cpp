#include "matching/pose_fitter.h"

#include <gtest/gtest.h>

#include <limits>
#include <vector>

#include "made_scene.h"

namespace {

using gslam::KeyframeId;
using gslam::SE3d;
using gslam::SO3d;
using made::Journey;
using visual::Match;
using visual::SensorKind;

class PoseFitterTest : public testing::TestWithParam<SensorKind> {
 protected:
  PoseFitterTest() : journey(GetParam(), {}, 8, {0.5, 0.002, 6}) {
    journey.visitCircle(room, 0, 0.05, 4);
    truth = made::cameraOnCircle(0.08);
    view = journey.lookFrom(room, truth, 1).view;
    matches =
        matchKeyframe(*view, journey.world.scene(), KeyframeId(2), {visual::kLooseDistance, 0.8F});
  }
  double errorOf(const SE3d& T_world_body) const {
    const SE3d T = T_world_body * journey.world.eye().T_body_camera;
    return (T.translation() - truth.translation()).norm();
  }

  made::Room room = made::makeRoom(5);
  Journey journey;
  SE3d truth;  // T_world_camera
  std::shared_ptr<const visual::View> view;
  std::vector<Match> matches;
  visual::PoseFitter fitter;
};

TEST_P(PoseFitterTest, FindsAPoseFromNothing) {
  ASSERT_GT(matches.size(), 50U);
  SE3d pose;
  ASSERT_TRUE(fitter.find(*view, journey.world.scene(), matches, 1, pose));
  EXPECT_LT(errorOf(pose), 0.03);
  EXPECT_GT(matches.size(), 50U);
}

TEST_P(PoseFitterTest, RefinesAmongWrongMatchesAndLeavesThemOut) {
  // A fifth sees the point of another feature.
  const std::vector<Match> right = matches;
  for (std::size_t i = 0; i + 7 < matches.size(); i += 5) matches[i].point = right[i + 7].point;
  const SE3d off(SO3d::exp({0.01, -0.02, 0.01}), {0.03, 0.02, -0.02});
  SE3d pose = truth * off * journey.world.eye().T_body_camera.inverse();
  ASSERT_TRUE(fitter.refine(*view, journey.world.scene(), matches, pose));
  EXPECT_LT(errorOf(pose), 0.03);
  std::size_t wrong = 0;
  for (const Match& match : matches) {
    for (const Match& other : right) {
      wrong += other.feature == match.feature && other.point != match.point ? 1 : 0;
    }
  }
  EXPECT_LE(wrong, 2U);
}

TEST_P(PoseFitterTest, SaysSoWhereThereIsNone) {
  std::vector<Match> few(matches.begin(), matches.begin() + 8);
  SE3d pose;
  EXPECT_FALSE(fitter.refine(*view, journey.world.scene(), few, pose));
  // Matches that have nothing to do with each other.
  std::vector<Match> mixed = matches;
  for (std::size_t i = 0; i < mixed.size(); ++i) {
    mixed[i].point = matches[(i * 37 + 11) % matches.size()].point;
  }
  EXPECT_FALSE(fitter.find(*view, journey.world.scene(), mixed, 1, pose));
}

TEST_P(PoseFitterTest, CountsErrorsInStandardDeviations) {
  const visual::Eye& eye = journey.world.eye();
  const std::uint32_t feature = matches.front().feature;
  const int octave = view->features()[feature].octave;
  gslam::Vec3d bearing;
  const double sigma = eye.levels.factor(octave);
  ASSERT_TRUE(eye.camera.unproject(view->pixel(feature) + gslam::Vec2d{0, 2 * sigma}, bearing));
  // At the depth that was measured, so that only the pixel is off, by two standard deviations.
  const double depth = eye.hasDepth() ? double(view->depth[feature]) : 4.0;
  const gslam::Vec3d point = (depth / bearing[2]) * bearing;
  EXPECT_NEAR(squaredError(eye, *view, feature, point), 4, 0.02);
  EXPECT_TRUE(fits(eye, *view, feature, point));
  EXPECT_EQ(squaredError(eye, *view, feature, {0, 0, -1}), std::numeric_limits<double>::infinity());
}

INSTANTIATE_TEST_SUITE_P(Sensors, PoseFitterTest,
                         testing::Values(SensorKind::mono, SensorKind::stereo, SensorKind::rgbd));

}  // namespace
