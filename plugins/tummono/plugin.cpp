#include <gslam/core/plugin.h>
#include <gslam/datasets/formats.h>

GSLAM_PLUGIN(tummono, "1.0.0", "TUM monoVO: exposures and photometric calibration") {
  registry.add(gslam::tumMonoFactory());
}
