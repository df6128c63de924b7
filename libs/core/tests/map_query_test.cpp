// Queries give what looking at everything gives.
#include <gmock/gmock.h>
#include <gslam/core/covisibility.h>
#include <gslam/core/map_trajectory.h>
#include <gslam/core/point_index.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <map>
#include <set>
#include <utility>
#include <vector>

#include "random_map.h"

namespace {

using gslam::Camera;
using gslam::Covisible;
using gslam::Keyframe;
using gslam::KeyframeId;
using gslam::Map;
using gslam::MapPoint;
using gslam::NearPoint;
using gslam::PointId;
using gslam::PointIndex;
using gslam::SE3d;
using gslam::Vec2d;
using gslam::Vec3d;
using gslam_test::RandomMap;
using testing::ElementsAre;
using testing::IsEmpty;

// Some in clusters, some at the very same place.
Map cloud(std::size_t count) {
  RandomMap random(4);
  Map map;
  for (std::size_t i = 0; i < count; ++i) {
    MapPoint point;
    point.position = i % 3 == 0 ? random.vector(10) : Vec3d{1, 2, 3} + random.vector(0.1);
    if (i % 50 == 0) point.position = {1, 2, 3};
    map.add(point);
  }
  return map;
}

std::vector<NearPoint> allByDistance(const Map& map, const Vec3d& centre) {
  std::vector<NearPoint> all;
  for (const auto& item : map.points()) {
    all.push_back(NearPoint{item.id, (item.value.position - centre).norm()});
  }
  std::sort(all.begin(), all.end(), [](const NearPoint& a, const NearPoint& b) {
    return a.distance != b.distance ? a.distance < b.distance : a.id < b.id;
  });
  return all;
}

std::vector<PointId> idsOf(const std::vector<NearPoint>& points) {
  std::vector<PointId> ids;
  for (const NearPoint& point : points) ids.push_back(point.id);
  return ids;
}

std::set<PointId> asSet(const std::vector<PointId>& ids) {
  return std::set<PointId>(ids.begin(), ids.end());
}

TEST(PointIndex, FindsTheNearest) {
  const Map map = cloud(2000);
  const PointIndex index(map);
  RandomMap random(5);
  for (int i = 0; i < 50; ++i) {
    const Vec3d centre = i % 2 == 0 ? random.vector(12) : Vec3d{1, 2, 3};
    std::vector<NearPoint> expected = allByDistance(map, centre);
    for (const std::size_t k : {100u, 7u, 1u}) {
      expected.resize(k);
      ASSERT_EQ(idsOf(index.nearest(centre, k)), idsOf(expected));
    }
  }
}

TEST(PointIndex, FindsWhatIsInABallOrABox) {
  const Map map = cloud(3000);
  const PointIndex index(map);
  RandomMap random(6);
  for (int i = 0; i < 50; ++i) {
    const Vec3d centre = random.vector(5);
    const double radius = random.number(0, 8);
    std::set<PointId> in_ball, in_box;
    for (const auto& item : map.points()) {
      const Vec3d d = item.value.position - centre;
      if (d.norm() <= radius) in_ball.insert(item.id);
      const double largest = std::max({std::fabs(d[0]), std::fabs(d[1]), std::fabs(d[2])});
      if (largest <= radius) in_box.insert(item.id);
    }
    const Vec3d reach = {radius, radius, radius};
    EXPECT_EQ(asSet(idsOf(index.inRadius(centre, radius))), in_ball);
    EXPECT_EQ(asSet(index.inBox(centre - reach, centre + reach)), in_box);
  }
  EXPECT_EQ(index.inRadius({0, 0, 0}, std::numeric_limits<double>::infinity()).size(), 3000u);
  EXPECT_EQ(index.inBox({1, 2, 3}, {1, 2, 3}).size(), 60u);
  EXPECT_THAT(index.inBox({1, 0, 0}, {0, 1, 1}), IsEmpty());
}

TEST(PointIndex, FindsWhatACameraSees) {
  const Map map = cloud(3000);
  const PointIndex index(map);
  RandomMap random(7);
  const Camera camera = Camera::fromParameters("pinhole", 640, 480, {500, 500, 319.5, 239.5});
  for (int i = 0; i < 20; ++i) {
    const SE3d pose = random.pose();
    const double far = i % 2 == 0 ? 9 : std::numeric_limits<double>::infinity();
    std::set<PointId> expected;
    for (const auto& item : map.points()) {
      const Vec3d p = pose.inverse() * item.value.position;
      const Vec2d pixel = {500 * p[0] / p[2] + 319.5, 500 * p[1] / p[2] + 239.5};
      const bool is_inside = pixel[0] >= -0.5 && pixel[0] < 639.5 && pixel[1] >= -0.5 &&
                             pixel[1] < 479.5 && p[2] > 0 && p.norm() <= far;
      if (is_inside) expected.insert(item.id);
    }
    std::set<PointId> found;
    for (const auto& seen : index.visible(camera, pose, far)) found.insert(seen.id);
    EXPECT_EQ(found, expected);
  }
}

TEST(PointIndex, IgnoresWhatIsNowhere) {
  Map map;
  MapPoint point;
  point.position[1] = std::numeric_limits<double>::quiet_NaN();
  map.add(point);
  EXPECT_EQ(PointIndex(map).size(), 0u);
  EXPECT_THAT(PointIndex(map).nearest({0, 0, 0}, 3), IsEmpty());
  EXPECT_THAT(PointIndex(Map()).inRadius({0, 0, 0}, 3), IsEmpty());
}

TEST(PointIndex, RefusesQueriesThatAreNowhere) {
  const PointIndex index(cloud(100));
  const double inf = std::numeric_limits<double>::infinity(), nan = std::nan("");
  const Camera camera = Camera::fromParameters("pinhole", 640, 480, {500, 500, 319.5, 239.5});
  for (const double x : {inf, -inf, nan}) {
    EXPECT_THROW(index.nearest({0, x, 0}, 3), gslam::ArgumentError);
    EXPECT_THROW(index.inRadius({0, 0, x}, 3), gslam::ArgumentError);
    EXPECT_THROW(index.visible(camera, SE3d(gslam::SO3d(), {x, 0, 0})), gslam::ArgumentError);
  }
  for (const double x : {-1.0, -inf, nan}) {
    EXPECT_THROW(index.inRadius({0, 0, 0}, x), gslam::ArgumentError);
    EXPECT_THROW(index.visible(camera, SE3d(), x), gslam::ArgumentError);
  }
  EXPECT_THROW(index.visible(Camera(), SE3d()), gslam::ArgumentError);
  EXPECT_THROW(index.inBox({0, nan, 0}, {1, 1, 1}), gslam::ArgumentError);
  EXPECT_THROW(index.inBox({0, 0, 0}, {1, 1, nan}), gslam::ArgumentError);
  EXPECT_EQ(index.inBox({-inf, -inf, -inf}, {inf, inf, inf}).size(), 100u);
}

TEST(Covisibility, CountsPointsThatBothSee) {
  const Map map = RandomMap(11).map(20, 400);
  std::map<KeyframeId, std::set<PointId>> seen;
  for (const auto& item : map.points()) {
    for (const auto& by : map.observations(item.id)) seen[by.keyframe].insert(item.id);
  }
  std::map<std::pair<KeyframeId, KeyframeId>, std::uint32_t> expected;
  for (const auto& a : seen) {
    for (const auto& b : seen) {
      std::uint32_t shared = 0;
      for (const PointId point : a.second) shared += std::uint32_t(b.second.count(point));
      if (a.first != b.first && shared >= 2) expected[std::make_pair(a.first, b.first)] = shared;
    }
  }
  std::map<std::pair<KeyframeId, KeyframeId>, std::uint32_t> found, graph;
  for (const auto& item : map.keyframes()) {
    std::uint32_t last = 0xFFFFFFFF;
    for (const Covisible& other : gslam::covisibleKeyframes(map, item.id, 2)) {
      EXPECT_LE(other.shared, last);
      last = other.shared;
      found[std::make_pair(item.id, other.keyframe)] = other.shared;
    }
  }
  EXPECT_EQ(found, expected);
  for (const auto& edge : gslam::covisibilityGraph(map, 2)) {
    graph[std::make_pair(edge.a, edge.b)] = edge.shared;
    graph[std::make_pair(edge.b, edge.a)] = edge.shared;
  }
  EXPECT_EQ(graph, expected);
  EXPECT_FALSE(expected.empty());
}

TEST(PoseGraph, KnowsNeighboursAndParts) {
  Map map;
  RandomMap random(1);
  std::vector<KeyframeId> k;
  for (int i = 0; i < 6; ++i) k.push_back(map.add(Keyframe()));
  map.add(random.edge(k[4], k[1]));
  map.add(random.edge(k[1], k[4]));
  map.add(random.edge(k[1], k[2]));
  map.add(random.edge(k[5], k[0]));
  EXPECT_THAT(gslam::neighbours(map, k[1]), ElementsAre(k[2], k[4]));
  EXPECT_THAT(gslam::neighbours(map, k[3]), IsEmpty());
  EXPECT_THAT(gslam::connectedParts(map), ElementsAre(ElementsAre(k[1], k[2], k[4]),
                                                      ElementsAre(k[0], k[5]), ElementsAre(k[3])));
}

TEST(MapTrajectory, HasTheKeyframesInTheOrderOfTime) {
  Map map;
  Keyframe keyframe;
  for (const std::int64_t stamp : {30, 10, 20}) {
    keyframe.stamp = stamp;
    keyframe.T_world_body = SE3d(gslam::SO3d(), {double(stamp), 0, 0});
    map.add(keyframe);
  }
  const gslam::Trajectory trajectory = gslam::keyframeTrajectory(map);
  ASSERT_EQ(trajectory.size(), 3u);
  EXPECT_EQ(trajectory[1].stamp, 20);
  EXPECT_EQ(trajectory[1].pose.translation()[0], 20);
  EXPECT_EQ(gslam::pathLength(map), 20);
  map.add(keyframe);
  try {
    gslam::keyframeTrajectory(map);
    ADD_FAILURE();
  } catch (const gslam::ArgumentError& error) {
    EXPECT_THAT(error.what(), testing::HasSubstr("keyframes 2 and 3"));
    EXPECT_THAT(error.what(), testing::HasSubstr("20 ns"));
  }
}

TEST(MapTrajectory, HasALengthWhateverTheStamps) {
  Map map;
  EXPECT_EQ(gslam::pathLength(map), 0);
  Keyframe keyframe;
  for (const double x : {0, 4, 1}) {  // at the same time: by id
    keyframe.T_world_body = SE3d(gslam::SO3d(), {x, 0, 0});
    map.add(keyframe);
  }
  EXPECT_EQ(gslam::pathLength(map), 7);
  keyframe.stamp = -1;
  map.add(keyframe);
  EXPECT_EQ(gslam::pathLength(map), 8);
}

}  // namespace
