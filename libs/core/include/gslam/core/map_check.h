#ifndef GSLAM_CORE_MAP_CHECK_H
#define GSLAM_CORE_MAP_CHECK_H

#include <gslam/base/span.h>
#include <gslam/core/map.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

/// @file
/// What is wrong with a map.

namespace gslam {
inline namespace v1 {
namespace detail {

class MapCheck {
 public:
  MapCheck(const Map& map, std::size_t most) : map_(map), most_(most) {}

  std::vector<std::string> problems() {
    for (const auto& item : map_.keyframes()) checkKeyframe(item.id, item.value);
    for (const auto& item : map_.points()) checkPoint(item.id, item.value);
    for (const auto& item : map_.edges()) checkEdge(item.id, item.value);
    require(seen_ == map_.observationCount(), "map",
            "counts " + std::to_string(map_.observationCount()) +
                " observations, but points have " + std::to_string(seen_));
    return problems_;
  }

 private:
  void require(bool is_right, const std::string& what, const std::string& problem) {
    if (!is_right && problems_.size() < most_) problems_.push_back(what + " " + problem);
  }

  template <std::size_t N>
  static bool isFinite(const Vec<double, N>& v) noexcept {
    for (std::size_t i = 0; i < N; ++i) {
      if (!std::isfinite(v[i])) return false;
    }
    return true;
  }
  static bool isPose(const SE3d& pose) noexcept {
    return isFinite(pose.translation()) &&
           std::fabs(pose.rotation().quaternion().squaredNorm() - 1) < 1e-6;
  }
  static std::string nameOf(const char* kind, std::uint32_t id) {
    return std::string(kind) + " " + std::to_string(id);
  }

  void checkKeyframe(KeyframeId id, const Keyframe& keyframe) {
    const std::string name = nameOf("keyframe", std::uint32_t(id));
    require(isPose(keyframe.T_world_body), name, "has a pose that is not finite");
    const std::size_t cameras = map_.rig().cameras.size();
    const std::vector<Feature>& features = keyframe.content->features;
    const auto is_stray = [cameras](const Feature& f) { return f.camera >= cameras; };
    require(cameras == 0 || std::none_of(features.begin(), features.end(), is_stray), name,
            "has a feature in a camera that the rig does not have");
    const Span<const PointId> points = map_.pointsSeen(id);
    require(points.size() == features.size(), name, "has not one place for a point a feature");
    for (std::uint32_t i = 0; i < points.size(); ++i) {
      if (points[i] == kNoPoint) continue;
      const Span<const Observation> seen = map_.observations(points[i]);
      require(std::find(seen.begin(), seen.end(), Observation{id, i}) != seen.end(), name,
              "sees " + nameOf("point", std::uint32_t(points[i])) + ", which does not know of it");
    }
  }

  void checkPoint(PointId id, const MapPoint& point) {
    const std::string name = nameOf("point", std::uint32_t(id));
    require(isFinite(point.position), name, "has a position that is not finite");
    for (const Observation& by : map_.observations(id)) {
      ++seen_;
      const bool is_known = map_.find(by.keyframe) != nullptr &&
                            by.feature < map_.pointsSeen(by.keyframe).size() &&
                            map_.pointSeen(by.keyframe, by.feature) == id;
      require(is_known, name,
              "is seen by " + nameOf("keyframe", std::uint32_t(by.keyframe)) +
                  ", which does not know of it");
    }
    const Shape* const shape = map_.shape(id);
    require(shape == nullptr || isFinite(shape->size), name, "has a size that is not finite");
  }

  void checkEdge(EdgeId id, const PoseEdge& edge) {
    const std::string name = nameOf("edge", std::uint32_t(id));
    require(isPose(edge.T_from_to) && edge.scale > 0 && std::isfinite(edge.scale), name,
            "has a pose that is not finite, or a scale that is not above 0");
    for (const KeyframeId end : {edge.from, edge.to}) {
      const Span<const EdgeId> edges = map_.edgesOf(end);
      require(map_.find(end) != nullptr && std::find(edges.begin(), edges.end(), id) != edges.end(),
              name,
              "ends at " + nameOf("keyframe", std::uint32_t(end)) +
                  ", which is missing or does not know of it");
    }
    for (std::size_t r = 0; r < 6; ++r) {
      const Vec<double, 6> row = edge.information.row(r), column = edge.information.col(r);
      require(isFinite(row) && row[r] >= 0, name, "has an information matrix that is not finite");
      require((row - column).norm() <= 1e-6 * row.norm(), name,
              "has an information matrix that is not symmetric");
    }
  }

  const Map& map_;
  std::size_t most_;
  std::size_t seen_ = 0;
  std::vector<std::string> problems_;
};

}  // namespace detail

/// What is wrong with a map, one sentence each; empty for one that is right. The links between its
/// parts are always right unless Map has a fault; numbers are as good as who wrote them.
/// @param most  stops after so many sentences
inline std::vector<std::string> validate(const Map& map, std::size_t most = 100) {
  return detail::MapCheck(map, most).problems();
}

}  // namespace v1
}  // namespace gslam

#endif  // GSLAM_CORE_MAP_CHECK_H
