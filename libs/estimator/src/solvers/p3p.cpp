#include <gslam/estimator/solvers/p3p.h>

#include <cmath>
#include <cstdint>
#include <cstring>

#include "math/check_size.h"
#include "math/triangle_pose.h"

namespace gslam {
inline namespace v1 {
namespace {

using detail::chosen;
using detail::Depths;
using detail::Triangle;
using detail::Two;
using detail::TwoFlags;

// How much of its square the discriminant of a double root may be off.
constexpr double kDouble = 1e-9;

// A member s M01 + t M02 - u M12 of the net of conics in the depths, where M_ij is the squared
// distance of two corners; symmetric, in the coordinates (d0, d1 - d0, d2 - d0).
struct Conic {
  double m00, m01, m02, m11, m12, m22;

  Conic(const Triangle& triangle, double s, double t, double u)
      : m00(2 * (s * triangle.c01 + t * triangle.c02 - u * triangle.c12)),
        m01(s * triangle.c01 - u * triangle.c12),
        m02(t * triangle.c02 - u * triangle.c12),
        m11(s - u),
        m12(u * (1 - triangle.c12)),
        m22(t - u) {}
};

// (s : t) of a degenerate conic s D1 + t D2, where D1 = M01 - a01 M12 and D2 = M02 - a02 M12.
struct Root {
  double s, t;
};

// The cube root of a positive number, to 1e-4: a third of the exponent, then a step of Halley's.
double roughCubeRoot(double x) {
  std::uint64_t bits;
  std::memcpy(&bits, &x, sizeof(bits));
  bits = bits / 3 + 0x2A9F7893782DA1CEu;
  double y;
  std::memcpy(&y, &bits, sizeof(y));
  const double cube = y * y * y;
  return y * (cube + 2 * x) / (2 * cube + x);
}

// The root of k3 t^3 + k2 t^2 s + k1 t s^2 + k0 s^3 that lies farthest from the others, the best
// conditioned: beyond the turning point, on the side that the value there tells. In x = k2 + 3 k3 t
// for s = 3 k3, which needs no division, nor k3 to be other than 0.
Root isolatedRoot(double k3, double k2, double k1, double k0) {
  const double s = 3 * k3, sk1 = s * k1, k22 = k2 * k2;
  const double g = sk1 - k22;  // x^3 + 3 g x + 2 h = 0
  const double h = k2 * (k22 - 1.5 * sk1) + 1.5 * (s * s) * k0;
  const double discriminant = h * h + g * g * g;
  const double magnitude = std::fabs(h);
  double x;
  if (discriminant > 0) {
    const double w = roughCubeRoot(magnitude + std::sqrt(discriminant));
    x = w - g / w;
  } else {
    // x = r u with u^3 - 3 u = k, 0 <= k <= 2: 2 cos(acos(k / 2) / 3) to 1e-6, by Chebyshev's
    // polynomials.
    const double r = std::sqrt(-g);
    const double k = 2 * magnitude / (-g * r);
    const double kk = k * k;
    x = r * ((1.73205196 + 0.166622564 * k) + kk * ((-0.0237768129 + 0.00549444639 * k) +
                                                    kk * (-0.00113177149 + 0.000123869162 * k)));
  }
  // A step of Halley's on the polynomial as it was given.
  const double t = std::copysign(x, -h) - k2;
  const double ts = t * s, ss = s * s, tt = t * t;
  const double value = t * (k3 * tt + k2 * ts) + s * (k1 * ts + k0 * ss);
  const double slope = 3 * k3 * tt + 2 * k2 * ts + k1 * ss;
  const double bend = 3 * k3 * t + k2 * s;
  const double divisor = slope * slope - value * bend;
  return {s, divisor > 0 ? t - value * slope / divisor : t};
}

Root degenerateConic(const Triangle& triangle) {
  const double a = triangle.a01, b = triangle.a02;
  const double c01 = triangle.c01, c02 = triangle.c02, c12 = triangle.c12;
  // 1 - m with m the product of the cosines, and the squared sines.
  const double one_m = c01 + (1 - c01) * (c02 + (1 - c02) * c12);
  const double n01 = c01 * (2 - c01), n02 = c02 * (2 - c02), n12 = c12 * (2 - c12);
  const double k3 = b * (b * n12 - n02);
  const double k2 = (1 - a) * n02 + b * (n12 * (2 * a + b) - 2 * one_m);
  const double k1 = (1 - b) * n01 + a * (n12 * (a + 2 * b) - 2 * one_m);
  const double k0 = a * (a * n12 - n01);
  const Root root = isolatedRoot(k3, k2, k1, k0);
  const bool is_root = std::fabs(root.s) + std::fabs(root.t) > 0;
  return is_root ? root : Root{1, 0};
}

// Where the two lines of a degenerate conic meet each other, and one more point on each.
struct Lines {
  double common[3];
  Two other[3];

  explicit Lines(const Conic& c) {
    const double a00 = c.m12 * c.m12 - c.m11 * c.m22;
    const double a11 = c.m02 * c.m02 - c.m00 * c.m22;
    const double a22 = c.m01 * c.m01 - c.m00 * c.m11;
    const double a01 = c.m01 * c.m22 - c.m02 * c.m12;
    const double a02 = c.m02 * c.m11 - c.m01 * c.m12;
    const double a12 = c.m00 * c.m12 - c.m01 * c.m02;
    // The common point is any column of the adjoint, which has rank 1: the one with the largest
    // element on the diagonal. The other points are where the lines meet the axis opposite.
    const double columns[9] = {a00, a01, a02, a01, a11, a12, a02, a12, a22};
    const double squares[5] = {c.m00, c.m11, c.m22, c.m00, c.m11};
    const double products[3] = {c.m12, c.m02, c.m01};
    static constexpr std::size_t kNext[4] = {1, 2, 0, 1};
    std::size_t i = a11 > a00;
    i = chosen(a22 > columns[4 * i], 2, i);
    const std::size_t j = kNext[i], k = kNext[i + 1];
    for (std::size_t l = 0; l < 3; ++l) common[l] = columns[3 * i + l];
    const double square = columns[4 * i];  // else it is a double line, or complex ones
    const double product = products[i];
    const double g = -(product + std::copysign(std::sqrt(square > 0 ? square : 0), product));
    other[i] = Two(0);
    other[j] = Two(g, squares[i + 2]);
    other[k] = Two(squares[i + 1], g);
  }
};

// Depths, up to their common factor, of the points where the lines meet a conic, where they are
// positive. Both lines at a time.
std::size_t meet(const Lines& lines, const Conic& conic, Depths (&depths)[5]) {
  const double* const v = lines.common;
  const Two* const p = lines.other;
  const double v0 = conic.m00 * v[0] + conic.m01 * v[1] + conic.m02 * v[2];
  const double v1 = conic.m01 * v[0] + conic.m11 * v[1] + conic.m12 * v[2];
  const double v2 = conic.m02 * v[0] + conic.m12 * v[1] + conic.m22 * v[2];
  // q0 s^2 + 2 q1 s t + q2 t^2 = 0 at s v + t p.
  const Two q0(v[0] * v0 + v[1] * v1 + v[2] * v2);
  const Two q1 = Two(v0) * p[0] + Two(v1) * p[1] + Two(v2) * p[2];
  const Two q2 = p[0] * (Two(conic.m00) * p[0] + Two(2 * conic.m01) * p[1]) +
                 p[1] * (Two(conic.m11) * p[1] + Two(2 * conic.m12) * p[2]) +
                 p[2] * (Two(conic.m22) * p[2] + Two(2 * conic.m02) * p[0]);
  const Two square = q1 * q1;
  const Two discriminant = square - q0 * q2;
  // Rounding parts a double root: one that is nearly double is left to Newton's method.
  const TwoFlags is_real = discriminant > Two(-kDouble) * square;
  const Two root = rootOf(chosenBy(discriminant > Two(0), discriminant, Two(0)));
  const Two g = -(q1 + signedAs(root, q1));
  std::size_t count = 0;
  for (int i = 0; i < 2; ++i) {
    const Two s = i == 0 ? q2 : g, t = i == 0 ? g : q0;
    const Two d = s * Two(v[0]) + t * p[0];
    const Two e = signedAs(Two(1), d) * (s * Two(v[1]) + t * p[1]);
    const Two f = signedAs(Two(1), d) * (s * Two(v[2]) + t * p[2]);
    const Two first = magnitudeOf(d);
    const TwoFlags is_solution = is_real & (first + e > Two(0)) & (first + f > Two(0));
    for (int k = 0; k < 2; ++k) {
      depths[count] = {first[k], {e[k], f[k]}};
      count += std::size_t(is_solution[k]);
    }
  }
  return count;
}

}  // namespace

std::size_t p3p(Span<const Vec3d> bearings, Span<const Vec3d> points,
                std::array<SE3d, 4>& T_camera_world) {
  detail::checkSize("bearings", bearings.size(), 3);
  detail::checkSize("points", points.size(), 3);
  Triangle triangle(bearings.data(), points.data());
  const Root root = degenerateConic(triangle);
  const double a = triangle.a01, b = triangle.a02;
  const Lines lines(Conic(triangle, root.s, root.t, root.s * a + root.t * b));
  // On those lines D1 and D2 are multiples of each other; the sum of their squares' parts is never
  // small.
  const Conic other(triangle, -root.t, root.s, root.s * b - root.t * a);
  Depths found[5];  // the last is written to, but not counted
  const std::size_t all = meet(lines, other, found);
  return triangle.poses(found, all, T_camera_world);
}

}  // namespace v1
}  // namespace gslam
