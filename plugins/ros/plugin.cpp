#include <gslam/core/plugin.h>
#include <gslam/datasets_ros/ros_dataset.h>

GSLAM_PLUGIN(ros, "1.0.0", "Recordings of ROS 1 and ROS 2: .bag, .db3, .mcap") {
  registry.add(gslam::rosFactory());
}
