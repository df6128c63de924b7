#include <gslam/estimator/solvers/homography_4pt.h>

#include <algorithm>
#include <cmath>

#include "math/check_size.h"

namespace gslam {
inline namespace v1 {
namespace {

// Relative to the square of the extent.
constexpr double kLeastArea = 1e-10;

// Four points by their differences from the first of them, and twice the areas of their triangles.
struct Quadrilateral {
  explicit Quadrilateral(const Vec2d* p) noexcept
      : x1(p[1][0] - p[0][0]), y1(p[1][1] - p[0][1]), x2(p[2][0] - p[0][0]), y2(p[2][1] - p[0][1]) {
    const double x3 = p[3][0] - p[0][0];
    const double y3 = p[3][1] - p[0][1];
    whole = x1 * y2 - y1 * x2;
    part1 = x3 * y2 - y3 * x2;
    part2 = x1 * y3 - y1 * x3;
    part0 = whole - part1 - part2;
    extent = x1 * x1 + y1 * y1 + x2 * x2 + y2 * y2 + x3 * x3 + y3 * y3;
  }

  // False for NaN as well.
  bool isProper() const noexcept {
    const double least = std::min(std::min(std::fabs(whole), std::fabs(part0)),
                                  std::min(std::fabs(part1), std::fabs(part2)));
    return least > kLeastArea * extent;
  }

  double x1, y1, x2, y2;
  double whole;                // of points 0 1 2
  double part0, part1, part2;  // of the fourth with two of these: its barycentric coordinates
  double extent;               // squared
};

}  // namespace

std::size_t homography4pt(Span<const Vec2d> first, Span<const Vec2d> second,
                          Mat3d& H_second_first) {
  detail::checkSize("first", first.size(), 4);
  detail::checkSize("second", second.size(), 4);
  const Quadrilateral a(first.data());
  const Quadrilateral b(second.data());
  if (!a.isProper() || !b.isProper()) return 0;
  const double ratio0 = a.part0 * b.part0;
  const double ratio1 = a.part1 * b.part1;
  const double ratio2 = a.part2 * b.part2;
  const double whole = a.whole * b.whole;
  const bool all_keep = ratio0 > 0 && ratio1 > 0 && ratio2 > 0 && whole > 0;
  const bool all_change = ratio0 < 0 && ratio1 < 0 && ratio2 < 0 && whole < 0;
  if (!all_keep && !all_change) return 0;

  // H takes corner i of the first triangle to w_i times that of the second.
  const double w0 = b.part0 * a.part1 * a.part2;
  const double w1 = b.part1 * a.part0 * a.part2;
  const double w2 = b.part2 * a.part0 * a.part1;
  // With the first corner of both at the origin:
  const double m00 = w1 * b.x1 * a.y2 - w2 * b.x2 * a.y1;
  const double m01 = w2 * b.x2 * a.x1 - w1 * b.x1 * a.x2;
  const double m10 = w1 * b.y1 * a.y2 - w2 * b.y2 * a.y1;
  const double m11 = w2 * b.y2 * a.x1 - w1 * b.y1 * a.x2;
  const double m20 = (w1 - w0) * a.y2 - (w2 - w0) * a.y1;
  const double m21 = (w2 - w0) * a.x1 - (w1 - w0) * a.x2;
  const double m22 = w0 * a.whole;  // the first corner's third coordinate

  const double ax = first[0][0], ay = first[0][1];
  const double bx = second[0][0], by = second[0][1];
  const double h22 = m22 - m20 * ax - m21 * ay;
  const double h00 = m00 + bx * m20;
  const double h01 = m01 + bx * m21;
  const double h02 = bx * m22 - (h00 * ax + h01 * ay);
  const double h10 = m10 + by * m20;
  const double h11 = m11 + by * m21;
  const double h12 = by * m22 - (h10 * ax + h11 * ay);

  const double squared = (h00 * h00 + h01 * h01 + h02 * h02) + (h10 * h10 + h11 * h11 + h12 * h12) +
                         (m20 * m20 + m21 * m21 + h22 * h22);
  if (!(squared > 1e-290 && squared < 1e290)) return 0;
  const double scale = std::copysign(1 / std::sqrt(squared), m22);
  H_second_first = {{scale * h00, scale * h01, scale * h02,  //
                     scale * h10, scale * h11, scale * h12,  //
                     scale * m20, scale * m21, scale * h22}};
  return 1;
}

}  // namespace v1
}  // namespace gslam
