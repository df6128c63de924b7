// Names and words in small letters, and what is in them.
#ifndef GSLAM_DATASETS_ROS_SRC_STORAGE_TEXT_H
#define GSLAM_DATASETS_ROS_SRC_STORAGE_TEXT_H

#include <string>

namespace gslam {
inline namespace v1 {
namespace ros {

inline bool contains(const std::string& text, const char* part) {
  return text.find(part) != std::string::npos;
}

inline std::string lower(std::string text) {
  for (char& c : text) {
    if (c >= 'A' && c <= 'Z') c = static_cast<char>(c - 'A' + 'a');
  }
  return text;
}

}  // namespace ros
}  // namespace v1
}  // namespace gslam

#endif  // GSLAM_DATASETS_ROS_SRC_STORAGE_TEXT_H
