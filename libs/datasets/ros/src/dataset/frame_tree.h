// Frames of ROS that are fixed to each other.
#ifndef GSLAM_DATASETS_ROS_SRC_DATASET_FRAME_TREE_H
#define GSLAM_DATASETS_ROS_SRC_DATASET_FRAME_TREE_H

#include <gslam/datasets_ros/recording.h>
#include <gslam/geometry/se3.h>

#include <map>
#include <string>
#include <utility>
#include <vector>

#include "reading/remarks.h"

namespace gslam {
inline namespace v1 {
namespace ros {

/// Static transforms, as a graph: any way between two frames will do, circles do no harm.
class FrameTree {
 public:
  /// Adds T_parent_child. Frames are the same with and without '/' before them.
  void add(const std::string& parent, const std::string& child, const SE3d& T_parent_child);
  /// Adds those of all messages of topics with transforms.
  void addTopics(const Recording& recording, const std::vector<std::size_t>& topics,
                 reading::Remarks& remarks);
  /// Finds T_a_b. False where no way leads from one to the other.
  bool find(const std::string& a, const std::string& b, SE3d& T_a_b) const;

 private:
  std::map<std::string, std::vector<std::pair<std::string, SE3d>>> neighbours_;
};

}  // namespace ros
}  // namespace v1
}  // namespace gslam

#endif  // GSLAM_DATASETS_ROS_SRC_DATASET_FRAME_TREE_H
