// The folder that rosbag2 makes: files and metadata.yaml.
#ifndef GSLAM_DATASETS_ROS_SRC_STORAGE_FOLDER_H
#define GSLAM_DATASETS_ROS_SRC_STORAGE_FOLDER_H

#include <string>
#include <vector>

namespace gslam {
inline namespace v1 {
namespace ros {

struct RecordingFolder {
  std::vector<std::string> files;    ///< with their folder
  bool are_messages_packed = false;  ///< each message by zstd
  bool has_count = false;
  std::size_t message_count = 0;  ///< as metadata.yaml has it
  std::vector<std::string> remarks;
};

/// @throws FileError, ParseError for a folder that is no recording
RecordingFolder readFolder(const std::string& folder);

/// Whether there is a recording of ROS 2 in a folder.
bool isRecordingFolder(const std::string& folder);

}  // namespace ros
}  // namespace v1
}  // namespace gslam

#endif  // GSLAM_DATASETS_ROS_SRC_STORAGE_FOLDER_H
