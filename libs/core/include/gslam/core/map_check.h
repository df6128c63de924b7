#ifndef GSLAM_CORE_MAP_CHECK_H
#define GSLAM_CORE_MAP_CHECK_H

#include <gslam/base/span.h>
#include <gslam/core/map.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <string>
#include <utility>
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
    checkAll("keyframe", map_.keyframes());
    checkAll("point", map_.points());
    checkAll("edge", map_.edges());
    if (!isFull() && seen_ != map_.observationCount()) {
      problems_.push_back("map counts " + std::to_string(map_.observationCount()) +
                          " observations, but points have " + std::to_string(seen_));
    }
    return std::move(problems_);
  }

 private:
  bool isFull() const noexcept { return problems_.size() >= most_; }

  template <class Range>
  void checkAll(const char* kind, const Range& range) {
    kind_ = kind;
    for (const auto& item : range) {
      if (isFull()) return;
      id_ = std::uint32_t(item.id);
      check(item.id, item.value);
    }
  }

  // Of what is looked at: a sentence only where it is needed, for most maps have no fault.
  void report(const std::string& problem) {
    if (!isFull()) problems_.push_back(nameOf(kind_, id_) + " " + problem);
  }
  void require(bool is_right, const char* problem) {
    if (!is_right) report(problem);
  }

  template <class T, std::size_t N>
  static bool isFinite(const Vec<T, N>& v) noexcept {
    for (std::size_t i = 0; i < N; ++i) {
      if (!std::isfinite(v[i])) return false;
    }
    return true;
  }
  static bool isRotation(const SO3d& rotation) noexcept {
    return std::fabs(rotation.quaternion().squaredNorm() - 1) < 1e-6;
  }
  static bool isPose(const SE3d& pose) noexcept {
    return isFinite(pose.translation()) && isRotation(pose.rotation());
  }
  static bool isFinite(const Feature& f) noexcept {
    return isFinite(f.pixel) && std::isfinite(f.size) && std::isfinite(f.angle) &&
           std::isfinite(f.response);
  }
  static std::string nameOf(const char* kind, std::uint32_t id) {
    return std::string(kind) + " " + std::to_string(id);
  }

  void check(KeyframeId id, const Keyframe& keyframe) {
    require(isPose(keyframe.T_world_body), "has a pose that is not finite");
    const std::vector<Feature>& features = keyframe.content->features;
    const std::size_t cameras = map_.rig().cameras.size();
    bool are_finite = true, have_cameras = true;
    for (const Feature& f : features) {
      are_finite = are_finite && isFinite(f);
      have_cameras = have_cameras && (cameras == 0 || f.camera < cameras);
    }
    require(are_finite, "has a feature that is not finite");
    require(have_cameras, "has a feature in a camera that the rig does not have");
    for (const CameraImage& image : keyframe.content->images) {
      require(std::uint8_t(image.kind) < kImageKinds, "has an image of an unknown kind");
    }
    const Span<const PointId> points = map_.pointsSeen(id);
    require(points.size() == features.size(), "has not one place for a point a feature");
    for (std::uint32_t i = 0; i < points.size() && !isFull(); ++i) {
      if (points[i] == kNoPoint) continue;
      const Span<const Observation> seen = map_.observations(points[i]);
      if (std::find(seen.begin(), seen.end(), Observation{id, i}) != seen.end()) continue;
      report("sees " + nameOf("point", std::uint32_t(points[i])) + ", which does not know of it");
    }
  }

  void check(PointId id, const MapPoint& point) {
    require(isFinite(point.position), "has a position that is not finite");
    require(isFinite(point.normal), "has a normal that is not finite");
    require(std::uint8_t(point.kind) < kPointKinds, "is of an unknown kind");
    for (const Observation& by : map_.observations(id)) {
      ++seen_;
      const bool is_known = map_.find(by.keyframe) != nullptr &&
                            by.feature < map_.pointsSeen(by.keyframe).size() &&
                            map_.pointSeen(by.keyframe, by.feature) == id;
      if (is_known) continue;
      report("is seen by " + nameOf("keyframe", std::uint32_t(by.keyframe)) +
             ", which does not know of it");
    }
    const Shape* const shape = map_.shape(id);
    if (shape == nullptr) return;
    require(isFinite(shape->size) && isRotation(shape->R_world_shape),
            "has a shape that is not finite");
  }

  void check(EdgeId id, const PoseEdge& edge) {
    require(isPose(edge.T_from_to), "has a pose that is not finite");
    require(edge.scale > 0 && std::isfinite(edge.scale), "has a scale that is not above 0");
    require(std::uint8_t(edge.kind) < kEdgeKinds, "is of an unknown kind");
    for (const KeyframeId end : {edge.from, edge.to}) {
      const Span<const EdgeId> edges = map_.edgesOf(end);
      const bool is_known = std::find(edges.begin(), edges.end(), id) != edges.end();
      if (is_known && map_.find(end) != nullptr) continue;
      report("ends at " + nameOf("keyframe", std::uint32_t(end)) +
             ", which is missing or does not know of it");
    }
    checkInformation(edge.information);
  }

  void checkInformation(const Mat<double, 6, 6>& information) {
    bool is_finite = true, is_positive = true, is_symmetric = true;
    for (std::size_t i = 0; i < 6; ++i) {
      const Vec<double, 6> row = information.row(i), column = information.col(i);
      is_finite = is_finite && isFinite(row);
      is_positive = is_positive && row[i] >= 0;
      is_symmetric = is_symmetric && (row - column).norm() <= 1e-6 * row.norm();
    }
    if (!is_finite) return report("has an information matrix that is not finite");
    require(is_positive, "has an information matrix with a number below 0 on its diagonal");
    require(is_symmetric, "has an information matrix that is not symmetric");
  }

  const Map& map_;
  std::size_t most_;
  const char* kind_ = "";  // of what is looked at
  std::uint32_t id_ = 0;
  std::size_t seen_ = 0;
  std::vector<std::string> problems_;
};

}  // namespace detail

/// What is wrong with a map, one sentence each; empty for one that is right. The links between its
/// parts are always right unless Map has a fault; numbers are as good as who wrote them.
/// @param map   to be looked through
/// @param most  stops after so many sentences, and looks no further
inline std::vector<std::string> validate(const Map& map, std::size_t most = 100) {
  return detail::MapCheck(map, most).problems();
}

}  // namespace v1
}  // namespace gslam

#endif  // GSLAM_CORE_MAP_CHECK_H
