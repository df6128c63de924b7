#include <gslam/core/plugin.h>
#include <gslam/datasets/formats.h>

GSLAM_PLUGIN(photos, "1.0.0", "Photos with positions, as of drones") {
  registry.add(gslam::photosFactory());
}
