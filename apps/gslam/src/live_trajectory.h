#ifndef GSLAM_APPS_LIVE_TRAJECTORY_H
#define GSLAM_APPS_LIVE_TRAJECTORY_H

#include <gslam/core/slam.h>
#include <gslam/core/trajectory.h>

#include <cstdint>
#include <mutex>
#include <string>
#include <unordered_map>

#include "run_folder.h"

namespace app {

/// Writes the first pose of each frame as it is published, TUM format, while the run goes on, and
/// keeps the last. A pose belongs to the frame whose id it has, and is written with the stamp of
/// that. Poses of frames that are starting or lost are left out; guessed ones are not.
/// Thread-safe.
class LiveTrajectory {
 public:
  /// @throws FileError
  explicit LiveTrajectory(const std::string& path);

  /// Notes a frame that is about to be fed.
  void expect(const gslam::Frame& frame);
  void add(const gslam::TrackedPose& pose);

  /// The last pose of each frame, where it has one. Of frames with the same stamp, the last
  /// frame's.
  gslam::Trajectory last() const;
  /// Poses that are not finite, which count as lost, and of frames that were not fed, which are in
  /// no trajectory.
  std::uint64_t invalidCount() const;
  /// Poses whose stamp is not that of their frame.
  std::uint64_t wrongStamps() const;
  /// @throws FileError when something could not be written
  void check() const { file_.check(); }

 private:
  struct Known {
    std::int64_t stamp;
    bool is_said;   // something, whatever it was
    bool has_pose;  // the last one
    gslam::SE3d pose;
  };
  mutable std::mutex mutex_;
  LineFile file_;
  std::unordered_map<std::uint64_t, Known> frames_;
  std::uint64_t invalid_ = 0, wrong_stamps_ = 0;
};

/// Reads what LiveTrajectory wrote, also where a crash cut its last line off; of no file, nothing.
/// @throws FileError, ParseError
gslam::Trajectory readLiveTrajectory(const std::string& path);

}  // namespace app

#endif  // GSLAM_APPS_LIVE_TRAJECTORY_H
