#include "matching/matcher.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <set>
#include <utility>
#include <vector>

#include "made_scene.h"

namespace {

using gslam::Image;
using gslam::KeyframeId;
using gslam::kNoPoint;
using gslam::PointId;
using gslam::SE3d;
using gslam::Vec2d;
using gslam::Vec3d;
using made::Journey;
using visual::FeaturePair;
using visual::Match;
using visual::MatchRules;
using visual::SensorKind;
using visual::SoughtPoint;

// Descriptors with few different bits, so that unrelated ones are near to each other, too.
Image tableOf(int rows, std::uint64_t seed) {
  made::Random random(seed);
  Image table(32, rows, gslam::PixelType::u8);
  for (int row = 0; row < rows; ++row) {
    for (int i = 0; i < 32; ++i) table.bytes(row)[i] = std::uint8_t(random.bits() & 0x11);
  }
  return table;
}

std::vector<std::uint32_t> everyThird(int rows, std::uint32_t first) {
  std::vector<std::uint32_t> chosen;
  for (std::uint32_t i = first; i < std::uint32_t(rows); i += 3) chosen.push_back(i);
  return chosen;
}

float distanceOfRows(const Image& a, std::uint32_t i, const Image& b, std::uint32_t j) {
  return visual::distanceOf(a.bytes(int(i)), b.bytes(int(j)), a);
}

TEST(MatchDescriptors, FindsWhatBruteForceFinds) {
  const Image first = tableOf(120, 1);
  Image second = tableOf(100, 2);
  // Some are those of the first one, with more and more wrong bits.
  for (int row = 0; row < 100; row += 6) {
    std::copy(first.bytes(row + 1), first.bytes(row + 1) + 32, second.bytes(row));
    for (int i = 0; i < row / 5; ++i) second.bytes(row)[i] ^= 1;
  }
  const std::vector<std::uint32_t> rows = everyThird(120, 1), others = everyThird(100, 0);
  for (const MatchRules rules : {MatchRules{1, 1}, MatchRules{0.09F, 1}, MatchRules{1, 0.85F}}) {
    std::set<std::pair<std::uint32_t, std::uint32_t>> expected;
    for (const std::uint32_t i : rows) {
      for (const std::uint32_t j : others) {
        const float d = distanceOfRows(first, i, second, j);
        bool is_pair = d <= rules.most;
        for (const std::uint32_t other : others) {
          if (other == j) continue;
          is_pair = is_pair && d < rules.ratio * distanceOfRows(first, i, second, other);
        }
        // Of equals among the first ones, the earlier one.
        for (const std::uint32_t other : rows) {
          if (other == i) continue;
          const float its = distanceOfRows(first, other, second, j);
          is_pair = is_pair && (other < i ? d < its : d <= its);
        }
        if (is_pair) expected.insert({i, j});
      }
    }
    std::set<std::pair<std::uint32_t, std::uint32_t>> found;
    for (const FeaturePair& pair : matchDescriptors(first, rows, second, others, rules)) {
      found.insert({pair.first, pair.second});
    }
    EXPECT_GT(expected.size(), 2U);
    EXPECT_EQ(found, expected) << "at most " << rules.most << ", ratio " << rules.ratio;
  }
}

TEST(MatchDescriptors, FindsNothingInNothing) {
  const Image table = tableOf(5, 1);
  const std::vector<std::uint32_t> rows = {0, 1};
  EXPECT_TRUE(matchDescriptors(table, rows, Image(), {}, MatchRules()).empty());
  EXPECT_TRUE(matchDescriptors(Image(), {}, table, rows, MatchRules()).empty());
}

TEST(KeepCommonTurn, LeavesOutWhatTurnsOtherwise) {
  std::vector<gslam::Feature> first(60), second(60);
  std::vector<FeaturePair> pairs;
  for (std::uint32_t i = 0; i < 60; ++i) {
    first[i].angle = float(0.1 * i);
    // Across zero, within a bin or two; every sixth by another angle.
    second[i].angle = float(0.1 * i + (i % 6 == 0 ? 2.0 : 0.03 * (i % 3) - 0.03));
    pairs.push_back({i, i});
  }
  keepCommonTurn(first, second, pairs);
  EXPECT_EQ(pairs.size(), 50U);
  for (const FeaturePair& pair : pairs) EXPECT_NE(pair.first % 6, 0U);
}

class ProjectionTest : public testing::TestWithParam<SensorKind> {
 protected:
  ProjectionTest() : journey(GetParam(), {}, 8) {
    journey.visitCircle(room, 0, 0.05, 4);
    const SE3d camera = made::cameraOnCircle(0.08);
    T_camera_world = camera.inverse();
    seen = journey.lookFrom(room, camera, 1);
    std::vector<PointId> points;
    for (const auto& item : scene().map.points()) points.push_back(item.id);
    findVisible(scene(), T_camera_world, points, 5, sought);
  }
  const visual::Scene& scene() const { return journey.world.scene(); }

