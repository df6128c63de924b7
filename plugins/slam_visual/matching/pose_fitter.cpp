#include "matching/pose_fitter.h"

#include <gslam/estimator/estimate_absolute_pose.h>
#include <gslam/optimizer/pose_problem.h>
#include <gslam/optimizer_pba.h>

#include <cmath>
#include <limits>

namespace visual {

using gslam::SE3d;
using gslam::Vec2d;
using gslam::Vec3d;

namespace {

constexpr std::size_t kLeastMatches = 10;

}  // namespace

double squaredError(const Eye& eye, const View& view, std::uint32_t feature,
                    const Vec3d& point_in_camera) {
  constexpr double kInfinite = std::numeric_limits<double>::infinity();
  Vec2d seen;
  if (!eye.camera.project(point_in_camera, seen)) return kInfinite;
  const Vec2d pixel = view.pixel(feature);
  double sum = (seen - pixel).squaredNorm();
  if (view.hasRight(feature)) {
    const Vec3d& p = point_in_camera;
    if (!eye.camera.project({p[0] - eye.baseline, p[1], p[2]}, seen)) return kInfinite;
    const double right = seen[0] - double(view.right_u[feature]);
    sum += right * right;
  }
  return sum * eye.levels.information(view.features()[feature].octave);
}

bool fits(const Eye& eye, const View& view, std::uint32_t feature, const Vec3d& point_in_camera) {
  const double limit = view.hasRight(feature) ? kChi2Stereo : kChi2Pixel;
  return squaredError(eye, view, feature, point_in_camera) <= limit;
}

void PoseFitter::gather(const View& view, const Scene& scene, const std::vector<Match>& matches) {
  points_.clear();
  pixels_.clear();
  information_.clear();
  right_.clear();
  for (const Match& match : matches) {
    points_.push_back(scene.map.at(match.point).position);
    pixels_.push_back(view.pixel(match.feature));
    information_.push_back(scene.eye.levels.information(view.features()[match.feature].octave));
    right_.push_back(double(view.right_u[match.feature]));
  }
}

bool PoseFitter::refine(const View& view, const Scene& scene, std::vector<Match>& matches,
                        SE3d& T_world_body) {
  const Eye& eye = scene.eye;
  std::vector<std::uint8_t>& fitting = fitting_;
  fitting.assign(matches.size(), 1);
  gather(view, scene, matches);
  SE3d pose = T_world_body;
  std::size_t count = matches.size();
  // With a loss among outliers, then twice without those that do not fit.
  for (int round = 0; round < 3; ++round) {
    if (count < kLeastMatches) return false;
    gslam::PoseProblem problem;
    problem.cameras = gslam::Span<const gslam::Camera>(&eye.camera, 1);
    problem.T_body_camera = gslam::Span<const SE3d>(&eye.T_body_camera, 1);
    problem.points = points_;
    problem.pixels = pixels_;
    problem.information = weights(fitting);
    if (eye.hasDepth()) {
      problem.right_u = right_;
      problem.baseline = eye.baseline;
    }
    gslam::OptimizerOptions options;
    options.max_iterations = round == 0 ? 10 : 5;
    options.function_tolerance = 1e-4;
    if (round < 2) options.loss = {gslam::LossKind::Huber, std::sqrt(kChi2Pixel)};
    const gslam::OptimizedPose fitted = gslam::optimizePose(problem, pose, options);
    if (!fitted.is_usable) return false;
    pose = fitted.T_world_body;
    const SE3d T_camera_world = (pose * eye.T_body_camera).inverse();
    count = 0;
    for (std::size_t i = 0; i < matches.size(); ++i) {
      fitting[i] = fits(eye, view, matches[i].feature, T_camera_world * points_[i]) ? 1 : 0;
      count += fitting[i];
    }
  }
  if (count < kLeastMatches) return false;
  std::size_t kept = 0;
  for (std::size_t i = 0; i < matches.size(); ++i) {
    if (fitting[i] != 0) matches[kept++] = matches[i];
  }
  matches.resize(kept);
  // What is predicted from poses is a product of poses, whose error would double with each frame.
  T_world_body = pose.normalized();
  return true;
}

// The information of pixels, without what does not fit.
gslam::Span<const double> PoseFitter::weights(const std::vector<std::uint8_t>& fitting) {
  weights_.resize(information_.size());
  for (std::size_t i = 0; i < weights_.size(); ++i) {
    weights_[i] = fitting[i] != 0 ? information_[i] : 0.0;
  }
  return weights_;
}

bool PoseFitter::find(const View& view, const Scene& scene, std::vector<Match>& matches,
                      std::uint64_t seed, SE3d& T_world_body) {
  if (matches.size() < kLeastMatches) return false;
  gather(view, scene, matches);
  gslam::EstimateOptions options;
  options.threshold = 4;
  options.max_iterations = 500;
  options.seed = seed;
  const gslam::AbsolutePoseEstimate estimate =
      gslam::estimateAbsolutePose(pixels_, scene.eye.camera, points_, options);
  if (!estimate.ok() || estimate.inlier_count < kLeastMatches) return false;
  std::size_t kept = 0;
  for (std::size_t i = 0; i < matches.size(); ++i) {
    if (estimate.inliers[i] != 0) matches[kept++] = matches[i];
  }
  matches.resize(kept);
  SE3d pose = estimate.model * scene.eye.T_body_camera.inverse();
  if (!refine(view, scene, matches, pose)) return false;
  T_world_body = pose;
  return true;
}

}  // namespace visual
