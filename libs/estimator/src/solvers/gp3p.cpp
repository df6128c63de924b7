#include <gslam/estimator/solvers/gp3p.h>
#include <gslam/estimator/solvers/p3p.h>

#include <algorithm>
#include <cmath>

#include "math/bernstein.h"
#include "math/check_size.h"
#include "math/triangle_pose.h"

namespace gslam {
inline namespace v1 {
namespace {

using detail::Bernstein;
using detail::minus;
using detail::mixOf;
using detail::SideFrame;
using detail::times;

// |P_i - P_j|^2 - side^2 for the points at depths d + e and d + f on two rays:
// (e - f)^2 + 2 c (d + e) (d + f) + 2 d q + 2 e p - 2 f s + r.
struct Distance {
  double c;        // 1 - cos of the angle between the rays
  double p, s, q;  // first and second bearing . apart, and their difference . apart
  double r;        // |apart|^2 - side^2, with apart from the second origin to the first
};

// Three rays and points; ray 0 is the one that is least parallel to the others, the unit of length
// the longest side.
struct Rig {
  Vec3d origins[3];
  Vec3d rays[3];
  Vec3d corner;
  Vec3d side1, side2;
  double unit;
  double squares[3];  // of the sides opposite
  double offset;      // sum of the squared distances of the origins
  Distance d01, d02, d12;

  Rig(const Vec3d* from, const Vec3d* bearings, const Vec3d* points) {
    const double narrow[3] = {turn(bearings[1], bearings[2]), turn(bearings[2], bearings[0]),
                              turn(bearings[0], bearings[1])};
    std::size_t i = 0;  // opposite of the smallest angle
    if (narrow[1] < narrow[i]) i = 1;
    if (narrow[2] < narrow[i]) i = 2;
    const std::size_t order[3] = {i, (i + 1) % 3, (i + 2) % 3};
    side1 = minus(points[order[1]], points[i]);
    side2 = minus(points[order[2]], points[i]);
    squares[0] = minus(side2, side1).squaredNorm();
    squares[1] = side2.squaredNorm();
    squares[2] = side1.squaredNorm();
    const double largest = std::max(squares[0], std::max(squares[1], squares[2]));
    unit = std::sqrt(largest);
    const double inverse = 1 / unit;
    corner = points[i];
    side1 = times(inverse, side1);
    side2 = times(inverse, side2);
    for (double& square : squares) square /= largest;
    for (std::size_t k = 0; k < 3; ++k) {
      origins[k] = times(inverse, from[order[k]]);
      rays[k] = bearings[order[k]];
    }
    offset = 0;
    d01 = distanceOf(0, 1, squares[2]);
    d02 = distanceOf(0, 2, squares[1]);
    d12 = distanceOf(1, 2, squares[0]);
  }

  static double turn(const Vec3d& a, const Vec3d& b) { return a.cross(b).squaredNorm(); }

  Distance distanceOf(std::size_t i, std::size_t j, double square) {
    const Vec3d apart = minus(origins[i], origins[j]);
    const Vec3d difference = minus(rays[i], rays[j]);
    const double length = apart.squaredNorm();
    offset += length;  // NaN stays
    return {0.5 * difference.squaredNorm(), rays[i].dot(apart), rays[j].dot(apart),
            difference.dot(apart), length - square};
  }
};

// Depths of ray 0 within which a point of the other ray is as near as the points are.
void narrow(const Distance& other, double& low, double& high) {
  const double n = other.c * (2 - other.c), half = other.c * other.s + other.q;
  const double discriminant = half * half + n * (other.s * other.s - other.r);
  if (!(discriminant >= 0)) {
    high = -1;
    return;
  }
  const double root = std::sqrt(discriminant);
  low = std::max(low, (-half - root) / n);
  high = std::min(high, (-half + root) / n);
}

// k0 + k1 d and k0 + k1 d + k2 d^2 for the depths d from low to high.
Bernstein<1> linear(double low, double high, double k1, double k0) {
  return {{k0 + k1 * low, k0 + k1 * high}};
}
Bernstein<2> quadratic(double low, double high, double k2, double k1, double k0) {
  return {{k0 + low * (k1 + k2 * low), 2 * (k0 + k2 * low * high) + k1 * (low + high),
           k0 + high * (k1 + k2 * high)}};
}

// The polynomial in the depth d of ray 0 whose roots are those of the solutions, low to high. With
// e and f the other depths less d, the distances are
//   e^2 + a1 e + b1 = 0, f^2 + a2 f + b2 = 0, e^2 + f^2 + g e f + v e + w f + z = 0.
// The last less the others is bilinear, f = -(s e + t) / (g e + u); that in the second, and less
// the first, is linear, l1 e + l0 = 0; that in the first is the polynomial.
Bernstein<8> eliminate(const Rig& rig, double low, double high) {
  const Distance &m01 = rig.d01, &m02 = rig.d02, &m12 = rig.d12;
  const double g = 2 * m12.c - 2, c = 2 * m12.c;
  const Bernstein<1> a1 = linear(low, high, 2 * m01.c, -2 * m01.s);
  const Bernstein<1> a2 = linear(low, high, 2 * m02.c, -2 * m02.s);
  const Bernstein<2> b1 = quadratic(low, high, 2 * m01.c, 2 * m01.q, m01.r);
  const Bernstein<2> b2 = quadratic(low, high, 2 * m02.c, 2 * m02.q, m02.r);
  const Bernstein<1> s = linear(low, high, c - 2 * m01.c, 2 * m12.p + 2 * m01.s);
  const Bernstein<1> u = linear(low, high, c - 2 * m02.c, -2 * m12.s + 2 * m02.s);
  const Bernstein<2> t = quadratic(low, high, c - 2 * (m01.c + m02.c), 2 * (m12.q - m01.q - m02.q),
                                   m12.r - m01.r - m02.r);
  const Bernstein<2> k2 = s * s + g * (g * b2 - a2 * s);
  const Bernstein<3> k1 = s * (2.0 * t - a2 * u) + g * (2.0 * (b2 * u) - a2 * t);
  const Bernstein<4> k0 = t * (t - a2 * u) + b2 * (u * u);
  const Bernstein<3> l1 = k1 - a1 * k2;
  const Bernstein<4> l0 = k0 - b1 * k2;
  return l0 * (l0 - a1 * l1) + b1 * (l1 * l1);
}

// Three depths, and the vectors between the points at them.
struct Solution {
  double d[3];
  Vec3d p10, p20;

  // Residuals of the three distances; their size.
  double residuals(const Rig& rig, double (&r)[3]) {
    const Vec3d p0 = along(rig, 0);
    p10 = minus(along(rig, 1), p0);
    p20 = minus(along(rig, 2), p0);
    r[0] = p10.squaredNorm() - rig.squares[2];
    r[1] = p20.squaredNorm() - rig.squares[1];
    r[2] = minus(p20, p10).squaredNorm() - rig.squares[0];
    return std::fabs(r[0]) + std::fabs(r[1]) + std::fabs(r[2]);
  }
  Vec3d along(const Rig& rig, std::size_t i) const {
    return mixOf(1, rig.origins[i], d[i], rig.rays[i]);
  }

  // Newton's method on them; false where it does not end at a solution with positive depths.
  bool refine(const Rig& rig) {
    double r[3];
    double error = residuals(rig, r);
    // Rounding of the points' coordinates, squared distances of which the residuals are.
    const double rounding = 1e-15 * (1 + std::fabs(d[0]) + std::fabs(d[1]) + std::fabs(d[2]));
    for (int step = 0; step < 12 && error > rounding; ++step) {
      // Half the derivatives: (a b 0), (c 0 g), (0 h k).
      const double a = -rig.rays[0].dot(p10), b = rig.rays[1].dot(p10);
      const double c = -rig.rays[0].dot(p20), g = rig.rays[2].dot(p20);
      const Vec3d p21 = minus(p20, p10);
      const double h = -rig.rays[1].dot(p21), k = rig.rays[2].dot(p21);
      const double inverse = -0.5 / (a * g * h + b * c * k);
      const double to0 = (b * (g * r[2] - k * r[1]) - g * h * r[0]) * inverse;
      const double to1 = (a * (k * r[1] - g * r[2]) - c * k * r[0]) * inverse;
      const double to2 = (c * h * r[0] - h * a * r[1] - b * c * r[2]) * inverse;
      Solution next = *this;
      next.d[0] -= to0;
      next.d[1] -= to1;
      next.d[2] -= to2;
      const double next_error = next.residuals(rig, r);
      if (!(next_error < error)) break;
      *this = next;
      error = next_error;
    }
    return (error < 1e-12 + rounding) & (d[0] > 0) & (d[1] > 0) & (d[2] > 0);
  }

  bool isLike(const Solution& other) const {
    const double difference =
        std::fabs(d[0] - other.d[0]) + std::fabs(d[1] - other.d[1]) + std::fabs(d[2] - other.d[2]);
    return difference < 1e-7 * (1 + d[0]);
  }
};

// The pairs of roots (e, f) of the first two distances at depth d that fit the third best. Two of
// them where both fit: solutions that are alike in d.
std::size_t complete(const Rig& rig, double d, Solution (&found)[2]) {
  const Distance &m01 = rig.d01, &m02 = rig.d02, &m12 = rig.d12;
  const double half1 = m01.s - m01.c * d, half2 = m02.s - m02.c * d;
  const double b1 = m01.r + 2 * d * (m01.q + m01.c * d);
  const double b2 = m02.r + 2 * d * (m02.q + m02.c * d);
  const double root1 = std::sqrt(std::max(half1 * half1 - b1, 0.0));
  const double root2 = std::sqrt(std::max(half2 * half2 - b2, 0.0));
  double errors[4];
  std::size_t best = 0;
  for (std::size_t i = 0; i < 4; ++i) {
    const double e = i < 2 ? half1 + root1 : half1 - root1;
    const double f = i % 2 == 0 ? half2 + root2 : half2 - root2;
    errors[i] = std::fabs((e - f) * (e - f) + 2 * m12.c * (d + e) * (d + f) +
                          2 * (d * m12.q + e * m12.p - f * m12.s) + m12.r);
    if (errors[i] < errors[best]) best = i;
  }
  std::size_t count = 0;
  for (std::size_t i = 0; i < 4 && count < 2; ++i) {
    if (i != best && !(errors[i] < 1e-5)) continue;
    if (i != best && count == 1 && best > i) continue;
    found[count].d[0] = d;
    found[count].d[1] = d + (i < 2 ? half1 + root1 : half1 - root1);
    found[count].d[2] = d + (i % 2 == 0 ? half2 + root2 : half2 - root2);
    ++count;
  }
  return count;
}

bool poseOf(const Rig& rig, const SideFrame& frame, const Solution& solution, SE3d& T_rig_world) {
  double q[4];
  if (!frame.rotation(solution.p10, solution.p20, q)) return false;
  double depth = solution.d[0];
  const detail::FlatTriangle flat{
      {rig.rays[0], rig.rays[1], rig.rays[2]},
      {rig.side1, rig.side2},
      {minus(rig.origins[0], rig.origins[1]), minus(rig.origins[0], rig.origins[2])}};
  if (frame.isFlat() && !flat.refine(q, depth)) return false;
  const Vec3d seen = mixOf(rig.unit, rig.origins[0], rig.unit * depth, rig.rays[0]);
  const Vec3d translation = minus(seen, detail::turned(q, rig.corner));
  if (!std::isfinite(translation[0] + translation[1] + translation[2])) return false;
  T_rig_world = detail::poseOf(q, translation);
  return true;
}

// All rays start in one place.
std::size_t central(const Vec3d& origin, Span<const Vec3d> bearings, Span<const Vec3d> points,
                    std::array<SE3d, 8>& T_rig_world) {
  std::array<SE3d, 4> T_camera_world;
  const std::size_t all = p3p(bearings, points, T_camera_world);
  std::size_t count = 0;
  for (std::size_t i = 0; i < all; ++i) {
    const SE3d& T = T_camera_world[i];
    const Vec3d translation = T.translation() + origin;
    if (!std::isfinite(translation[0] + translation[1] + translation[2])) continue;
    T_rig_world[count++] = SE3d(T.rotation(), translation);
  }
  return count;
}

}  // namespace

std::size_t gp3p(Span<const Vec3d> origins, Span<const Vec3d> bearings, Span<const Vec3d> points,
                 std::array<SE3d, 8>& T_rig_world) {
  detail::checkSize("origins", origins.size(), 3);
  detail::checkSize("bearings", bearings.size(), 3);
  detail::checkSize("points", points.size(), 3);
  const Rig rig(origins.data(), bearings.data(), points.data());
  if (!(rig.offset < 1e280)) return 0;
  if (rig.offset < 1e-28) return central(origins[0], bearings, points, T_rig_world);
  double low = 0, high = 1e9;
  narrow(rig.d01, low, high);
  narrow(rig.d02, low, high);
  if (!(low <= high)) return 0;
  // Roots at the ends, where the other depths are double, are not to be lost by rounding.
  const double margin = 1e-7 * (high - low) + 1e-12 * high;
  low -= margin;
  high += margin;
  double roots[8];
  const std::size_t candidates = detail::octicRoots(eliminate(rig, low, high), roots);
  const SideFrame frame(rig.side1, rig.side2);
  Solution solutions[8];
  std::size_t count = 0;
  for (std::size_t i = 0; i < candidates; ++i) {
    Solution found[2];
    const std::size_t pairs = complete(rig, low + roots[i] * (high - low), found);
    for (std::size_t k = 0; k < pairs && count < 8; ++k) {
      if (!found[k].refine(rig)) continue;
      bool is_new = true;
      for (std::size_t j = 0; j < count; ++j) is_new = is_new && !found[k].isLike(solutions[j]);
      if (!is_new) continue;
      solutions[count] = found[k];
      if (poseOf(rig, frame, found[k], T_rig_world[count])) ++count;
    }
  }
  return count;
}

}  // namespace v1
}  // namespace gslam
