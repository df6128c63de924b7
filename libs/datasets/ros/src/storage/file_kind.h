// Kinds of recordings by the names of files.
#ifndef GSLAM_DATASETS_ROS_SRC_STORAGE_FILE_KIND_H
#define GSLAM_DATASETS_ROS_SRC_STORAGE_FILE_KIND_H

#include <string>

namespace gslam {
inline namespace v1 {
namespace ros {

enum class RecordingKind { none, bag, db3, mcap, packed };

inline bool hasEnding(const std::string& path, const std::string& ending) {
  if (path.size() <= ending.size()) return false;
  for (std::size_t i = 0; i < ending.size(); ++i) {
    char c = path[path.size() - ending.size() + i];
    if (c >= 'A' && c <= 'Z') c = static_cast<char>(c - 'A' + 'a');
    if (c != ending[i]) return false;
  }
  return true;
}

/// By its ending, in any case.
inline RecordingKind fileKindOf(const std::string& path) {
  // rosbag calls it so until it is closed.
  const bool is_bag = hasEnding(path, ".bag") || hasEnding(path, ".bag.active");
  if (is_bag) return RecordingKind::bag;
  if (hasEnding(path, ".db3")) return RecordingKind::db3;
  if (hasEnding(path, ".mcap")) return RecordingKind::mcap;
  const bool is_packed = hasEnding(path, ".db3.zstd") || hasEnding(path, ".mcap.zstd");
  return is_packed ? RecordingKind::packed : RecordingKind::none;
}

}  // namespace ros
}  // namespace v1
}  // namespace gslam

#endif  // GSLAM_DATASETS_ROS_SRC_STORAGE_FILE_KIND_H
