#include <gslam/estimator/solvers/essential_8pt.h>

#include <algorithm>

#include "math/check_size.h"
#include "math/linear_epipolar.h"
#include "math/null_space.h"

namespace gslam {
inline namespace v1 {

std::size_t essential8pt(Span<const Vec3d> first, Span<const Vec3d> second, Mat3d& essential) {
  detail::checkSizes("first", first.size(), "second", second.size(), 8);
  Mat3d e;
  if (first.size() == 8) {
    detail::Row9 rows[8];
    for (std::size_t i = 0; i < 8; ++i) {
      detail::setEpipolarRow(first[i].data(), second[i].data(), rows[i]);
    }
    detail::Row9 basis[1];
    detail::nullSpace(rows, basis);
    std::copy_n(basis[0].values, 9, e.values);
  } else {
    detail::LinearEpipolar linear;
    for (std::size_t i = 0; i < first.size(); ++i) linear.add(first[i], second[i]);
    if (!linear.solve(e)) return 0;
  }
  if (!detail::makeEssential(e)) return 0;
  essential = e;
  return 1;
}

}  // namespace v1
}  // namespace gslam
