#include <gslam/core/plugin.h>
#include <gslam/datasets/formats.h>

GSLAM_PLUGIN(tumvi, "1.0.0", "TUM VI: fisheye pairs, exposures, IMU, motion capture") {
  registry.add(gslam::tumViFactory());
}
