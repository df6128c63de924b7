#ifndef GSLAM_PLUGINS_SLAM_VISUAL_TRACKING_PATIENCE_H
#define GSLAM_PLUGINS_SLAM_VISUAL_TRACKING_PATIENCE_H

#include <gslam/core.h>

#include <algorithm>
#include <cstddef>

namespace visual {

/// When a map of few keyframes, in which the camera is lost, is sooner made anew: after as many
/// frames as it was of use, so that one dark frame does not cost a map, and a bad one goes soon.
class Patience {
 public:
  /// @param state      of the next frame
  /// @param keyframes  in the map
  /// @return whether to begin anew
  bool isOver(gslam::TrackingState state, std::size_t keyframes) {
    if (state == gslam::TrackingState::tracking) {
      ++followed_;
      lost_ = 0;
      return false;
    }
    ++lost_;
    return keyframes <= kYoung && lost_ > std::min(followed_, kMost);
  }
  void reset() { followed_ = lost_ = 0; }

 private:
  static constexpr std::size_t kYoung = 5;  // keyframes
  static constexpr std::size_t kMost = 30;  // frames
  std::size_t followed_ = 0, lost_ = 0;
};

}  // namespace visual

#endif  // GSLAM_PLUGINS_SLAM_VISUAL_TRACKING_PATIENCE_H
