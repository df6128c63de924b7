// Image messages to images.
#ifndef GSLAM_DATASETS_ROS_SRC_MESSAGES_IMAGE_H
#define GSLAM_DATASETS_ROS_SRC_MESSAGES_IMAGE_H

#include <gslam/core/frame.h>
#include <gslam/core/image.h>
#include <gslam/datasets_ros/export.h>

#include <string>

#include "messages.h"
#include "reading/decode.h"

namespace gslam {
inline namespace v1 {
namespace ros {

/// An image and what its pixels mean.
struct DecodedImage {
  Image image;
  ImageKind kind = ImageKind::grey;
  double depth_scale = 0;  ///< of depth: metres are pixel * depth_scale
  std::string note;        ///< what else there is to say of its encoding
};

/// The pixels of sensor_msgs/Image: mono8, mono16, 8UC1, 8UC3, 8UC4, 16UC1, 32FC1, rgb8, bgr8,
/// rgba8, bgra8, rgb16, bgr16, rgba16, bgra16, bayer_*8 and bayer_*16.
/// @param is_depth  whether grey images of 16 bits or floats are depth for another reason than
///   their encoding, such as the name of the topic. (16UC1 and 32FC1 always are.)
/// @param name      of the message for errors
/// @throws ParseError for another encoding, and when the size is not that of the data
GSLAM_DATASETS_ROS_EXPORT DecodedImage decodeRaw(const ImageMessage& message, bool is_depth,
                                                 const std::string& name);

/// The same of sensor_msgs/CompressedImage: JPEG and PNG; compressedDepth of 16 bits, and of
/// floats, which are stored as inverse depth. (RVL, and TIFF, which floats may be stored in, are
/// not read.)
/// @param shape  unless null: what the image must be like. One of another size is refused before it
///   is decoded.
/// @throws ParseError, FileError when they are not what they say
GSLAM_DATASETS_ROS_EXPORT DecodedImage decodeCompressed(const CompressedImageMessage& message,
                                                        bool is_depth, const std::string& name,
                                                        const reading::ImageShape* shape = nullptr);

}  // namespace ros
}  // namespace v1
}  // namespace gslam

#endif  // GSLAM_DATASETS_ROS_SRC_MESSAGES_IMAGE_H
