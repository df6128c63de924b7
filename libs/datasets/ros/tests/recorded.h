// Messages that tests record, in any kind of file.
#ifndef GSLAM_DATASETS_ROS_TESTS_RECORDED_H
#define GSLAM_DATASETS_ROS_TESTS_RECORDED_H

#include <gslam/base/error.h>

#include <cstdint>
#include <cstdio>
#include <filesystem>
#include <fstream>
#include <functional>
#include <string>
#include <vector>

#include "encoder.h"

using RawBytes = std::vector<std::uint8_t>;

/// A message to be recorded. Types are as ROS 1 has them: "sensor_msgs/Imu".
struct Recorded {
  std::string topic, type;
  std::int64_t received = 0;
  std::vector<std::uint8_t> bytes;
};

/// "sensor_msgs/msg/Imu".
inline std::string ros2Type(const std::string& type) {
  const std::size_t slash = type.find('/');
  return type.substr(0, slash) + "/msg" + type.substr(slash);
}

inline std::string folderOfTests() {
  return std::filesystem::temp_directory_path().string() + "/";
}

inline void writeFile(const std::string& path, const std::vector<std::uint8_t>& bytes) {
  std::ofstream file(path, std::ios::binary);
  file.write(reinterpret_cast<const char*>(bytes.data()), std::streamsize(bytes.size()));
  if (!file) throw gslam::FileError(path, "cannot be written");
}

inline std::vector<std::uint8_t> readFile(const std::string& path) {
  std::ifstream file(path, std::ios::binary);
  if (!file) throw gslam::FileError(path, "cannot be opened");
  return std::vector<std::uint8_t>(std::istreambuf_iterator<char>(file), {});
}

/// What an Error says; empty where nothing was thrown.
inline std::string errorOf(const std::function<void()>& call) {
  try {
    call();
  } catch (const gslam::Error& error) {
    return error.what();
  }
  return "";
}

inline bool has(const std::string& text, const std::string& part) {
  return text.find(part) != std::string::npos;
}

inline bool hasAny(const std::vector<std::string>& texts, const std::string& part) {
  for (const std::string& text : texts) {
    if (has(text, part)) return true;
  }
  return false;
}

#endif  // GSLAM_DATASETS_ROS_TESTS_RECORDED_H
