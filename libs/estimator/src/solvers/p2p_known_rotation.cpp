#include <gslam/estimator/solvers/p2p_known_rotation.h>

#include "math/check_size.h"
#include "math/two.h"

namespace gslam {
inline namespace v1 {
namespace {

using detail::Two;

struct TwoVectors {
  Two x, y, z;
};

// The sum of two points and their difference, which is exact for those that lie close together,
// both turned.
inline TwoVectors turnedSumAndSide(const double* rotation, const Vec3d& p, const Vec3d& q) {
  const Two x(q[0] + p[0], q[0] - p[0]), y(q[1] + p[1], q[1] - p[1]), z(q[2] + p[2], q[2] - p[2]);
  const Two ax(rotation[0]), ay(rotation[1]), az(rotation[2]), w(rotation[3]);
  const Two twice_x = ax + ax, twice_y = ay + ay, twice_z = az + az;
  const Two dx = twice_y * z - twice_z * y;
  const Two dy = twice_z * x - twice_x * z;
  const Two dz = twice_x * y - twice_y * x;
  return {(w * dx + x) + (ay * dz - az * dy), (w * dy + y) + (az * dx - ax * dz),
          (w * dz + z) + (ax * dy - ay * dx)};
}

}  // namespace

// Two numbers at a time: it is called millions of times, and most of it is done twice.
std::size_t p2pKnownRotation(Span<const Vec3d> bearings, Span<const Vec3d> points,
                             const SO3d& R_camera_world, SE3d& T_camera_world) {
  detail::checkSize("bearings", bearings.size(), 2);
  detail::checkSize("points", points.size(), 2);
  const Vec3d& a = bearings[0];
  const Vec3d& b = bearings[1];
  const TwoVectors turned = turnedSumAndSide(R_camera_world.data(), points[0], points[1]);
  // The depths s and t that make |t b - s a - side| least, by products with the normal, which are
  // exact for narrow angles too: side . (n x b) / n^2 and side . (n x a) / n^2, and half of them.
  const Vec3d n = a.cross(b);
  const double square = n.squaredNorm();
  const Two nx(n[0]), ny(n[1]), nz(n[2]);
  const Two x(b[0], a[0]), y(b[1], a[1]), z(b[2], a[2]);
  const Two along = (ny * z - nz * y) * Two(turned.x[1]) + (nz * x - nx * z) * Two(turned.y[1]) +
                    (nx * y - ny * x) * Two(turned.z[1]);
  const Two half_depths = along * Two(0.5 / square);
  const double s = half_depths[0], t = half_depths[1];
  // The middle of s a and t b - side is where the first point should be.
  const Two xy = (Two(s) * Two::load(a.data()) + Two(t) * Two::load(b.data())) -
                 Two(0.5) * Two(turned.x[0], turned.y[0]);
  const Vec3d translation = {{xy[0], xy[1], (s * a[2] + t * b[2]) - 0.5 * turned.z[0]}};
  const double sum = (translation[0] + translation[1]) + translation[2];
  // The last comparison is false for what is not finite.
  if (!((square > 1e-24) & (s > 0) & (t > 0) & (sum - sum == 0))) return 0;
  T_camera_world = SE3d(R_camera_world, translation);
  return 1;
}

}  // namespace v1
}  // namespace gslam
