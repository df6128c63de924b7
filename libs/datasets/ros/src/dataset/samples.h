// Samples of inertial units and satellite receivers.
#ifndef GSLAM_DATASETS_ROS_SRC_DATASET_SAMPLES_H
#define GSLAM_DATASETS_ROS_SRC_DATASET_SAMPLES_H

#include <gslam/core/sensor.h>
#include <gslam/datasets_ros/recording.h>

#include <cstddef>
#include <string>
#include <vector>

#include "messages/messages.h"
#include "reading/remarks.h"

namespace gslam {
inline namespace v1 {
namespace ros {

/// All samples of a topic, by stamp.
struct ImuList {
  std::vector<ImuSample> samples;
  std::string frame_id;
};
struct GnssList {
  std::vector<GnssSample> samples;
  std::string frame_id;
};

/// @{
/// Reads them; what is not finite, or no place on Earth, is skipped and said.
ImuList readImu(const Recording& recording, std::size_t topic, bool by_header,
                reading::Remarks& remarks);
GnssList readGnss(const Recording& recording, std::size_t topic, bool by_header,
                  reading::Remarks& remarks);
/// @}

/// The position of a message, at a stamp.
GnssSample gnssSampleOf(const NavSatFix& message, std::int64_t stamp);

}  // namespace ros
}  // namespace v1
}  // namespace gslam

#endif  // GSLAM_DATASETS_ROS_SRC_DATASET_SAMPLES_H
