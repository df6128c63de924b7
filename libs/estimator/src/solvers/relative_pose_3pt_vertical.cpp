#include <gslam/estimator/solvers/relative_pose_3pt_vertical.h>

#include <cmath>

#include "math/check_size.h"
#include "math/quartic.h"
#include "math/quaternion.h"

namespace gslam {
inline namespace v1 {
namespace {

// Of the normal of an epipolar plane's equations, squared: what rounding leaves of no motion.
constexpr double kLeastNormal = 1e-28;
// Of an equation, about an angle: double roots are not found better.
constexpr double kMostResidual = 1e-7;

bool rotationToZ(const Vec3d& direction, SO3d& rotation) {
  Vec3d unit;
  if (!detail::setUnit(direction, unit)) return false;
  detail::Quaternion q;
  detail::shortestToZ(unit, q);
  rotation = SO3d::fromQuaternion(q[0], q[1], q[2], q[3]);
  return true;
}

double crossed(const Vec3d& a, const Vec3d& b) noexcept {
  return a[0] * b[1] - a[1] * b[0];
}
double dotted(const Vec3d& a, const Vec3d& b) noexcept {
  return a[0] * b[0] + a[1] * b[1];
}

// cc cos^2 + cs cos sin + ss sin^2 + c cos + s sin
struct Trigonometric {
  double cc = 0, cs = 0, ss = 0, c = 0, s = 0;

  // The same of an angle less by that of (cosine, sine).
  Trigonometric shifted(double cosine, double sine) const noexcept {
    const double c2 = cosine * cosine, s2 = sine * sine, both = cosine * sine;
    return {cc * c2 + cs * both + ss * s2, 2 * (ss - cc) * both + cs * (c2 - s2),
            cc * s2 - cs * both + ss * c2, c * cosine + s * sine, s * cosine - c * sine};
  }
};

// The determinant of the rows (R a) x b, in which R turns by an angle about z.
Trigonometric determinantOf(const Vec3d* a, const Vec3d* b) noexcept {
  Trigonometric d;
  for (std::size_t i = 0; i < 3; ++i) {
    const std::size_t j = (i + 1) % 3, k = (i + 2) % 3;
    // The third element of row i: u cos + v sin.
    const double u = crossed(a[i], b[i]);
    const double v = -dotted(a[i], b[i]);
    // The minor of the others' first two: m + mc cos + ms sin.
    const double jk = a[j][2] * b[k][2], kj = b[j][2] * a[k][2];
    const double m =
        a[j][2] * a[k][2] * crossed(b[j], b[k]) + b[j][2] * b[k][2] * crossed(a[j], a[k]);
    const double mc = -(jk * crossed(b[j], a[k]) + kj * crossed(a[j], b[k]));
    const double ms = kj * dotted(a[j], b[k]) - jk * dotted(b[j], a[k]);
    d.cc += u * mc;
    d.cs += u * ms + v * mc;
    d.ss += v * ms;
    d.c += u * m;
    d.s += v * m;
  }
  return d;
}

// Cosines and sines of the angles at which it is 0.
struct Angles {
  explicit Angles(const Trigonometric& d) noexcept {
    // The half tangent is infinite at half a turn: that is put where |d| is large.
    static constexpr double kDiagonal = 0.70710678118654752;
    static constexpr double kStarts[4][2] = {
        {1, 0}, {0, 1}, {kDiagonal, kDiagonal}, {kDiagonal, -kDiagonal}};
    double largest = 0;
    double x = 1, y = 0;
    for (const auto& start : kStarts) {
      const double even =
          (d.cc * start[0] + d.cs * start[1]) * start[0] + d.ss * start[1] * start[1];
      const double odd = d.c * start[0] + d.s * start[1];
      const double sign = odd * even > 0 ? -1 : 1;
      const double size = std::fabs(even) + std::fabs(odd);
      if (!(size > largest)) continue;
      largest = size;
      x = sign * start[0];
      y = sign * start[1];
    }
    const Trigonometric p = d.shifted(x, y);
    const double quartic[5] = {p.cc + p.c, 2 * (p.cs + p.s), 4 * p.ss - 2 * p.cc, 2 * (p.s - p.cs),
                               p.cc - p.c};
    double roots[4];
    count = detail::quarticRoots(quartic, roots);
    for (std::size_t i = 0; i < count; ++i) {
      const double t2 = roots[i] * roots[i];
      const double inverse = 1 / (1 + t2);
      const double c = t2 < 1e300 ? (1 - t2) * inverse : -1;
      const double s = t2 < 1e300 ? 2 * roots[i] * inverse : 0;
      cosine[i] = c * x - s * y;
      sine[i] = s * x + c * y;
    }
  }

  std::size_t count;
  double cosine[4], sine[4];
};

// The three equations at an angle: their rows are (R a) x b.
struct Equations {
  Equations(const Vec3d* a, const Vec3d* b, double cosine, double sine) noexcept
      : c(cosine), s(sine) {
    for (std::size_t i = 0; i < 3; ++i) {
      turned[i] = {{c * a[i][0] - s * a[i][1], s * a[i][0] + c * a[i][1], a[i][2]}};
      rows[i] = turned[i].cross(b[i]);
    }
  }
  // The step of Newton's method on the determinant. Of rows that are all small it is far more exact
  // than the polynomial.
  double step(const Vec3d* b) const noexcept {
    double slope = 0;
    Vec3d minor{};
    for (std::size_t i = 0; i < 3; ++i) {
      minor = rows[(i + 1) % 3].cross(rows[(i + 2) % 3]);
      const Vec3d moved = {{-turned[i][1], turned[i][0], 0}};
      slope += moved.cross(b[i]).dot(minor);
    }
    return -rows[2].dot(minor) / slope;
  }

  double c, s;
  Vec3d turned[3], rows[3];
};

Equations bettered(const Vec3d* a, const Vec3d* b, double cosine, double sine) noexcept {
  Equations now(a, b, cosine, sine);
  for (int i = 0; i < 4; ++i) {
    const double step = now.step(b);
    const double size = std::fabs(step);
    if (!(size > 1e-13 && size < 0.05)) break;  // done, or a multiple root, or none
    const double c = now.c - step * now.s;
    const double s = now.s + step * now.c;
    const double scale = 1 / std::sqrt(c * c + s * s);
    now = Equations(a, b, scale * c, scale * s);
    if (size < 1e-8) break;  // the next one would be below rounding
  }
  return now;
}

// The direction at right angles to three rows that are nearly in a plane.
bool nullDirection(const Vec3d* rows, Vec3d& direction) noexcept {
  double largest = kLeastNormal;
  bool found = false;
  for (std::size_t i = 0; i < 3; ++i) {
    const Vec3d n = rows[i].cross(rows[(i + 1) % 3]);
    const double squared = n.squaredNorm();
    if (!(squared > largest)) continue;
    largest = squared;
    direction = n;
    found = true;
  }
  if (found) direction *= 1 / std::sqrt(largest);
  return found;
}

bool isSolved(const Vec3d* rows, const Vec3d& t) noexcept {
  for (std::size_t i = 0; i < 3; ++i) {
    if (!(std::fabs(rows[i].dot(t)) < kMostResidual)) return false;
  }
  return true;
}

// Turns t so that all points are in front of both cameras; false where neither sign does it.
bool isInFront(const Vec3d* turned, const Vec3d* b, const Vec3d* rows, Vec3d& t) noexcept {
  double sign = 0;
  for (std::size_t i = 0; i < 3; ++i) {
    const double first = b[i].cross(t).dot(rows[i]);
    const double second = turned[i].cross(t).dot(rows[i]);
    if (!(first * second > 0)) return false;
    if (sign == 0) sign = std::copysign(1.0, first);
    if (!(first * sign > 0)) return false;
  }
  t *= sign;
  return true;
}

}  // namespace

std::size_t relativePose3ptVertical(Span<const Vec3d> first, Span<const Vec3d> second,
                                    const Vec3d& gravity_first, const Vec3d& gravity_second,
                                    std::array<SE3d, 4>& T_second_first) {
  detail::checkSize("first", first.size(), 3);
  detail::checkSize("second", second.size(), 3);
  SO3d level_first, level_second;
  if (!rotationToZ(gravity_first, level_first)) return 0;
  if (!rotationToZ(gravity_second, level_second)) return 0;
  Vec3d a[3], b[3];
  for (std::size_t i = 0; i < 3; ++i) {
    a[i] = level_first * first[i];
    b[i] = level_second * second[i];
  }
  const Angles angles(determinantOf(a, b));
  std::size_t count = 0;
  for (std::size_t k = 0; k < angles.count; ++k) {
    const Equations e = bettered(a, b, angles.cosine[k], angles.sine[k]);
    Vec3d t;
    if (!nullDirection(e.rows, t) || !isSolved(e.rows, t)) continue;
    if (!isInFront(e.turned, b, e.rows, t)) continue;
    const double c = e.c, s = e.s;
    // Half of the angle, without a cancellation.
    const double half_c = c >= 0 ? std::sqrt(0.5 + 0.5 * c) : std::fabs(s) / std::sqrt(2 - 2 * c);
    const double half_s = c >= 0 ? std::fabs(s) / std::sqrt(2 + 2 * c) : std::sqrt(0.5 - 0.5 * c);
    const SO3d turn = SO3d::fromQuaternion(0, 0, std::copysign(half_s, s), half_c);
    const SO3d back = level_second.inverse();
    T_second_first[count++] = SE3d(back * turn * level_first, back * t);
  }
  return count;
}

}  // namespace v1
}  // namespace gslam
