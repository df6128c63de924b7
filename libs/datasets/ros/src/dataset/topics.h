// Which topics of a recording become what of a dataset.
#ifndef GSLAM_DATASETS_ROS_SRC_DATASET_TOPICS_H
#define GSLAM_DATASETS_ROS_SRC_DATASET_TOPICS_H

#include <gslam/datasets_ros/recording.h>
#include <gslam/svar/svar.h>

#include <cstddef>
#include <string>
#include <vector>

#include "messages/poses.h"

namespace gslam {
inline namespace v1 {
namespace ros {

constexpr std::size_t kNoTopic = static_cast<std::size_t>(-1);

/// A topic of images.
struct CameraTopic {
  std::size_t images = kNoTopic;
  std::size_t info = kNoTopic;
  std::string name;  ///< of the camera: "cam0" of "/cam0/image_raw"
  bool is_compressed = false;
  bool is_depth = false;      ///< by a word of its name
  bool is_rectified = false;  ///< by a word of its name's last part
};

/// What was chosen.
struct ChosenTopics {
  std::vector<CameraTopic> cameras;
  bool are_cameras_named = false;  ///< by parameters, not chosen by their types
  std::size_t imu = kNoTopic;
  std::size_t gnss = kNoTopic;
  bool has_truth = false, has_odometry = false;
  PoseTopic truth, odometry;
  std::vector<std::size_t> transforms;  ///< of frames that are fixed to each other
};

/// Those that the parameters name, else by their types and names.
/// @throws Error for a name that is none, or is of a type that cannot be that
ChosenTopics chooseTopics(const Recording& recording, const Svar& parameters);

/// Whether a topic is used for anything.
bool isUsed(const ChosenTopics& topics, std::size_t topic);

/// @{
/// What names say: "/cam0/image_rect_color" has rectified images, "/camera/depth/image" depth.
GSLAM_DATASETS_ROS_EXPORT bool saysRectified(const std::string& topic);
GSLAM_DATASETS_ROS_EXPORT bool saysDepth(const std::string& topic);
/// @}

/// "cam0" of "/cam0/image_raw", "camera_rgb" of "/camera/rgb/image_color/compressed".
GSLAM_DATASETS_ROS_EXPORT std::string cameraNameOf(const std::string& topic);

}  // namespace ros
}  // namespace v1
}  // namespace gslam

#endif  // GSLAM_DATASETS_ROS_SRC_DATASET_TOPICS_H
