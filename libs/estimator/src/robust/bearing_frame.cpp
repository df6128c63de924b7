#include "robust/bearing_frame.h"

#include <cmath>

namespace gslam {
inline namespace v1 {
namespace detail {

Mat<double, 2, 3> frameOfBearing(const Vec3d& bearing) {
  std::size_t least = 0;
  for (std::size_t k = 1; k < 3; ++k) {
    if (std::abs(bearing[k]) < std::abs(bearing[least])) least = k;
  }
  Vec3d axis{};
  axis[least] = 1;
  Vec3d u = bearing.cross(axis);
  u /= std::sqrt(u.squaredNorm());
  const Vec3d v = bearing.cross(u);
  return {{u[0], u[1], u[2], v[0], v[1], v[2]}};
}

Mat<double, 2, 3> frameOfPixel(const Mat<double, 3, 2>& j) {
  const Mat<double, 2, 3> jt = j.transpose();
  const Mat2d square = jt * j;
  const double determinant = square(0, 0) * square(1, 1) - square(0, 1) * square(1, 0);
  const Mat2d inverse = {{square(1, 1) / determinant, -square(0, 1) / determinant,
                          -square(1, 0) / determinant, square(0, 0) / determinant}};
  return inverse * jt;
}

}  // namespace detail
}  // namespace v1
}  // namespace gslam
