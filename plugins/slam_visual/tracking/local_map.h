#ifndef GSLAM_PLUGINS_SLAM_VISUAL_TRACKING_LOCAL_MAP_H
#define GSLAM_PLUGINS_SLAM_VISUAL_TRACKING_LOCAL_MAP_H

#include <gslam/core.h>

#include <cstdint>
#include <vector>

#include "matching/matcher.h"

namespace visual {

/// The part of the scene around what a frame sees: keyframes that see the same points, their
/// neighbours, and all that these see. Keeps its memory from one frame to the next.
class LocalMap {
 public:
  /// @param matches  what the frame sees
  /// @return whether there is a keyframe that sees some of it
  bool gather(const Scene& scene, gslam::Span<const Match> matches);

  /// The keyframe that sees most of what a frame sees, without the rest; there must be one.
  gslam::KeyframeId referenceOf(const Scene& scene, gslam::Span<const Match> matches);

  const std::vector<gslam::PointId>& points() const noexcept { return points_; }

 private:
  void addKeyframe(gslam::KeyframeId id);
  void vote(const Scene& scene, gslam::Span<const Match> matches);

  std::uint32_t stamp_ = 0;
  std::vector<std::uint32_t> votes_;           // by keyframe
  std::vector<std::uint32_t> keyframe_stamp_;  // by keyframe: stamp_ where it is in the list
  std::vector<std::uint32_t> point_stamp_;     // by point
  std::vector<gslam::KeyframeId> keyframes_;
  std::vector<gslam::PointId> points_;
};

}  // namespace visual

#endif  // GSLAM_PLUGINS_SLAM_VISUAL_TRACKING_LOCAL_MAP_H
