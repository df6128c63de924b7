#include "tracking/initializer.h"

#include <gslam/estimator/estimate_relative_pose.h>
#include <gslam/estimator/solvers/triangulate_optimal.h>

#include <algorithm>
#include <cmath>

#include "mapping/adjusted_scene.h"
#include "mapping/local_mapper.h"
#include "matching/pose_fitter.h"

namespace visual {

using gslam::KeyframeId;
using gslam::PointId;
using gslam::SE3d;
using gslam::Vec2d;
using gslam::Vec3d;

namespace {

constexpr std::size_t kLeastPoints = 50;
constexpr double kLeastParallax = 0.0175;  // radians: a degree

// The parallax that so many of the points have, or more.
double parallaxOf(std::vector<double> parallaxes, std::size_t rank) {
  if (parallaxes.empty()) return 0;
  const std::size_t place = std::min(rank, parallaxes.size() - 1);
  std::nth_element(parallaxes.begin(), parallaxes.begin() + std::ptrdiff_t(place), parallaxes.end(),
                   [](double a, double b) { return a > b; });
  return parallaxes[place];
}

// A unit of length for which the first keyframe's points are at depth 1 in the middle.
void normalise(World& world) {
  const KeyframeId first = KeyframeId(0), second = world.newest();
  std::vector<double> depths;
  const SE3d T_camera_world = world.scene().T_world_camera(first).inverse();
  for (const auto& item : world.map().points()) {
    depths.push_back((T_camera_world * item.value.position)[2]);
  }
  std::nth_element(depths.begin(), depths.begin() + std::ptrdiff_t(depths.size() / 2),
                   depths.end());
  const double scale = 1 / depths[depths.size() / 2];
  const Vec3d centre = world.scene().T_world_camera(first).translation();
  // About the centre of the first camera, so that its pose stays.
  const SE3d camera = world.scene().T_world_camera(second);
  const SE3d moved(camera.rotation(), centre + scale * (camera.translation() - centre));
  world.moveKeyframe(second, moved * world.eye().T_body_camera.inverse());
  std::vector<PointId> points;
  for (const auto& item : world.map().points()) points.push_back(item.id);
  for (const PointId id : points) {
    world.movePoint(id, centre + scale * (world.map().at(id).position - centre));
    world.refresh(id);
  }
}

}  // namespace

Initializer::Initializer(const Options& options) : options_(options) {}

void Initializer::reset() {
  reference_ = nullptr;
}

bool Initializer::begin(const std::shared_ptr<const View>& view, World& world,
                        std::string& reason) {
  const bool has_begun = world.eye().hasDepth() ? beginWithDepth(view, world, reason)
                                                : beginWithMotion(view, world, reason);
  if (has_begun) reset();
  return has_begun;
}

bool Initializer::beginWithDepth(const std::shared_ptr<const View>& view, World& world,
                                 std::string& reason) {
  std::size_t close = 0;
  for (std::size_t i = 0; i < view->size(); ++i) close += view->isClose(i, world.eye()) ? 1 : 0;
  if (close < 2 * kLeastPoints) {
    reason = "only " + std::to_string(close) + " features have a depth, " +
             std::to_string(2 * kLeastPoints) + " are needed";
    return false;
  }
  std::vector<PointId> added;
  addPointsFromDepth(world, world.addKeyframe(view, SE3d()), added);
  return true;
}

std::vector<FeaturePair> Initializer::matchReference(const View& view) const {
  const auto fine = [](const View& v) {
    std::vector<std::uint32_t> rows;
    for (std::uint32_t i = 0; i < v.size(); ++i) {
      if (v.features()[i].octave <= 3) rows.push_back(i);
    }
    return rows;
  };
  std::vector<FeaturePair> pairs =
      matchDescriptors(reference_->descriptors(), fine(*reference_), view.descriptors(), fine(view),
                       {60.0F / 256, 0.85F});
  keepCommonTurn(reference_->features(), view.features(), pairs);
  return pairs;
}

bool Initializer::beginWithMotion(const std::shared_ptr<const View>& view, World& world,
                                  std::string& reason) {
  if (reference_ == nullptr) {
    const bool is_rich = view->size() >= 2 * kLeastPoints;
    if (is_rich) reference_ = view;
    reason = is_rich ? "waits for a second view"
                     : "the image has only " + std::to_string(view->size()) + " features, " +
                           std::to_string(2 * kLeastPoints) + " are needed";
    return false;
  }
  const std::vector<FeaturePair> pairs = matchReference(*view);
  if (pairs.size() < 2 * kLeastPoints) {
    reason = "only " + std::to_string(pairs.size()) + " features are in both views";
    reference_ = view->size() >= 2 * kLeastPoints ? view : nullptr;
    return false;
  }
  TwoViews views;
  if (!reconstruct(*view, world.eye(), pairs, views, reason)) return false;
  if (build(view, views, world)) return true;
  reason = "the first two views do not fit";
  world = World(world.eye());
  return false;
}

bool Initializer::reconstruct(const View& view, const Eye& eye,
                              const std::vector<FeaturePair>& pairs, TwoViews& result,
                              std::string& reason) const {
  std::vector<Vec2d> first, second;
  for (const FeaturePair& pair : pairs) {
    first.push_back(reference_->pixel(pair.first));
    second.push_back(view.pixel(pair.second));
  }
  gslam::EstimateOptions options;
  options.threshold = 2;
  options.seed = options_.seed;
  const gslam::RelativePoseEstimate estimate =
      gslam::estimateRelativePose(first, second, eye.camera, eye.camera, options);
  if (!estimate.ok() || estimate.alternative.has_value()) {
    reason = estimate.ok() ? "a plane is seen that two motions explain" : estimate.message;
    return false;
  }
  result.T_second_first = estimate.model;
  const Vec3d second_in_first = estimate.model.inverse().translation();
  std::vector<double> parallaxes;
  for (std::size_t i = 0; i < pairs.size(); ++i) {
    Vec3d a, b, point;
    if (estimate.inliers[i] == 0 || !eye.camera.unproject(first[i], a) ||
        !eye.camera.unproject(second[i], b) ||
        triangulateOptimal(estimate.model, a, b, point) != 1) {
      continue;
    }
    if (!fits(eye, *reference_, pairs[i].first, point) ||
        !fits(eye, view, pairs[i].second, estimate.model * point)) {
      continue;
    }
    const Vec3d other = point - second_in_first;
    const double cosine = point.dot(other) / (point.norm() * other.norm());
    const double parallax = std::acos(std::clamp(cosine, -1.0, 1.0));
    if (parallax < kLeastParallax / 3) continue;  // too far to say where
    parallaxes.push_back(parallax);
    result.pairs.push_back(pairs[i]);
    result.points.push_back(point);
  }
  const double parallax = parallaxOf(parallaxes, kLeastPoints);
  if (result.points.size() >= kLeastPoints && parallax >= kLeastParallax) return true;
  reason = "the camera has not moved enough: " + std::to_string(result.points.size()) +
           " points, parallax " + std::to_string(parallax * 57.2958) + " degrees";
  return false;
}

bool Initializer::build(const std::shared_ptr<const View>& view, const TwoViews& views,
                        World& world) const {
  const SE3d& T_body_camera = world.eye().T_body_camera;
  const KeyframeId first = world.addKeyframe(reference_, SE3d());
  const SE3d T_world_first = T_body_camera;
  const SE3d T_world_second = T_world_first * views.T_second_first.inverse();
  const KeyframeId second = world.addKeyframe(view, T_world_second * T_body_camera.inverse());
  world.setParent(second, first);
  for (std::size_t i = 0; i < views.points.size(); ++i) {
    const PointId id = world.addPoint(T_world_first * views.points[i], first, views.pairs[i].first);
    world.observe(id, second, views.pairs[i].second);
  }
  const AdjustedScene adjusted = adjustAll(world.scene(), options_);
  if (!adjusted.is_usable) return false;
  apply(adjusted, world);
  std::size_t fitting = 0;
  const SE3d T_first = world.scene().T_world_camera(first).inverse();
  const SE3d T_second = world.scene().T_world_camera(second).inverse();
  std::vector<PointId> bad;
  for (const auto& item : world.map().points()) {
    const gslam::Span<const gslam::Observation> seen = world.map().observations(item.id);
    const bool is_good =
        seen.size() == 2 &&
        fits(world.eye(), *reference_, seen[0].feature, T_first * item.value.position) &&
        fits(world.eye(), *view, seen[1].feature, T_second * item.value.position);
    fitting += is_good ? 1 : 0;
    if (!is_good) bad.push_back(item.id);
  }
  for (const PointId id : bad) world.removePoint(id);
  if (fitting < kLeastPoints) return false;
  normalise(world);
  world.refreshNeighbours(first);
  world.refreshNeighbours(second);
  return true;
}

}  // namespace visual
