#include "mapping/local_mapper.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <vector>

#include "made_scene.h"

namespace {

using gslam::KeyframeId;
using gslam::kNoPoint;
using gslam::PointId;
using gslam::SE3d;
using gslam::SO3d;
using gslam::Vec3d;
using made::Room;
using made::Seen;
using visual::KeyframeRequest;
using visual::LocalMapper;
using visual::Options;
using visual::SensorKind;

// A mapper that gets keyframes of a camera whose tracking is off by a bit.
struct FedMapper {
  explicit FedMapper(SensorKind kind, std::size_t points = 3000)
      : room(made::makeRoom(6, points)), world(made::makeEye(kind)) {}

  Seen look(const SE3d& camera) {
    return made::look(room, world.eye(), camera, {0.4, 0.004, 8}, random, seen.size());
  }
  SE3d bodyAt(const SE3d& camera) const { return camera * world.eye().T_body_camera.inverse(); }

  // The first two keyframes, with the points that both see where they are in truth.
  void begin(const SE3d& first, const SE3d& second) {
    std::vector<std::int64_t> feature(room.points.size(), -1);
    for (const SE3d& camera : {first, second}) {
      seen.push_back(look(camera));
      truth.push_back(bodyAt(camera));
      world.addKeyframe(seen.back().view, truth.back());
    }
    for (std::size_t i = 0; i < seen[0].points.size(); ++i) {
      feature[seen[0].points[i]] = std::int64_t(i);
    }
    for (std::uint32_t i = 0; i < seen[1].points.size(); ++i) {
      const std::int64_t other = feature[seen[1].points[i]];
      if (other < 0) continue;
      const PointId id =
          world.addPoint(room.points[seen[1].points[i]], KeyframeId(0), std::uint32_t(other));
      world.observe(id, KeyframeId(1), i);
      world.refresh(id);
    }
    world.setParent(KeyframeId(1), KeyframeId(0));
    for (std::uint32_t i = 0; i < 2; ++i) world.refreshNeighbours(KeyframeId(i));
    mapper.begin(world);
  }

  // What a tracker would say: matches with the points that are there, and a pose that is off.
  KeyframeRequest request(const SE3d& camera, const Vec3d& off = {}) {
    seen.push_back(look(camera));
    truth.push_back(bodyAt(camera));
    KeyframeRequest result;
    result.view = seen.back().view;
    result.reference = world.newest();
    result.T_world_body = SE3d(truth.back().rotation(), truth.back().translation() + off);
    result.T_reference_body =
        world.map().at(result.reference).T_world_body.inverse() * result.T_world_body;
    std::vector<PointId> point_of(room.points.size(), kNoPoint);
    for (const auto& item : world.map().points()) {
      const gslam::Observation by = world.map().observations(item.id)[0];
      point_of[seen[std::uint32_t(by.keyframe)].points[by.feature]] = item.id;
    }
    for (std::uint32_t i = 0; i < seen.back().points.size(); ++i) {
      const PointId point = point_of[seen.back().points[i]];
      if (point != kNoPoint) result.matches.push_back({i, point, 0});
    }
    return result;
  }
  KeyframeId add(const SE3d& camera, const Vec3d& off = {}) {
    return mapper.add(world, request(camera, off));
  }
  void improve(KeyframeId id) { mapper.improve(world, id, removed); }

  double poseError(KeyframeId id) const {
    return (world.map().at(id).T_world_body.translation() - truth[std::uint32_t(id)].translation())
        .norm();
  }
  double pointError() const {
    std::vector<double> errors;
    for (const auto& item : world.map().points()) {
      const gslam::Observation by = world.map().observations(item.id)[0];
      const Vec3d p = room.points[seen[std::uint32_t(by.keyframe)].points[by.feature]];
      errors.push_back((item.value.position - p).norm());
    }
    std::sort(errors.begin(), errors.end());
    return errors[errors.size() / 2];
  }

