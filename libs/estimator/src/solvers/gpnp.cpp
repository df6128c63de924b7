#include <gslam/estimator/solvers/gpnp.h>

#include "math/check_size.h"
#include "math/pose_form.h"

namespace gslam {
inline namespace v1 {

std::size_t gpnp(Span<const Vec3d> origins, Span<const Vec3d> bearings, Span<const Vec3d> points,
                 std::array<SE3d, 4>& T_rig_world) {
  detail::checkSizes("bearings", bearings.size(), "points", points.size(), 4);
  detail::checkSizes("bearings", bearings.size(), "origins", origins.size(), 4);
  return detail::pnp::solvePose({origins, bearings, points}, T_rig_world);
}

}  // namespace v1
}  // namespace gslam
