#include <gslam/estimator/solvers/fundamental_7pt.h>

#include <cmath>

#include "math/check_size.h"
#include "math/cubic.h"
#include "math/linear_epipolar.h"
#include "math/null_space.h"

namespace gslam {
inline namespace v1 {
namespace {

using detail::Row9;

Vec3d cross(const double* a, const double* b) noexcept {
  return {{a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]}};
}

// The sum of the products of the cofactors of a with b.
double cofactorsTimes(const double* a, const double* b) noexcept {
  const Vec3d u = cross(a + 3, a + 6), v = cross(a + 6, a), w = cross(a, a + 3);
  return (u[0] * b[0] + u[1] * b[1] + u[2] * b[2]) + (v[0] * b[3] + v[1] * b[4] + v[2] * b[5]) +
         (w[0] * b[6] + w[1] * b[7] + w[2] * b[8]);
}

// Whether a matrix of norm 1 has rank 2, to rounding. Matches that leave more than two matrices
// free, or are all but one point, give others.
bool isSingular(const Mat3d& f) noexcept {
  return std::fabs(cofactorsTimes(f.values, f.values)) / 3 <= 1e-12;
}

// Turns the pair of matrices so that det(first) is large; coefficients of det(x first + second),
// the highest first.
void determinantCubic(Row9 (&basis)[2], double (&c)[4]) noexcept {
  double* const a = basis[0].values;
  double* const b = basis[1].values;
  const double aaa = cofactorsTimes(a, a) / 3, aab = cofactorsTimes(a, b);
  const double abb = cofactorsTimes(b, a), bbb = cofactorsTimes(b, b) / 3;
  // At (1, 0), (0, 1), (1, 1), (1, -1), the last two of norm sqrt(2).
  constexpr double kCube = 0.3535533905932738;  // sqrt(1/2)^3
  const double values[4] = {std::fabs(aaa), std::fabs(bbb),
                            kCube * std::fabs((aaa + abb) + (aab + bbb)),
                            kCube * std::fabs((aaa + abb) - (aab + bbb))};
  std::size_t best = 0;
  for (std::size_t i = 1; i < 4; ++i) best = values[i] > 1.5 * values[best] ? i : best;
  if (best == 0) {
    c[0] = aaa, c[1] = aab, c[2] = abb, c[3] = bbb;
    return;
  }
  if (best == 1) {
    const Row9 swap = basis[0];
    basis[0] = basis[1];
    basis[1] = swap;
    c[0] = bbb, c[1] = abb, c[2] = aab, c[3] = aaa;
    return;
  }
  const double sign = best == 2 ? 1 : -1;
  const Row9 old = basis[0];
  detail::add(sign, basis[1], basis[0]);
  detail::add(-sign, old, basis[1]);  // b - sign a, at right angles to a + sign b
  c[0] = cofactorsTimes(a, a) / 3;
  c[1] = cofactorsTimes(a, b);
  c[2] = cofactorsTimes(b, a);
  c[3] = cofactorsTimes(b, b) / 3;
}

}  // namespace

std::size_t fundamental7pt(Span<const Vec2d> first, Span<const Vec2d> second,
                           std::array<Mat3d, 3>& fundamentals) {
  detail::checkSize("first", first.size(), 7);
  detail::checkSize("second", second.size(), 7);
  const detail::PointScale scale_first = detail::PointScale::of(first);
  const detail::PointScale scale_second = detail::PointScale::of(second);
  Row9 rows[7];
  for (std::size_t i = 0; i < 7; ++i) {
    detail::setEpipolarRow(scale_first(first[i]).data(), scale_second(second[i]).data(), rows[i]);
  }
  Row9 basis[2];
  detail::nullSpace(rows, basis);
  double c[4];
  determinantCubic(basis, c);
  std::array<double, 3> roots;
  const std::size_t found = detail::cubicRoots(c[0], c[1], c[2], c[3], roots);
  std::size_t count = 0;
  for (std::size_t i = 0; i < found; ++i) {
    bool again = false;
    for (std::size_t k = 0; k < i; ++k) {
      again = again || std::fabs(roots[k] - roots[i]) <= 1e-12 * (1 + std::fabs(roots[i]));
    }
    if (again) continue;
    Row9 f = basis[1];
    detail::add(roots[i], basis[0], f);
    Mat3d& fundamental = fundamentals[count];
    if (detail::unscaleFundamental(f.values, scale_first, scale_second, fundamental) &&
        isSingular(fundamental)) {
      ++count;
    }
  }
  return count;
}

}  // namespace v1
}  // namespace gslam
