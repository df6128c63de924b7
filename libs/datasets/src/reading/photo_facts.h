// What a photo's file says of how it was taken: EXIF, and the XMP of drones.
#ifndef GSLAM_DATASETS_SRC_READING_PHOTO_FACTS_H
#define GSLAM_DATASETS_SRC_READING_PHOTO_FACTS_H

#include <gslam/core/sensor.h>

#include <cstdint>
#include <string>
#include <vector>

#include "file_tree.h"

namespace gslam {
inline namespace v1 {
namespace reading {

/// What is not known is 0, or has a flag that is false.
struct PhotoFacts {
  bool has_position = false;      ///< with an altitude, and a fix of the receiver
  Geodetic position{};            ///< its altitude is above the sea, as EXIF has it
  std::int64_t gps_stamp = 0;     ///< nanoseconds, UTC since 1970, of the receiver
  std::int64_t camera_stamp = 0;  ///< nanoseconds since 1970 by the camera's clock, whose zone is
                                  ///< not known
  std::string camera;             ///< maker and model
  double focal_length_35mm = 0;   ///< millimetres, as if the film were 36 mm wide
  std::int64_t exposure = 0;      ///< nanoseconds
  bool has_gimbal = false;        ///< whether the next three mean anything (DJI)
  double gimbal_yaw = 0;          ///< degrees, clockwise from north
  double gimbal_pitch = 0;        ///< degrees, -90 looks down
  double gimbal_roll = 0;         ///< degrees
  double height = 0;              ///< metres above the place of take-off (DJI)
};

/// @param bytes  of the file
/// @param name   what errors call it
/// @throws FileError when they are no image
PhotoFacts photoFacts(const std::vector<std::uint8_t>& bytes, const std::string& name);

/// The same of a file in a tree, of which only the beginning is read where that is enough.
PhotoFacts photoFacts(const FileTree& tree, const std::string& file);

/// Whether an image file in a tree has a position.
bool hasPosition(const FileTree& tree, const std::string& file);

}  // namespace reading
}  // namespace v1
}  // namespace gslam

#endif  // GSLAM_DATASETS_SRC_READING_PHOTO_FACTS_H
