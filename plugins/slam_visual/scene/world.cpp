#include "scene/world.h"

#include <algorithm>

#include "matching/descriptors.h"

namespace visual {

using gslam::KeyframeId;
using gslam::kNoPoint;
using gslam::Observation;
using gslam::PointId;
using gslam::SE3d;
using gslam::Vec3d;

World::World(const Eye& eye) {
  scene_.eye = eye;
}

KeyframeId World::addKeyframe(const std::shared_ptr<const View>& view, const SE3d& T_world_body) {
  gslam::Keyframe keyframe;
  keyframe.frame = view->frame;
  keyframe.stamp = view->stamp;
  // A pose that was made from others' and their inverses has the errors of all their lengths, which
  // would double from keyframe to keyframe.
  keyframe.T_world_body = T_world_body.normalized();
  keyframe.content = view->content;
  const KeyframeId id = scene_.map.add(keyframe);
  scene_.facts.push_back({view, nullptr, id, 1, {}, 1});
  return id;
}

void World::removeKeyframe(KeyframeId id) {
  const KeyframeId heir = parent(id);
  const SE3d T_parent_body = map().at(heir).T_world_body.inverse() * map().at(id).T_world_body;
  for (std::uint32_t i = 0; i < map().pointsSeen(id).size(); ++i) {
    if (map().pointSeen(id, i) != kNoPoint) forget(id, i);
  }
  for (Scene::Facts& other : scene_.facts) {
    // One that was removed keeps its parent, and its pose in it.
    if (other.view != nullptr && other.parent == id) other.parent = heir;
  }
  of(id).T_parent_body = T_parent_body;
  of(id).parent_stretch = stretch(heir);
  scene_.map.remove(id);
  of(id).view = nullptr;
  of(id).neighbours = nullptr;
}

void World::moveKeyframe(KeyframeId id, const SE3d& T_world_body, double stretch) {
  scene_.map.setPose(id, T_world_body.normalized());
  of(id).stretch *= stretch;
}

void World::refreshNeighbours(KeyframeId id) {
  of(id).neighbours =
      std::make_shared<const std::vector<gslam::Covisible>>(covisibleKeyframes(map(), id, 15));
}

PointId World::addPoint(const Vec3d& position, KeyframeId keyframe, std::uint32_t feature) {
  gslam::MapPoint point;
  point.position = position;
  const PointId id = scene_.map.add(point);
  sightings_.resize(std::uint32_t(id) + 1);
  sightings(id) = {1, 1, keyframesAdded()};
  observe(id, keyframe, feature);
  refresh(id);
  return id;
}

void World::movePoint(PointId id, const Vec3d& position) {
  scene_.map.setPosition(id, position);
}

void World::removePoint(PointId id) {
  scene_.map.remove(id);
}

void World::observe(PointId point, KeyframeId keyframe, std::uint32_t feature) {
  scene_.map.observe(point, keyframe, feature);
}

void World::forget(KeyframeId keyframe, std::uint32_t feature) {
  const PointId point = map().pointSeen(keyframe, feature);
  if (point == kNoPoint) return;
  scene_.map.forget(keyframe, feature);
  if (!isDetermined(point)) removePoint(point);
}

// Two views, or one that measured a depth, say where a point is.
bool World::isDetermined(PointId id) const {
  const gslam::Span<const Observation> seen = map().observations(id);
  if (seen.size() != 1) return !seen.empty();
  return scene_.view(seen[0].keyframe).depth[seen[0].feature] > 0;
}

void World::merge(PointId kept, PointId gone) {
  Sightings& of_kept = sightings(kept);
  of_kept.expected += sightings(gone).expected;
  of_kept.found += sightings(gone).found;
  scene_.map.merge(kept, gone);
  refresh(kept);
}

void World::refresh(PointId id) {
  const gslam::Span<const Observation> seen = map().observations(id);
  if (seen.empty()) return;
  const auto row = [this](const Observation& by) {
    return map().at(by.keyframe).content->descriptors.bytes(int(by.feature));
  };
  const gslam::Image& kind = map().at(seen[0].keyframe).content->descriptors;
  // The medoid, among the last ones where there are many.
  const std::size_t first = seen.size() > 16 ? seen.size() - 16 : 0;
  std::size_t best = first;
  float least = 1e9F;
  for (std::size_t i = first; i < seen.size() && seen.size() > 2; ++i) {
    float worst = 0;
    for (std::size_t j = first; j < seen.size(); ++j) {
      if (j != i) worst += distanceOf(row(seen[i]), row(seen[j]), kind);
    }
    if (worst < least) {
      least = worst;
      best = i;
    }
  }
  gslam::MapPoint point = map().at(id);
  Vec3d sum{};
  for (const Observation& by : seen) {
    const SE3d T_world_camera = scene_.T_world_camera(by.keyframe);
    sum = sum + (T_world_camera.translation() - point.position).normalized();
  }
  const double length = sum.norm();
  if (length > 1e-9) {
    for (std::size_t i = 0; i < 3; ++i) point.normal[i] = float(sum[i] / length);
  }
  scene_.map.set(id, point);
  const gslam::Image& table = map().at(seen[best].keyframe).content->descriptors;
  scene_.map.setDescriptor(id, table.view(0, int(seen[best].feature), table.width(), 1));
}

}  // namespace visual
