#ifndef GSLAM_CORE_MAP_TRAJECTORY_H
#define GSLAM_CORE_MAP_TRAJECTORY_H

#include <gslam/base/error.h>
#include <gslam/core/map.h>
#include <gslam/core/trajectory.h>

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <string>
#include <utility>
#include <vector>

/// @file
/// The way that a map's keyframes went.

namespace gslam {
inline namespace v1 {
namespace detail {

struct KeyframePose {
  StampedPose pose;
  KeyframeId id;
};

// By stamp, and where that is the same by id.
inline std::vector<KeyframePose> keyframePoses(const Map& map) {
  std::vector<KeyframePose> poses;
  poses.reserve(map.keyframes().size());
  for (const auto& item : map.keyframes()) {
    poses.push_back(KeyframePose{StampedPose{item.value.stamp, item.value.T_world_body}, item.id});
  }
  std::stable_sort(poses.begin(), poses.end(), [](const KeyframePose& a, const KeyframePose& b) {
    return a.pose.stamp < b.pose.stamp;
  });
  return poses;
}

}  // namespace detail

/// The poses of the keyframes at their stamps.
/// @throws ArgumentError when two have the same stamp; it names both
inline Trajectory keyframeTrajectory(const Map& map) {
  std::vector<StampedPose> poses;
  KeyframeId last{};
  for (const detail::KeyframePose& next : detail::keyframePoses(map)) {
    if (!poses.empty() && poses.back().stamp == next.pose.stamp) {
      throw ArgumentError("keyframes " + std::to_string(std::uint32_t(last)) + " and " +
                              std::to_string(std::uint32_t(next.id)),
                          "have the same stamp, " + std::to_string(next.pose.stamp) +
                              " ns, which a trajectory cannot have");
    }
    poses.push_back(next.pose);
    last = next.id;
  }
  return Trajectory(std::move(poses));
}

/// Length of the way from keyframe to keyframe, by stamp, and where two have the same by id; in the
/// unit of the map.
inline double pathLength(const Map& map) {
  const std::vector<detail::KeyframePose> poses = detail::keyframePoses(map);
  double sum = 0;
  for (std::size_t i = 1; i < poses.size(); ++i) {
    sum += (poses[i].pose.pose.translation() - poses[i - 1].pose.pose.translation()).norm();
  }
  return sum;
}

}  // namespace v1
}  // namespace gslam

#endif  // GSLAM_CORE_MAP_TRAJECTORY_H
