// Real roots of polynomials of degree four.
#ifndef GSLAM_ESTIMATOR_MATH_QUARTIC_H
#define GSLAM_ESTIMATOR_MATH_QUARTIC_H

#include <cmath>
#include <cstddef>

namespace gslam {
inline namespace v1 {
namespace detail {

namespace quartic_parts {

// Discriminants of double roots come out so far off, as a part of their largest term, because the
// root of the resolvent is exact to the square root of epsilon only.
constexpr double kDouble = 1e-6;
// What a root may leave of the polynomial, as a part of the sum of its terms' magnitudes: complex
// roots leave more, unless they are within 1e-5 of the real line.
constexpr double kRest = 1e-10;

// The largest real root of z^3 + b z^2 + c z + d.
inline double largestRootOfCubic(double b, double c, double d) {
  const double shift = b * (1.0 / 3);
  const double g = c * (1.0 / 3) - shift * shift;
  const double h = 0.5 * (d + shift * (2 * shift * shift - c));
  const double discriminant = h * h + g * g * g;
  double x;
  if (discriminant > 0) {
    const double w = std::cbrt(std::fabs(h) + std::sqrt(discriminant));
    x = w > 0 ? std::copysign(w - g / w, -h) : 0;
  } else {
    const double r = std::sqrt(-g);
    const double cosine = r > 0 ? -h / (-g * r) : 0;
    const double third = std::acos(cosine > 1 ? 1 : (cosine < -1 ? -1 : cosine)) * (1.0 / 3);
    x = 2 * r * std::cos(third);
  }
  x -= shift;
  for (int step = 0; step < 2; ++step) {
    const double slope = (3 * x + 2 * b) * x + c;
    const double move = (((x + b) * x + c) * x + d) / slope;
    if (!(std::fabs(move) < 0.1 * std::fabs(x))) break;  // a double root
    x -= move;
  }
  return x;
}

// Real roots of y^2 + b y + c.
inline std::size_t quadraticRoots(double b, double c, double* roots) {
  const double half = -0.5 * b;
  const double discriminant = half * half - c;
  if (!(discriminant > -kDouble * (half * half + std::fabs(c)))) return 0;
  const double g = half + std::copysign(std::sqrt(discriminant > 0 ? discriminant : 0), half);
  roots[0] = g;
  roots[1] = g != 0 ? c / g : 0;
  return 2;
}

// Ferrari's: the real roots of x^4 + b x^3 + c x^2 + d x + e, not yet bettered.
inline std::size_t monicRoots(double b, double c, double d, double e, double* roots) {
  const double shift = 0.25 * b;
  const double ss = shift * shift;
  const double p = c - 6 * ss;
  const double q = d + shift * (8 * ss - 2 * c);
  const double r = e + shift * (shift * (c - 3 * ss) - d);
  const double z = largestRootOfCubic(2 * p, p * p - 4 * r, -q * q);
  std::size_t count = 0;
  const double size = std::fabs(p) + std::sqrt(std::fabs(r));
  if (z > 1e-14 * size) {  // two quadratics
    const double m = std::sqrt(z);
    const double middle = 0.5 * (p + z), part = 0.5 * q / m;
    count = quadraticRoots(m, middle - part, roots);
    count += quadraticRoots(-m, middle + part, roots + count);
  } else {  // without odd powers
    double squares[2];
    const std::size_t found = quadraticRoots(p, r, squares);
    for (std::size_t i = 0; i < found; ++i) {
      if (!(squares[i] >= -kDouble * size)) continue;
      const double y = std::sqrt(squares[i] > 0 ? squares[i] : 0);
      roots[count++] = y;
      roots[count++] = -y;
    }
  }
  for (std::size_t i = 0; i < count; ++i) roots[i] -= shift;
  return count;
}

// Steps of Newton's as long as they lead nearer to 0; half the error each for double roots. False
// where that leads to no root.
inline bool better(const double (&c)[5], double& x) {
  double value = (((c[4] * x + c[3]) * x + c[2]) * x + c[1]) * x + c[0];
  for (int step = 0; step < 12; ++step) {
    const double slope = ((4 * c[4] * x + 3 * c[3]) * x + 2 * c[2]) * x + c[1];
    const double next = x - value / slope;
    const double next_value = (((c[4] * next + c[3]) * next + c[2]) * next + c[1]) * next + c[0];
    if (!(std::fabs(next_value) < std::fabs(value))) break;
    value = next_value;
    x = next;
  }
  const double a = std::fabs(x);
  const double terms =
      (((std::fabs(c[4]) * a + std::fabs(c[3])) * a + std::fabs(c[2])) * a + std::fabs(c[1])) * a +
      std::fabs(c[0]);
  return std::fabs(value) <= kRest * terms;
}

// The roots of a polynomial whose first coefficient is not small.
inline std::size_t forwardRoots(const double (&c)[5], double* roots) {
  const double inverse = 1 / c[4];
  double found[4];
  const std::size_t all =
      monicRoots(c[3] * inverse, c[2] * inverse, c[1] * inverse, c[0] * inverse, found);
  std::size_t count = 0;
  for (std::size_t i = 0; i < all; ++i) {
    if (better(c, found[i])) roots[count++] = found[i];
  }
  return count;
}

// The polynomial of x that is c at (u x - v) : (v x + u).
inline void rotate(const double (&c)[5], double u, double v, double (&rotated)[5]) {
  double power[5];
  for (double& value : rotated) value = 0;
  for (std::size_t k = 0; k <= 4; ++k) {
    double term[5] = {c[k], 0, 0, 0, 0};
    for (std::size_t factor = 0; factor < 4; ++factor) {
      const double first = factor < k ? u : v, last = factor < k ? -v : u;
      for (std::size_t i = 4; i > 0; --i) power[i] = last * term[i] + first * term[i - 1];
      power[0] = last * term[0];
      for (std::size_t i = 0; i <= 4; ++i) term[i] = power[i];
    }
    for (std::size_t i = 0; i <= 4; ++i) rotated[i] += term[i];
  }
}

// The first and the last coefficient are both small: there are roots near 0 and near infinity. The
// circle of x : y is turned until none is at infinity.
inline std::size_t rotatedRoots(const double (&c)[5], double* roots) {
  static constexpr double kTurns[6][2] = {{0.6, 0.8},  {0.6, -0.8},  {0.8, 0.6},
                                          {0.8, -0.6}, {0.96, 0.28}, {0.28, 0.96}};
  double best[5] = {0, 0, 0, 0, 0};
  std::size_t turn = 0;
  for (std::size_t i = 0; i < 6; ++i) {
    double rotated[5];
    rotate(c, kTurns[i][0], kTurns[i][1], rotated);
    if (!(std::fabs(rotated[4]) > std::fabs(best[4]))) continue;
    for (std::size_t k = 0; k <= 4; ++k) best[k] = rotated[k];
    turn = i;
  }
  if (best[4] == 0) return 0;
  double turned[4];
  const std::size_t found = forwardRoots(best, turned);
  std::size_t count = 0;
  const double u = kTurns[turn][0], v = kTurns[turn][1];
  for (std::size_t i = 0; i < found; ++i) {
    double x = (u * turned[i] - v) / (v * turned[i] + u);
    if (std::isfinite(x) && better(c, x)) roots[count++] = x;
  }
  return count;
}

}  // namespace quartic_parts

// The real roots of c[4] x^4 + c[3] x^3 + c[2] x^2 + c[1] x + c[0], each bettered on the polynomial
// as it is given; a double root twice, also where rounding has parted it. A leading coefficient
// that is zero, or nearly, is a root at infinity or far away, which costs the others nothing.
// Returns how many there are, 0 to 4: in no order, finite, none where a coefficient is not finite.
inline std::size_t quarticRoots(const double (&c)[5], double (&roots)[4]) {
  using namespace quartic_parts;
  const double first = std::fabs(c[4]), last = std::fabs(c[0]);
  const double middle = std::fabs(c[1]) + std::fabs(c[2]) + std::fabs(c[3]);
  if (!std::isfinite(first + middle + last) || !(first + middle + last > 0)) return 0;
  double found[4];
  std::size_t all, count = 0;
  if (first >= last && first > 1e-4 * middle) {
    all = forwardRoots(c, found);
  } else if (last > 1e-4 * middle) {
    const double reversed[5] = {c[4], c[3], c[2], c[1], c[0]};
    all = forwardRoots(reversed, found);
    for (std::size_t i = 0; i < all; ++i) found[i] = 1 / found[i];
  } else {
    all = rotatedRoots(c, found);
  }
  for (std::size_t i = 0; i < all; ++i) {
    if (std::isfinite(found[i])) roots[count++] = found[i];
  }
  return count;
}

}  // namespace detail
}  // namespace v1
}  // namespace gslam

#endif  // GSLAM_ESTIMATOR_MATH_QUARTIC_H
