// Calibrations in messages to cameras.
#ifndef GSLAM_DATASETS_ROS_SRC_MESSAGES_CAMERA_H
#define GSLAM_DATASETS_ROS_SRC_MESSAGES_CAMERA_H

#include <gslam/datasets_ros/export.h>
#include <gslam/geometry/camera.h>

#include <string>

#include "messages.h"

namespace gslam {
inline namespace v1 {
namespace ros {

/// The camera that sensor_msgs/CameraInfo describes, of the images as they are recorded: binning
/// and the region of interest are applied.
/// @param is_rectified  whether the images were rectified: then P counts, and not K and D
/// @param name          of the message for errors
/// @return no camera where K is zero, which stands for "not calibrated"
/// @throws ParseError when the model is not known, or the values make no camera
GSLAM_DATASETS_ROS_EXPORT Camera cameraOf(const CameraInfo& info, bool is_rectified,
                                          const std::string& name);

/// Where a rectified camera is in the frame that its messages name, by the fourth column of P: for
/// the right one of a stereo pair, which has the frame of the left one, the baseline along x.
/// @return zero where P does not say it
GSLAM_DATASETS_ROS_EXPORT Vec3d offsetOf(const CameraInfo& info) noexcept;

}  // namespace ros
}  // namespace v1
}  // namespace gslam

#endif  // GSLAM_DATASETS_ROS_SRC_MESSAGES_CAMERA_H
