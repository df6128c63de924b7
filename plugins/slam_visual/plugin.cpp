#include <gslam/core/plugin.h>

#include "visual_slam.h"

GSLAM_PLUGIN(slam_visual, "1.0.0", "Visual SLAM with features, keyframes and loops") {
  registry.add(visual::visualFactory());
}
