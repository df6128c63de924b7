#include <gslam/estimator/solvers/decompose_essential.h>

#include "math/essential_motion.h"
#include "math/rotation_fit.h"

namespace gslam {
inline namespace v1 {

std::size_t decomposeEssential(const Mat3d& essential,
                               std::array<SE3d, 4>& T_second_first) noexcept {
  detail::EssentialMotion motion;
  if (!motion.set(essential)) return 0;
  for (std::size_t i = 0; i < 2; ++i) {
    const SO3d rotation = detail::rotationOf(motion.rotations[i]);
    T_second_first[2 * i] = SE3d(rotation, motion.t);
    T_second_first[2 * i + 1] = SE3d(rotation, -motion.t);
  }
  return 4;
}

}  // namespace v1
}  // namespace gslam
