#include <gslam/core/plugin.h>
#include <gslam/datasets/formats.h>

GSLAM_PLUGIN(strecha, "1.0.0", "Strecha's multi-view benchmark: photos with exact cameras") {
  registry.add(gslam::strechaFactory());
}
