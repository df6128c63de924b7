#include "recorded_poses.h"

#include <gslam/base/error.h>
#include <gslam/svar/error.h>
#ifdef GSLAM_HAS_DATASETS_ROS
#include <gslam/datasets_ros/recording.h>
#endif

#include <algorithm>
#include <cstddef>
#include <filesystem>
#include <memory>

namespace app {

#ifdef GSLAM_HAS_DATASETS_ROS

namespace {

// As readTrajectory() takes them. ROS 2 says "geometry_msgs/msg/PoseStamped".
bool hasPoses(const gslam::RecordedTopic& topic) {
  static const std::vector<std::string> kTypes = {"geometry_msgs/PoseStamped",
                                                  "geometry_msgs/PoseWithCovarianceStamped",
                                                  "geometry_msgs/TransformStamped",
                                                  "geometry_msgs/PointStamped",
                                                  "nav_msgs/Odometry",
                                                  "tf2_msgs/TFMessage",
                                                  "tf/tfMessage"};
  std::string type = topic.type;
  const std::size_t middle = type.find("/msg/");
  if (middle != std::string::npos) type.erase(middle, 4);
  return topic.count > 0 && std::find(kTypes.begin(), kTypes.end(), type) != kTypes.end();
}

std::string listOf(const std::vector<std::string>& names) {
  std::string text;
  for (const std::string& name : names) text += (text.empty() ? "" : ", ") + name;
  return text;
}

std::string onlyTopic(const gslam::Recording& recording, const std::string& option) {
  std::vector<std::string> all, found;
  for (const gslam::RecordedTopic& topic : recording.topics()) {
    all.push_back(topic.name + " (" + topic.type + ")");
    if (hasPoses(topic)) found.push_back(topic.name);
  }
  if (found.size() == 1) return found[0];
  if (found.empty()) {
    throw gslam::FileError(
        recording.path(),
        all.empty() ? "has no topics" : "has no topic with poses; it has " + listOf(all));
  }
  throw gslam::ConfigError(option, "must be given: these topics of " + recording.path() +
                                       " have poses: " + listOf(found));
}

}  // namespace

bool isRecording(const std::string& path) {
  return gslam::isRecording(path);
}

RecordedPoses readRecordedPoses(const std::string& path, const std::string& topic,
                                const std::string& option) {
  const std::shared_ptr<const gslam::Recording> recording = gslam::Recording::open(path);
  RecordedPoses poses;
  poses.topic = topic.empty() ? onlyTopic(*recording, option) : topic;
  poses.remarks = recording->remarks();
  poses.trajectory = gslam::readTrajectory(*recording, poses.topic, &poses.remarks);
  return poses;
}

#else

bool isRecording(const std::string& path) {
  const std::string ending = std::filesystem::path(path).extension();
  return ending == ".bag" || ending == ".db3" || ending == ".mcap";
}

RecordedPoses readRecordedPoses(const std::string& path, const std::string&, const std::string&) {
  throw gslam::FileError(path,
                         "is a recording of ROS, and this program was built without "
                         "datasets_ros, which reads them");
}

#endif

}  // namespace app
