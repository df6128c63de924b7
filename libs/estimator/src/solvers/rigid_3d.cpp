#include <gslam/estimator/solvers/rigid_3d.h>

#include <cmath>
#include <limits>

#include "math/check_size.h"
#include "math/rotation_fit.h"

namespace gslam {
inline namespace v1 {

std::size_t rigid3D(Span<const Vec3d> first, Span<const Vec3d> second, SE3d& T_second_first,
                    Span<const double> weights) {
  detail::checkSizes("first", first.size(), "second", second.size(), 3);
  if (!weights.empty()) detail::checkSize("weights", weights.size(), first.size());
  detail::Alignment fit;
  if (!fit.compute(first, second, weights)) return 0;
  const Vec3d t = fit.mean_second - fit.rotation * fit.mean_first;
  if (!(t.squaredNorm() <= std::numeric_limits<double>::max())) return 0;
  T_second_first = SE3d(fit.rotation, t);
  return 1;
}

}  // namespace v1
}  // namespace gslam
