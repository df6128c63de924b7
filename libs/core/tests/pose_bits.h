// Poses, compared bit by bit.
#ifndef GSLAM_CORE_TESTS_POSE_BITS_H
#define GSLAM_CORE_TESTS_POSE_BITS_H

#include <gslam/geometry/se3.h>

#include <string>

inline std::string bitsOf(const gslam::SE3d& pose) {
  return std::string(reinterpret_cast<const char*>(&pose), sizeof(pose));
}

#endif  // GSLAM_CORE_TESTS_POSE_BITS_H
