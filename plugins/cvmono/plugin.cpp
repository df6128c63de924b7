#include <gslam/core/plugin.h>
#include <gslam/datasets/formats.h>

GSLAM_PLUGIN(cvmono, "1.0.0", "One camera: images, videos, devices") {
  registry.add(gslam::cvMonoFactory());
}
