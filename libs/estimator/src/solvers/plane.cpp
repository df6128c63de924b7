#include <gslam/estimator/solvers/plane.h>
#include <gslam/geometry/detail/symmetric_eigen.h>

#include <cmath>

#include "math/check_size.h"

namespace gslam {
inline namespace v1 {
namespace {

// `normal` has length 1 but for `factor`.
inline std::size_t finish(const Vec3d& normal, double factor, const Vec3d& point,
                          Vec4d& plane) noexcept {
  const double d = -factor * normal.dot(point);
  if (!(std::fabs(d) < 1e290)) return 0;
  const double sign = std::copysign(factor, d);
  plane = {{sign * normal[0], sign * normal[1], sign * normal[2], std::fabs(d)}};
  return 1;
}

inline std::size_t ofThree(const Vec3d* p, Vec4d& plane) noexcept {
  const Vec3d u = p[1] - p[0];
  const Vec3d v = p[2] - p[0];
  const Vec3d normal = u.cross(v);
  const double area = normal.squaredNorm();
  if (!(area > 1e-16 * (u.squaredNorm() * v.squaredNorm()) && area < 1e290)) return 0;
  return finish(normal, 1 / std::sqrt(area), p[0], plane);
}

std::size_t ofMany(Span<const Vec3d> points, Vec4d& plane) noexcept {
  Vec3d mean{};
  for (const Vec3d& p : points) mean += p;
  mean *= 1 / static_cast<double>(points.size());
  double xx = 0, xy = 0, xz = 0, yy = 0, yz = 0, zz = 0;
  for (const Vec3d& p : points) {
    const Vec3d d = p - mean;
    xx += d[0] * d[0];
    xy += d[0] * d[1];
    xz += d[0] * d[2];
    yy += d[1] * d[1];
    yz += d[1] * d[2];
    zz += d[2] * d[2];
  }
  const double spread = xx + yy + zz;
  if (!(spread > 1e-290 && spread < 1e290)) return 0;
  const double scale = 1 / spread;
  const Mat3d moments = {{scale * xx, scale * xy, scale * xz,  //
                          scale * xy, scale * yy, scale * yz,  //
                          scale * xz, scale * yz, scale * zz}};
  const detail::SymmetricEigen<double, 3> eigen(moments);
  // The normal is unique where the least spread is less than the next.
  if (!(eigen.values[1] - eigen.values[2] > 1e-14)) return 0;
  return finish(eigen.vectors.col(2), 1, mean, plane);
}

}  // namespace

std::size_t planeFromPoints(Span<const Vec3d> points, Vec4d& plane) {
  detail::checkSizes("points", points.size(), "points", points.size(), 3);
  return points.size() == 3 ? ofThree(points.data(), plane) : ofMany(points, plane);
}

}  // namespace v1
}  // namespace gslam
