#include "tracking/local_map.h"

#include <algorithm>

namespace visual {

using gslam::KeyframeId;
using gslam::PointId;

namespace {

constexpr std::size_t kMostKeyframes = 40;

}  // namespace

void LocalMap::addKeyframe(KeyframeId id) {
  if (keyframes_.size() >= kMostKeyframes || keyframe_stamp_[std::uint32_t(id)] == stamp_) return;
  keyframe_stamp_[std::uint32_t(id)] = stamp_;
  keyframes_.push_back(id);
}

void LocalMap::vote(const Scene& scene, gslam::Span<const Match> matches) {
  votes_.assign(scene.facts.size(), 0);
  for (const Match& match : matches) {
    for (const gslam::Observation& by : scene.map.observations(match.point)) {
      ++votes_[std::uint32_t(by.keyframe)];
    }
  }
}

// The later one of two that see as much.
KeyframeId LocalMap::referenceOf(const Scene& scene, gslam::Span<const Match> matches) {
  vote(scene, matches);
  std::size_t best = 0;
  for (std::size_t i = 0; i < votes_.size(); ++i) {
    if (votes_[i] >= votes_[best]) best = i;
  }
  return KeyframeId(best);
}

bool LocalMap::gather(const Scene& scene, gslam::Span<const Match> matches) {
  vote(scene, matches);
  ++stamp_;
  keyframe_stamp_.resize(scene.facts.size(), 0);
  point_stamp_.resize(std::uint32_t(scene.map.nextPointId()), 0);
  keyframes_.clear();
  points_.clear();
  std::vector<KeyframeId>& seers = keyframes_;
  for (std::size_t i = 0; i < votes_.size(); ++i) {
    if (votes_[i] != 0) seers.push_back(KeyframeId(i));
  }
  if (seers.empty()) return false;
  std::sort(seers.begin(), seers.end(), [this](KeyframeId a, KeyframeId b) {
    const std::uint32_t of_a = votes_[std::uint32_t(a)], of_b = votes_[std::uint32_t(b)];
    return of_a != of_b ? of_a > of_b : a > b;
  });
  seers.resize(std::min(seers.size(), kMostKeyframes));
  for (const KeyframeId id : seers) keyframe_stamp_[std::uint32_t(id)] = stamp_;
  const std::size_t direct = std::min<std::size_t>(seers.size(), 10);
  for (std::size_t i = 0; i < direct; ++i) {
    std::size_t added = 0;
    for (const gslam::Covisible& other : scene.neighbours(keyframes_[i])) {
      if (++added > 10) break;
      if (scene.map.find(other.keyframe) != nullptr) addKeyframe(other.keyframe);
    }
  }
  for (const KeyframeId id : keyframes_) {
    for (const PointId point : scene.map.pointsSeen(id)) {
      if (point == gslam::kNoPoint || point_stamp_[std::uint32_t(point)] == stamp_) continue;
      point_stamp_[std::uint32_t(point)] = stamp_;
      points_.push_back(point);
    }
  }
  return true;
}

}  // namespace visual
