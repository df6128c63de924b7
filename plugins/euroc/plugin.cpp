#include <gslam/core/plugin.h>
#include <gslam/datasets/formats.h>

GSLAM_PLUGIN(euroc, "1.0.0", "EuRoC MAV and others in the ASL layout") {
  registry.add(gslam::eurocFactory());
}
