#ifndef GSLAM_PLUGINS_SLAM_VISUAL_SCENE_VIEW_H
#define GSLAM_PLUGINS_SLAM_VISUAL_SCENE_VIEW_H

#include <gslam/core.h>

#include <cmath>
#include <cstdint>
#include <memory>
#include <vector>

#include "scene/eye.h"
#include "scene/feature_grid.h"

namespace visual {

/// What was found in a frame: features with their descriptors and, where it was measured, depth.
///
/// Immutable once made, so that threads may share it.
struct View {
  std::uint64_t frame = 0;  ///< Frame::id
  std::int64_t stamp = 0;   ///< Frame::stamp
  /// Features and descriptors, which a keyframe shares.
  std::shared_ptr<const gslam::KeyframeContent> content;
  std::vector<float> depth;    ///< of each feature, metres; 0: not measured
  std::vector<float> right_u;  ///< of each feature, in the second camera; NaN: not measured
  FeatureGrid grid;

  const std::vector<gslam::Feature>& features() const noexcept { return content->features; }
  const gslam::Image& descriptors() const noexcept { return content->descriptors; }
  std::size_t size() const noexcept { return content->features.size(); }
  gslam::Vec2d pixel(std::size_t i) const noexcept {
    const gslam::Vec2f& p = content->features[i].pixel;
    return {double(p[0]), double(p[1])};
  }
  bool hasRight(std::size_t i) const noexcept { return !std::isnan(right_u[i]); }
  /// Whether a depth was measured that is near enough to be a position.
  bool isClose(std::size_t i, const Eye& eye) const noexcept {
    return depth[i] > 0 && double(depth[i]) <= eye.far;
  }
};

}  // namespace visual

#endif  // GSLAM_PLUGINS_SLAM_VISUAL_SCENE_VIEW_H
