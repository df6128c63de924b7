#include "live_trajectory.h"

#include <gslam/core/trajectory_file.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <map>
#include <utility>
#include <vector>

#include "trajectory_input.h"

namespace app {
namespace {

bool isFinite(const gslam::SE3d& pose) {
  return std::all_of(pose.data(), pose.data() + 7, [](double x) { return std::isfinite(x); });
}

}  // namespace

LiveTrajectory::LiveTrajectory(const std::string& path) : file_(path) {
  file_.append("# timestamp tx ty tz qx qy qz qw\n");
}

void LiveTrajectory::expect(const gslam::Frame& frame) {
  const std::lock_guard<std::mutex> lock(mutex_);
  frames_.insert({frame.id, {frame.stamp, false, false, gslam::SE3d()}});
}

void LiveTrajectory::add(const gslam::TrackedPose& pose) {
  const std::lock_guard<std::mutex> lock(mutex_);
  const auto found = frames_.find(pose.frame);
  if (found == frames_.end()) {
    ++invalid_;
    return;
  }
  Known& frame = found->second;
  const bool is_first = !std::exchange(frame.is_said, true);
  if (pose.stamp != frame.stamp) ++wrong_stamps_;
  frame.has_pose = gslam::hasPose(pose.state) && isFinite(pose.T_world_body);
  if (gslam::hasPose(pose.state) && !frame.has_pose) ++invalid_;
  if (!frame.has_pose) return;
  frame.pose = pose.T_world_body;
  if (!is_first) return;
  gslam::detail::LineWriter line(' ');
  gslam::detail::writeTumLine(line, {frame.stamp, frame.pose});
  line.endLine();
  file_.append(line.take());
}

gslam::Trajectory LiveTrajectory::last() const {
  const std::lock_guard<std::mutex> lock(mutex_);
  const std::map<std::uint64_t, Known> by_id(frames_.begin(), frames_.end());
  std::map<std::int64_t, gslam::SE3d> by_stamp;
  for (const auto& frame : by_id) {
    if (frame.second.has_pose) by_stamp[frame.second.stamp] = frame.second.pose;
  }
  std::vector<gslam::StampedPose> poses;
  for (const auto& pose : by_stamp) poses.push_back({pose.first, pose.second});
  return gslam::Trajectory(std::move(poses));
}

std::uint64_t LiveTrajectory::invalidCount() const {
  const std::lock_guard<std::mutex> lock(mutex_);
  return invalid_;
}

std::uint64_t LiveTrajectory::wrongStamps() const {
  const std::lock_guard<std::mutex> lock(mutex_);
  return wrong_stamps_;
}

gslam::Trajectory readLiveTrajectory(const std::string& path) {
  if (!std::filesystem::exists(path)) return {};
  std::string content = contentOf(path);
  content.resize(content.rfind('\n') + 1);
  gslam::TrajectoryFileOptions how;
  how.format = gslam::TrajectoryFormat::tum;
  how.may_be_empty = true;
  how.duplicates = gslam::DuplicateStamps::keep_first;  // two frames of a dataset may have one
  return gslam::parseTrajectory(content, path, how);
}

}  // namespace app
