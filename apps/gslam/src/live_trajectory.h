#ifndef GSLAM_APPS_LIVE_TRAJECTORY_H
#define GSLAM_APPS_LIVE_TRAJECTORY_H

#include <gslam/core/slam.h>

#include <cstdint>
#include <mutex>
#include <string>
#include <unordered_set>

#include "run_folder.h"

namespace app {

/// Writes each pose as it is first published, TUM format, while the run goes on. Poses of frames
/// that are starting or lost, and those that are not finite, are left out; guessed ones are not.
/// Thread-safe.
class LiveTrajectory {
 public:
  /// @throws FileError
  explicit LiveTrajectory(const std::string& path);

  void add(const gslam::TrackedPose& pose);
  /// @throws FileError when something could not be written
  void check() const { file_.check(); }

 private:
  std::mutex mutex_;
  LineFile file_;
  std::unordered_set<std::uint64_t> frames_;  // of which something was said
};

}  // namespace app

#endif  // GSLAM_APPS_LIVE_TRAJECTORY_H
