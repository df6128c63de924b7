#include "live_trajectory.h"

#include <gslam/core/trajectory_file.h>

namespace app {

LiveTrajectory::LiveTrajectory(const std::string& path) : file_(path) {
  file_.append("# timestamp tx ty tz qx qy qz qw\n");
}

void LiveTrajectory::add(const gslam::TrackedPose& pose) {
  const std::lock_guard<std::mutex> lock(mutex_);
  if (!frames_.insert(pose.frame).second || !gslam::hasPose(pose.state)) return;
  gslam::detail::LineWriter line(' ');
  if (!gslam::detail::writeTumLine(line, {pose.stamp, pose.T_world_body})) return;  // not finite
  line.endLine();
  file_.append(line.take());
}

}  // namespace app
