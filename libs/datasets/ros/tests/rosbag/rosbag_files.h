// Bags as rosbag_storage writes and reads them.
#ifndef GSLAM_DATASETS_ROS_TESTS_ROSBAG_ROSBAG_FILES_H
#define GSLAM_DATASETS_ROS_TESTS_ROSBAG_ROSBAG_FILES_H

#include <gtest/gtest.h>

#include <cstdint>
#include <string>
#include <vector>

#include "../recorded.h"

namespace rosbag_files {

struct BagShape {
  std::string compression = "none";  // bz2, lz4
  std::uint32_t chunk_size = 1 << 20;
  bool is_closed = true;
};

/// Messages of any bytes.
void write(const std::string& path, const std::vector<Recorded>& messages, const BagShape& shape);

/// Messages of the packages of ROS 1: what its own code makes of them.
void writeTrueMessages(const std::string& path);

/// All messages as rosbag::View has them.
std::vector<Recorded> read(const std::string& path);

}  // namespace rosbag_files

#endif  // GSLAM_DATASETS_ROS_TESTS_ROSBAG_ROSBAG_FILES_H
