#include "tracking/tracker.h"

#include <algorithm>
#include <utility>

namespace visual {

using gslam::KeyframeId;
using gslam::kNoPoint;
using gslam::PointId;
using gslam::SE3d;
using gslam::TrackingState;

namespace {

// Frames after a keyframe in which sightings of points are counted.
constexpr int kMostCounted = 60;

}  // namespace

Tracker::Tracker(const Options& options, Relocalizer& relocalizer)
    : options_(options), relocalizer_(relocalizer) {}

Tracked Tracker::begin(const std::shared_ptr<const View>& view, const Scene& scene) {
  last_ = view;
  reference_ = scene.newest();
  T_reference_last_ = SE3d();
  reference_stretch_ = scene.of(reference_).stretch;
  T_last_next_ = SE3d();
  is_lost_ = false;
  frames_lost_ = 0;
  frames_since_keyframe_ = 0;
  most_seen_ = 0;
  expected_.clear();
  found_.clear();
  recallLast(scene);
  Tracked tracked;
  tracked.state = TrackingState::tracking;
  tracked.reference = reference_;
  tracked.T_world_body = T_world_last_;
  return tracked;
}

// The frame before, as the scene has it now: keyframes moved, points came and went.
void Tracker::recallLast(const Scene& scene) {
  SE3d T_stand_in_reference;
  const KeyframeId stand_in = scene.standIn(reference_, T_stand_in_reference);
  const double stretched = scene.stretch(reference_) / reference_stretch_;
  const SE3d T_reference_last(T_reference_last_.rotation(),
                              stretched * T_reference_last_.translation());
  T_world_last_ = scene.map.at(stand_in).T_world_body * T_stand_in_reference * T_reference_last;
  const KeyframeId newest = scene.newest();
  if (scene.of(newest).view != last_) return;
  last_matches_.clear();
  const gslam::Span<const PointId> points = scene.map.pointsSeen(newest);
  for (std::uint32_t i = 0; i < points.size(); ++i) {
    if (points[i] != kNoPoint) last_matches_.push_back({i, points[i], 0});
  }
}

bool Tracker::followLast(const View& view, const Scene& scene, double window) {
  T_world_body_ = T_world_last_ * T_last_next_;
  sought_.clear();
  for (const Match& match : last_matches_) {
    const gslam::MapPoint* const point = scene.map.find(match.point);
    const gslam::Image* const descriptor = scene.map.descriptor(match.point);
    if (point == nullptr || descriptor == nullptr) continue;
    sought_.push_back({match.point, point->position, descriptor->bytes(),
                       last_->features()[match.feature].octave, window});
  }
  const SE3d T_camera_world = (T_world_body_ * scene.eye.T_body_camera).inverse();
  matches_ = projector_.match(view, scene.eye, T_camera_world, sought_, {kLooseDistance, 0.9F});
  if (matches_.size() < 20) return false;
  return fitter_.refine(view, scene, matches_, T_world_body_);
}

bool Tracker::followReference(const View& view, const Scene& scene) {
  SE3d unused;
  const KeyframeId reference = scene.standIn(reference_, unused);
  matches_ = matchKeyframe(view, scene, reference, {kLooseDistance, 0.75F});
  return fitter_.find(view, scene, matches_, options_.seed, T_world_body_);
}

bool Tracker::followMap(const View& view, const Scene& scene) {
  if (!local_map_.gather(scene, matches_)) return false;
  const SE3d T_camera_world = (T_world_body_ * scene.eye.T_body_camera).inverse();
  sought_.clear();
  // Just found again, or with a coarse idea of the motion: look farther around.
  const double window = frames_since_found_ < 2 ? 3 : 1;
  findVisible(scene, T_camera_world, local_map_.points(), 4 * window, sought_);
  matches_ = projector_.match(view, scene.eye, T_camera_world, sought_, {kLooseDistance, 0.8F});
  if (!fitter_.refine(view, scene, matches_, T_world_body_)) return false;
  const std::size_t least = std::size_t(options_.tracking.least_inliers);
  // Of one that was just found again it takes more, but not more than it was found by.
  const bool is_young = frames_since_found_ < 30;
  return matches_.size() >= (is_young ? std::min(3 * least / 2, found_by_) : least);
}

// Where far less of the map is found than in the frame before, the motion may be a wrong one, after
// a frame from elsewhere for example: then the reference is asked as well, and whoever finds more
// is right.
bool Tracker::follow(const View& view, const Scene& scene) {
  recallLast(scene);
  const double window = options_.tracking.window;
  const bool is_moved =
      (followLast(view, scene, scene.eye.kind == SensorKind::stereo ? window / 2 : window) ||
       followLast(view, scene, 2 * window)) &&
      followMap(view, scene);
  if (is_moved && 2 * matches_.size() >= last_matches_.size()) return true;
  const SE3d T_world_moved = T_world_body_;
  std::vector<Match> moved;
  std::vector<SoughtPoint> sought;
  moved.swap(matches_);
  sought.swap(sought_);
  const bool is_near = followReference(view, scene) && followMap(view, scene);
  if (!is_moved || (is_near && matches_.size() > moved.size())) return is_near;
  T_world_body_ = T_world_moved;
  matches_.swap(moved);
  sought_.swap(sought);
  return true;
}

Tracked Tracker::track(const std::shared_ptr<const View>& view, const Scene& scene,
                       bool is_mapper_idle) {
  bool is_followed = !is_lost_ && follow(*view, scene);
  if (!is_followed && findAgain(*view, scene)) {
    frames_since_found_ = 0;
    found_by_ = matches_.size();
    is_followed = followMap(*view, scene);
  }
  if (is_followed) return keep(view, scene, is_mapper_idle);
  is_lost_ = true;
  ++frames_lost_;
  Tracked lost;
  lost.reason = view->size() < std::size_t(options_.tracking.least_inliers)
                    ? "the image has only " + std::to_string(view->size()) + " features"
                    : "too little of the image fits the map";
  return lost;
}

// As if it went on as it did, for a while; half of the way may be wrong, or a part of the depth.
bool Tracker::findAgain(const View& view, const Scene& scene) {
  constexpr int kMostFrames = 60;
  if (frames_lost_ >= kMostFrames)
    return relocalizer_.locate(view, scene, nullptr, matches_, T_world_body_);
  recallLast(scene);
  SE3d unused;
  Relocalizer::Guess guess{scene.standIn(reference_, unused), T_world_last_, 0};
  for (int i = 0; i <= frames_lost_; ++i) guess.T_world_body = guess.T_world_body * T_last_next_;
  guess.T_world_body = guess.T_world_body.normalized();
  const double way = double(frames_lost_ + 1) * T_last_next_.translation().norm();
  guess.within = 0.5 * way + 0.2 * medianDepth(scene, guess.reference);
  return relocalizer_.locate(view, scene, &guess, matches_, T_world_body_);
}

Tracked Tracker::keep(const std::shared_ptr<const View>& view, const Scene& scene,
                      bool is_mapper_idle) {
  if (frames_since_keyframe_ < kMostCounted) {
    for (const SoughtPoint& point : sought_) expected_.push_back(point.id);
    for (const Match& match : matches_) found_.push_back(match.point);
  }
  const bool has_motion = !is_lost_ && frames_since_found_ > 0;
  T_last_next_ = has_motion ? T_world_last_.inverse() * T_world_body_ : SE3d();
  reference_ = local_map_.referenceOf(scene, matches_);
  reference_stretch_ = scene.of(reference_).stretch;
  T_reference_last_ = scene.map.at(reference_).T_world_body.inverse() * T_world_body_;
  last_ = view;
  last_matches_ = matches_;
  is_lost_ = false;
  frames_lost_ = 0;
  ++frames_since_found_;
  ++frames_since_keyframe_;
  Tracked tracked;
  tracked.state = TrackingState::tracking;
  tracked.T_world_body = T_world_body_;
  tracked.reference = reference_;
  tracked.T_reference_body = T_reference_last_;
  tracked.stretch = reference_stretch_;
  tracked.matches = matches_;
  tracked.is_keyframe_due = isKeyframeDue(*view, scene, is_mapper_idle);
  return tracked;
}

// When much of what was seen after the last keyframe is out of sight, or when there is much near
// the camera that the map does not have.
bool Tracker::isKeyframeDue(const View& view, const Scene& scene, bool is_mapper_idle) {
  const TrackingOptions& o = options_.tracking;
  const std::size_t seen = matches_.size();
  most_seen_ = std::max(most_seen_, seen);
  if (frames_since_keyframe_ <= o.keyframe_gap || seen < 15) return false;
  std::size_t close = 0, close_known = 0;
  if (scene.eye.hasDepth()) {
    for (std::size_t i = 0; i < view.size(); ++i) close += view.isClose(i, scene.eye) ? 1 : 0;
    for (const Match& match : matches_) {
      close_known += view.isClose(match.feature, scene.eye) ? 1 : 0;
    }
  }
  const bool lacks_close = close_known < 100 && close > close_known + 70;
  const double ratio = scene.eye.hasDepth() ? o.keyframe_ratio : 0.5 * (1 + o.keyframe_ratio);
  const bool has_lost_much = double(seen) < ratio * double(most_seen_);
  const bool is_weak = seen < 3 * std::size_t(o.least_inliers) || lacks_close;
  const bool is_long_ago =
      frames_since_keyframe_ >= o.most_gap && double(seen) < 0.9 * double(most_seen_);
  return is_weak || ((has_lost_much || is_long_ago) && is_mapper_idle);
}

KeyframeRequest Tracker::takeKeyframe() {
  KeyframeRequest request;
  request.view = last_;
  request.T_world_body = T_world_body_;
  request.reference = reference_;
  request.T_reference_body = T_reference_last_;
  request.stretch = reference_stretch_;
  request.matches = last_matches_;
  request.expected.swap(expected_);
  request.found.swap(found_);
  frames_since_keyframe_ = 0;
  most_seen_ = 0;
  return request;
}

}  // namespace visual
