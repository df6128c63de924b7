#include <gslam/estimator/solvers/rotation_2pt.h>

#include <cmath>

#include "math/check_size.h"
#include "math/rotation_fit.h"

namespace gslam {
inline namespace v1 {

std::size_t rotation2pt(Span<const Vec3d> first, Span<const Vec3d> second, SO3d& R_second_first) {
  detail::checkSizes("first", first.size(), "second", second.size(), 2);
  SO3d rotation;
  if (first.size() == 2) {
    const Vec3d a[2] = {first[0], first[1]};
    const Vec3d b[2] = {second[0], second[1]};
    double trace;
    if (!detail::fitPlanarRotation(a, b, {{1, 0, 0, 1}}, rotation, trace)) return 0;
  } else {
    Vec3d c0{}, c1{}, c2{};  // columns of the sum of b a^T
    double square_first = 0;
    double square_second = 0;
    for (std::size_t i = 0; i < first.size(); ++i) {
      c0 += first[i][0] * second[i];
      c1 += first[i][1] * second[i];
      c2 += first[i][2] * second[i];
      square_first += first[i].squaredNorm();
      square_second += second[i].squaredNorm();
    }
    const Mat3d m = {{c0[0], c1[0], c2[0], c0[1], c1[1], c2[1], c0[2], c1[2], c2[2]}};
    const double bound = std::sqrt(square_first) * std::sqrt(square_second);
    if (!detail::fitRotation(m, bound, rotation)) return 0;
  }
  R_second_first = rotation;
  return 1;
}

}  // namespace v1
}  // namespace gslam
