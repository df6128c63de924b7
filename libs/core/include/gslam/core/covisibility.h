#ifndef GSLAM_CORE_COVISIBILITY_H
#define GSLAM_CORE_COVISIBILITY_H

#include <gslam/base/span.h>
#include <gslam/core/map.h>

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <unordered_map>
#include <utility>
#include <vector>

/// @file
/// Which keyframes of a map belong together.

namespace gslam {
inline namespace v1 {

/// A keyframe that sees some of the points that another one sees.
struct Covisible {
  KeyframeId keyframe;   ///< the other one
  std::uint32_t shared;  ///< points that both see
};

/// Two keyframes that see some of the same points.
struct CovisibleEdge {
  KeyframeId a;          ///< the one with the smaller id
  KeyframeId b;          ///< the other
  std::uint32_t shared;  ///< points that both see
};

namespace detail {

// Counts the points that keyframes share; its memory is used again and again.
class SharedPointCounter {
 public:
  explicit SharedPointCounter(const Map& map) : map_(map) {}

  // Those that share `least` points or more, in no order.
  std::vector<Covisible> count(KeyframeId id, std::uint32_t least) {
    counts_.clear();
    points_.clear();
    for (const PointId point : map_.pointsSeen(id)) {
      if (point != kNoPoint) points_.push_back(point);
    }
    std::sort(points_.begin(), points_.end());  // two cameras may see the same
    points_.erase(std::unique(points_.begin(), points_.end()), points_.end());
    for (const PointId point : points_) addSeers(point);
    std::vector<Covisible> result;
    for (const auto& count : counts_) {
      const KeyframeId other = KeyframeId(count.first);
      if (other != id && count.second.shared >= least) {
        result.push_back(Covisible{other, count.second.shared});
      }
    }
    return result;
  }

 private:
  struct Count {
    std::uint32_t shared = 0;
    PointId last = kNoPoint;  // a keyframe that sees a point twice shares one point
  };

  void addSeers(PointId point) {
    for (const Observation& by : map_.observations(point)) {
      Count& count = counts_[std::uint32_t(by.keyframe)];
      if (count.last == point) continue;
      count.last = point;
      ++count.shared;
    }
  }

  const Map& map_;
  std::vector<PointId> points_;
  std::unordered_map<std::uint32_t, Count> counts_;
};

// Takes the numbers of one connected part after the other.
class ConnectedParts {
 public:
  explicit ConnectedParts(const Map& map) : map_(map) {}

  std::vector<std::vector<KeyframeId>> all() {
    std::vector<std::vector<KeyframeId>> parts;
    for (const auto& item : map_.keyframes()) {
      if (!reached_[std::uint32_t(item.id)]) parts.push_back(from(item.id));
    }
    std::stable_sort(parts.begin(), parts.end(), isLarger);
    return parts;
  }

 private:
  using Part = std::vector<KeyframeId>;
  static bool isLarger(const Part& a, const Part& b) noexcept { return a.size() > b.size(); }

  Part from(KeyframeId start) {
    Part part(1, start);
    reached_[std::uint32_t(start)] = true;
    for (std::size_t i = 0; i < part.size(); ++i) {
      for (const EdgeId id : map_.edgesOf(part[i])) {
        const PoseEdge& edge = map_.at(id);
        const KeyframeId other = edge.from == part[i] ? edge.to : edge.from;
        bool& is_reached = reached_[std::uint32_t(other)];
        if (!is_reached) part.push_back(other);
        is_reached = true;
      }
    }
    std::sort(part.begin(), part.end());
    return part;
  }

  const Map& map_;
  std::unordered_map<std::uint32_t, bool> reached_;
};

}  // namespace detail

/// The keyframes that see points that a keyframe sees, those that share most first.
/// @param map    with the keyframes
/// @param id     the keyframe
/// @param least  points that must be shared, 1 or more
/// @throws ArgumentError when there is no such keyframe
inline std::vector<Covisible> covisibleKeyframes(const Map& map, KeyframeId id,
                                                 std::uint32_t least = 1) {
  std::vector<Covisible> result = detail::SharedPointCounter(map).count(id, least);
  std::sort(result.begin(), result.end(), [](const Covisible& a, const Covisible& b) {
    return a.shared != b.shared ? a.shared > b.shared : a.keyframe < b.keyframe;
  });
  return result;
}

/// All pairs of keyframes that see the same points, by their ids. Takes time for each pair of
/// observations of a point.
/// @param map    with the keyframes
/// @param least  points that must be shared, 1 or more
inline std::vector<CovisibleEdge> covisibilityGraph(const Map& map, std::uint32_t least = 1) {
  std::vector<CovisibleEdge> edges;
  detail::SharedPointCounter counter(map);
  for (const auto& item : map.keyframes()) {
    const std::size_t first = edges.size();
    for (const Covisible& other : counter.count(item.id, least)) {
      if (item.id < other.keyframe) {
        edges.push_back(CovisibleEdge{item.id, other.keyframe, other.shared});
      }
    }
    std::sort(edges.begin() + std::ptrdiff_t(first), edges.end(),
              [](const CovisibleEdge& a, const CovisibleEdge& b) { return a.b < b.b; });
  }
  return edges;
}

/// The keyframes at the other ends of a keyframe's edges, by id, each once; none for a keyframe
/// that is not in the map.
inline std::vector<KeyframeId> neighbours(const Map& map, KeyframeId id) {
  std::vector<KeyframeId> result;
  for (const EdgeId edge_id : map.edgesOf(id)) {
    const PoseEdge& edge = map.at(edge_id);
    result.push_back(edge.from == id ? edge.to : edge.from);
  }
  std::sort(result.begin(), result.end());
  result.erase(std::unique(result.begin(), result.end()), result.end());
  return result;
}

/// The parts of the pose graph that no edge connects, the largest first; in each the keyframes by
/// id.
inline std::vector<std::vector<KeyframeId>> connectedParts(const Map& map) {
  return detail::ConnectedParts(map).all();
}

}  // namespace v1
}  // namespace gslam

#endif  // GSLAM_CORE_COVISIBILITY_H
