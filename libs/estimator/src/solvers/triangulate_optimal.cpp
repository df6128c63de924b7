#include <gslam/estimator/solvers/triangulate_optimal.h>

#include <cmath>
#include <limits>

#include "math/two_rays.h"

namespace gslam {
inline namespace v1 {

std::size_t triangulateOptimal(const SE3d& T_second_first, const Vec3d& bearing_first,
                               const Vec3d& bearing_second, Vec3d& point_first) noexcept {
  const detail::TwoRays rays(T_second_first, bearing_first, bearing_second);
  // Normals of the planes of the baseline and a bearing; the best plane's has the largest sum of
  // squared products with them.
  const Vec3d p = rays.c.cross(rays.f);
  const Vec3d q = rays.c.cross(rays.g);
  const double pq = p.dot(q);
  const double half = 0.5 * (p.squaredNorm() - q.squaredNorm());
  const double root = std::sqrt(half * half + pq * pq);
  const Vec3d n = half >= 0 ? (half + root) * p + pq * q : pq * p + (root - half) * q;
  const double inverse = 1 / n.squaredNorm();
  const Vec3d f = rays.f - (inverse * n.dot(rays.f)) * n;
  const Vec3d g = rays.g - (inverse * n.dot(rays.g)) * n;
  // All are in one plane: f depth_first = c + g depth_second.
  const double divisor = f.cross(g).dot(n);
  const double depth_first = rays.c.cross(g).dot(n) / divisor;
  const double along_second = rays.c.cross(f).dot(n) * divisor;
  if (!(depth_first > 0 && along_second > 0 &&
        divisor * divisor * inverse > detail::kLeastParallax)) {
    return 0;
  }
  const Vec3d point = depth_first * f;
  if (!(point.squaredNorm() <= std::numeric_limits<double>::max())) return 0;
  point_first = point;
  return 1;
}

}  // namespace v1
}  // namespace gslam
