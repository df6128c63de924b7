// A map does what a few std::map would do, and so do its copies.
#include <gmock/gmock.h>
#include <gslam/core/map.h>
#include <gslam/core/map_check.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <map>
#include <set>
#include <string>
#include <utility>
#include <vector>

#include "random_map.h"

namespace {

using gslam::EdgeId;
using gslam::Image;
using gslam::Keyframe;
using gslam::KeyframeId;
using gslam::kNoPoint;
using gslam::Map;
using gslam::MapPoint;
using gslam::Observation;
using gslam::PointId;
using gslam::PoseEdge;
using gslam::SE3d;
using gslam::SIM3d;
using gslam::SO3d;
using gslam::Vec2d;
using gslam::Vec3d;
using gslam_test::RandomMap;
using testing::ElementsAre;
using testing::IsEmpty;

// The same with nothing shared and no ids in lists.
struct Model {
  std::map<KeyframeId, std::pair<SE3d, std::vector<PointId>>> keyframes;
  std::map<PointId, std::pair<Vec3d, std::vector<Observation>>> points;
  std::map<EdgeId, std::pair<KeyframeId, KeyframeId>> edges;
  std::map<PointId, Vec3d> shapes;       // their sizes
  std::map<PointId, Image> descriptors;  // with pixels of their own
  std::map<PointId, std::uint32_t> labels;

  void forget(KeyframeId keyframe, std::uint32_t feature) {
    PointId& point = keyframes[keyframe].second[feature];
    if (point == kNoPoint) return;
    std::vector<Observation>& seen = points[point].second;
    seen.erase(std::find(seen.begin(), seen.end(), Observation{keyframe, feature}));
    point = kNoPoint;
  }
  void observe(PointId point, KeyframeId keyframe, std::uint32_t feature) {
    if (keyframes[keyframe].second[feature] == point) return;
    forget(keyframe, feature);
    keyframes[keyframe].second[feature] = point;
    points[point].second.push_back(Observation{keyframe, feature});
  }
  void remove(KeyframeId keyframe) {
    for (std::uint32_t i = 0; i < keyframes[keyframe].second.size(); ++i) forget(keyframe, i);
    keyframes.erase(keyframe);
    for (auto edge = edges.begin(); edge != edges.end();) {
      const bool ends = edge->second.first == keyframe || edge->second.second == keyframe;
      edge = ends ? edges.erase(edge) : std::next(edge);
    }
  }
  void remove(PointId point) {
    const std::vector<Observation> seen = points[point].second;
    for (const Observation& by : seen) forget(by.keyframe, by.feature);
    points.erase(point);
    shapes.erase(point);
    descriptors.erase(point);
    labels.erase(point);
  }
  // All features are of one camera.
  void merge(PointId stays, PointId goes) {
    const std::vector<Observation> seen = points[goes].second;
    remove(goes);
    for (const Observation& by : seen) {
      const std::vector<Observation>& known = points[stays].second;
      const bool is_seen = std::any_of(known.begin(), known.end(), [&](const Observation& other) {
        return other.keyframe == by.keyframe;
      });
      if (!is_seen) observe(stays, by.keyframe, by.feature);
    }
  }
};

void expectSame(const Map& map, const Model& model) {
  ASSERT_EQ(map.keyframes().size(), model.keyframes.size());
  ASSERT_EQ(map.points().size(), model.points.size());
  ASSERT_EQ(map.edges().size(), model.edges.size());
  auto keyframe = model.keyframes.begin();
  for (const auto& item : map.keyframes()) {
    ASSERT_EQ(item.id, keyframe->first);
    ASSERT_EQ(item.value.T_world_body.translation(), keyframe->second.first.translation());
    const auto seen = map.pointsSeen(item.id);
    ASSERT_EQ(std::vector<PointId>(seen.begin(), seen.end()), keyframe->second.second);
    ++keyframe;
  }
  std::size_t observations = 0;
  auto point = model.points.begin();
  for (const auto& item : map.points()) {
    ASSERT_EQ(item.id, point->first);
    ASSERT_EQ(item.value.position, point->second.first);
    const auto seen = map.observations(item.id);
    ASSERT_EQ(std::vector<Observation>(seen.begin(), seen.end()), point->second.second);
    observations += seen.size();
    ASSERT_EQ(item.value.label, model.labels.at(item.id));
    const auto shape = model.shapes.find(item.id);
    ASSERT_EQ(map.shape(item.id) != nullptr, shape != model.shapes.end());
    if (shape != model.shapes.end()) {
      ASSERT_EQ(map.shape(item.id)->size, shape->second);
    }
    const auto row = model.descriptors.find(item.id);
    ASSERT_EQ(map.descriptor(item.id) != nullptr, row != model.descriptors.end());
    if (row != model.descriptors.end()) {
      ASSERT_EQ(*map.descriptor(item.id), row->second);
    }
    ++point;
  }
  ASSERT_EQ(map.observationCount(), observations);
  auto edge = model.edges.begin();
  for (const auto& item : map.edges()) {
    ASSERT_EQ(item.id, edge->first);
    ASSERT_EQ(item.value.from, edge->second.first);
    ASSERT_EQ(item.value.to, edge->second.second);
    ++edge;
  }
  ASSERT_THAT(gslam::validate(map), IsEmpty());
}

template <class Known>
typename Known::key_type anyOf(const Known& known, RandomMap& random) {
  return std::next(known.begin(), std::ptrdiff_t(random.below(known.size())))->first;
}

// Does the same to both.
class Twins {
 public:
  explicit Twins(unsigned seed) : random_(seed) {}

