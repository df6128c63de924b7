#include <gslam/core/plugin.h>
#include <gslam/datasets/formats.h>

GSLAM_PLUGIN(folder, "1.0.0", "Users' own cameras, described by dataset.yaml") {
  registry.add(gslam::folderFactory());
}
