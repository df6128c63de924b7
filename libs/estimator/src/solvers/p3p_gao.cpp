#include <gslam/estimator/solvers/p3p_gao.h>

#include <cmath>

#include "math/check_size.h"
#include "math/quartic.h"
#include "math/triangle_pose.h"

namespace gslam {
inline namespace v1 {
namespace {

using detail::Depths;
using detail::Triangle;

// The system (2) in x = d1 / d0 and y = d2 / d0,
//   -a y^2 + a r x y + (1 - a) x^2 - q x + 1 = 0,
//   (1 - b) y^2 + (b r x - p) y + 1 - b x^2 = 0,
// with a and b the squared sides 0-1 and 0-2, the side 1-2 being 1.
struct System {
  double a, b, p, q, r;

  explicit System(const Triangle& triangle)
      : a(triangle.a01),
        b(triangle.a02),
        p(2 - 2 * triangle.c02),
        q(2 - 2 * triangle.c01),
        r(2 - 2 * triangle.c12) {}

  // y^2 eliminated: numerator(x) = a divisor(x) y.
  double numerator(double x) const { return ((1 - a - b) * x - (1 - b) * q) * x + (1 - b + a); }
  double divisor(double x) const { return p - r * x; }

  // y of that put into the first: the quartic in x.
  std::size_t roots(double (&x)[4]) const {
    const double n2 = 1 - a - b, n1 = -(1 - b) * q, n0 = 1 - b + a;
    // -N^2 + a r x N D + a W D^2, with D = p - r x and W = (1 - a) x^2 - q x + 1.
    const double pp = p * p, pr = 2 * p * r, rr = r * r, w2 = 1 - a;
    const double c[5] = {
        -n0 * n0 + a * pp, -2 * n1 * n0 + a * (r * n0 * p - pr - q * pp),
        -2 * n2 * n0 - n1 * n1 + a * (r * (n1 * p - n0 * r) + rr + q * pr + w2 * pp),
        -2 * n2 * n1 + a * (r * (n2 * p - n1 * r) - q * rr - w2 * pr),
        -n2 * n2 + a * (w2 * rr - rr * n2)};
    return detail::quarticRoots(c, x);
  }

  // Adds the y of an x.
  void complete(double x, Depths* ratios, std::size_t& all) const {
    if (!(x > 0)) return;
    const double n = numerator(x), d = a * divisor(x);
    if (std::fabs(d) > 1e-3 * (std::fabs(n) + a * (std::fabs(p) + std::fabs(r) * x))) {
      if (n / d > 0) ratios[all++] = {1, {x - 1, n / d - 1}};
      return;
    }
    // Both vanish: y is a root of the first equation.
    const double half = 0.5 * r * x;
    const double square = half * half + (((1 - a) * x - q) * x + 1) / a;
    if (!(square > -1e-4)) return;
    const double root = std::sqrt(square > 0 ? square : 0);
    if (half + root > 0) ratios[all++] = {1, {x - 1, half + root - 1}};
    if (half - root > 0) ratios[all++] = {1, {x - 1, half - root - 1}};
  }
};

}  // namespace

std::size_t p3pGao(Span<const Vec3d> bearings, Span<const Vec3d> points,
                   std::array<SE3d, 4>& T_camera_world) {
  detail::checkSize("bearings", bearings.size(), 3);
  detail::checkSize("points", points.size(), 3);
  Triangle triangle(bearings.data(), points.data());
  const System system(triangle);
  double roots[4];
  const std::size_t found = system.roots(roots);
  Depths ratios[8];
  std::size_t all = 0;
  for (std::size_t i = 0; i < found; ++i) system.complete(roots[i], ratios, all);
  return triangle.distinctPoses(ratios, all, T_camera_world);
}

}  // namespace v1
}  // namespace gslam
