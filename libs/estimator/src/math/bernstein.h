// Polynomials between 0 and 1 in Bernstein's basis, where they lose no digits, and their roots.
#ifndef GSLAM_ESTIMATOR_MATH_BERNSTEIN_H
#define GSLAM_ESTIMATOR_MATH_BERNSTEIN_H

#include <cmath>
#include <cstddef>

namespace gslam {
inline namespace v1 {
namespace detail {

// Sum over k of c[k] x^k (1 - x)^(N - k): the binomials are in the coefficients, so that products
// are those of ordinary polynomials. Only polynomials of the same N may be added.
template <std::size_t N>
struct Bernstein {
  double c[N + 1];

  friend Bernstein operator+(Bernstein a, const Bernstein& b) {
    for (std::size_t i = 0; i <= N; ++i) a.c[i] += b.c[i];
    return a;
  }
  friend Bernstein operator-(Bernstein a, const Bernstein& b) {
    for (std::size_t i = 0; i <= N; ++i) a.c[i] -= b.c[i];
    return a;
  }
  friend Bernstein operator*(double factor, Bernstein a) {
    for (std::size_t i = 0; i <= N; ++i) a.c[i] *= factor;
    return a;
  }
};

template <std::size_t M, std::size_t N>
Bernstein<M + N> operator*(const Bernstein<M>& a, const Bernstein<N>& b) {
  Bernstein<M + N> product;
  for (std::size_t i = 0; i <= M + N; ++i) product.c[i] = 0;
  for (std::size_t i = 0; i <= M; ++i) {
    for (std::size_t j = 0; j <= N; ++j) product.c[i + j] += a.c[i] * b.c[j];
  }
  return product;
}

namespace bernstein_parts {

constexpr std::size_t kDegree = 8;
constexpr int kDeepest = 24;  // halvings
constexpr double kBinomial[kDegree + 1] = {1, 8, 28, 56, 70, 56, 28, 8, 1};

// A part of the interval, and the polynomial's control points there.
struct Part {
  double b[kDegree + 1];
  double from, width;
  int depth;
};

// Changes of sign: as many roots as there are inside, or a multiple of two more (Descartes' rule).
inline int changesOf(const Part& part) {
  int changes = 0;
  double last = 0;
  for (const double value : part.b) {
    changes += (value < 0 && last > 0) || (value > 0 && last < 0);
    last = value != 0 ? value : last;
  }
  return changes;
}

// The left half; the part becomes the right one (de Casteljau).
inline Part leftHalf(Part& part) {
  Part left;
  double* const b = part.b;
  left.b[0] = b[0];
  for (std::size_t level = 1; level <= kDegree; ++level) {
    for (std::size_t i = 0; i <= kDegree - level; ++i) b[i] = 0.5 * (b[i] + b[i + 1]);
    left.b[level] = b[0];
  }
  // What was computed last in place i is the control point i of the right half.
  left.from = part.from;
  left.width = part.width *= 0.5;
  left.depth = ++part.depth;
  part.from += part.width;
  return left;
}

// The only root inside: Newton's method on the powers of the part's own coordinate, halving where
// that leads out.
inline double onlyRoot(const Part& part) {
  double p[kDegree + 1];
  for (std::size_t i = 0; i <= kDegree; ++i) p[i] = part.b[i];
  for (std::size_t level = 1; level <= kDegree; ++level) {
    for (std::size_t i = kDegree; i >= level; --i) p[i] -= p[i - 1];
  }
  for (std::size_t i = 0; i <= kDegree; ++i) p[i] *= kBinomial[i];
  const bool rises = part.b[kDegree] > 0 || part.b[0] < 0;
  double low = 0, high = 1;
  double x = part.b[0] / (part.b[0] - part.b[kDegree]);
  if (!(x > 0 && x < 1)) x = 0.5;
  for (int step = 0; step < 40; ++step) {
    double value = p[kDegree], slope = 0;
    for (std::size_t i = kDegree; i-- > 0;) {
      slope = slope * x + value;
      value = value * x + p[i];
    }
    ((value > 0) == rises ? high : low) = x;
    double next = x - value / slope;
    if (!(next > low && next < high)) next = 0.5 * (low + high);
    const double move = std::fabs(next - x);
    x = next;
    if (move < 1e-9) break;
  }
  return part.from + part.width * x;
}

}  // namespace bernstein_parts

// The roots between 0 and 1 of a polynomial of degree 8, in rising order, to about 1e-9; how many.
// Roots closer than 1e-7 to each other come as one, as does a pair of complex roots that is as
// close to the real line.
inline std::size_t octicRoots(const Bernstein<8>& polynomial, double (&roots)[8]) {
  using namespace bernstein_parts;
  Part stack[kDeepest + 2];
  std::size_t height = 1, count = 0;
  for (std::size_t i = 0; i <= kDegree; ++i) stack[0].b[i] = polynomial.c[i] / kBinomial[i];
  stack[0].from = 0;
  stack[0].width = 1;
  stack[0].depth = 0;
  // Each halving sorts the roots; 8 of them, each alone after kDeepest, make an end.
  while (height > 0 && count < 8) {
    Part& part = stack[height - 1];
    const int changes = changesOf(part);
    if (changes == 0) {
      --height;
    } else if (changes == 1) {
      roots[count++] = onlyRoot(part);
      --height;
    } else if (part.depth == kDeepest) {
      roots[count++] = part.from + 0.5 * part.width;
      --height;
    } else {
      const Part left = leftHalf(part);
      if (part.b[0] == 0) roots[count++] = part.from;  // a root of neither half
      stack[height++] = left;
    }
  }
  return count;
}

}  // namespace detail
}  // namespace v1
}  // namespace gslam

#endif  // GSLAM_ESTIMATOR_MATH_BERNSTEIN_H
