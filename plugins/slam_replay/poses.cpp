#include "poses.h"

#include <gslam/core/trajectory_file.h>

#include <cerrno>
#include <fstream>
#include <random>
#include <sstream>
#include <utility>
#include <vector>

namespace replay {
namespace {

using gslam::SE3d;
using gslam::SO3d;
using gslam::Vec3d;

std::string contentOf(const std::string& path) {
  std::ifstream in(path, std::ios::binary);
  if (!in) throw gslam::FileError(path, "cannot be opened", errno);
  std::ostringstream content;
  content << in.rdbuf();
  if (in.bad()) throw gslam::FileError(path, "cannot be read", errno);
  return std::move(content).str();
}

}  // namespace

gslam::Trajectory withDrift(const gslam::Trajectory& truth, const PoseOptions& options) {
  std::vector<gslam::StampedPose> poses;
  poses.reserve(truth.size());
  double way = 0;
  Vec3d before{}, place{};
  for (const gslam::StampedPose& pose : truth) {
    const Vec3d step = poses.empty() ? pose.pose.translation() : pose.pose.translation() - before;
    const SO3d turned = SO3d::exp({{0, 0, options.drift_rad_per_m * way}});
    place = place + turned * step;
    if (!poses.empty()) way += step.norm();
    before = pose.pose.translation();
    const Vec3d pushed = place + options.drift * way * Vec3d{{1, 0, 0}};
    const SO3d heading = SO3d::exp({{0, 0, options.drift_rad_per_m * way}});
    poses.push_back({pose.stamp, SE3d(heading * pose.pose.rotation(), options.scale * pushed)});
  }
  return gslam::Trajectory(std::move(poses));
}

Poses::Poses(const PoseOptions& options) : options_(options) {
  const std::string content = contentOf(options.file);
  gslam::TrajectoryFileOptions reading;
  reading.format = gslam::detectTrajectoryFormat(content, options.file);
  reading.duplicates = gslam::DuplicateStamps::keep_first;  // public ground truth has some
  is_numbered_ = reading.format == gslam::TrajectoryFormat::kitti;
  trajectory_ = withDrift(gslam::parseTrajectory(content, options.file, reading), options);
}

bool Poses::smooth(const gslam::Frame& frame, SE3d& pose) const {
  const std::int64_t stamp = is_numbered_ ? static_cast<std::int64_t>(frame.id) : frame.stamp;
  if (options_.max_gap == 0) return trajectory_.interpolate(stamp, pose);
  return trajectory_.interpolate(stamp, pose, options_.max_gap);
}

SE3d Poses::withNoise(const SE3d& pose, std::uint64_t frame) const {
  std::seed_seq seed{std::uint32_t(options_.seed), std::uint32_t(options_.seed >> 32),
                     std::uint32_t(frame), std::uint32_t(frame >> 32)};
  std::mt19937_64 random(seed);
  std::normal_distribution<double> normal;
  Vec3d move{}, turn{};
  for (std::size_t i = 0; i < 3; ++i) move[i] = options_.noise_m * normal(random);
  for (std::size_t i = 0; i < 3; ++i) turn[i] = options_.noise_rad * normal(random);
  return SE3d((pose.rotation() * SO3d::exp(turn)).normalized(), pose.translation() + move);
}

}  // namespace replay
