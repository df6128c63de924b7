#include <gslam/estimator/solvers/triangulate_midpoint.h>
#include <gslam/geometry/detail/pair.h>

#include <limits>

#include "math/two_rays.h"

namespace gslam {
inline namespace v1 {
namespace {

using Pair = detail::Pair<double>;

// Two vectors side by side.
struct VectorPair {
  Pair x, y, z;
};

GSLAM_ALWAYS_INLINE VectorPair crossed(const VectorPair& a, Pair x, Pair y, Pair z) noexcept {
  return {a.y * z - a.z * y, a.z * x - a.x * z, a.x * y - a.y * x};
}

// v turned back by the quaternion q.
GSLAM_ALWAYS_INLINE VectorPair turnedBack(const double* q, const VectorPair& v) noexcept {
  const Pair x = Pair::both(q[0]), y = Pair::both(q[1]), z = Pair::both(q[2]);
  const Pair w = Pair::both(q[3]);
  const VectorPair c = crossed(v, x, y, z);
  const VectorPair d = {c.x + c.x, c.y + c.y, c.z + c.z};
  const VectorPair e = crossed(d, x, y, z);
  return {(v.x + w * d.x) + e.x, (v.y + w * d.y) + e.y, (v.z + w * d.z) + e.z};
}

}  // namespace

// The ray from the first camera is f, that from the second g, its centre -e. There is little to do,
// and it is done for two vectors at a time.
std::size_t triangulateMidpoint(const SE3d& T_second_first, const Vec3d& bearing_first,
                                const Vec3d& bearing_second, Vec3d& point_first) noexcept {
  const Vec3d& f = bearing_first;
  const Vec3d& t = T_second_first.translation();
  const VectorPair ge = turnedBack(T_second_first.data(),
                                   {Pair(bearing_second[0], t[0]), Pair(bearing_second[1], t[1]),
                                    Pair(bearing_second[2], t[2])});
  const double gx = ge.x.first(), gy = ge.y.first(), gz = ge.z.first();
  const double ex = ge.x.second(), ey = ge.y.second(), ez = ge.z.second();
  const double nx = f[1] * gz - f[2] * gy, ny = f[2] * gx - f[0] * gz, nz = f[0] * gy - f[1] * gx;
  const Pair n_x = Pair::both(nx), n_y = Pair::both(ny), n_z = Pair::both(nz);
  const VectorPair moments = crossed({Pair(gx, f[0]), Pair(gy, f[1]), Pair(gz, f[2])},
                                     Pair::both(ex), Pair::both(ey), Pair::both(ez));
  // Depths times n^2, along the first ray and along the second.
  const Pair depths = moments.x * n_x + moments.y * n_y + moments.z * n_z;
  const Pair products = Pair(nx, ex) * n_x + Pair(ny, ey) * n_y + Pair(nz, ez) * n_z;
  const double n2 = products.first();
  if (!(n2 > detail::kLeastParallax && depths.first() > 0 && depths.second() > 0)) return 0;
  // The segment between the rays is parallel to n, so that its middle is as far along both.
  const double inverse = 1 / n2;
  const double along = inverse * depths.first();
  const double beside = -0.5 * (inverse * products.second());
  const Vec3d point = {
      {along * f[0] + beside * nx, along * f[1] + beside * ny, along * f[2] + beside * nz}};
  if (!(point.squaredNorm() <= std::numeric_limits<double>::max())) return 0;
  point_first = point;
  return 1;
}

}  // namespace v1
}  // namespace gslam
