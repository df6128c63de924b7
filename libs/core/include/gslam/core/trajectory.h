#ifndef GSLAM_CORE_TRAJECTORY_H
#define GSLAM_CORE_TRAJECTORY_H

#include <gslam/base/error.h>
#include <gslam/geometry/interpolate.h>
#include <gslam/geometry/se3.h>

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <string>
#include <utility>
#include <vector>

/// @file
/// Where something was, and when.

namespace gslam {
inline namespace v1 {

/// A pose at a time.
struct StampedPose {
  std::int64_t stamp;  ///< nanoseconds
  SE3d pose;           ///< T_world_body unless said otherwise
};

/// Poses in the order of their stamps, each stamp once.
///
/// Thread-safety: as std::vector; it may be read by many threads, or written by one.
class Trajectory {
 public:
  using const_iterator = std::vector<StampedPose>::const_iterator;  ///< as in std::vector

  /// No poses.
  Trajectory() = default;
  /// These poses, in any order.
  /// @throws ArgumentError when two have the same stamp
  explicit Trajectory(std::vector<StampedPose> poses) : poses_(std::move(poses)) {
    const bool is_sorted = std::is_sorted(poses_.begin(), poses_.end(), isBefore);
    if (!is_sorted) std::stable_sort(poses_.begin(), poses_.end(), isBefore);
    const auto twin = std::adjacent_find(poses_.begin(), poses_.end(), isNotBefore);
    if (twin != poses_.end()) failTwin(twin->stamp);
  }

  /// Adds a pose; at the end this takes constant time.
  /// @throws ArgumentError when there is one with this stamp
  void add(std::int64_t stamp, const SE3d& pose) {
    const StampedPose added = {stamp, pose};
    const const_iterator place = lowerBound(stamp);
    if (place != poses_.end() && place->stamp == stamp) failTwin(stamp);
    poses_.insert(poses_.begin() + (place - poses_.begin()), added);
  }

  /// @{
  /// As in std::vector.
  std::size_t size() const noexcept { return poses_.size(); }
  bool empty() const noexcept { return poses_.empty(); }
  const StampedPose& operator[](std::size_t i) const noexcept { return poses_[i]; }
  const StampedPose& front() const noexcept { return poses_.front(); }
  const StampedPose& back() const noexcept { return poses_.back(); }
  const_iterator begin() const noexcept { return poses_.begin(); }
  const_iterator end() const noexcept { return poses_.end(); }
  /// @}

  /// The first pose at or after a stamp; end() where there is none.
  const_iterator lowerBound(std::int64_t stamp) const noexcept {
    if (poses_.empty() || poses_.back().stamp < stamp) return poses_.end();
    return std::lower_bound(poses_.begin(), poses_.end(), StampedPose{stamp, SE3d()}, isBefore);
  }

  /// The pose nearest in time; null where the trajectory is empty. Of two as near, the earlier.
  const StampedPose* nearest(std::int64_t stamp) const noexcept {
    if (poses_.empty()) return nullptr;
    const const_iterator after = lowerBound(stamp);
    if (after == poses_.end()) return &poses_.back();
    if (after == poses_.begin()) return &poses_.front();
    const const_iterator before = after - 1;
    return distance(before->stamp, stamp) <= distance(after->stamp, stamp) ? &*before : &*after;
  }

  /// The pose at a time between two others, along the straight line and the shortest rotation.
  /// @param stamp    nanoseconds
  /// @param pose     result; unchanged where there is none
  /// @param max_gap  most nanoseconds between the two poses around the stamp
  /// @return whether the stamp is inside the trajectory, in no larger gap
  bool interpolate(std::int64_t stamp, SE3d& pose, std::int64_t max_gap = INT64_MAX) const {
    const const_iterator after = lowerBound(stamp);
    if (after == poses_.end()) return false;
    if (after->stamp == stamp) {
      pose = after->pose;
      return true;
    }
    if (after == poses_.begin()) return false;
    const const_iterator before = after - 1;
    const std::uint64_t gap = distance(before->stamp, after->stamp);
    if (max_gap < 0 || gap > std::uint64_t(max_gap)) return false;
    const double part = double(distance(before->stamp, stamp)) / double(gap);
    pose = interpolateSplit(before->pose, after->pose, part);
    return true;
  }

  /// Length of the way from pose to pose, metres.
  double length() const noexcept {
    double sum = 0;
    for (std::size_t i = 1; i < poses_.size(); ++i) {
      sum += (poses_[i].pose.translation() - poses_[i - 1].pose.translation()).norm();
    }
    return sum;
  }

  /// Nanoseconds from the first to the last pose.
  std::uint64_t duration() const noexcept {
    return empty() ? 0 : distance(front().stamp, back().stamp);
  }

 private:
  static bool isBefore(const StampedPose& a, const StampedPose& b) noexcept {
    return a.stamp < b.stamp;
  }
  static bool isNotBefore(const StampedPose& a, const StampedPose& b) noexcept {
    return a.stamp >= b.stamp;
  }
  // Between any two stamps, however far apart.
  static std::uint64_t distance(std::int64_t a, std::int64_t b) noexcept {
    return a < b ? std::uint64_t(b) - std::uint64_t(a) : std::uint64_t(a) - std::uint64_t(b);
  }
  [[noreturn]] static void failTwin(std::int64_t stamp) {
    throw ArgumentError("stamp", "is " + std::to_string(stamp) + " ns, which another pose has");
  }

  std::vector<StampedPose> poses_;
};

}  // namespace v1
}  // namespace gslam

#endif  // GSLAM_CORE_TRAJECTORY_H
