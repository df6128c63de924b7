#ifndef GSLAM_CORE_POINT_INDEX_H
#define GSLAM_CORE_POINT_INDEX_H

#include <gslam/base/error.h>
#include <gslam/core/map.h>
#include <gslam/geometry/camera.h>
#include <gslam/geometry/se3.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <string>
#include <utility>
#include <vector>

/// @file
/// Points of a map by where they are.

namespace gslam {
inline namespace v1 {

/// A point and how far it is away.
struct NearPoint {
  PointId id;       ///< which one
  double distance;  ///< in the unit of the map
};

/// A point that a camera sees.
struct VisiblePoint {
  PointId id;       ///< which one
  Vec2d pixel;      ///< where
  double distance;  ///< from the camera, in the unit of the map
};

/// The positions of the points of a map in a kd-tree: made once for a snapshot, asked often.
///
/// It has no pointer into the map. 1e6 points take about 0.3 s and 32 MB. Points whose
/// position is not finite are left out.
///
/// Thread-safety: it does not change; many threads may ask.
///
/// Source: J. Bentley, "Multidimensional binary search trees used for associative searching", 1975.
class PointIndex {
 public:
  /// Of all points.
  explicit PointIndex(const Map& map) {
    entries_.reserve(map.points().size());
    for (const auto& item : map.points()) {
      const Vec3d& p = item.value.position;
      if (!std::isfinite(p[0]) || !std::isfinite(p[1]) || !std::isfinite(p[2])) continue;
      entries_.push_back(Entry{p, item.id, 0});
    }
    build(0, entries_.size());
  }

  /// How many points it has.
  std::size_t size() const noexcept { return entries_.size(); }

  /// The points in a box, its border included, in no order.
  /// @param least, most  its corners; numbers may be infinite
  /// @throws ArgumentError when one is not a number
  std::vector<PointId> inBox(const Vec3d& least, const Vec3d& most) const {
    for (std::size_t i = 0; i < 3; ++i) {
      if (std::isnan(least[i]) || std::isnan(most[i])) {
        throw ArgumentError("corner of the box", "has an element that is not a number");
      }
    }
    std::vector<PointId> found;
    search(
        0, entries_.size(),
        [&](const Entry& entry) {
          for (std::size_t i = 0; i < 3; ++i) {
            if (!(entry.position[i] >= least[i] && entry.position[i] <= most[i])) return;
          }
          found.push_back(entry.id);
        },
        [&](std::size_t axis) { return std::make_pair(least[axis], most[axis]); });
    return found;
  }

  /// The points within a distance, in no order.
  /// @param centre  world coordinates
  /// @param radius  0 or more; infinite: all
  /// @throws ArgumentError when the centre is not finite, or the radius below 0 or not a number
  std::vector<NearPoint> inRadius(const Vec3d& centre, double radius) const {
    checkFinite("centre", centre);
    checkDistance("radius", radius);
    std::vector<NearPoint> found;
    search(
        0, entries_.size(),
        [&](const Entry& entry) {
          const double distance = (entry.position - centre).norm();
          if (distance <= radius) found.push_back(NearPoint{entry.id, distance});
        },
        [&](std::size_t axis) {
          return std::make_pair(centre[axis] - radius, centre[axis] + radius);
        });
    return found;
  }

  /// The k nearest points, the nearest first; fewer where there are fewer.
  /// @throws ArgumentError when the centre is not finite
  std::vector<NearPoint> nearest(const Vec3d& centre, std::size_t k) const {
    checkFinite("centre", centre);
    std::vector<NearPoint> heap;  // the farthest first
    if (k != 0) searchNearest(0, entries_.size(), centre, k, heap);
    std::sort_heap(heap.begin(), heap.end(), isNearer);
    return heap;
  }

  /// The points that a camera has in its image, whatever lies before them, in no order.
  /// @param camera          the camera
  /// @param T_world_camera  its pose
  /// @param max_distance    from the camera, 0 or more
  /// @throws ArgumentError when the camera is none, the pose is not finite, or the distance is
  /// below
  ///   0 or not a number
  std::vector<VisiblePoint> visible(
      const Camera& camera, const SE3d& T_world_camera,
      double max_distance = std::numeric_limits<double>::infinity()) const {
    if (!camera.isValid()) throw ArgumentError("camera", "is none, expected one with a model");
    checkFinite("T_world_camera", T_world_camera.translation());
    checkFinite("T_world_camera", T_world_camera.rotation().quaternion());
    checkDistance("max_distance", max_distance);
    std::vector<VisiblePoint> found;
    const SE3d T_camera_world = T_world_camera.inverse();
    const Vec3d centre = T_world_camera.translation();
    search(
        0, entries_.size(),
        [&](const Entry& entry) {
          const double distance = (entry.position - centre).norm();
          Vec2d pixel{};
          if (!(distance <= max_distance)) return;
          if (!camera.project(T_camera_world * entry.position, pixel)) return;
          if (camera.isInImage(pixel)) found.push_back(VisiblePoint{entry.id, pixel, distance});
        },
        [&](std::size_t axis) {
          return std::make_pair(centre[axis] - max_distance, centre[axis] + max_distance);
        });
    return found;
  }

 private:
  template <std::size_t N>
  static void checkFinite(const char* name, const Vec<double, N>& v) {
    for (std::size_t i = 0; i < N; ++i) {
      if (!std::isfinite(v[i])) throw ArgumentError(name, "is not finite");
    }
  }
  static void checkDistance(const char* name, double distance) {
    if (!(distance >= 0)) {
      throw ArgumentError(name, "is " + std::to_string(distance) + ", expected 0 or more");
    }
  }

  // Each range of entries is a tree: its middle entry splits it along its axis, unless it is small.
  struct Entry {
    Vec3d position;
    PointId id;
    std::uint32_t axis;
  };
  static constexpr std::size_t kLeaf = 12;

  static bool isNearer(const NearPoint& a, const NearPoint& b) noexcept {
    return a.distance != b.distance ? a.distance < b.distance : a.id < b.id;
  }

  void build(std::size_t begin, std::size_t end) {
    while (end - begin > kLeaf) {
      const std::size_t middle = begin + (end - begin) / 2;
      const std::size_t axis = widestAxis(begin, end);
      const auto first = entries_.begin();
      std::nth_element(first + std::ptrdiff_t(begin), first + std::ptrdiff_t(middle),
                       first + std::ptrdiff_t(end), [axis](const Entry& a, const Entry& b) {
                         return a.position[axis] < b.position[axis];
                       });
      entries_[middle].axis = static_cast<std::uint32_t>(axis);
      build(begin, middle);
      begin = middle + 1;
    }
  }

  std::size_t widestAxis(std::size_t begin, std::size_t end) const noexcept {
    Vec3d least = entries_[begin].position, most = least;
    for (std::size_t i = begin; i < end; ++i) {
      for (std::size_t a = 0; a < 3; ++a) {
        least[a] = std::min(least[a], entries_[i].position[a]);
        most[a] = std::max(most[a], entries_[i].position[a]);
      }
    }
    const Vec3d extent = most - least;
    const std::size_t wider = extent[1] > extent[0] ? 1 : 0;
    return extent[2] > extent[wider] ? 2 : wider;
  }

  // Calls visit(entry) with all that may lie between bounds(axis).first and .second.
  template <class Visit, class Bounds>
  void search(std::size_t begin, std::size_t end, const Visit& visit, const Bounds& bounds) const {
    while (end - begin > kLeaf) {
      const std::size_t middle = begin + (end - begin) / 2;
      const Entry& entry = entries_[middle];
      const std::pair<double, double> wanted = bounds(entry.axis);
      const double split = entry.position[entry.axis];
      if (wanted.first <= split) search(begin, middle, visit, bounds);
      visit(entry);
      if (!(split <= wanted.second)) return;
      begin = middle + 1;
    }
    for (std::size_t i = begin; i < end; ++i) visit(entries_[i]);
  }

  void searchNearest(std::size_t begin, std::size_t end, const Vec3d& centre, std::size_t k,
                     std::vector<NearPoint>& heap) const {
    if (end - begin <= kLeaf) {
      for (std::size_t i = begin; i < end; ++i) offer(entries_[i], centre, k, heap);
      return;
    }
    const std::size_t middle = begin + (end - begin) / 2;
    const Entry& entry = entries_[middle];
    const double beyond = centre[entry.axis] - entry.position[entry.axis];
    offer(entry, centre, k, heap);
    if (beyond < 0) {
      searchNearest(begin, middle, centre, k, heap);
      if (mayBeNear(beyond, k, heap)) searchNearest(middle + 1, end, centre, k, heap);
    } else {
      searchNearest(middle + 1, end, centre, k, heap);
      if (mayBeNear(beyond, k, heap)) searchNearest(begin, middle, centre, k, heap);
    }
  }

  static bool mayBeNear(double beyond, std::size_t k, const std::vector<NearPoint>& heap) noexcept {
    return heap.size() < k || std::fabs(beyond) <= heap.front().distance;
  }

  static void offer(const Entry& entry, const Vec3d& centre, std::size_t k,
                    std::vector<NearPoint>& heap) {
    const NearPoint near = {entry.id, (entry.position - centre).norm()};
    if (heap.size() == k) {
      if (!isNearer(near, heap.front())) return;
      std::pop_heap(heap.begin(), heap.end(), isNearer);
      heap.pop_back();
    }
    heap.push_back(near);
    std::push_heap(heap.begin(), heap.end(), isNearer);
  }

  std::vector<Entry> entries_;
};

}  // namespace v1
}  // namespace gslam

#endif  // GSLAM_CORE_POINT_INDEX_H
