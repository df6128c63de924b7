#include "mapping/adjusted_scene.h"

#include <cstddef>
#include <cstdint>

#include "mapping/bundle.h"

namespace visual {

using gslam::KeyframeId;
using gslam::PointId;
using gslam::SE3d;

AdjustedScene adjustAll(const Scene& scene, const Options& options) {
  std::vector<KeyframeId> keyframes;
  std::vector<PointId> points;
  for (const auto& item : scene.map.keyframes()) keyframes.push_back(item.id);
  for (const auto& item : scene.map.points()) points.push_back(item.id);
  Bundle bundle;
  bundle.gather(scene, keyframes, points);
  AdjustedScene adjusted;
  adjusted.is_usable = bundle.adjust(scene, options, 15);
  adjusted.report = bundle.report();
  if (!adjusted.is_usable) return adjusted;
  for (std::size_t i = 0; i < bundle.movingCount(); ++i) {
    adjusted.keyframes.push_back(bundle.keyframe(i));
    adjusted.T_world_body.push_back(bundle.T_world_body(i));
  }
  adjusted.points = bundle.points();
  for (std::size_t i = 0; i < adjusted.points.size(); ++i) {
    adjusted.positions.push_back(bundle.position(i));
  }
  return adjusted;
}

void apply(const AdjustedScene& adjusted, World& world) {
  if (!adjusted.is_usable) return;
  const std::size_t count = world.keyframesAdded();
  std::vector<SE3d> before(count), after(count);
  std::vector<std::uint8_t> is_moved(count, 0);
  for (std::size_t i = 0; i < adjusted.keyframes.size(); ++i) {
    const std::uint32_t number = std::uint32_t(adjusted.keyframes[i]);
    after[number] = adjusted.T_world_body[i];
    is_moved[number] = 1;
  }
  // By number, so that a parent comes before its children.
  for (const auto& item : world.map().keyframes()) {
    const std::uint32_t number = std::uint32_t(item.id);
    before[number] = item.value.T_world_body;
    if (is_moved[number] != 0) continue;
    const std::uint32_t parent = std::uint32_t(world.parent(item.id));
    const bool has_parent = parent < number && world.map().find(KeyframeId(parent)) != nullptr;
    after[number] =
        has_parent ? after[parent] * before[parent].inverse() * before[number] : before[number];
  }
  std::vector<std::uint8_t> is_adjusted(std::uint32_t(world.map().nextPointId()), 0);
  for (std::size_t i = 0; i < adjusted.points.size(); ++i) {
    const PointId id = adjusted.points[i];
    is_adjusted[std::uint32_t(id)] = 1;
    if (world.map().find(id) != nullptr) world.movePoint(id, adjusted.positions[i]);
  }
  std::vector<PointId> others;
  for (const auto& item : world.map().points()) {
    if (is_adjusted[std::uint32_t(item.id)] == 0) others.push_back(item.id);
  }
  for (const PointId id : others) {
    const std::uint32_t first = std::uint32_t(world.map().observations(id)[0].keyframe);
    world.movePoint(id, after[first] * before[first].inverse() * world.map().at(id).position);
  }
  std::vector<KeyframeId> keyframes;
  for (const auto& item : world.map().keyframes()) keyframes.push_back(item.id);
  for (const KeyframeId id : keyframes) world.moveKeyframe(id, after[std::uint32_t(id)]);
}

}  // namespace visual
