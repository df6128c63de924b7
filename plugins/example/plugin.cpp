#include <gslam/core/plugin.h>

#include "carousel.h"
#include "dead_reckoning.h"
#include "pose_printer.h"

GSLAM_PLUGIN(example, "1.0.0", "A dataset, a SLAM system and an application to begin from") {
  registry.add(example::carouselFactory());
  registry.add(example::deadReckoningFactory());
  registry.add(example::posePrinterFactory());
}
