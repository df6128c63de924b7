// From the left-handed world of ICL-NUIM to a right-handed one.
#ifndef GSLAM_DATASETS_SRC_FORMATS_ICL_MIRROR_H
#define GSLAM_DATASETS_SRC_FORMATS_ICL_MIRROR_H

#include <gslam/geometry/se3.h>

namespace gslam {
inline namespace v1 {
namespace reading {

/// S T S with S = diag(1, -1, 1). ICL-NUIM's camera has fy = -480: y points up in its camera and in
/// its world, both left-handed, as POV-Ray's are. With y turned down in both, the camera has
/// fy = +480, the images stay as they are, and the poses become these.
inline SE3d mirroredInY(const SE3d& pose) {
  const Vec<double, 4>& q = pose.rotation().quaternion();
  const Vec3d& t = pose.translation();
  return SE3d(SO3d::fromQuaternion(-q[0], q[1], -q[2], q[3]), Vec3d{{t[0], -t[1], t[2]}});
}

}  // namespace reading
}  // namespace v1
}  // namespace gslam

#endif  // GSLAM_DATASETS_SRC_FORMATS_ICL_MIRROR_H
