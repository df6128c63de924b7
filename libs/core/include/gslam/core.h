#ifndef GSLAM_CORE_H
#define GSLAM_CORE_H

/// @file
/// All of GSLAM::core that needs no other library.

#include <gslam/core/application.h>
#include <gslam/core/covisibility.h>
#include <gslam/core/dataset.h>
#include <gslam/core/frame.h>
#include <gslam/core/image.h>
#include <gslam/core/map.h>
#include <gslam/core/map_check.h>
#include <gslam/core/map_file.h>
#include <gslam/core/map_range.h>
#include <gslam/core/map_trajectory.h>
#include <gslam/core/map_types.h>
#include <gslam/core/ply.h>
#include <gslam/core/point_index.h>
#include <gslam/core/registry.h>
#include <gslam/core/rig.h>
#include <gslam/core/sensor.h>
#include <gslam/core/shared_map.h>
#include <gslam/core/slam.h>
#include <gslam/core/trajectory.h>
#include <gslam/core/version.h>

#endif  // GSLAM_CORE_H