  Room room;
  visual::World world;
  Options options;
  LocalMapper mapper{options};
  made::Random random{4};
  std::vector<Seen> seen;
  std::vector<SE3d> truth;  // T_world_body
  std::vector<KeyframeId> removed;
};

TEST(AddPointsFromDepth, TakesTheNearestFirst) {
  FedMapper mapped(SensorKind::rgbd);
  visual::Eye eye = mapped.world.eye();
  eye.far = 3;
  visual::World world(eye);
  const Seen seen = mapped.look(made::cameraOnCircle(0.1));
  const KeyframeId id = world.addKeyframe(seen.view, SE3d());
  std::vector<PointId> added;
  visual::addPointsFromDepth(world, id, added);
  std::vector<float> depths = seen.view->depth;
  std::sort(depths.begin(), depths.end());
  const auto close =
      std::size_t(std::upper_bound(depths.begin(), depths.end(), 3.0F) - depths.begin());
  ASSERT_GT(depths.size(), 200U);
  ASSERT_EQ(added.size(), std::max<std::size_t>(close, 100));
  for (std::size_t i = 0; i < added.size(); ++i) {
    const gslam::Observation by = world.map().observations(added[i])[0];
    EXPECT_EQ(seen.view->depth[by.feature], depths[i]);
    const Vec3d p = world.scene().T_world_camera(id).inverse() * world.map().at(added[i]).position;
    EXPECT_NEAR(p[2], double(depths[i]), 1e-5);
  }
  // Those that have a point keep it.
  const std::size_t before = world.map().points().size();
  visual::addPointsFromDepth(world, id, added);
  EXPECT_EQ(world.map().points().size(), before);
}

class LocalMapperTest : public testing::TestWithParam<SensorKind> {};

TEST_P(LocalMapperTest, BringsWhatIsOffToWhereItIs) {
  FedMapper mapped(GetParam());
  mapped.begin(made::cameraOnCircle(0), made::cameraOnCircle(0.15));
  const std::size_t before = mapped.world.map().points().size();
  const Vec3d off{0.03, -0.02, 0.02};
  for (int i = 2; i < 7; ++i) {
    const KeyframeId id = mapped.add(made::cameraOnCircle(0.15 * i), off);
    const double was = mapped.poseError(id);
    mapped.improve(id);
    EXPECT_TRUE(i != 2 || was > 0.04) << was;
    EXPECT_LT(mapped.poseError(id), 0.03) << i;
  }
  EXPECT_GT(mapped.world.map().points().size(), 3 * before / 2) << "it grows";
  // With a single camera the length of the first step, and so of all, is what it was.
  EXPECT_LT(mapped.pointError(), GetParam() == SensorKind::mono ? 0.15 : 0.06);
}

TEST_P(LocalMapperTest, AddsAKeyframeWhereItsReferenceIsNow) {
  FedMapper mapped(GetParam());
  mapped.begin(made::cameraOnCircle(0), made::cameraOnCircle(0.1));
  KeyframeRequest request = mapped.request(made::cameraOnCircle(0.2));
  // A loop is closed meanwhile, which moves the reference and makes it twice as large.
  const SE3d moved(SO3d::exp({0, 0, 1}), {3, 2, 1});
  mapped.world.moveKeyframe(KeyframeId(1), moved, 2);
  const KeyframeId id = mapped.mapper.add(mapped.world, request);
  const SE3d expected = moved * SE3d(request.T_reference_body.rotation(),
                                     2.0 * request.T_reference_body.translation());
  EXPECT_TRUE(mapped.world.map().at(id).T_world_body.isApprox(expected, 1e-9));
}

TEST_P(LocalMapperTest, ManagesWithAReferenceAndPointsThatAreGone) {
  FedMapper mapped(GetParam());
  mapped.begin(made::cameraOnCircle(0), made::cameraOnCircle(0.1));
  mapped.improve(mapped.add(made::cameraOnCircle(0.2)));
  KeyframeRequest request = mapped.request(made::cameraOnCircle(0.3));
  request.expected.push_back(request.matches[0].point);
  request.found.push_back(request.matches[1].point);
  for (std::size_t i = 0; i < request.matches.size(); i += 2) {
    mapped.world.removePoint(request.matches[i].point);
  }
  mapped.world.removeKeyframe(KeyframeId(2));
  const KeyframeId id = mapped.mapper.add(mapped.world, request);
  EXPECT_LT(mapped.poseError(id), 0.05);
  EXPECT_NE(mapped.world.map().find(mapped.world.parent(id)), nullptr);
  mapped.improve(id);
  EXPECT_LT(mapped.poseError(id), 0.05);
}

TEST_P(LocalMapperTest, RemovesKeyframesThatSayNothingNew) {
  FedMapper mapped(GetParam());
  mapped.begin(made::cameraOnCircle(0), made::cameraOnCircle(0.1));
  // To and fro before the same wall.
  for (int i = 0; i < 12; ++i) {
    const KeyframeId id = mapped.add(made::cameraOnCircle(i % 2 == 0 ? 0.05 : 0.1 - 0.004 * i));
    mapped.improve(id);
    EXPECT_NE(mapped.world.map().find(KeyframeId(0)), nullptr) << "it holds the world";
    EXPECT_NE(mapped.world.map().find(id), nullptr) << "it is needed to follow the camera";
    EXPECT_EQ(mapped.world.newest(), id);
  }
  EXPECT_GE(mapped.removed.size(), 3U);
  for (const KeyframeId id : mapped.removed) {
    EXPECT_EQ(mapped.world.map().find(id), nullptr);
    EXPECT_EQ(mapped.world.scene().of(id).view, nullptr);
  }
  for (const auto& item : mapped.world.map().points()) {
    EXPECT_FALSE(mapped.world.map().observations(item.id).empty());
  }
}

TEST_P(LocalMapperTest, RemovesPointsThatAreNotConfirmed) {
  FedMapper mapped(GetParam());
  mapped.begin(made::cameraOnCircle(0), made::cameraOnCircle(0.15));
  // A point that should have been seen and was not.
  KeyframeRequest request = mapped.request(made::cameraOnCircle(0.3));
  const PointId unseen = mapped.world.map().pointsSeen(KeyframeId(0))[0] != kNoPoint
                             ? mapped.world.map().pointsSeen(KeyframeId(0))[0]
                             : (*mapped.world.map().points().begin()).id;
  for (int i = 0; i < 20; ++i) request.expected.push_back(unseen);
  const PointId seen_well = request.matches.back().point;
  ASSERT_NE(unseen, seen_well);
  for (int i = 0; i < 20; ++i) {
    request.expected.push_back(seen_well);
    request.found.push_back(seen_well);
  }
  const KeyframeId id = mapped.mapper.add(mapped.world, request);
  mapped.improve(id);
  EXPECT_EQ(mapped.world.map().find(unseen), nullptr);
  EXPECT_NE(mapped.world.map().find(seen_well), nullptr);
}

// A point that only one keyframe saw, by its depth, is gone two keyframes later.
TEST(LocalMapper, RemovesPointsThatNobodyElseSees) {
  FedMapper mapped(SensorKind::rgbd);
  mapped.begin(made::cameraOnCircle(0), made::cameraOnCircle(0.15));
  const KeyframeId id = mapped.add(made::cameraOnCircle(0.3));
  std::vector<PointId> lonely;
  for (const PointId point : mapped.world.map().pointsSeen(id)) {
    if (point != kNoPoint && mapped.world.map().observations(point).size() == 1) {
      lonely.push_back(point);
    }
  }
  ASSERT_GT(lonely.size(), 20U);
  // Nothing that comes shows them: the camera looks elsewhere.
  mapped.mapper.improveLittle(mapped.world, id);
  for (int i = 0; i < 3; ++i) {
    const KeyframeId next = mapped.add(made::cameraOnCircle(made::kPi + 0.1 * i));
    mapped.mapper.improveLittle(mapped.world, next);
  }
  for (const PointId point : lonely) {
    const auto* found = mapped.world.map().find(point);
    if (found == nullptr) continue;
    EXPECT_GE(rayCount(mapped.world.scene(), point), 3U);
  }
}

TEST_P(LocalMapperTest, MakesOnePointOfTwo) {
  FedMapper mapped(GetParam());
  mapped.begin(made::cameraOnCircle(0), made::cameraOnCircle(0.15));
  // The tracker has missed half of what is there.
  KeyframeRequest request = mapped.request(made::cameraOnCircle(0.2));
  request.matches.resize(request.matches.size() / 2);
  const KeyframeId id = mapped.mapper.add(mapped.world, request);
  mapped.improve(id);
  std::vector<int> count(mapped.room.points.size(), 0);
  std::size_t twice = 0, once = 0;
  for (const auto& item : mapped.world.map().points()) {
    const gslam::Observation by = mapped.world.map().observations(item.id)[0];
    const std::size_t point = mapped.seen[std::uint32_t(by.keyframe)].points[by.feature];
    twice += ++count[point] == 2 ? 1 : 0;
    once += count[point] == 1 ? 1 : 0;
  }
  EXPECT_LE(twice, once / 10);
}

TEST_P(LocalMapperTest, DoesTheSameToTheSame) {
  FedMapper one(GetParam(), 1500), other(GetParam(), 1500);
  for (FedMapper* mapped : {&one, &other}) {
    mapped->begin(made::cameraOnCircle(0), made::cameraOnCircle(0.15));
    for (int i = 2; i < 5; ++i) mapped->improve(mapped->add(made::cameraOnCircle(0.15 * i)));
  }
  ASSERT_EQ(one.world.map().points().size(), other.world.map().points().size());
  for (const auto& item : one.world.map().points()) {
    ASSERT_EQ(item.value.position, other.world.map().at(item.id).position);
  }
}

INSTANTIATE_TEST_SUITE_P(Sensors, LocalMapperTest,
                         testing::Values(SensorKind::mono, SensorKind::rgbd));

}  // namespace
