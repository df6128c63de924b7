#ifndef GSLAM_PLUGINS_SLAM_VISUAL_VISUAL_SLAM_H
#define GSLAM_PLUGINS_SLAM_VISUAL_VISUAL_SLAM_H

#include <gslam/core.h>

namespace visual {

/// The SLAM system `visual`: features, keyframes, loops; for a camera, a stereo pair or a camera
/// with depth. The README beside this file says how it works and lists its parameters.
gslam::SlamFactory visualFactory();

}  // namespace visual

#endif  // GSLAM_PLUGINS_SLAM_VISUAL_VISUAL_SLAM_H
