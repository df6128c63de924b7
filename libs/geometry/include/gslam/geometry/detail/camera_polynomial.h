// Where a polynomial first changes its sign: how far a distortion stays one-to-one.
#ifndef GSLAM_GEOMETRY_DETAIL_CAMERA_POLYNOMIAL_H
#define GSLAM_GEOMETRY_DETAIL_CAMERA_POLYNOMIAL_H

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <limits>

namespace gslam {
inline namespace v1 {
namespace detail {

// c[0] + c[1] x + ... + c[15] x^15; what would have a higher power is left out.
struct CameraPolynomial {
  static constexpr std::size_t kSize = 16;

  std::array<double, 16> c;

  double operator()(double x) const noexcept {
    double sum = 0;
    for (std::size_t i = kSize; i-- > 0;) sum = sum * x + c[i];
    return sum;
  }

  CameraPolynomial derivative() const noexcept {
    CameraPolynomial result{};
    for (std::size_t i = 1; i < kSize; ++i) result.c[i - 1] = static_cast<double>(i) * c[i];
    return result;
  }

  std::size_t degree() const noexcept {
    std::size_t i = kSize - 1;
    while (i > 0 && !(std::fabs(c[i]) > 0)) --i;
    return i;
  }

  friend CameraPolynomial operator*(const CameraPolynomial& a, const CameraPolynomial& b) noexcept {
    CameraPolynomial result{};
    for (std::size_t i = 0; i < kSize; ++i) {
      for (std::size_t k = 0; i + k < kSize; ++k) result.c[i + k] += a.c[i] * b.c[k];
    }
    return result;
  }

  // a - factor * b
  friend CameraPolynomial subtract(const CameraPolynomial& a, const CameraPolynomial& b,
                                   double factor) noexcept {
    CameraPolynomial result{};
    for (std::size_t i = 0; i < kSize; ++i) result.c[i] = a.c[i] - factor * b.c[i];
    return result;
  }

  // The polynomial whose value at r is this one's at r^2; for a degree up to 7.
  CameraPolynomial ofSquare() const noexcept {
    CameraPolynomial result{};
    for (std::size_t i = 0; 2 * i < kSize; ++i) result.c[2 * i] = c[i];
    return result;
  }
};

// No root is farther from 0 than this (Cauchy).
inline double rootBound(const CameraPolynomial& p) noexcept {
  const std::size_t degree = p.degree();
  double largest = 0;
  for (std::size_t i = 0; i < degree; ++i) largest = std::max(largest, std::fabs(p.c[i]));
  return std::min(1 + largest / std::fabs(p.c[degree]), 1e12);
}

// The change of sign between low and high, where there is one.
inline double bisect(const CameraPolynomial& p, double low, double high) noexcept {
  const bool is_negative = p(low) < 0;
  for (;;) {
    const double middle = low + (high - low) / 2;
    if (!(middle > low && middle < high)) return low;
    ((p(middle) < 0) == is_negative ? low : high) = middle;
  }
}

// The smallest x > 0 at which p changes its sign; infinity where it never does.
//
// Between two neighbouring roots of the derivative there is at most one of the polynomial. So the
// roots of all derivatives are found one after the other, from the one of degree 1 on.
inline double firstPositiveRoot(const CameraPolynomial& p) noexcept {
  const std::size_t degree = p.degree();
  if (degree == 0) return std::numeric_limits<double>::infinity();
  const double bound = rootBound(p);
  std::array<CameraPolynomial, CameraPolynomial::kSize> derivatives;
  derivatives[degree] = p;
  for (std::size_t k = degree; k-- > 1;) derivatives[k] = derivatives[k + 1].derivative();
  std::array<double, CameraPolynomial::kSize + 1> roots;  // of the derivative before
  std::size_t count = 0;
  for (std::size_t k = 1; k <= degree; ++k) {
    const CameraPolynomial& q = derivatives[k];
    std::array<double, CameraPolynomial::kSize + 1> found;
    std::size_t found_count = 0;
    double low = 0;
    for (std::size_t i = 0; i <= count; ++i) {
      const double high = i < count ? roots[i] : bound;
      if ((q(low) < 0) != (q(high) < 0)) found[found_count++] = bisect(q, low, high);
      low = high;
    }
    roots = found;
    count = found_count;
  }
  return count > 0 ? roots[0] : std::numeric_limits<double>::infinity();
}

}  // namespace detail
}  // namespace v1
}  // namespace gslam

#endif  // GSLAM_GEOMETRY_DETAIL_CAMERA_POLYNOMIAL_H
