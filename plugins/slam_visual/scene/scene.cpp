#include "scene/scene.h"

#include <algorithm>

namespace visual {

using gslam::KeyframeId;
using gslam::Observation;
using gslam::PointId;

KeyframeId Scene::standIn(KeyframeId id, gslam::SE3d& T_stand_in_body) const {
  T_stand_in_body = gslam::SE3d();
  while (map.find(id) == nullptr) {
    const Facts& gone = of(id);
    const double stretched = stretch(gone.parent) / gone.parent_stretch;
    const gslam::SE3d T_parent_body(gone.T_parent_body.rotation(),
                                    stretched * gone.T_parent_body.translation());
    T_stand_in_body = T_parent_body * T_stand_in_body;
    id = gone.parent;
  }
  return id;
}

double Scene::stretch(KeyframeId id) const {
  double result = of(id).stretch;
  // What became of the parent since then became of it, too.
  for (; map.find(id) == nullptr; id = of(id).parent) {
    result *= of(of(id).parent).stretch / of(id).parent_stretch;
  }
  return result;
}

Visibility visibilityOf(const Scene& scene, PointId id) {
  Visibility result;
  const gslam::Span<const Observation> seen = scene.map.observations(id);
  if (seen.empty()) return result;
  const Observation& first = seen[0];
  const gslam::Keyframe& keyframe = scene.map.at(first.keyframe);
  const gslam::Vec3d centre = keyframe.T_world_body * scene.eye.T_body_camera.translation();
  result.seen_at = (scene.map.at(id).position - centre).norm();
  result.octave = keyframe.content->features[first.feature].octave;
  const Levels& levels = scene.eye.levels;
  // The pyramid has smaller and larger pictures of it, as far as its levels go, and a bit more.
  result.farthest = 1.2 * result.seen_at * levels.factor(result.octave);
  result.nearest =
      0.8 * result.seen_at * levels.factor(result.octave) / levels.factor(levels.count() - 1);
  return result;
}

std::size_t rayCount(const Scene& scene, PointId id) {
  std::size_t count = 0;
  for (const Observation& by : scene.map.observations(id)) {
    count += scene.view(by.keyframe).depth[by.feature] > 0 ? 2 : 1;
  }
  return count;
}

double medianDepth(const Scene& scene, KeyframeId id) {
  std::vector<double> depths;
  const gslam::SE3d T_camera_world = scene.T_world_camera(id).inverse();
  for (const PointId point : scene.map.pointsSeen(id)) {
    if (point == gslam::kNoPoint) continue;
    depths.push_back((T_camera_world * scene.map.at(point).position)[2]);
  }
  if (depths.empty()) return 0;
  const auto middle = depths.begin() + std::ptrdiff_t(depths.size() / 2);
  std::nth_element(depths.begin(), middle, depths.end());
  return *middle;
}

std::int64_t featureOf(const gslam::Map& map, PointId point, KeyframeId keyframe) {
  for (const Observation& seen : map.observations(point)) {
    if (seen.keyframe == keyframe) return seen.feature;
  }
  return -1;
}

}  // namespace visual
