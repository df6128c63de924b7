#include <gslam/estimator/solvers/affine_2d.h>

#include <cmath>
#include <limits>

#include "math/check_size.h"

namespace gslam {
inline namespace v1 {
namespace {

constexpr double kHuge = std::numeric_limits<double>::max();

// x -> B (x - from) + to, B = numerator / divisor.
inline std::size_t compose(const double* numerator, double divisor, const Vec2d& from,
                           const Vec2d& to, Mat<double, 2, 3>& result) noexcept {
  const double inverse = 1 / divisor;
  const double m00 = numerator[0] * inverse, m01 = numerator[1] * inverse;
  const double m10 = numerator[2] * inverse, m11 = numerator[3] * inverse;
  const double tx = to[0] - (m00 * from[0] + m01 * from[1]);
  const double ty = to[1] - (m10 * from[0] + m11 * from[1]);
  // One that is not finite makes the sum so.
  const double sum = (std::fabs(m00) + std::fabs(m01)) + (std::fabs(m10) + std::fabs(m11)) +
                     (std::fabs(tx) + std::fabs(ty));
  if (!(sum <= kHuge)) return 0;
  result = {{m00, m01, tx, m10, m11, ty}};
  return 1;
}

std::size_t exact(const Vec2d* a, const Vec2d* b, Mat<double, 2, 3>& result) noexcept {
  const double x1 = a[1][0] - a[0][0], y1 = a[1][1] - a[0][1];
  const double x2 = a[2][0] - a[0][0], y2 = a[2][1] - a[0][1];
  const double area = x1 * y2 - y1 * x2;
  const double extent = (x1 * x1 + y1 * y1) + (x2 * x2 + y2 * y2);
  if (!(std::fabs(area) > 1e-10 * extent)) return 0;
  const double u1 = b[1][0] - b[0][0], v1 = b[1][1] - b[0][1];
  const double u2 = b[2][0] - b[0][0], v2 = b[2][1] - b[0][1];
  const double numerator[4] = {u1 * y2 - u2 * y1, u2 * x1 - u1 * x2,  //
                               v1 * y2 - v2 * y1, v2 * x1 - v1 * x2};
  return compose(numerator, area, a[0], b[0], result);
}

std::size_t leastSquares(Span<const Vec2d> first, Span<const Vec2d> second,
                         Mat<double, 2, 3>& result) noexcept {
  const double share = 1 / static_cast<double>(first.size());
  Vec2d mean_a{};
  Vec2d mean_b{};
  for (std::size_t i = 0; i < first.size(); ++i) {
    mean_a += first[i];
    mean_b += second[i];
  }
  mean_a *= share;
  mean_b *= share;
  double xx = 0, xy = 0, yy = 0;
  double ux = 0, uy = 0, vx = 0, vy = 0;
  for (std::size_t i = 0; i < first.size(); ++i) {
    const Vec2d a = first[i] - mean_a;
    const Vec2d b = second[i] - mean_b;
    xx += a[0] * a[0];
    xy += a[0] * a[1];
    yy += a[1] * a[1];
    ux += b[0] * a[0];
    uy += b[0] * a[1];
    vx += b[1] * a[0];
    vy += b[1] * a[1];
  }
  const double determinant = xx * yy - xy * xy;
  const double spread = xx + yy;
  if (!(determinant > 1e-12 * spread * spread)) return 0;
  const double numerator[4] = {ux * yy - uy * xy, uy * xx - ux * xy,  //
                               vx * yy - vy * xy, vy * xx - vx * xy};
  return compose(numerator, determinant, mean_a, mean_b, result);
}

}  // namespace

std::size_t affine2D(Span<const Vec2d> first, Span<const Vec2d> second,
                     Mat<double, 2, 3>& A_second_first) {
  detail::checkSizes("first", first.size(), "second", second.size(), 3);
  return first.size() == 3 ? exact(first.data(), second.data(), A_second_first)
                           : leastSquares(first, second, A_second_first);
}

}  // namespace v1
}  // namespace gslam
