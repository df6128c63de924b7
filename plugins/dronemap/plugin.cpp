#include <gslam/core/plugin.h>
#include <gslam/datasets/formats.h>

GSLAM_PLUGIN(dronemap, "1.0.0", "NPU DroneMap") {
  registry.add(gslam::droneMapFactory());
}