  // Whether a feature is where the point should be, and of the size that it should have.
  bool isCandidate(const SoughtPoint& point, std::uint32_t feature) const {
    const visual::Eye& eye = scene().eye;
    const Vec3d p = T_camera_world * point.position;
    Vec2d pixel, right;
    if (!eye.camera.project(p, pixel) || !eye.camera.isInImage(pixel)) return false;
    const double window = point.window * eye.levels.factor(point.level);
    const Vec2d off = seen.view->pixel(feature) - pixel;
    if (std::abs(off[0]) > window || std::abs(off[1]) > window) return false;
    if (std::abs(seen.view->features()[feature].octave - point.level) > 1) return false;
    const double measured = double(seen.view->right_u[feature]);
    if (!eye.hasDepth() || std::isnan(measured)) return true;
    EXPECT_TRUE(eye.camera.project({p[0] - eye.baseline, p[1], p[2]}, right));
    return std::abs(measured - right[0]) <= window;
  }

  made::Room room = made::makeRoom(5, 6000);
  Journey journey;
  SE3d T_camera_world;
  made::Seen seen;
  std::vector<SoughtPoint> sought;
};

TEST_P(ProjectionTest, FindsWhatBruteForceFinds) {
  ASSERT_GT(sought.size(), 100U);
  std::vector<std::uint8_t> taken(seen.view->size(), 0);
  for (std::size_t i = 0; i < taken.size(); i += 7) taken[i] = 1;
  std::vector<Match> best(seen.view->size(), Match{0, kNoPoint, 2});
  for (const SoughtPoint& point : sought) {
    visual::Nearest nearest;
    for (std::uint32_t feature = 0; feature < seen.view->size(); ++feature) {
      if (taken[feature] != 0 || !isCandidate(point, feature)) continue;
      const Image& table = seen.view->descriptors();
      nearest.offer(feature,
                    visual::distanceOf(point.descriptor, table.bytes(int(feature)), table));
    }
    if (!nearest.isFound() || nearest.distance > visual::kLooseDistance) continue;
    if (nearest.distance < best[nearest.row].distance) {
      best[nearest.row] = {nearest.row, point.id, nearest.distance};
    }
  }
  std::vector<Match> expected;
  for (const Match& match : best) {
    if (match.point != kNoPoint) expected.push_back(match);
  }
  visual::ProjectionMatcher matcher;
  const std::vector<Match>& found = matcher.match(*seen.view, scene().eye, T_camera_world, sought,
                                                  {visual::kLooseDistance, 1}, taken);
  ASSERT_GT(expected.size(), 100U);
  ASSERT_EQ(found.size(), expected.size());
  for (std::size_t i = 0; i < found.size(); ++i) {
    EXPECT_EQ(found[i].feature, expected[i].feature);
    EXPECT_EQ(found[i].point, expected[i].point);
    EXPECT_EQ(found[i].distance, expected[i].distance);
  }
}

TEST_P(ProjectionTest, FindsTheFeatureThatSeesThePoint) {
  visual::ProjectionMatcher matcher;
  const std::vector<Match>& found = matcher.match(*seen.view, scene().eye, T_camera_world, sought,
                                                  {visual::kLooseDistance, 0.8F});
  std::size_t wrong = 0;
  std::set<PointId> points;
  std::int64_t last = -1;
  for (const Match& match : found) {
    EXPECT_GT(std::int64_t(match.feature), last) << "by feature, one point each";
    last = match.feature;
    EXPECT_TRUE(points.insert(match.point).second) << "one feature a point";
    const Vec3d truth = room.points[seen.points[match.feature]];
    wrong += (scene().map.at(match.point).position - truth).norm() > 0.15 ? 1 : 0;
  }
  EXPECT_GT(found.size(), 200U);
  EXPECT_LE(wrong, found.size() / 100);
}

TEST_P(ProjectionTest, FindsNothingInAViewWithoutFeatures) {
  visual::View empty;
  empty.content = std::make_shared<const gslam::KeyframeContent>();
  visual::ProjectionMatcher matcher;
  EXPECT_TRUE(matcher.match(empty, scene().eye, T_camera_world, sought, {}).empty());
}

TEST_P(ProjectionTest, LooksForPointsWhereTheyCanBeSeenOnly) {
  const visual::Eye& eye = scene().eye;
  const Vec3d centre = T_camera_world.inverse().translation();
  std::set<PointId> found;
  for (const SoughtPoint& point : sought) {
    EXPECT_TRUE(found.insert(point.id).second);
    EXPECT_TRUE(point.window == 5 || point.window == 0.6 * 5);
  }
  std::size_t hidden = 0;
  for (const auto& item : scene().map.points()) {
    Vec2d pixel;
    const Vec3d p = item.value.position, ray = centre - p;
    const bool is_in = eye.camera.project(T_camera_world * p, pixel) && eye.camera.isInImage(pixel);
    const visual::Visibility v = visibilityOf(scene(), item.id);
    const Vec3d normal{double(item.value.normal[0]), double(item.value.normal[1]),
                       double(item.value.normal[2])};
    const bool is_visible = is_in && ray.norm() >= v.nearest && ray.norm() <= v.farthest &&
                            ray.dot(normal) > 0.5 * ray.norm();
    EXPECT_EQ(found.count(item.id) == 1, is_visible);
    hidden += is_visible ? 0 : 1;
  }
  EXPECT_GT(hidden, 10U);
}

TEST_P(ProjectionTest, LooksNotFromBehindNorFromAfar) {
  const PointId id = sought.front().id;
  const gslam::MapPoint point = scene().map.at(id);
  const Vec3d normal{double(point.normal[0]), double(point.normal[1]), double(point.normal[2])};
  const visual::Visibility v = visibilityOf(scene(), id);
  // A camera at a distance along a direction that looks at the point.
  const auto isSoughtFrom = [&](const Vec3d& direction, double distance) {
    const Vec3d forward = -1.0 * direction.normalized();
    const Vec3d right = Vec3d{0.1, 0.2, 1}.cross(forward).normalized();
    const Vec3d down = forward.cross(right);
    const gslam::Mat3d R{right[0],   down[0],  forward[0], right[1],  down[1],
                         forward[1], right[2], down[2],    forward[2]};
    const SE3d camera(gslam::SO3d::fromMatrix(R), point.position - distance * forward);
    std::vector<SoughtPoint> list;
    findVisible(scene(), camera.inverse(), std::vector<PointId>{id}, 5, list);
    return !list.empty();
  };
  EXPECT_TRUE(isSoughtFrom(normal, v.seen_at));
  EXPECT_FALSE(isSoughtFrom(-1.0 * normal, v.seen_at));
  EXPECT_FALSE(isSoughtFrom(normal, 1.01 * v.farthest));
  EXPECT_TRUE(isSoughtFrom(normal, 0.99 * v.farthest));
  EXPECT_FALSE(isSoughtFrom(normal, 0.99 * v.nearest));
  EXPECT_TRUE(isSoughtFrom(normal, 1.01 * v.nearest));
  const Vec3d side = normal.cross(Vec3d{0.3, 0.5, 0.8}).normalized();
  EXPECT_TRUE(isSoughtFrom(0.6 * normal + 0.8 * side, v.seen_at));
  EXPECT_FALSE(isSoughtFrom(0.4 * normal + 0.9165 * side, v.seen_at));
}

INSTANTIATE_TEST_SUITE_P(Sensors, ProjectionTest,
                         testing::Values(SensorKind::mono, SensorKind::rgbd));

}  // namespace