  void step() {
    const std::uint32_t dice = random_.below(115);
    if (dice < 6 || model.keyframes.size() < 2) return addKeyframe();
    if (dice < 30 || model.points.size() < 2) return addPoint();
    if (dice < 70) return observe();
    if (dice < 76) return removePoint();
    if (dice < 78) return removeKeyframe();
    if (dice < 82) return addEdge();
    if (dice < 84 && !model.edges.empty()) return removeEdge();
    if (dice < 90) return move();
    if (dice < 100) return forget();
    if (dice < 106) return replace();
    if (dice < 112) return describe();
    if (dice < 114) return merge();
    if (random_.below(20) == 0) transform();
  }

  Map map;
  Model model;

 private:
  void addKeyframe() {
    const std::size_t features = random_.below(20);
    Keyframe keyframe = random_.keyframe(features, false);
    gslam::KeyframeContent content = *keyframe.content;
    for (gslam::Feature& feature : content.features) feature.camera = 0;
    keyframe.content = std::make_shared<const gslam::KeyframeContent>(content);
    model.keyframes[map.add(keyframe)] =
        std::make_pair(keyframe.T_world_body, std::vector<PointId>(features, kNoPoint));
  }
  void addPoint() {
    const MapPoint point = random_.point();
    // Sometimes far off, so that chunks and pages have gaps.
    PointId id = map.nextPointId();
    if (random_.below(200) == 0) id = PointId(std::uint32_t(id) + random_.below(200000));
    map.insert(id, point);
    model.points[id].first = point.position;
    model.labels[id] = point.label;
  }
  void observe() {
    const KeyframeId keyframe = anyOf(model.keyframes, random_);
    const PointId point = anyOf(model.points, random_);
    const std::size_t features = map.pointsSeen(keyframe).size();
    if (features == 0) return;
    const std::uint32_t feature = random_.below(features);
    map.observe(point, keyframe, feature);
    model.observe(point, keyframe, feature);
  }
  void forget() {
    const KeyframeId keyframe = anyOf(model.keyframes, random_);
    if (map.pointsSeen(keyframe).empty()) return;
    const std::uint32_t feature = random_.below(map.pointsSeen(keyframe).size());
    map.forget(keyframe, feature);
    model.forget(keyframe, feature);
  }
  void removePoint() {
    const PointId point = anyOf(model.points, random_);
    EXPECT_TRUE(map.remove(point));
    EXPECT_FALSE(map.remove(point));
    model.remove(point);
  }
  void removeKeyframe() {
    const KeyframeId keyframe = anyOf(model.keyframes, random_);
    EXPECT_TRUE(map.remove(keyframe));
    EXPECT_FALSE(map.remove(keyframe));
    model.remove(keyframe);
  }
  void addEdge() {
    const KeyframeId a = anyOf(model.keyframes, random_), b = anyOf(model.keyframes, random_);
    if (a == b) return;
    model.edges[map.add(random_.edge(a, b))] = std::make_pair(a, b);
  }
  void removeEdge() {
    const EdgeId edge = anyOf(model.edges, random_);
    EXPECT_TRUE(map.remove(edge));
    model.edges.erase(edge);
  }
  void move() {
    const PointId point = anyOf(model.points, random_);
    model.points[point].first = random_.vector(5);
    map.setPosition(point, model.points[point].first);
    const KeyframeId keyframe = anyOf(model.keyframes, random_);
    model.keyframes[keyframe].first = random_.pose();
    map.setPose(keyframe, model.keyframes[keyframe].first);
  }

