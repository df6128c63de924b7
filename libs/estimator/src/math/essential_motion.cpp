#include "math/essential_motion.h"

#include <cmath>

#include "math/linear_epipolar.h"

namespace gslam {
inline namespace v1 {
namespace detail {

bool EssentialMotion::set(const Mat3d& essential) noexcept {
  Mat3d e = essential;
  Mat3d c;
  for (int attempt = 0; attempt < 2; ++attempt) {
    double squared = 0;
    for (const double value : e.values) squared += value * value;
    if (squared > 1e-200 && squared < 1e200) {
      e *= std::sqrt(2 / squared);
      const double* const a = e.values;
      const Vec3d r0 = {{a[0], a[1], a[2]}}, r1 = {{a[3], a[4], a[5]}}, r2 = {{a[6], a[7], a[8]}};
      const Vec3d c0 = r1.cross(r2), c1 = r2.cross(r0), c2 = r0.cross(r1);
      c = {{c0[0], c0[1], c0[2], c1[0], c1[1], c1[2], c2[0], c2[1], c2[2]}};
      // The singular values are 1, 1, 0 where the squares of the cofactors add up to 1 and the
      // determinant is 0.
      const double cofactors = c0.squaredNorm() + c1.squaredNorm() + c2.squaredNorm();
      if (std::fabs(cofactors - 1) < 4e-15 && std::fabs(r0.dot(c0)) < 1e-13) break;
    }
    if (attempt == 1 || !makeEssential(e)) return false;
  }
  // C = t t^T R: t is any column, the longest for its digits.
  double longest = 0;
  for (std::size_t j = 0; j < 3; ++j) {
    const Vec3d column = c.col(j);
    const double squared = column.squaredNorm();
    if (squared > longest) {
      longest = squared;
      t = column;
    }
  }
  if (!(longest > 0)) return false;
  t /= std::sqrt(longest);
  const double* const a = e.values;
  for (std::size_t j = 0; j < 3; ++j) {
    const Vec3d turned = t.cross(Vec3d{{a[j], a[3 + j], a[6 + j]}});
    for (std::size_t i = 0; i < 3; ++i) {
      rotations[0](i, j) = c(i, j) - turned[i];
      rotations[1](i, j) = c(i, j) + turned[i];
    }
  }
  return true;
}

}  // namespace detail
}  // namespace v1
}  // namespace gslam
