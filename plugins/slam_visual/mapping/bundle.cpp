#include "mapping/bundle.h"

#include <gslam/optimizer_pba.h>

#include <algorithm>
#include <cmath>

#include "matching/pose_fitter.h"

namespace visual {

using gslam::KeyframeId;
using gslam::Observation;
using gslam::PointId;
using gslam::SE3d;
using gslam::Span;

namespace {

constexpr std::uint32_t kNone = 0xFFFFFFFF;

}  // namespace

std::uint32_t Bundle::indexOf(KeyframeId id) {
  std::uint32_t& index = index_of_[std::uint32_t(id)];
  if (index == kNone) {
    index = std::uint32_t(keyframes_.size());
    keyframes_.push_back(id);
  }
  return index;
}

void Bundle::gather(const Scene& scene, Span<const KeyframeId> moving, Span<const PointId> points) {
  index_of_.assign(scene.facts.size(), kNone);
  keyframes_.clear();
  for (const KeyframeId id : moving) indexOf(id);
  moving_count_ = keyframes_.size();
  points_.clear();
  positions_.clear();
  observations_.clear();
  of_pose_.clear();
  of_point_.clear();
  pixels_.clear();
  information_.clear();
  right_.clear();
  outliers_.clear();
  for (const PointId id : points) {
    const Span<const Observation> seen = scene.map.observations(id);
    if (seen.empty()) continue;
    const std::uint32_t point = std::uint32_t(points_.size());
    points_.push_back(id);
    positions_.push_back(scene.map.at(id).position);
    for (const Observation& by : seen) {
      const View& view = scene.view(by.keyframe);
      const double weight = scene.eye.levels.information(view.features()[by.feature].octave);
      observations_.push_back(by);
      of_pose_.push_back(indexOf(by.keyframe));
      of_point_.push_back(point);
      pixels_.push_back(view.pixel(by.feature));
      information_.push_back({weight, 0, weight});
      right_.push_back(double(view.right_u[by.feature]));
    }
  }
  poses_.resize(keyframes_.size());
  fixed_.resize(keyframes_.size());
  std::size_t fixed_count = 0;
  for (std::size_t i = 0; i < keyframes_.size(); ++i) {
    poses_[i] = scene.map.at(keyframes_[i]).T_world_body;
    fixed_[i] = i >= moving_count_ || std::uint32_t(keyframes_[i]) == 0 ? 1 : 0;
    fixed_count += fixed_[i];
  }
  if (fixed_count == 0 && !fixed_.empty()) {
    const auto oldest = std::min_element(keyframes_.begin(), keyframes_.end());
    fixed_[std::size_t(oldest - keyframes_.begin())] = 1;
  }
}

bool Bundle::solve(const Scene& scene, const Options& options, std::size_t iterations) {
  gslam::Camera camera = scene.eye.camera;
  SE3d T_body_camera = scene.eye.T_body_camera;
  const double baseline = scene.eye.baseline;
  gslam::BundleProblem problem;
  problem.T_world_body = poses_;
  problem.pose_fixed = fixed_;
  problem.points = positions_;
  problem.cameras = Span<gslam::Camera>(&camera, 1);
  problem.T_body_camera = Span<SE3d>(&T_body_camera, 1);
  problem.observation_pose = of_pose_;
  problem.observation_point = of_point_;
  problem.pixels = pixels_;
  problem.information = information_;
  if (scene.eye.hasDepth()) {
    problem.right_u = right_;
    problem.baseline = Span<const double>(&baseline, 1);
  }
  gslam::OptimizerOptions o;
  o.backend = options.mapping.backend;
  o.max_iterations = iterations;
  o.function_tolerance = 1e-5;
  o.threads = unsigned(options.workers);
  o.loss = {gslam::LossKind::Huber, std::sqrt(kChi2Pixel)};
  const gslam::OptimizerSummary summary = gslam::optimizeBundle(problem, o);
  report_ = briefReport(summary);
  return summary.is_usable;
}

// Takes out observations that do not fit.
void Bundle::dropOutliers(const Scene& scene) {
  std::vector<SE3d> T_camera_world;
  for (const SE3d& pose : poses_) {
    T_camera_world.push_back((pose * scene.eye.T_body_camera).inverse());
  }
  std::size_t kept = 0;
  for (std::size_t i = 0; i < observations_.size(); ++i) {
    const Observation& by = observations_[i];
    if (!fits(scene.eye, scene.view(by.keyframe), by.feature,
              T_camera_world[of_pose_[i]] * positions_[of_point_[i]])) {
      outliers_.push_back(by);
      continue;
    }
    observations_[kept] = by;
    of_pose_[kept] = of_pose_[i];
    of_point_[kept] = of_point_[i];
    pixels_[kept] = pixels_[i];
    information_[kept] = information_[i];
    right_[kept++] = right_[i];
  }
  observations_.resize(kept);
  of_pose_.resize(kept);
  of_point_.resize(kept);
  pixels_.resize(kept);
  information_.resize(kept);
  right_.resize(kept);
}

bool Bundle::adjust(const Scene& scene, const Options& options, std::size_t iterations) {
  if (observations_.empty() || keyframes_.size() < 2) return false;
  if (!solve(scene, options, iterations)) return false;
  dropOutliers(scene);
  if (observations_.empty() || !solve(scene, options, 2 * iterations)) return false;
  dropOutliers(scene);
  return true;
}

}  // namespace visual
