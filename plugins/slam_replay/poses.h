#ifndef GSLAM_PLUGINS_SLAM_REPLAY_POSES_H
#define GSLAM_PLUGINS_SLAM_REPLAY_POSES_H

#include <gslam/core.h>

#include <cstdint>

#include "options.h"

namespace replay {

/// The poses of a file, with the errors that were asked for. The same frame has the same pose,
/// whatever frames were asked for before.
class Poses {
 public:
  /// Reads the file, in any format that readTrajectory() knows.
  /// @throws FileError, ParseError
  explicit Poses(const PoseOptions& options);

  /// T_world_body at a frame, with drift and scale, but without noise.
  /// @return false where the file says nothing
  bool smooth(const gslam::Frame& frame, gslam::SE3d& pose) const;
  /// The same with noise, which depends on the seed and the frame's id alone.
  gslam::SE3d withNoise(const gslam::SE3d& pose, std::uint64_t frame) const;

 private:
  PoseOptions options_;
  gslam::Trajectory trajectory_;
  bool is_numbered_ = false;  // its stamps are numbers of frames, as in KITTI's files
};

/// Turns the heading about z of the world and pushes along x of the world, both in proportion to
/// the way; then scales. Between any two poses, the rotation is wrong by `drift_rad_per_m` of the
/// way between them; where it is 0, the translation is by `drift` of the way.
gslam::Trajectory withDrift(const gslam::Trajectory& truth, const PoseOptions& options);

}  // namespace replay

#endif  // GSLAM_PLUGINS_SLAM_REPLAY_POSES_H
