#include <gslam/core/plugin.h>
#include <gslam/datasets/formats.h>

GSLAM_PLUGIN(7scenes, "1.0.0", "Microsoft 7-Scenes: colour and depth with poses of KinectFusion") {
  registry.add(gslam::sevenScenesFactory());
}
