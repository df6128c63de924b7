// Real roots of cubic and quadratic polynomials.
#ifndef GSLAM_ESTIMATOR_MATH_CUBIC_H
#define GSLAM_ESTIMATOR_MATH_CUBIC_H

#include <array>
#include <cfloat>
#include <cmath>
#include <cstddef>

namespace gslam {
inline namespace v1 {
namespace detail {

// The real roots of a x^2 + b x + c, without cancellation. A discriminant that is negative by no
// more than rounding counts as zero, so that a double root is not lost. Twice the same for a double
// root; none where a = b = 0 or a coefficient is not finite.
inline std::size_t quadraticRoots(double a, double b, double c, double* roots) noexcept {
  const double square = b * b;
  const double product = 4 * a * c;
  double discriminant = square - product;
  if (!(discriminant > 0)) {
    if (!(discriminant >= -8 * DBL_EPSILON * square)) return 0;
    discriminant = 0;
  }
  const double q = -0.5 * (b + std::copysign(std::sqrt(discriminant), b));
  std::size_t count = 0;
  const double far = q / a;
  if (std::isfinite(far)) roots[count++] = far;
  if (q != 0) {
    const double near = c / q;
    if (std::isfinite(near)) roots[count++] = near;
  } else if (a != 0) {
    roots[count++] = 0;  // b = c = 0
  }
  return count;
}

// One step of Newton's method for x^3 + b x^2 + c x + d, not taken where it would not be small.
inline double polishedCubicRoot(double b, double c, double d, double x) noexcept {
  const double value = ((x + b) * x + c) * x + d;
  const double slope = (3 * x + 2 * b) * x + c;
  const double step = value / slope;
  return std::fabs(step) <= 1e-4 * std::fabs(x) ? x - step : x;
}

// The real roots of x^3 + b x^2 + c x + d in no certain order; one or three, a multiple root as
// often as its multiplicity. None where a coefficient is not finite.
//
// Halley's method finds one root from the side of the point of inflection where it runs straight
// to it; that root is divided out, and the two of the quadratic rest are polished. (U. Deiters, R.
// Macias-Salinas, "Calculation of densities from cubic equations of state: revisited", Ind. Eng.
// Chem. Res. 53(6), 2014)
inline std::size_t monicCubicRoots(double b, double c, double d,
                                   std::array<double, 3>& roots) noexcept {
  const double inflection = b * (-1.0 / 3);
  const double value = ((inflection + b) * inflection + c) * inflection + d;
  double x = inflection;
  // For y = x - inflection it is y^3 + slope y + value.
  const double slope = c + b * inflection;
  if (value != 0) {
    // Beyond the extremum on the side where the outer root is, no farther than twice from it.
    double start = 0;
    if (slope < 0) {
      // The outer root lies between sqrt(-slope) and 2 sqrt(-slope / 3), or farther for a value
      // that leaves one root only.
      start = std::copysign(1.1547005383792515 * std::sqrt(-slope), -value);
      if (std::fabs(value) > 0.3849001794597505 * -slope * std::sqrt(-slope)) {
        start = std::copysign(std::cbrt(std::fabs(value)) + std::fabs(start) * 0.5, -value);
      }
    } else {
      // The smaller of the roots of the equation's two parts.
      const double cube = std::cbrt(std::fabs(value));
      start = std::copysign(slope > cube * cube ? std::fabs(value) / slope : 0.7 * cube, -value);
    }
    double y = start;
    for (int i = 0; i < 12; ++i) {
      const double f = (y * y + slope) * y + value;
      const double f1 = 3 * y * y + slope;
      const double step = f * f1 / (f1 * f1 - 3 * y * f);
      if (!std::isfinite(step)) break;
      y -= step;
      if (std::fabs(step) <= 1e-6 * std::fabs(y)) break;  // it converges cubically
    }
    x = inflection + y;
  }
  x = polishedCubicRoot(b, c, d, x);
  if (!std::isfinite(x)) return 0;
  roots[0] = x;
  // x^2 + p x + q; divided from the end that loses fewer digits.
  const double p_down = b + x;
  const double q_down = c + p_down * x;
  double p = p_down;
  double q = q_down;
  if (std::fabs(x * x * x) > std::fabs(d)) {  // a large root: from the constant upwards
    q = -d / x;
    p = (q - c) / x;
    if (!std::isfinite(p) || !std::isfinite(q)) {
      p = p_down;
      q = q_down;
    }
  }
  double rest[2];
  if (quadraticRoots(1, p, q, rest) < 2) return 1;
  roots[1] = polishedCubicRoot(b, c, d, rest[0]);
  roots[2] = polishedCubicRoot(b, c, d, rest[1]);
  return 3;
}

// The real roots of a x^3 + b x^2 + c x + d, as above; those of the polynomial of lower degree
// where a is zero or so small that the quotients overflow.
inline std::size_t cubicRoots(double a, double b, double c, double d,
                              std::array<double, 3>& roots) noexcept {
  const double inverse = 1 / a;
  const double b1 = b * inverse, c1 = c * inverse, d1 = d * inverse;
  // The cube of the largest root must be a number.
  if (std::fabs(b1) < 1e90 && std::fabs(c1) < 1e180 && std::fabs(d1) < 1e270) {
    return monicCubicRoots(b1, c1, d1, roots);
  }
  return quadraticRoots(b, c, d, roots.data());
}

}  // namespace detail
}  // namespace v1
}  // namespace gslam

#endif  // GSLAM_ESTIMATOR_MATH_CUBIC_H
