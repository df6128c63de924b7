#ifndef GSLAM_PLUGINS_SLAM_VISUAL_SCENE_FRAME_LOG_H
#define GSLAM_PLUGINS_SLAM_VISUAL_SCENE_FRAME_LOG_H

#include <gslam/core.h>

#include <cstdint>
#include <vector>

#include "scene/scene.h"
#include "tracking/tracker.h"

namespace visual {

/// Every frame by the keyframe that it was tracked by, so that its pose is right when keyframes
/// have moved.
class FrameLog {
 public:
  /// @param view     of the frame
  /// @param tracked  what became of it
  void add(const View& view, const Tracked& tracked) {
    entries_.push_back({view.frame, view.stamp, tracked.state, tracked.reference,
                        tracked.T_reference_body, tracked.stretch});
  }
  /// What was tracked so far means nothing in the world that begins now.
  void loseAll() {
    for (Entry& entry : entries_) entry.state = gslam::TrackingState::lost;
  }
  /// The poses of all frames as the scene has them now; those of frames that were lost mean
  /// nothing.
  std::vector<gslam::TrackedPose> poses(const Scene& scene) const;

 private:
  struct Entry {
    std::uint64_t frame;
    std::int64_t stamp;
    gslam::TrackingState state;
    gslam::KeyframeId reference;
    gslam::SE3d T_reference_body;
    double stretch;
  };
  std::vector<Entry> entries_;
};

}  // namespace visual

#endif  // GSLAM_PLUGINS_SLAM_VISUAL_SCENE_FRAME_LOG_H
