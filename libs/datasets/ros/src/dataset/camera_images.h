// The images of a camera: where they are, and how one is loaded.
#ifndef GSLAM_DATASETS_ROS_SRC_DATASET_CAMERA_IMAGES_H
#define GSLAM_DATASETS_ROS_SRC_DATASET_CAMERA_IMAGES_H

#include <gslam/core/rig.h>
#include <gslam/datasets_ros/recording.h>

#include <cstdint>
#include <string>
#include <vector>

#include "messages/image.h"
#include "reading/decode.h"
#include "reading/remarks.h"
#include "topics.h"

namespace gslam {
inline namespace v1 {
namespace ros {

/// An image of a recording.
struct StampedImage {
  std::int64_t stamp = 0;
  MessageRef message;
};

/// All there is of a camera.
struct CameraImages {
  CameraTopic topic;
  CameraSensor sensor;
  std::string frame_id;
  Vec3d offset{0, 0, 0};             ///< in the frame, by P of rectified images; see offsetOf()
  std::vector<StampedImage> images;  ///< by stamp, each stamp once
  reading::ImageShape shape;         ///< of the first one
};

/// Looks at the head of each image, all of the first one, and the calibration.
/// @param by_header  whether stamps are those of the messages, not when they were received
/// @throws Error when the first image or the calibration cannot be read, or do not fit together
CameraImages readCamera(const Recording& recording, const CameraTopic& topic, bool by_header,
                        reading::Remarks& remarks);

/// @throws Error when it is damaged, or is not as the first one of the camera
Image loadImage(const Recording& recording, const CameraImages& camera, const MessageRef& message);

/// The stamps of a topic's messages, and where they are.
std::vector<StampedImage> readStamps(const Recording& recording, std::size_t topic, bool by_header,
                                     reading::Remarks& remarks);

}  // namespace ros
}  // namespace v1
}  // namespace gslam

#endif  // GSLAM_DATASETS_ROS_SRC_DATASET_CAMERA_IMAGES_H
