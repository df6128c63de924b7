#ifndef GSLAM_PLUGINS_EXAMPLE_POSE_PRINTER_H
#define GSLAM_PLUGINS_EXAMPLE_POSE_PRINTER_H

#include <gslam/core.h>

namespace example {

/// An application: prints where every SLAM system says that the body is.
gslam::ApplicationFactory posePrinterFactory();

}  // namespace example

#endif  // GSLAM_PLUGINS_EXAMPLE_POSE_PRINTER_H
