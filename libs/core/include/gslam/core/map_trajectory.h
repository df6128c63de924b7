#ifndef GSLAM_CORE_MAP_TRAJECTORY_H
#define GSLAM_CORE_MAP_TRAJECTORY_H

#include <gslam/core/map.h>
#include <gslam/core/trajectory.h>

#include <utility>
#include <vector>

/// @file
/// The way that a map's keyframes went.

namespace gslam {
inline namespace v1 {

/// The poses of the keyframes at their stamps.
/// @throws ArgumentError when two have the same stamp
inline Trajectory keyframeTrajectory(const Map& map) {
  std::vector<StampedPose> poses;
  for (const auto& item : map.keyframes()) {
    poses.push_back(StampedPose{item.value.stamp, item.value.T_world_body});
  }
  return Trajectory(std::move(poses));
}

}  // namespace v1
}  // namespace gslam

#endif  // GSLAM_CORE_MAP_TRAJECTORY_H
