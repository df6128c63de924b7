#include <gslam/estimator/solvers/relative_pose_from_essential.h>

#include "math/check_size.h"
#include "math/essential_motion.h"
#include "math/rotation_fit.h"

namespace gslam {
inline namespace v1 {

std::size_t relativePoseFromEssential(const Mat3d& essential, Span<const Vec3d> first,
                                      Span<const Vec3d> second, SE3d& T_second_first) {
  detail::checkSizes("first", first.size(), "second", second.size(), 1);
  detail::EssentialMotion motion;
  if (!motion.set(essential)) return 0;
  // Rounding of bearings: so little is no parallax, and on the baseline.
  constexpr double kNoParallax = 1e-9;
  constexpr double kOnBaseline = 1e-12;
  const Mat3d& r = motion.rotations[0];
  const Vec3d& t = motion.t;
  std::size_t in_front[2][2] = {};
  for (std::size_t i = 0; i < first.size(); ++i) {
    const Vec3d x = r * first[i];
    const double a = x.dot(t), b = second[i].dot(t);
    // On which side of the baseline, the same for both? The other rotation turns x to the other.
    const double side = x.dot(second[i]) - a * b;
    for (std::size_t k = 0; k < 2; ++k) {
      if (!((k == 0 ? side : -side) > -kOnBaseline)) continue;
      in_front[k][0] += b - a > -kNoParallax ? 1 : 0;
      in_front[k][1] += a - b > -kNoParallax ? 1 : 0;
    }
  }
  std::size_t best = 0;
  for (std::size_t k = 1; k < 4; ++k) {
    if (in_front[k / 2][k % 2] > in_front[best / 2][best % 2]) best = k;
  }
  const std::size_t count = in_front[best / 2][best % 2];
  if (count == 0) return 0;
  T_second_first = SE3d(detail::rotationOf(motion.rotations[best / 2]), best % 2 == 0 ? t : -t);
  return count;
}

}  // namespace v1
}  // namespace gslam
