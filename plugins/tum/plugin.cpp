#include <gslam/core/plugin.h>
#include <gslam/datasets/formats.h>

GSLAM_PLUGIN(tum, "1.0.0", "TUM RGB-D: colour and depth with poses of motion capture") {
  registry.add(gslam::tumFactory());
}
