#include "loops/place_search.h"

#include <algorithm>
#include <bitset>

namespace visual {

using gslam::KeyframeId;
using gslam::PointId;
using gslam::SE3d;
using gslam::Span;

std::vector<KeyframeId> placeAround(const Scene& scene, KeyframeId keyframe, std::size_t most) {
  std::vector<KeyframeId> place(1, keyframe);
  for (const gslam::Covisible& other : scene.neighbours(keyframe)) {
    if (place.size() >= most) break;
    if (scene.map.find(other.keyframe) != nullptr) place.push_back(other.keyframe);
  }
  return place;
}

std::vector<PointId> pointsOf(const Scene& scene, Span<const KeyframeId> keyframes) {
  std::vector<PointId> points;
  for (const KeyframeId id : keyframes) {
    for (const PointId point : scene.map.pointsSeen(id)) {
      if (point != gslam::kNoPoint) points.push_back(point);
    }
  }
  std::sort(points.begin(), points.end());
  points.erase(std::unique(points.begin(), points.end()), points.end());
  return points;
}

bool searchPlace(const View& view, const Scene& scene, Span<const PointId> points,
                 ProjectionMatcher& projector, PoseFitter& fitter, std::vector<Match>& matches,
                 SE3d& T_world_body) {
  MatchRules rules;
  rules.ratio = 0.9F;
  std::vector<SoughtPoint> sought;
  for (const double window : {10.0, 5.0}) {
    const SE3d T_camera_world = (T_world_body * scene.eye.T_body_camera).inverse();
    sought.clear();
    findVisible(scene, T_camera_world, points, window, sought);
    matches = projector.match(view, scene.eye, T_camera_world, sought, rules);
    if (!fitter.refine(view, scene, matches, T_world_body)) return false;
  }
  return true;
}

int partsOfImage(const View& view, const Eye& eye, const std::vector<Match>& matches) {
  constexpr int kSide = 6;
  const auto part = [](double at, int size) {
    return std::size_t(std::clamp(int(at * kSide / size), 0, kSide - 1));
  };
  std::bitset<std::size_t(kSide) * kSide> parts;
  for (const Match& match : matches) {
    const gslam::Vec2d pixel = view.pixel(match.feature);
    parts.set(part(pixel[1], eye.camera.height()) * kSide + part(pixel[0], eye.camera.width()));
  }
  return int(parts.count());
}

}  // namespace visual
