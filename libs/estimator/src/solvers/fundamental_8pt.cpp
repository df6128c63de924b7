#include <gslam/estimator/solvers/fundamental_8pt.h>

#include <algorithm>

#include "math/check_size.h"
#include "math/linear_epipolar.h"
#include "math/null_space.h"

namespace gslam {
inline namespace v1 {

std::size_t fundamental8pt(Span<const Vec2d> first, Span<const Vec2d> second, Mat3d& fundamental) {
  detail::checkSizes("first", first.size(), "second", second.size(), 8);
  const detail::PointScale scale_first = detail::PointScale::of(first);
  const detail::PointScale scale_second = detail::PointScale::of(second);
  Mat3d f;
  if (first.size() == 8) {
    detail::Row9 rows[8];
    for (std::size_t i = 0; i < 8; ++i) {
      detail::setEpipolarRow(scale_first(first[i]).data(), scale_second(second[i]).data(), rows[i]);
    }
    detail::Row9 basis[1];
    detail::nullSpace(rows, basis);
    std::copy_n(basis[0].values, 9, f.values);
  } else {
    detail::LinearEpipolar linear;
    for (std::size_t i = 0; i < first.size(); ++i) {
      linear.add(scale_first(first[i]), scale_second(second[i]));
    }
    if (!linear.solve(f)) return 0;
  }
  detail::makeRankTwo(f);
  return detail::unscaleFundamental(f.values, scale_first, scale_second, fundamental) ? 1 : 0;
}

}  // namespace v1
}  // namespace gslam
