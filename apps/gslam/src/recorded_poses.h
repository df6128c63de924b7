// Poses in recordings of ROS, where the program was built with datasets_ros.
#ifndef GSLAM_APPS_RECORDED_POSES_H
#define GSLAM_APPS_RECORDED_POSES_H

#include <gslam/core/trajectory.h>

#include <string>
#include <vector>

namespace app {

struct RecordedPoses {
  std::string topic;
  gslam::Trajectory trajectory;
  std::vector<std::string> remarks;
};

/// Whether a path looks like a recording of ROS, also in a program that cannot read one.
bool isRecording(const std::string& path);

/// Reads the poses of a topic.
/// @param topic   empty: the only one that has poses
/// @param option  that says it, for errors
/// @throws ConfigError where it must be said, Error where none has poses, or this program was built
///   without datasets_ros
RecordedPoses readRecordedPoses(const std::string& path, const std::string& topic,
                                const std::string& option);

}  // namespace app

#endif  // GSLAM_APPS_RECORDED_POSES_H
