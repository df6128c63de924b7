#include <gslam/estimator/solvers/similarity_3d.h>

#include <cmath>
#include <limits>

#include "math/check_size.h"
#include "math/rotation_fit.h"

namespace gslam {
inline namespace v1 {

std::size_t similarity3D(Span<const Vec3d> first, Span<const Vec3d> second, SIM3d& S_second_first,
                         Span<const double> weights) {
  detail::checkSizes("first", first.size(), "second", second.size(), 3);
  if (!weights.empty()) detail::checkSize("weights", weights.size(), first.size());
  detail::Alignment fit;
  if (!fit.compute(first, second, weights)) return 0;
  const double scale = fit.trace / fit.square_first;
  if (!(scale > 0 && scale <= std::numeric_limits<double>::max())) return 0;
  const Vec3d t = fit.mean_second - scale * (fit.rotation * fit.mean_first);
  if (!(t.squaredNorm() <= std::numeric_limits<double>::max())) return 0;
  S_second_first = SIM3d(fit.rotation, t, scale);
  return 1;
}

}  // namespace v1
}  // namespace gslam
