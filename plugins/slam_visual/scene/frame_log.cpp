#include "scene/frame_log.h"

namespace visual {

using gslam::SE3d;

std::vector<gslam::TrackedPose> FrameLog::poses(const Scene& scene) const {
  std::vector<gslam::TrackedPose> poses;
  for (const Entry& entry : entries_) {
    gslam::TrackedPose pose{entry.frame, entry.stamp, SE3d(), entry.state};
    if (hasPose(entry.state)) {
      SE3d T_stand_in_reference;
      const gslam::KeyframeId id = scene.standIn(entry.reference, T_stand_in_reference);
      const double stretched = scene.stretch(entry.reference) / entry.stretch;
      const SE3d T_reference_body(entry.T_reference_body.rotation(),
                                  stretched * entry.T_reference_body.translation());
      pose.T_world_body = scene.map.at(id).T_world_body * T_stand_in_reference * T_reference_body;
    }
    poses.push_back(pose);
  }
  return poses;
}

}  // namespace visual
