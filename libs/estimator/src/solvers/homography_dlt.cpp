#include <gslam/estimator/solvers/homography_4pt.h>
#include <gslam/estimator/solvers/homography_dlt.h>
#include <gslam/geometry/detail/symmetric_eigen.h>

#include <cmath>

#include "math/check_size.h"

namespace gslam {
inline namespace v1 {
namespace {

// That of a double, with a margin for what the caller computed before.
constexpr double kRounding = 1e-14;

// Mean and covariance of points of the plane.
struct Moments {
  explicit Moments(Span<const Vec2d> points) noexcept {
    const double share = 1 / static_cast<double>(points.size());
    for (const Vec2d& p : points) mean += p;
    mean *= share;
    for (const Vec2d& p : points) {
      const Vec2d d = p - mean;
      xx += d[0] * d[0];
      xy += d[0] * d[1];
      yy += d[1] * d[1];
    }
    xx *= share;
    xy *= share;
    yy *= share;
  }

  Vec2d mean{};
  double xx = 0, xy = 0, yy = 0;
};

// x -> L (x - mean) with the identity as covariance; L is lower triangular.
struct Whitening {
  explicit Whitening(const Moments& m) noexcept : mean(m.mean) {
    const double spread = m.xx + m.yy;
    // The longer axis first, else a set along y would lose its digits.
    const bool swapped = m.yy > m.xx;
    const double longer = swapped ? m.yy : m.xx;
    const double shorter = swapped ? m.xx : m.yy;
    const double rest = shorter - m.xy * m.xy / longer;
    is_proper = rest > 1e-14 * spread && spread < 1e290;
    if (!is_proper) return;
    const double l0 = 1 / std::sqrt(longer);
    const double l2 = 1 / std::sqrt(rest);
    rounding = kRounding * l2 * (std::fabs(mean[0]) + std::fabs(mean[1]) + std::sqrt(spread));
    const double l1 = -l2 * m.xy / longer;
    matrix = swapped ? Mat<double, 2, 2>{{0, l0, l2, l1}} : Mat<double, 2, 2>{{l0, 0, l1, l2}};
  }
  Vec2d operator()(const Vec2d& p) const noexcept { return matrix * (p - mean); }

  Vec2d mean;
  Mat<double, 2, 2> matrix;
  double rounding = 0;  // of whitened coordinates, those of the caller being rounded
  bool is_proper;
};

// Sums of products of homogeneous whitened points (u, v, 1).
struct Sums {
  double uu = 0, uv = 0, vv = 0, u = 0, v = 0, one = 0;

  void add(double weight, double x, double y) noexcept {
    const double wx = weight * x;
    const double wy = weight * y;
    uu += wx * x;
    uv += wx * y;
    vv += wy * y;
    u += wx;
    v += wy;
    one += weight;
  }
  Mat3d matrix(double factor) const noexcept {
    return factor * Mat3d{{uu, uv, u, uv, vv, v, u, v, one}};
  }
};

}  // namespace

std::size_t homographyDlt(Span<const Vec2d> first, Span<const Vec2d> second,
                          Mat3d& H_second_first) {
  detail::checkSizes("first", first.size(), "second", second.size(), 4);
  if (first.size() == 4) return homography4pt(first, second, H_second_first);
  const Whitening whiten(Moments{first});
  const Moments m(second);
  const double spread = 0.5 * (m.xx + m.yy);
  if (!whiten.is_proper || !(spread > 1e-290 && spread < 1e290)) return 0;
  const double scale = 1 / std::sqrt(spread);

  Sums sum_x, sum_y, sum_both;
  for (std::size_t i = 0; i < first.size(); ++i) {
    const Vec2d p = whiten(first[i]);
    const Vec2d q = scale * (second[i] - m.mean);
    sum_x.add(q[0], p[0], p[1]);
    sum_y.add(q[1], p[0], p[1]);
    sum_both.add(q.squaredNorm(), p[0], p[1]);
  }
  // The first two rows of H are x h and y h for the third row h: the whitened points have the
  // identity as second moment.
  const double share = 1 / static_cast<double>(first.size());
  const Mat3d x = sum_x.matrix(share);
  const Mat3d y = sum_y.matrix(share);
  const Mat3d both = sum_both.matrix(share);
  const Mat3d rest = both - x * x - y * y;
  for (const double value : rest.values) {
    if (!(std::fabs(value) < 1e100)) return 0;
  }
  const detail::SymmetricEigen<double, 3> eigen(rest);
  // What cancelled in the difference is rounded to the size of the sum.
  const double rounding = 10 * kRounding + whiten.rounding +
                          kRounding * scale * (std::fabs(m.mean[0]) + std::fabs(m.mean[1]));
  if (!(eigen.values[1] > rounding * (both(0, 0) + both(1, 1) + both(2, 2)))) return 0;
  const Vec3d h = eigen.vectors.col(2);

  // Back to the coordinates of the caller: S^-1 [x h; y h; h] W.
  const Vec3d hx = (1 / scale) * (x * h) + m.mean[0] * h;
  const Vec3d hy = (1 / scale) * (y * h) + m.mean[1] * h;
  const Vec2d shift = -(whiten.matrix * whiten.mean);
  Mat3d w{};
  w.setBlock(0, 0, whiten.matrix);
  w(0, 2) = shift[0];
  w(1, 2) = shift[1];
  w(2, 2) = 1;
  const Mat3d product = Mat3d{{hx[0], hx[1], hx[2], hy[0], hy[1], hy[2], h[0], h[1], h[2]}} * w;
  double squared = 0;
  for (const double value : product.values) squared += value * value;
  if (!(squared > 1e-290 && squared < 1e290)) return 0;
  H_second_first = std::copysign(1 / std::sqrt(squared), h[2]) * product;
  return 1;
}

}  // namespace v1
}  // namespace gslam
