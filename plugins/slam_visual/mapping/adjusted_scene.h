#ifndef GSLAM_PLUGINS_SLAM_VISUAL_MAPPING_ADJUSTED_SCENE_H
#define GSLAM_PLUGINS_SLAM_VISUAL_MAPPING_ADJUSTED_SCENE_H

#include <gslam/core.h>

#include <string>
#include <vector>

#include "options.h"
#include "scene/world.h"

namespace visual {

/// Poses and points of a bundle adjustment of all of a scene.
struct AdjustedScene {
  bool is_usable = false;
  std::vector<gslam::KeyframeId> keyframes;
  std::vector<gslam::SE3d> T_world_body;  ///< of these
  std::vector<gslam::PointId> points;
  std::vector<gslam::Vec3d> positions;  ///< of these
  std::string report;                   ///< a line
};
/// Only reads, so that it may be done in another thread while the world grows.
AdjustedScene adjustAll(const Scene& scene, const Options& options);

/// Moves what was adjusted, and what was added meanwhile with the keyframe that it was added
/// beside.
void apply(const AdjustedScene& adjusted, World& world);

}  // namespace visual

#endif  // GSLAM_PLUGINS_SLAM_VISUAL_MAPPING_ADJUSTED_SCENE_H
