#include <gslam/estimator/solvers/p2p_known_vertical.h>

#include <cmath>

#include "math/check_size.h"
#include "math/quaternion.h"
#include "math/triangle_pose.h"

namespace gslam {
inline namespace v1 {
namespace {

using detail::minus;
using detail::mixOf;
using detail::Quaternion;
using detail::turned;

// A rotation from one unit vector to another, by way of z.
void uprightOf(const Vec3d& from, const Vec3d& to, Quaternion& q) noexcept {
  Quaternion from_z, to_z;
  detail::shortestToZ(from, to_z);
  detail::shortestToZ(to, from_z);
  for (std::size_t i = 0; i < 3; ++i) from_z[i] = -from_z[i];
  detail::multiply(from_z, to_z, q);
}

}  // namespace

std::size_t p2pKnownVertical(Span<const Vec3d> bearings, Span<const Vec3d> points,
                             const Vec3d& gravity_camera, const Vec3d& gravity_world,
                             std::array<SE3d, 2>& T_camera_world) {
  detail::checkSize("bearings", bearings.size(), 2);
  detail::checkSize("points", points.size(), 2);
  const Vec3d& a = bearings[0];
  const Vec3d& b = bearings[1];
  Vec3d g, up;
  if (!detail::setUnit(gravity_camera, g) || !detail::setUnit(gravity_world, up)) return 0;
  Quaternion upright;
  uprightOf(up, g, upright);
  // The step from the first to the second point, upright but for the heading: height g + side.
  const Vec3d step = minus(points[1], points[0]);
  const double height = step.dot(up);
  const Vec3d side = turned(upright, mixOf(1, step, -height, up));
  // t b - s a = height g + u + x w with u and w horizontal, for (s, t) = height (-ga, gb) / sum +
  // x (gb, ga): all depths with that height.
  const double ga = g.dot(a), gb = g.dot(b);
  const double sum = ga * ga + gb * gb;
  const double part = height / sum;
  const Vec3d w = mixOf(ga, b, -gb, a);
  const Vec3d u = mixOf(part, mixOf(gb, b, ga, a), -height, g);
  // |u + x w|^2 = |side|^2.
  const double ww = w.squaredNorm(), uw = u.dot(w), ss = side.squaredNorm();
  // As |u|^2 |w|^2 - (u w)^2 = |u x w|^2, which does not cancel.
  const double discriminant = ww * ss - u.cross(w).squaredNorm();
  if (!((discriminant > -1e-12 * ww * ss) & (ww > 1e-28) & (ss > 1e-28 * step.squaredNorm()))) {
    return 0;
  }
  const double root = std::sqrt(discriminant > 0 ? discriminant : 0);
  std::size_t count = 0;
  for (int i = 0; i < 2; ++i) {
    const double x = ((i == 0 ? root : -root) - uw) / ww;
    const double s = x * gb - part * ga, t = x * ga + part * gb;
    if (!(s > 0 && t > 0)) continue;
    const Vec3d seen = mixOf(1, u, x, w);
    // Half the angle from side to seen, about g; by whichever of its two forms does not cancel.
    const double cosine = side.dot(seen), sine = g.dot(side.cross(seen));
    const bool is_acute = cosine > 0;
    const double length = std::sqrt(cosine * cosine + sine * sine);
    const double half_w = is_acute ? length + cosine : std::fabs(sine);
    const double half_g = is_acute ? sine : std::copysign(length - cosine, sine);
    const Quaternion heading = {half_g * g[0], half_g * g[1], half_g * g[2], half_w};
    Quaternion q;
    detail::multiply(heading, upright, q);
    if (!detail::normalize(q)) continue;
    const Vec3d corner = turned(q, points[0]);
    const Vec3d translation = mixOf(s, a, -1, corner);
    if (!std::isfinite(translation[0] + translation[1] + translation[2])) continue;
    T_camera_world[count++] = detail::poseOf(q, translation);
  }
  return count;
}

}  // namespace v1
}  // namespace gslam