  // A point by another; an edge by one with other ends.
  void replace() {
    const PointId id = anyOf(model.points, random_);
    const MapPoint point = random_.point();
    map.set(id, point);
    model.points[id].first = point.position;
    model.labels[id] = point.label;
    if (model.edges.empty()) return;
    const EdgeId edge = anyOf(model.edges, random_);
    const KeyframeId a = anyOf(model.keyframes, random_), b = anyOf(model.keyframes, random_);
    if (a == b) return;
    map.set(edge, random_.edge(a, b));
    model.edges[edge] = std::make_pair(a, b);
  }
  void describe() {
    const PointId id = anyOf(model.points, random_);
    const gslam::Shape shape = random_.shape();
    const Image row =
        random_.below(3) == 0 ? Image() : random_.image(3, 1, gslam::PixelType::u8, 2);
    if (random_.below(3) != 0) {
      map.setShape(id, shape);
      model.shapes[id] = shape.size;
    } else {
      map.removeShape(id);
      model.shapes.erase(id);
    }
    map.setDescriptor(id, row);
    if (row.empty()) {
      model.descriptors.erase(id);
    } else {
      model.descriptors[id] = row.clone();
    }
  }
  void merge() {
    const PointId stays = anyOf(model.points, random_), goes = anyOf(model.points, random_);
    if (stays == goes) return;
    map.merge(stays, goes);
    model.merge(stays, goes);
  }
  // Without a turn, so that both are rounded alike.
  void transform() {
    const SIM3d S(SO3d(), {1, -2, 4}, random_.below(2) == 0 ? 2 : 0.5);
    map.transform(S);
    for (auto& one : model.keyframes) {
      SE3d& pose = one.second.first;
      pose = SE3d(pose.rotation(), S * pose.translation());
    }
    for (auto& one : model.points) one.second.first = S * one.second.first;
    for (auto& one : model.shapes) one.second *= S.scale();
  }

