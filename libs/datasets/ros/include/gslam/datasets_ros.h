#ifndef GSLAM_DATASETS_ROS_H
#define GSLAM_DATASETS_ROS_H

/// @file
/// All of GSLAM::datasets_ros.

#include <gslam/datasets_ros/recording.h>
#include <gslam/datasets_ros/ros_dataset.h>
#include <gslam/datasets_ros/version.h>

#endif  // GSLAM_DATASETS_ROS_H
