#include <gslam/core/plugin.h>
#include <gslam/datasets/formats.h>

GSLAM_PLUGIN(kitti, "1.0.0", "KITTI odometry: rectified stereo from a car") {
  registry.add(gslam::kittiFactory());
}
