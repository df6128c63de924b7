#include <gslam/core/plugin.h>

#include "carousel.h"
#include "dead_reckoning.h"

GSLAM_PLUGIN(example, "1.0.0", "A dataset and a SLAM system to begin from") {
  registry.add(example::carouselFactory());
  registry.add(example::deadReckoningFactory());
}
