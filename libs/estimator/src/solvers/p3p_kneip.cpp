#include <gslam/estimator/solvers/p3p_kneip.h>

#include <cmath>

#include "math/check_size.h"
#include "math/quartic.h"
#include "math/triangle_pose.h"

namespace gslam {
inline namespace v1 {
namespace {

using detail::Depths;
using detail::Triangle;

// The paper's quantities, for the points 1 and 2 at distance 1, which are the ends of the longest
// side, and the point 3, which is the corner opposite.
struct Parameters {
  double p1, p2;   // point 3 in the plane of the points: along the side from point 1, and off it
  double x, y, z;  // direction 3 in the frame of direction 1 and the plane of 1 and 2; z <= 0
  double b;        // cot of the angle between the directions 1 and 2
  bool is_swapped;
};

Parameters parametersOf(const Triangle& triangle) {
  Parameters p;
  const Vec3d n = triangle.ray(1).cross(triangle.ray(2));
  const double sine = n.norm();
  const Vec3d& direction = triangle.ray(0);
  p.z = direction.dot(n) / sine;
  p.is_swapped = p.z > 0;
  const Vec3d& first = triangle.ray(p.is_swapped ? 2 : 1);
  const double sign = p.is_swapped ? -1 : 1;
  p.z *= sign;
  p.x = direction.dot(first);
  p.y = direction.dot(n.cross(first)) * sign / sine;
  p.b = (1 - triangle.c12) / sine;
  // In the triangle with sides 1, a01 and a02.
  const double along = 0.5 * (1 + triangle.a01 - triangle.a02);
  p.p1 = p.is_swapped ? 1 - along : along;
  p.p2 = triangle.side1().cross(triangle.side2()).norm();
  return p;
}

// The quartic (11) in u = p2 cos(theta), which no flat triangle makes vanish.
std::size_t rootsOf(const Parameters& p, double (&u)[4]) {
  const double zz = p.z * p.z, pp = p.p2 * p.p2, q1 = p.p1 * (1 - p.p1);
  const double w =
      p.x * p.p1 * (p.x * p.p1 - 2 * p.y * p.b) + p.y * p.y * ((1 - p.p1) * (1 - p.p1) + p.b * p.b);
  const double c[5] = {pp * w - zz * q1 * q1, 2 * (pp * p.y * (p.x - p.y * p.b) - q1 * p.b * zz),
                       pp * (p.x * p.x + p.y * p.y) - w + zz * (2 * q1 - p.b * p.b),
                       2 * (p.b * (zz + p.y * p.y) - p.x * p.y), -1};
  return detail::quarticRoots(c, u);
}

// The distances of the camera from the three points, as ratios to that of point 3.
bool ratiosOf(const Parameters& p, double u, Depths& ratios) {
  if (!(std::fabs(u) <= 1.001 * p.p2 + 1e-9)) return false;
  const double numerator = p.x * p.p1 + p.y * (u - p.b);
  const double divisor = p.x * u + p.y * (1 - p.p1);
  const double length = std::sqrt(numerator * numerator + divisor * divisor);
  const double sine = std::fabs(divisor) / length;
  const double cosine = std::copysign(numerator, numerator * divisor) / length;
  const double d1 = sine * p.b + cosine;
  if (!(d1 > 0)) return false;
  const double along = d1 * cosine, off = d1 * sine;
  const double d2 = std::sqrt((1 - along) * (1 - along) + off * off);
  // |(off cos(theta) - p2, off sin(theta))|^2, with u = p2 cos(theta).
  const double square = (along - p.p1) * (along - p.p1) + off * off + p.p2 * p.p2 - 2 * off * u;
  const double inverse = 1 / std::sqrt(square);
  const double e = d1 * inverse - 1, f = d2 * inverse - 1;
  ratios = p.is_swapped ? Depths{1, {f, e}} : Depths{1, {e, f}};
  return square > 0;
}

}  // namespace

std::size_t p3pKneip(Span<const Vec3d> bearings, Span<const Vec3d> points,
                     std::array<SE3d, 4>& T_camera_world) {
  detail::checkSize("bearings", bearings.size(), 3);
  detail::checkSize("points", points.size(), 3);
  Triangle triangle(bearings.data(), points.data());
  const Parameters parameters = parametersOf(triangle);
  double roots[4];
  const std::size_t found = rootsOf(parameters, roots);
  Depths ratios[4];
  std::size_t all = 0;
  for (std::size_t i = 0; i < found; ++i) {
    if (ratiosOf(parameters, roots[i], ratios[all])) ++all;
  }
  return triangle.distinctPoses(ratios, all, T_camera_world);
}

}  // namespace v1
}  // namespace gslam
