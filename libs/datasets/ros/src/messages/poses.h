// Poses in messages of any type that has one.
#ifndef GSLAM_DATASETS_ROS_SRC_MESSAGES_POSES_H
#define GSLAM_DATASETS_ROS_SRC_MESSAGES_POSES_H

#include <gslam/datasets_ros/recording.h>
#include <gslam/geometry/pose_with_covariance.h>
#include <gslam/geometry/se3.h>

#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

#include "reading/remarks.h"

namespace gslam {
inline namespace v1 {
namespace ros {

/// Whether readPoses() knows a type, such as "nav_msgs/Odometry".
bool isPoseType(const std::string& plain_type);

/// A topic with poses, and of transforms the pair of frames.
struct PoseTopic {
  std::size_t topic = 0;
  std::string parent, child;  ///< of transforms only
};

/// Finds what a user names: "/odom", "/tf", or "/tf:map.base_link".
/// @throws Error when there is no such topic or pair of frames, or it has no poses
PoseTopic findPoseTopic(const Recording& recording, const std::string& name);

/// A pose that was recorded.
struct RecordedPose {
  std::int64_t stamp = 0;
  SE3d pose;  ///< T_parent_child
  bool has_covariance = false;
  PoseWithCovariance<SE3d> uncertain;  ///< where has_covariance
};

/// Those of a topic.
struct PoseList {
  std::vector<RecordedPose> poses;  ///< by stamp, each stamp once
  std::string parent, child;        ///< frames of the first one; empty: not said
};

/// Reads them all. What is skipped is said: poses that are not finite, and stamps that were there.
/// @param by_header  whether stamps are those of the messages, not when they were received
PoseList readPoses(const Recording& recording, const PoseTopic& topic, reading::Remarks& remarks,
                   bool by_header = true);

/// Of those a trajectory.
Trajectory trajectoryOf(const PoseList& list);

}  // namespace ros
}  // namespace v1
}  // namespace gslam

#endif  // GSLAM_DATASETS_ROS_SRC_MESSAGES_POSES_H
