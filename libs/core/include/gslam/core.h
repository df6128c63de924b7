#ifndef GSLAM_CORE_H
#define GSLAM_CORE_H

/// @file
/// All that a dataset, a SLAM system or an application needs. Programs that run them include
/// plugins.h, open_dataset.h and isolated_slam.h beside it; files are read and written by
/// trajectory_file.h, map_file.h and ply.h; opencv.h and eigen.h are for those who have these.

#include <gslam/core/application.h>
#include <gslam/core/associate.h>
#include <gslam/core/covisibility.h>
#include <gslam/core/dataset.h>
#include <gslam/core/frame.h>
#include <gslam/core/geodesy.h>
#include <gslam/core/image.h>
#include <gslam/core/map.h>
#include <gslam/core/map_check.h>
#include <gslam/core/map_range.h>
#include <gslam/core/map_trajectory.h>
#include <gslam/core/map_types.h>
#include <gslam/core/memory_dataset.h>
#include <gslam/core/parameters.h>
#include <gslam/core/pixel_type.h>
#include <gslam/core/player.h>
#include <gslam/core/plugin.h>
#include <gslam/core/point_index.h>
#include <gslam/core/recorder.h>
#include <gslam/core/registry.h>
#include <gslam/core/rig.h>
#include <gslam/core/run.h>
#include <gslam/core/sensor.h>
#include <gslam/core/shared_map.h>
#include <gslam/core/slam.h>
#include <gslam/core/slam_thread.h>
#include <gslam/core/slam_topics.h>
#include <gslam/core/stamp.h>
#include <gslam/core/trajectory.h>
#include <gslam/core/version.h>

#endif  // GSLAM_CORE_H
