#include <gslam/core/plugin.h>
#include <gslam/datasets/formats.h>

GSLAM_PLUGIN(kittiraw, "1.0.0",
             "KITTI raw: drives with cameras, an inertial unit and satellite positions") {
  registry.add(gslam::kittiRawFactory());
}
