#ifndef GSLAM_CORE_RECORDER_H
#define GSLAM_CORE_RECORDER_H

#include <gslam/core/slam.h>
#include <gslam/core/trajectory.h>
#include <gslam/messenger/messenger.h>

#include <cmath>
#include <cstddef>
#include <cstdint>
#include <map>
#include <mutex>
#include <string>
#include <utility>
#include <vector>

/// @file
/// Keeps the poses that a SLAM system publishes.

namespace gslam {
inline namespace v1 {

/// Keeps what a SLAM system says of each frame: the last pose, where it says more than one.
///
/// All members may be called by any thread, also while poses come.
class Recorder {
 public:
  /// Listens to "/<name>/pose" from now on.
  /// @throws ArgumentError when the name cannot be part of a topic
  Recorder(const std::string& name, const Messenger& messenger) {
    subscriber_ = messenger.inNamespace(name).subscribe<TrackedPose>(
        "pose", [this](const TrackedPose& pose) { keep(pose); });
  }
  Recorder(const Recorder&) = delete;
  Recorder& operator=(const Recorder&) = delete;

  /// What was said of each frame, by id. A pose that is not finite is kept as lost.
  std::vector<TrackedPose> poses() const {
    const std::lock_guard<std::mutex> lock(mutex_);
    std::vector<TrackedPose> poses;
    poses.reserve(poses_.size());
    for (const auto& pose : poses_) poses.push_back(pose.second);
    return poses;
  }

  /// The poses that mean something. Of two frames with the same stamp, the later one's.
  Trajectory trajectory() const {
    std::map<std::int64_t, SE3d> by_stamp;
    for (const TrackedPose& pose : poses()) {
      if (hasPose(pose.state)) by_stamp[pose.stamp] = pose.T_world_body;
    }
    std::vector<StampedPose> stamped;
    stamped.reserve(by_stamp.size());
    for (const auto& pose : by_stamp) stamped.push_back({pose.first, pose.second});
    return Trajectory(std::move(stamped));
  }

  /// Poses that were not finite, which no pose should be.
  std::size_t invalidCount() const {
    const std::lock_guard<std::mutex> lock(mutex_);
    return invalid_count_;
  }

 private:
  static bool isFinite(const SE3d& pose) noexcept {
    for (std::size_t i = 0; i < 7; ++i) {
      if (!std::isfinite(pose.data()[i])) return false;
    }
    return true;
  }

  void keep(TrackedPose pose) {
    const bool is_invalid = hasPose(pose.state) && !isFinite(pose.T_world_body);
    if (is_invalid) {
      pose.state = TrackingState::lost;
      pose.T_world_body = SE3d();
    }
    const std::lock_guard<std::mutex> lock(mutex_);
    if (is_invalid) ++invalid_count_;
    poses_[pose.frame] = pose;
  }

  mutable std::mutex mutex_;
  std::map<std::uint64_t, TrackedPose> poses_;  // by Frame::id
  std::size_t invalid_count_ = 0;
  Subscriber subscriber_;  // last: ends before the rest goes
};

}  // namespace v1
}  // namespace gslam

#endif  // GSLAM_CORE_RECORDER_H
