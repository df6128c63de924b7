#ifndef GSLAM_OPTIMIZER_FILES_H
#define GSLAM_OPTIMIZER_FILES_H

#include <gslam/optimizer/files/bal.h>
#include <gslam/optimizer/files/bundler.h>
#include <gslam/optimizer/files/colmap.h>
#include <gslam/optimizer/files/g2o.h>
#include <gslam/optimizer/files/toro.h>

/// @file
/// Files of bundles and pose graphs.

#endif  // GSLAM_OPTIMIZER_FILES_H
