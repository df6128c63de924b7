#include <gslam/estimator/solvers/affine_3d.h>

#include <cmath>
#include <limits>

#include "math/check_size.h"

namespace gslam {
inline namespace v1 {
namespace {

// x -> [columns] rows (x - from) / divisor + to: the columns times the rows of an adjugate.
inline std::size_t compose(const Vec3d* columns, const Vec3d* rows, double divisor,
                           const Vec3d& from, const Vec3d& to, Mat<double, 3, 4>& result) noexcept {
  const double inverse = 1 / divisor;
  const Vec3d row0 = inverse * rows[0];
  const Vec3d row1 = inverse * rows[1];
  const Vec3d row2 = inverse * rows[2];
  Mat<double, 3, 4> m;
  double sum = 0;  // not finite if one of the terms is not
  for (std::size_t r = 0; r < 3; ++r) {
    const Vec3d v = columns[0][r] * row0 + columns[1][r] * row1 + columns[2][r] * row2;
    const double t = to[r] - v.dot(from);
    m(r, 0) = v[0];
    m(r, 1) = v[1];
    m(r, 2) = v[2];
    m(r, 3) = t;
    sum += (std::fabs(v[0]) + std::fabs(v[1])) + (std::fabs(v[2]) + std::fabs(t));
  }
  if (!(sum <= std::numeric_limits<double>::max())) return 0;
  result = m;
  return 1;
}

std::size_t exact(const Vec3d* a, const Vec3d* b, Mat<double, 3, 4>& result) noexcept {
  const Vec3d d1 = a[1] - a[0];
  const Vec3d d2 = a[2] - a[0];
  const Vec3d d3 = a[3] - a[0];
  const Vec3d rows[3] = {d2.cross(d3), d3.cross(d1), d1.cross(d2)};
  const double volume = d1.dot(rows[0]);
  const double extent = d1.squaredNorm() + d2.squaredNorm() + d3.squaredNorm();
  // Squares, to do without a root: |volume| > 1e-10 sqrt(extent)^3.
  if (!(volume * volume > 1e-20 * extent * extent * extent)) return 0;
  const Vec3d columns[3] = {b[1] - b[0], b[2] - b[0], b[3] - b[0]};
  return compose(columns, rows, volume, a[0], b[0], result);
}

std::size_t leastSquares(Span<const Vec3d> first, Span<const Vec3d> second,
                         Mat<double, 3, 4>& result) noexcept {
  const double share = 1 / static_cast<double>(first.size());
  Vec3d mean_a{};
  Vec3d mean_b{};
  for (std::size_t i = 0; i < first.size(); ++i) {
    mean_a += first[i];
    mean_b += second[i];
  }
  mean_a *= share;
  mean_b *= share;
  Vec3d c0{}, c1{}, c2{};  // columns of the first points' second moments
  Vec3d columns[3] = {};   // of the sum of b a^T
  for (std::size_t i = 0; i < first.size(); ++i) {
    const Vec3d a = first[i] - mean_a;
    const Vec3d b = second[i] - mean_b;
    c0 += a[0] * a;
    c1 += a[1] * a;
    c2 += a[2] * a;
    columns[0] += a[0] * b;
    columns[1] += a[1] * b;
    columns[2] += a[2] * b;
  }
  const Vec3d rows[3] = {c1.cross(c2), c2.cross(c0), c0.cross(c1)};
  const double determinant = c0.dot(rows[0]);
  // Between the two larger moments and the least: the determinant is their product.
  const double minors = rows[0][0] + rows[1][1] + rows[2][2];
  const double spread = c0[0] + c1[1] + c2[2];
  if (!(determinant > 1e-12 * spread * minors)) return 0;
  return compose(columns, rows, determinant, mean_a, mean_b, result);
}

}  // namespace

std::size_t affine3D(Span<const Vec3d> first, Span<const Vec3d> second,
                     Mat<double, 3, 4>& A_second_first) {
  detail::checkSizes("first", first.size(), "second", second.size(), 4);
  return first.size() == 4 ? exact(first.data(), second.data(), A_second_first)
                           : leastSquares(first, second, A_second_first);
}

}  // namespace v1
}  // namespace gslam