  RandomMap random_;
};

TEST(Map, WhatGoesWithAPointStaysInSnapshots) {
  Map map;
  const PointId id = map.add(MapPoint()), other = map.add(MapPoint());
  gslam::Shape shape;
  shape.size = {1, 2, 3};
  const Image row = RandomMap(1).image(4, 1, gslam::PixelType::u8, 1);
  for (const PointId one : {id, other}) {
    map.setShape(one, shape);
    map.setDescriptor(one, row);
  }
  const Map snapshot = map;
  EXPECT_TRUE(map.remove(id));
  EXPECT_EQ(map.shape(id), nullptr);
  EXPECT_EQ(map.descriptor(id), nullptr);
  ASSERT_NE(snapshot.shape(id), nullptr);
  EXPECT_EQ(snapshot.shape(id)->size, shape.size);
  ASSERT_NE(snapshot.descriptor(id), nullptr);
  EXPECT_EQ(*snapshot.descriptor(id), row);
  for (const Map* const one : {&snapshot, static_cast<const Map*>(&map)}) {
    ASSERT_NE(one->shape(other), nullptr);
    EXPECT_EQ(*one->descriptor(other), row);
  }
}

TEST(Map, DoesWhatPlainContainersDo) {
  for (unsigned seed = 0; seed < 5; ++seed) {
    Twins twins(seed);
    for (int i = 0; i < 4000; ++i) {
      twins.step();
      if (i % 500 != 0) continue;
      ASSERT_NO_FATAL_FAILURE(expectSame(twins.map, twins.model));
    }
    ASSERT_NO_FATAL_FAILURE(expectSame(twins.map, twins.model));
  }
}

TEST(Map, CopiesStayAsTheyWere) {
  Twins twins(7);
  std::vector<std::pair<Map, Model>> copies;
  for (int i = 0; i < 3000; ++i) {
    twins.step();
    if (i % 100 == 0) copies.emplace_back(twins.map, twins.model);
  }
  for (const auto& copy : copies) ASSERT_NO_FATAL_FAILURE(expectSame(copy.first, copy.second));
}

TEST(Map, CopiesGoTheirOwnWays) {
  Twins first(9);
  for (int i = 0; i < 1500; ++i) first.step();
  Twins second = first;
  Twins third = first;
  for (int i = 0; i < 1000; ++i) {
    second.step();
    first.step();
    if (i % 300 == 0) third = second;  // over one that has changes of its own
    third.step();
  }
  ASSERT_NO_FATAL_FAILURE(expectSame(first.map, first.model));
  ASSERT_NO_FATAL_FAILURE(expectSame(second.map, second.model));
  ASSERT_NO_FATAL_FAILURE(expectSame(third.map, third.model));
}

// NOLINTBEGIN(bugprone-use-after-move,clang-analyzer-cplusplus.Move): that is what it is about
void expectEmpty(Map& map) {
  EXPECT_TRUE(map.keyframes().empty() && map.points().empty() && map.edges().empty());
  EXPECT_TRUE(map.rig().cameras.empty());
  EXPECT_EQ(map.observationCount(), 0u);
  EXPECT_EQ(map.nextPointId(), PointId(0));
  EXPECT_EQ(map.nextKeyframeId(), KeyframeId(0));
  EXPECT_EQ(map.nextEdgeId(), EdgeId(0));
  EXPECT_EQ(map.add(MapPoint()), PointId(0));  // and is as good as new
  EXPECT_THAT(map.observations(PointId(0)), IsEmpty());
  EXPECT_EQ(map.shape(PointId(0)), nullptr);
  EXPECT_EQ(map.descriptor(PointId(0)), nullptr);
  EXPECT_THAT(gslam::validate(map), IsEmpty());
}

TEST(Map, MovedFromIsEmpty) {
  Map map = RandomMap(1).map(5, 20);
  const std::size_t observations = map.observationCount();
  Map moved(std::move(map));
  EXPECT_EQ(moved.observationCount(), observations);
  expectEmpty(map);
  map = std::move(moved);
  EXPECT_EQ(map.observationCount(), observations);
  expectEmpty(moved);
  EXPECT_THAT(gslam::validate(map), IsEmpty());
}
// NOLINTEND(bugprone-use-after-move,clang-analyzer-cplusplus.Move)

// What a snapshot shares is copied when it is written, and what was there goes with the snapshot,
// or at once where that is gone.
TEST(Map, TakesWhatLiesInItself) {
  Map map = RandomMap(2).map(6, 30);
  const KeyframeId k[] = {(*map.keyframes().begin()).id, KeyframeId(3)};
  const PointId a = (*map.points().begin()).id;
  const PointId last = map.add(map.at(a));
  const auto comeAndGo = [&map] { const Map snapshot = map; };
  const SE3d pose = map.at(k[1]).T_world_body;
  comeAndGo();
  map.setPose(k[0], map.at(k[1]).T_world_body);
  EXPECT_EQ(map.at(k[0]).T_world_body.translation(), pose.translation());
  const MapPoint point = map.at(a);
  comeAndGo();
  map.setPosition(last, map.at(a).position);
  EXPECT_EQ(map.at(last).position, point.position);
  comeAndGo();
  map.set(last, map.at(a));
  EXPECT_EQ(map.at(last).color, point.color);
  comeAndGo();
  map.add(map.at(a));
  comeAndGo();
  map.add(map.at(k[0]));
  comeAndGo();
  map.setRig(map.rig());
  map.setShape(a, gslam::Shape());
  comeAndGo();
  map.setShape(last, *map.shape(a));
  comeAndGo();
  map.setShape(a, *map.shape(last));
  map.setDescriptor(a, RandomMap(1).image(4, 1, gslam::PixelType::u8, 1));
  comeAndGo();
  map.setDescriptor(last, *map.descriptor(a));
  EXPECT_EQ(*map.descriptor(last), *map.descriptor(a));
  EXPECT_THAT(gslam::validate(map), IsEmpty());
}

bool sameEdge(const PoseEdge& a, const PoseEdge& b) {
  return a.from == b.from && a.to == b.to && a.kind == b.kind && a.scale == b.scale &&
         a.T_from_to.translation() == b.T_from_to.translation() && a.information == b.information;
}

TEST(Map, AnEdgeThatIsSetToAnotherChangesNoOther) {
  RandomMap random(4);
  Map map;
  std::vector<KeyframeId> k;
  for (int i = 0; i < 5; ++i) k.push_back(map.add(random.keyframe(0, false)));
  std::vector<EdgeId> edges;
  for (std::size_t i = 0; i < 4; ++i) edges.push_back(map.add(random.edge(k[i], k[i + 1])));
  for (const EdgeId x : edges) {
    for (const EdgeId y : edges) {
      for (const bool is_shared : {false, true}) {
        Map changed = map;
        if (is_shared) changed = Map(map);
        changed.setPose(k[0], SE3d());
        { const Map snapshot = is_shared ? changed : Map(); }
        changed.set(x, changed.at(y));
        for (const EdgeId z : edges) {
          EXPECT_TRUE(sameEdge(changed.at(z), map.at(z == x ? y : z)));
        }
        EXPECT_THAT(gslam::validate(changed), IsEmpty());
        const EdgeId added = changed.add(changed.at(y));
        EXPECT_TRUE(sameEdge(changed.at(added), map.at(y)));
      }
    }
  }
}

TEST(Map, IdsAreNotUsedAgain) {
  Map map;
  const PointId first = map.add(MapPoint());
  map.remove(first);
  EXPECT_NE(map.add(MapPoint()), first);
  map.insert(PointId(70000), MapPoint());
  EXPECT_EQ(map.add(MapPoint()), PointId(70001));
  EXPECT_THROW(map.insert(PointId(70001), MapPoint()), gslam::ArgumentError);
}

TEST(Map, TakesTheLastIdAndThenNoMore) {
  Map map;
  map.insert(PointId(0xFFFFFFFE), MapPoint());
  EXPECT_NE(map.find(PointId(0xFFFFFFFE)), nullptr);
  EXPECT_THROW(map.insert(kNoPoint, MapPoint()), gslam::ArgumentError);
  EXPECT_THROW(map.add(MapPoint()), gslam::Error);
  std::size_t count = 0;
  for (const auto& item : map.points()) {
    EXPECT_EQ(item.id, PointId(0xFFFFFFFE));
    ++count;
  }
  EXPECT_EQ(count, 1u);
}

TEST(Map, RefusesWhatIsNotInIt) {
  Map map;
  RandomMap random(1);
  const KeyframeId keyframe = map.add(random.keyframe(3, false));
  const PointId point = map.add(MapPoint());
  EXPECT_THROW(map.at(PointId(5)), gslam::ArgumentError);
  EXPECT_THROW(map.observe(PointId(5), keyframe, 0), gslam::ArgumentError);
  EXPECT_THROW(map.observe(point, KeyframeId(5), 0), gslam::ArgumentError);
  EXPECT_THROW(map.observe(point, keyframe, 3), gslam::ArgumentError);
  EXPECT_THROW(map.forget(keyframe, 3), gslam::ArgumentError);
  EXPECT_THROW(map.setPose(KeyframeId(5), SE3d()), gslam::ArgumentError);
  EXPECT_THROW(map.setShape(PointId(5), gslam::Shape()), gslam::ArgumentError);
  EXPECT_THROW(map.add(random.edge(keyframe, KeyframeId(5))), gslam::ArgumentError);
  EXPECT_THROW(map.add(random.edge(keyframe, keyframe)), gslam::ArgumentError);
  EXPECT_THROW(map.merge(point, point), gslam::ArgumentError);
  EXPECT_THROW(map.setDescriptor(point, gslam::Image(2, 2, gslam::PixelType::u8)),
               gslam::ArgumentError);
  EXPECT_EQ(map.find(EdgeId(0)), nullptr);
  EXPECT_THAT(gslam::validate(map), IsEmpty());
}

TEST(Map, RefusesDescriptorsThatAreNotOneAFeature) {
  Keyframe keyframe;
  gslam::KeyframeContent content;
  content.features.resize(3);
  content.descriptors = gslam::Image(32, 2, gslam::PixelType::u8);
  keyframe.content = std::make_shared<const gslam::KeyframeContent>(content);
  EXPECT_THROW(Map().add(keyframe), gslam::ArgumentError);
}

// The keyframe sees `a` with camera 0 and feature 0, `b` with 0 and 1, `b` with 1 and 2.
TEST(Map, MergeMovesWhatSawThePointThatGoes) {
  Map map;
  gslam::KeyframeContent content;
  content.features.resize(3);
  content.features[2].camera = 1;
  Keyframe keyframe;
  keyframe.content = std::make_shared<const gslam::KeyframeContent>(content);
  const KeyframeId both = map.add(keyframe), only_b = map.add(keyframe);
  const PointId a = map.add(MapPoint()), b = map.add(MapPoint());
  map.observe(a, both, 0);
  map.observe(b, both, 1);
  map.observe(b, both, 2);
  map.observe(b, only_b, 1);
  map.merge(a, b);
  EXPECT_EQ(map.find(b), nullptr);
  EXPECT_THAT(map.pointsSeen(both), ElementsAre(a, kNoPoint, a));
  EXPECT_THAT(map.pointsSeen(only_b), ElementsAre(kNoPoint, a, kNoPoint));
  EXPECT_THAT(gslam::validate(map), IsEmpty());
}

TEST(Map, ImagesCanBeDroppedWhileSnapshotsKeepThem) {
  Map map;
  const KeyframeId id = map.add(RandomMap(3).keyframe(4, true));
  const Map copy = map;
  map.setImages(id, {});
  EXPECT_TRUE(map.at(id).content->images.empty());
  EXPECT_EQ(map.at(id).content->features.size(), 4u);
  EXPECT_EQ(copy.at(id).content->images.size(), 2u);
}

Vec2d pixelIn(const Map& map, const Keyframe& keyframe, std::size_t camera, PointId point) {
  const gslam::CameraSensor& sensor = map.rig().cameras[camera];
  const SE3d T_camera_world = (keyframe.T_world_body * sensor.T_body_camera).inverse();
  Vec2d pixel = {-1, -1};
  sensor.camera.project(T_camera_world * map.at(point).position, pixel);
  return pixel;
}

// The squared error of an edge, by its definition.
double errorOf(const Map& map, const PoseEdge& edge) {
  const SE3d measured = map.at(edge.from).T_world_body.inverse() * map.at(edge.to).T_world_body;
  const auto error = (edge.T_from_to.inverse() * measured).log();
  return error.dot(edge.information * error);
}

TEST(Map, TransformChangesNothingThatIsSeen) {
  const Map before = RandomMap(5).map(8, 40);
  Map after = before;
  const SIM3d S(SO3d::exp({0.3, -2, 1}), {5, -7, 100}, 3.7);
  after.transform(S);
  for (const auto& item : before.keyframes()) {
    const Keyframe& moved = after.at(item.id);
    EXPECT_LT((moved.T_world_body.translation() - S * item.value.T_world_body.translation()).norm(),
              1e-9);
    for (const auto& point : before.points()) {
      for (std::size_t camera = 0; camera < 2; ++camera) {
        const Vec2d was = pixelIn(before, item.value, camera, point.id);
        if (was.norm() > 1e4) continue;  // too near to the camera's plane to be compared
        EXPECT_LT((pixelIn(after, moved, camera, point.id) - was).norm(), 1e-5);
      }
    }
    const auto& images = item.value.content->images;
    if (images.empty()) continue;
    EXPECT_DOUBLE_EQ(moved.content->images[1].depth_scale, images[1].depth_scale * 3.7);
  }
  for (const auto& item : before.edges()) {
    const double error = errorOf(before, item.value);
    EXPECT_NEAR(errorOf(after, after.at(item.id)), error, 1e-6 * error);
  }
  for (const auto& item : before.points()) {
    const gslam::Shape* const shape = before.shape(item.id);
    if (shape == nullptr) continue;
    const Vec3d end = item.value.position + shape->R_world_shape * shape->size;
    const gslam::Shape& moved = *after.shape(item.id);
    const Vec3d moved_end = after.at(item.id).position + moved.R_world_shape * moved.size;
    EXPECT_LT((moved_end - S * end).norm(), 1e-9);
  }
  EXPECT_THAT(gslam::validate(after), IsEmpty());
  after.transform(S.inverse());
  for (const auto& item : before.points()) {
    EXPECT_LT((after.at(item.id).position - item.value.position).norm(), 1e-9);
    EXPECT_LT((after.at(item.id).normal - item.value.normal).norm(), 1e-5f);
  }
}

TEST(MapCheck, SaysWhatIsWrong) {
  Map map;
  RandomMap random(1);
  map.setRig(random.rig());
  gslam::KeyframeContent content;
  content.features.resize(1);
  content.features[0].camera = 2;
  Keyframe keyframe;
  keyframe.content = std::make_shared<const gslam::KeyframeContent>(content);
  keyframe.T_world_body = SE3d(SO3d(), {std::numeric_limits<double>::quiet_NaN(), 0, 0});
  map.add(keyframe);
  MapPoint point;
  point.position = {0, std::numeric_limits<double>::infinity(), 0};
  map.add(point);
  EXPECT_THAT(gslam::validate(map),
              ElementsAre("keyframe 0 has a pose that is not finite",
                          "keyframe 0 has a feature in a camera that the rig does not have",
                          "point 0 has a position that is not finite"));
  EXPECT_EQ(gslam::validate(map, 1).size(), 1u);
  EXPECT_THAT(gslam::validate(map, 0), IsEmpty());
}

TEST(MapCheck, SaysWhichNumbersAreWrong) {
  constexpr float kNan = std::numeric_limits<float>::quiet_NaN();
  Map map;
  gslam::KeyframeContent content;
  content.features.resize(2);
  content.features[1].angle = kNan;
  Keyframe keyframe;
  keyframe.content = std::make_shared<const gslam::KeyframeContent>(content);
  const KeyframeId a = map.add(keyframe), b = map.add(Keyframe());
  MapPoint point;
  point.normal = {0, kNan, 0};
  map.add(point);
  PoseEdge edge;
  edge.from = a;
  edge.to = b;
  edge.information(2, 2) = -1;
  map.add(edge);
  edge.information(2, 2) = kNan;
  map.add(edge);
  edge.information(2, 2) = 1;
  edge.information(0, 1) = 1;
  edge.scale = 0;
  map.add(edge);
  EXPECT_THAT(gslam::validate(map),
              ElementsAre("keyframe 0 has a feature that is not finite",
                          "point 0 has a normal that is not finite",
                          "edge 0 has an information matrix with a number below 0 on its diagonal",
                          "edge 1 has an information matrix that is not finite",
                          "edge 2 has a scale that is not above 0",
                          "edge 2 has an information matrix that is not symmetric"));
}

// Files have no place for them, so maps have none.
TEST(Map, RefusesUnknownKinds) {
  RandomMap random(1);
  Map map;
  const KeyframeId a = map.add(random.keyframe(0, true)), b = map.add(random.keyframe(0, false));
  MapPoint point;
  const PointId id = map.add(point);
  point.kind = static_cast<gslam::PointKind>(5);
  EXPECT_THROW(map.add(point), gslam::ArgumentError);
  EXPECT_THROW(map.set(id, point), gslam::ArgumentError);
  PoseEdge edge = random.edge(a, b);
  const EdgeId edge_id = map.add(edge);
  edge.kind = static_cast<gslam::EdgeKind>(4);
  EXPECT_THROW(map.add(edge), gslam::ArgumentError);
  EXPECT_THROW(map.set(edge_id, edge), gslam::ArgumentError);
  EXPECT_EQ(map.at(edge_id).from, a);
  gslam::KeyframeContent content;
  content.images = random.images();
  map.setImages(a, content.images);
  content.images[1].kind = static_cast<gslam::ImageKind>(11);
  EXPECT_THROW(map.setImages(a, content.images), gslam::ArgumentError);
  Keyframe keyframe;
  keyframe.content = std::make_shared<const gslam::KeyframeContent>(content);
  EXPECT_THROW(map.add(keyframe), gslam::ArgumentError);
  gslam::SensorRig rig = random.rig();
  rig.cameras[0].kind = static_cast<gslam::ImageKind>(200);
  EXPECT_THROW(map.setRig(rig), gslam::ArgumentError);
  EXPECT_EQ(map.points().size(), 1u);
  EXPECT_EQ(map.edges().size(), 1u);
  EXPECT_EQ(map.keyframes().size(), 2u);
  EXPECT_THAT(gslam::validate(map), IsEmpty());
}

}  // namespace
