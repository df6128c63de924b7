#include "loops/loop_check.h"

#include <algorithm>
#include <cmath>

#include "matching/pose_fitter.h"

namespace visual {

using gslam::KeyframeId;
using gslam::PointId;
using gslam::SE3d;
using gslam::SIM3d;
using gslam::Vec3d;

namespace {

constexpr std::size_t kLeastPairs = 15;
constexpr double kLeastAgreeing = 0.5;  // of the pairs
constexpr double kSameScale = 0.25;     // by how much the distances of a pair may differ
constexpr double kMostErrors = 4;       // of the squared error of an inlier: points have some, too
constexpr double kMostDrift = 0.3;      // of the way
constexpr double kMostDriftOfDepth = 0.2;  // of the distance of what is seen: where there is no way

// A point of the map of now and one of the old place that the same feature sees.
struct Pair {
  PointId old;
  Vec3d here;    // the new one in the camera, lengths of now
  double ratio;  // of the distance of the old one from the camera in that of the new one
};

double median(std::vector<double> values) {
  const auto middle = values.begin() + std::ptrdiff_t(values.size() / 2);
  std::nth_element(values.begin(), middle, values.end());
  return *middle;
}

std::vector<Pair> pairsOf(const Scene& scene, const std::vector<Match>& matches,
                          const LoopGeometry& loop) {
  const SE3d T_here_now = scene.T_world_camera(loop.here).inverse();
  const SE3d T_here_old = (loop.T_world_body * scene.eye.T_body_camera).inverse();
  std::vector<Pair> pairs;
  for (const Match& match : matches) {
    const PointId own = scene.map.pointSeen(loop.here, match.feature);
    if (own == gslam::kNoPoint || own == match.point) continue;
    const Vec3d here = T_here_now * scene.map.at(own).position;
    const double distance = (T_here_old * scene.map.at(match.point).position).norm();
    if (here[2] > 0) pairs.push_back({match.point, here, distance / here.norm()});
  }
  return pairs;
}

// Whether a keyframe of the place that sees the old point could as well see the new one there.
bool isSeenThere(const Scene& scene, const std::vector<KeyframeId>& place, PointId old,
                 const Vec3d& position) {
  for (const KeyframeId id : place) {
    const std::int64_t feature = featureOf(scene.map, old, id);
    if (feature < 0) continue;
    const SE3d T_camera_world = scene.T_world_camera(id).inverse();
    const View& view = scene.view(id);
    const double limit = view.hasRight(std::size_t(feature)) ? kChi2Stereo : kChi2Pixel;
    return squaredError(scene.eye, view, std::uint32_t(feature), T_camera_world * position) <=
           kMostErrors * limit;
  }
  return false;
}

std::size_t agreeing(const Scene& scene, const std::vector<KeyframeId>& place,
                     const std::vector<Pair>& pairs, const LoopGeometry& loop) {
  const SIM3d S_world_camera(loop.T_world_body * scene.eye.T_body_camera, loop.scale);
  std::size_t count = 0;
  for (const Pair& pair : pairs) {
    if (std::abs(pair.ratio / loop.scale - 1) > kSameScale) continue;
    if (isSeenThere(scene, place, pair.old, S_world_camera * pair.here)) ++count;
  }
  return count;
}

// Whether lengths are measured so badly that `here` is where the loop says, and not where the map
// says: two rooms may be furnished alike.
bool isDriftPossible(const Scene& scene, const std::vector<Match>& matches,
                     const LoopGeometry& loop) {
  std::vector<Vec3d> way;
  for (const auto& keyframe : scene.map.keyframes()) {
    if (keyframe.id < std::min(loop.there, loop.here)) continue;
    if (keyframe.id > std::max(loop.there, loop.here)) break;
    way.push_back(keyframe.value.T_world_body.translation());
  }
  double length = 0;
  for (std::size_t i = 1; i < way.size(); ++i) length += (way[i] - way[i - 1]).norm();
  std::vector<double> depths;
  for (const Match& match : matches) {
    depths.push_back((scene.map.at(match.point).position - loop.T_world_body.translation()).norm());
  }
  const Vec3d now = scene.map.at(loop.here).T_world_body.translation();
  return (loop.T_world_body.translation() - now).norm() <=
         kMostDrift * length + kMostDriftOfDepth * median(depths);
}

}  // namespace

// A camera does not move with the scale of its map: it is scaled about itself, not about the body.
SIM3d LoopGeometry::S_there_here(const Scene& scene) const {
  const SE3d& T_body_camera = scene.eye.T_body_camera;
  return SIM3d(scene.map.at(there).T_world_body.inverse()) *
         SIM3d(T_world_body * T_body_camera, scale) * SIM3d(T_body_camera.inverse());
}

bool checkLoop(const Scene& scene, const std::vector<KeyframeId>& place,
               const std::vector<Match>& matches, LoopGeometry& loop) {
  const std::vector<Pair> pairs = pairsOf(scene, matches, loop);
  if (pairs.size() < kLeastPairs) return false;
  if (scene.eye.hasDepth()) {
    loop.scale = 1;
    if (!isDriftPossible(scene, matches, loop)) return false;
  } else {
    std::vector<double> ratios;
    for (const Pair& pair : pairs) ratios.push_back(pair.ratio);
    loop.scale = median(ratios);
  }
  const double needed = std::max(double(kLeastPairs), kLeastAgreeing * double(pairs.size()));
  return double(agreeing(scene, place, pairs, loop)) >= needed;
}

}  // namespace visual
