#include <gslam/core/plugin.h>
#include <gslam/datasets/synthetic.h>

GSLAM_PLUGIN(synthetic, "1.0.0",
             "Computed worlds with exact truth, the dataset that needs no download") {
  registry.add(gslam::syntheticFactory());
}
