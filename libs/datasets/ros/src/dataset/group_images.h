// Frames made of the images of several cameras.
#ifndef GSLAM_DATASETS_ROS_SRC_DATASET_GROUP_IMAGES_H
#define GSLAM_DATASETS_ROS_SRC_DATASET_GROUP_IMAGES_H

#include <gslam/datasets_ros/export.h>

#include <cstddef>
#include <cstdint>
#include <vector>

namespace gslam {
inline namespace v1 {
namespace ros {

constexpr std::size_t kNoImage = static_cast<std::size_t>(-1);

/// A frame: for each camera the place of its image, or kNoImage.
struct ImageGroup {
  std::int64_t stamp = 0;  ///< of the image of the first camera that has one
  std::vector<std::size_t> images;
};

/// Puts images together that were taken at the same time: camera after camera, the images that are
/// no further from a frame than the tolerance go to it, by associate(); each other one begins a
/// frame of its own.
/// @param stamps     for each camera, ascending, none twice
/// @param tolerance  nanoseconds
/// @return by stamp, none twice
GSLAM_DATASETS_ROS_EXPORT std::vector<ImageGroup> groupImages(
    const std::vector<std::vector<std::int64_t>>& stamps, std::int64_t tolerance);

/// Whether more than a thousand stamps lie within the tolerance of one: associate() takes time and
/// memory for each such pair, and the tolerance cannot be what was meant.
/// @param stamps  ascending
GSLAM_DATASETS_ROS_EXPORT bool isDense(const std::vector<std::int64_t>& stamps,
                                       std::int64_t tolerance) noexcept;

/// Whether each camera has an image.
GSLAM_DATASETS_ROS_EXPORT bool isComplete(const ImageGroup& group) noexcept;

}  // namespace ros
}  // namespace v1
}  // namespace gslam

#endif  // GSLAM_DATASETS_ROS_SRC_DATASET_GROUP_IMAGES_H
