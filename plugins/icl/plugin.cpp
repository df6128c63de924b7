#include <gslam/core/plugin.h>
#include <gslam/datasets/formats.h>

GSLAM_PLUGIN(icl, "1.0.0", "ICL-NUIM: rendered colour and depth with exact poses") {
  registry.add(gslam::iclFactory());
}
