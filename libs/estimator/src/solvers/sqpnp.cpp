#include <gslam/estimator/solvers/sqpnp.h>

#include "math/check_size.h"
#include "math/pose_form.h"

namespace gslam {
inline namespace v1 {

std::size_t sqpnp(Span<const Vec3d> bearings, Span<const Vec3d> points,
                  std::array<SE3d, 4>& T_camera_world) {
  detail::checkSizes("bearings", bearings.size(), "points", points.size(), 3);
  return detail::pnp::solvePose({{}, bearings, points}, T_camera_world);
}

}  // namespace v1
}  // namespace gslam
