#ifndef GSLAM_PLUGINS_SLAM_VISUAL_SCENE_EYE_H
#define GSLAM_PLUGINS_SLAM_VISUAL_SCENE_EYE_H

#include <gslam/core.h>

#include "options.h"
#include "scene/levels.h"

namespace visual {

/// The one camera that all positions of features refer to: the camera of the dataset, or the left
/// one of a rectified pair. A depth image stands for a second camera beside it.
struct Eye {
  SensorKind kind = SensorKind::mono;
  gslam::Camera camera;       ///< whose pixels features have
  gslam::SE3d T_body_camera;  ///< takes its coordinates to those of the body
  double baseline = 0;        ///< metres to the second camera; 0: there is none
  double focal = 0;           ///< pixels a radian, in the middle of the image
  double far = 0;             ///< depth beyond this one, metres, is no position
  Levels levels;              ///< of the pyramid of features

  bool hasDepth() const noexcept { return baseline > 0; }
  /// Where the second camera sees a point that the first one sees at `pixel` with that depth, u.
  /// NaN where it sees none.
  double rightOf(const gslam::Vec2d& pixel, double depth) const;
  /// The point at a pixel with that depth (z), camera coordinates.
  /// @return whether the pixel has a bearing that looks forward
  bool pointOf(const gslam::Vec2d& pixel, double depth, gslam::Vec3d& point) const;
};

}  // namespace visual

#endif  // GSLAM_PLUGINS_SLAM_VISUAL_SCENE_EYE_H
