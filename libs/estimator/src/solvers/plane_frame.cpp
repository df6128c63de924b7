#include <gslam/estimator/solvers/plane_frame.h>

#include "math/quaternion.h"

namespace gslam {
inline namespace v1 {

std::size_t planeFrame(const Vec4d& plane, const Vec3d& near_point, SE3d& T_world_plane) noexcept {
  const double length = plane.segment<3>(0).norm();
  if (!(length > 1e-290 && length < 1e290)) return 0;
  const Vec3d n = plane.segment<3>(0) / length;
  const Vec3d origin = near_point - (n.dot(near_point) + plane[3] / length) * n;
  if (!(origin.squaredNorm() < 1e300)) return 0;
  detail::Quaternion to_z;
  detail::shortestToZ(n, to_z);
  const SO3d rotation = SO3d::fromQuaternion(-to_z[0], -to_z[1], 0, to_z[3]);
  T_world_plane = SE3d(rotation, origin);
  return 1;
}

}  // namespace v1
}  // namespace gslam
