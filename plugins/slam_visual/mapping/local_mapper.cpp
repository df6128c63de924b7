#include "mapping/local_mapper.h"

#include <algorithm>
#include <utility>

namespace visual {

using gslam::Covisible;
using gslam::KeyframeId;
using gslam::kNoPoint;
using gslam::Observation;
using gslam::PointId;
using gslam::SE3d;
using gslam::Span;
using gslam::Vec3d;

namespace {

// The points that keyframes see, each once, in the order of the keyframes.
std::vector<PointId> pointsOf(const gslam::Map& map, const std::vector<KeyframeId>& keyframes) {
  std::vector<PointId> points;
  std::vector<std::uint8_t> is_in(std::uint32_t(map.nextPointId()), 0);
  for (const KeyframeId id : keyframes) {
    for (const PointId point : map.pointsSeen(id)) {
      if (point == kNoPoint || is_in[std::uint32_t(point)] != 0) continue;
      is_in[std::uint32_t(point)] = 1;
      points.push_back(point);
    }
  }
  return points;
}

// Whether others see what this keyframe sees, as large: three of them nearly all of it.
bool isRedundant(const Scene& scene, KeyframeId id) {
  const View& view = scene.view(id);
  const Span<const PointId> points = scene.map.pointsSeen(id);
  std::size_t counted = 0, redundant = 0;
  for (std::uint32_t i = 0; i < points.size(); ++i) {
    if (points[i] == kNoPoint) continue;
    if (scene.eye.hasDepth() && !view.isClose(i, scene.eye)) continue;
    ++counted;
    const Span<const Observation> seen = scene.map.observations(points[i]);
    if (rayCount(scene, points[i]) <= 3) continue;
    int others = 0;
    for (const Observation& by : seen) {
      if (by.keyframe == id) continue;
      const int octave = scene.view(by.keyframe).features()[by.feature].octave;
      if (octave <= view.features()[i].octave + 1 && ++others >= 3) break;
    }
    redundant += others >= 3 ? 1 : 0;
  }
  return counted > 0 && double(redundant) > 0.9 * double(counted);
}

}  // namespace

void addPointsFromDepth(World& world, KeyframeId id, std::vector<PointId>& added) {
  const Scene& scene = world.scene();
  const View& view = scene.view(id);
  std::vector<std::pair<float, std::uint32_t>> by_depth;
  for (std::uint32_t i = 0; i < view.size(); ++i) {
    if (view.depth[i] > 0) by_depth.push_back({view.depth[i], i});
  }
  std::sort(by_depth.begin(), by_depth.end());
  const SE3d T_world_camera = scene.T_world_camera(id);
  int count = 0;
  for (const auto& [depth, feature] : by_depth) {
    if (double(depth) > scene.eye.far && count >= 100) break;
    ++count;
    Vec3d point;
    if (scene.map.pointSeen(id, feature) != kNoPoint) continue;
    if (!scene.eye.pointOf(view.pixel(feature), double(depth), point)) continue;
    added.push_back(world.addPoint(T_world_camera * point, id, feature));
  }
}

LocalMapper::LocalMapper(const Options& options) : options_(options) {}

void LocalMapper::begin(const World& world) {
  recent_.clear();
  for (const auto& item : world.map().points()) recent_.push_back(item.id);
}

KeyframeId LocalMapper::add(World& world, const KeyframeRequest& request) {
  for (const PointId id : request.expected) {
    if (world.map().find(id) != nullptr) ++world.sightings(id).expected;
  }
  for (const PointId id : request.found) {
    if (world.map().find(id) != nullptr) ++world.sightings(id).found;
  }
  // Where it is from the keyframe that it was tracked by, which may have moved.
  SE3d T_stand_in_reference;
  const KeyframeId stand_in = world.scene().standIn(request.reference, T_stand_in_reference);
  const double stretched = world.scene().stretch(request.reference) / request.stretch;
  const SE3d T_reference_body(request.T_reference_body.rotation(),
                              stretched * request.T_reference_body.translation());
  const SE3d T_world_body =
      world.map().at(stand_in).T_world_body * T_stand_in_reference * T_reference_body;
  const KeyframeId id = world.addKeyframe(request.view, T_world_body);
  world.setParent(id, stand_in);
  for (const Match& match : request.matches) {
    if (world.map().find(match.point) == nullptr) continue;
    if (featureOf(world.map(), match.point, id) >= 0) continue;
    world.observe(match.point, id, match.feature);
    world.refresh(match.point);
  }
  if (world.eye().hasDepth()) addPointsFromDepth(world, id, recent_);
  world.refreshNeighbours(id);
  const Span<const Covisible> neighbours = world.scene().neighbours(id);
  if (!neighbours.empty() && neighbours[0].keyframe < id)
    world.setParent(id, neighbours[0].keyframe);
  return id;
}

void LocalMapper::growAround(World& world, KeyframeId id) {
  cullPoints(world);
  triangulate(world, id);
  fuse(world, id);
  world.refreshNeighbours(id);
}

void LocalMapper::improve(World& world, KeyframeId id, std::vector<KeyframeId>& removed) {
  growAround(world, id);
  adjust(world, id);
  cullKeyframes(world, id, removed);
  for (const Covisible& other : world.scene().neighbours(id)) {
    if (world.map().find(other.keyframe) != nullptr) world.refreshNeighbours(other.keyframe);
  }
  world.refreshNeighbours(id);
}

void LocalMapper::improveLittle(World& world, KeyframeId id) {
  growAround(world, id);
}

void LocalMapper::cullPoints(World& world) {
  const std::size_t least = world.eye().hasDepth() ? 3 : 2;
  std::size_t kept = 0;
  for (const PointId id : recent_) {
    if (world.map().find(id) == nullptr) continue;
    const World::Sightings& s = world.sightings(id);
    const std::uint32_t age = world.keyframesAdded() - s.born;
    const bool is_bad = double(s.found) < 0.25 * double(s.expected) ||
                        (age >= 2 && rayCount(world.scene(), id) < least);
    if (is_bad) {
      world.removePoint(id);
    } else if (age < 3) {
      recent_[kept++] = id;
    }
  }
  recent_.resize(kept);
}

void LocalMapper::triangulate(World& world, KeyframeId id) {
  const std::vector<Covisible> neighbours = covisibleKeyframes(world.map(), id, 10);
  std::size_t count = 0;
  for (const Covisible& other : neighbours) {
    if (count++ >= std::size_t(options_.mapping.neighbours)) break;
    const double baseline = (world.scene().T_world_camera(id).translation() -
                             world.scene().T_world_camera(other.keyframe).translation())
                                .norm();
    const bool is_far_enough = world.eye().hasDepth()
                                   ? baseline > world.eye().baseline
                                   : baseline > 0.01 * medianDepth(world.scene(), other.keyframe);
    if (is_far_enough) triangulator_.addPoints(world, id, other.keyframe, recent_);
  }
}

// Points that are there twice, once for this keyframe and once for its neighbours.
void LocalMapper::fuse(World& world, KeyframeId id) {
  std::vector<KeyframeId> targets;
  std::vector<std::uint8_t> is_in(world.keyframesAdded(), 0);
  is_in[std::uint32_t(id)] = 1;
  const auto add = [&](Span<const Covisible> list, std::size_t most) {
    for (const Covisible& other : list) {
      if (most-- == 0) break;
      if (is_in[std::uint32_t(other.keyframe)] != 0 ||
          world.map().find(other.keyframe) == nullptr) {
        continue;
      }
      is_in[std::uint32_t(other.keyframe)] = 1;
      targets.push_back(other.keyframe);
    }
  };
  add(covisibleKeyframes(world.map(), id, 10), std::size_t(options_.mapping.neighbours));
  const std::size_t direct = targets.size();
  for (std::size_t i = 0; i < direct; ++i) add(world.scene().neighbours(targets[i]), 5);
  for (const KeyframeId target : targets) {
    fuseInto(world, target, pointsOf(world.map(), {id}));
  }
  fuseInto(world, id, pointsOf(world.map(), targets));
  for (const PointId point : pointsOf(world.map(), {id})) world.refresh(point);
}

void LocalMapper::fuseInto(World& world, KeyframeId id, const std::vector<PointId>& points) {
  const Scene& scene = world.scene();
  const SE3d T_camera_world = scene.T_world_camera(id).inverse();
  std::vector<PointId> unseen;
  for (const PointId point : points) {
    if (featureOf(scene.map, point, id) < 0) unseen.push_back(point);
  }
  sought_.clear();
  findVisible(scene, T_camera_world, unseen, 3, sought_);
  const View& view = scene.view(id);
  for (const Match& match :
       projector_.match(view, scene.eye, T_camera_world, sought_, {kStrictDistance, 1})) {
    if (scene.map.find(match.point) == nullptr || featureOf(scene.map, match.point, id) >= 0) {
      continue;
    }
    if (!fits(scene.eye, view, match.feature,
              T_camera_world * scene.map.at(match.point).position)) {
      continue;
    }
    const PointId there = scene.map.pointSeen(id, match.feature);
    if (there == kNoPoint) {
      world.observe(match.point, id, match.feature);
    } else if (scene.map.observations(there).size() >= scene.map.observations(match.point).size()) {
      world.merge(there, match.point);
    } else {
      world.merge(match.point, there);
    }
  }
}

void LocalMapper::adjust(World& world, KeyframeId id) {
  std::vector<KeyframeId> moving = {id};
  for (const Covisible& other : world.scene().neighbours(id)) {
    if (moving.size() >= std::size_t(options_.mapping.window)) break;
    moving.push_back(other.keyframe);
  }
  if (world.map().keyframes().size() < 2) return;
  bundle_.gather(world.scene(), moving, pointsOf(world.map(), moving));
  if (!bundle_.adjust(world.scene(), options_)) return;
  for (std::size_t i = 0; i < bundle_.movingCount(); ++i) {
    world.moveKeyframe(bundle_.keyframe(i), bundle_.T_world_body(i));
  }
  const std::vector<PointId>& points = bundle_.points();
  for (std::size_t i = 0; i < points.size(); ++i) world.movePoint(points[i], bundle_.position(i));
  for (const Observation& by : bundle_.outliers()) world.forget(by.keyframe, by.feature);
}

void LocalMapper::cullKeyframes(World& world, KeyframeId id, std::vector<KeyframeId>& removed) {
  const Span<const Covisible> neighbours = world.scene().neighbours(id);
  const std::vector<Covisible> list(neighbours.begin(), neighbours.end());
  for (const Covisible& other : list) {
    // The first one holds the world, and the newest are still needed to follow the camera.
    const std::uint32_t number = std::uint32_t(other.keyframe);
    if (number == 0 || number + 2 >= std::uint32_t(id)) continue;
    if (world.map().find(other.keyframe) == nullptr ||
        !isRedundant(world.scene(), other.keyframe)) {
      continue;
    }
    world.removeKeyframe(other.keyframe);
    removed.push_back(other.keyframe);
  }
}

}  // namespace visual
