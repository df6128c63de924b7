#include <gslam/base/platform.h>

#include <cmath>
#include <cstddef>
#include <limits>

#include "math/essential_system.h"

namespace gslam {
inline namespace v1 {
namespace detail {
namespace {

using Lanes = Pair<double>;

// Two numbers that start as zero.
struct Number : Pair<double> {
  Number() noexcept : Pair(Pair::both(0)) {}
  Number(Pair pair) noexcept : Pair(pair) {}  // NOLINT(google-explicit-constructor)
};

// Row by row.
using Matrix = Number[10];  // the last is unused, so that all arrays are alike

GSLAM_ALWAYS_INLINE Lanes dot3(const Number* a, const Number* b) noexcept {
  return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}

// Symmetric: 00 01 02 11 12 22.
constexpr std::size_t kSymmetric[3][3] = {{0, 1, 2}, {1, 3, 4}, {2, 4, 5}};

GSLAM_ALWAYS_INLINE void subtractHalfTrace(Number (&s)[6]) noexcept {
  const Lanes half = Lanes::both(0.5) * (s[0] + s[3] + s[5]);
  s[0] = s[0] - half;
  s[3] = s[3] - half;
  s[5] = s[5] - half;
}

// The ten equations at E, and what their derivatives need.
struct Equations {
  Matrix e;
  Number g[6];  // E E^T - trace(E E^T) / 2
  Matrix cofactors;
  Number residual[10];

  GSLAM_ALWAYS_INLINE void evaluate() noexcept {
    for (std::size_t i = 0; i < 3; ++i) {
      for (std::size_t j = i; j < 3; ++j) g[kSymmetric[i][j]] = dot3(e + 3 * i, e + 3 * j);
    }
    subtractHalfTrace(g);
    for (std::size_t i = 0; i < 3; ++i) {
      const Number* const a = e + 3 * ((i + 1) % 3);
      const Number* const b = e + 3 * ((i + 2) % 3);
      cofactors[3 * i] = a[1] * b[2] - a[2] * b[1];
      cofactors[3 * i + 1] = a[2] * b[0] - a[0] * b[2];
      cofactors[3 * i + 2] = a[0] * b[1] - a[1] * b[0];
    }
    times(g, e, residual);
    residual[9] = dot3(cofactors, e);
  }

  // residual' for E' = d.
  GSLAM_ALWAYS_INLINE void derivative(const Matrix& d, Number (&result)[10]) const noexcept {
    Number h[6];
    for (std::size_t i = 0; i < 3; ++i) {
      for (std::size_t j = i; j < 3; ++j) {
        h[kSymmetric[i][j]] = dot3(d + 3 * i, e + 3 * j) + dot3(e + 3 * i, d + 3 * j);
      }
    }
    subtractHalfTrace(h);
    Number other[10];
    times(h, e, result);
    times(g, d, other);
    for (std::size_t i = 0; i < 9; ++i) result[i] = result[i] + other[i];
    result[9] = dot3(cofactors, d) + dot3(cofactors + 3, d + 3) + dot3(cofactors + 6, d + 6);
  }

 private:
  static GSLAM_ALWAYS_INLINE void times(const Number (&s)[6], const Matrix& m,
                                        Number (&result)[10]) noexcept {
    for (std::size_t i = 0; i < 3; ++i) {
      for (std::size_t j = 0; j < 3; ++j) {
        result[3 * i + j] = s[kSymmetric[i][0]] * m[j] + s[kSymmetric[i][1]] * m[3 + j] +
                            s[kSymmetric[i][2]] * m[6 + j];
      }
    }
  }
};

GSLAM_ALWAYS_INLINE Lanes dot10(const Number (&a)[10], const Number (&b)[10]) noexcept {
  Lanes even = a[0] * b[0];
  Lanes odd = a[1] * b[1];
  for (std::size_t i = 2; i < 10; i += 2) {
    even = even + a[i] * b[i];
    odd = odd + a[i + 1] * b[i + 1];
  }
  return even + odd;
}

GSLAM_ALWAYS_INLINE Lanes inverse(Lanes a) noexcept {
  return Lanes(1 / a.first(), 1 / a.second());
}

// J^T J step = -J^T r, with so little damping that a family of solutions, which has no only step,
// does not matter.
GSLAM_ALWAYS_INLINE void gaussNewtonStep(const Number (&j)[3][10], const Number (&r)[10],
                                         Number (&step)[3]) noexcept {
  Lanes a = dot10(j[0], j[0]);
  const Lanes b = dot10(j[0], j[1]);
  const Lanes c = dot10(j[0], j[2]);
  Lanes d = dot10(j[1], j[1]);
  const Lanes e = dot10(j[1], j[2]);
  Lanes f = dot10(j[2], j[2]);
  const Lanes x = dot10(j[0], r);
  const Lanes y = dot10(j[1], r);
  const Lanes z = dot10(j[2], r);
  const Lanes damping = Lanes::both(1e-16) * (a + d + f);
  a = a + damping;
  d = d + damping;
  f = f + damping;
  const Lanes aa = d * f - e * e;
  const Lanes bb = c * e - b * f;
  const Lanes cc = b * e - c * d;
  const Lanes scale = -inverse(a * aa + b * bb + c * cc);
  const Lanes dd = a * f - c * c;
  const Lanes ee = b * c - a * e;
  const Lanes ff = a * d - b * b;
  step[0] = scale * (aa * x + bb * y + cc * z);
  step[1] = scale * (bb * x + dd * y + ee * z);
  step[2] = scale * (cc * x + ee * y + ff * z);
}

// Two solutions at a time. The largest coefficient of each is the one that stays 1.
struct Polisher {
  Matrix fixed;
  Matrix d[3];
  Number s[3];
  std::size_t order[2][4];

  GSLAM_ALWAYS_INLINE Polisher(const EssentialBasis& basis, const double (&v)[4],
                               const double (&w)[4]) noexcept {
    arrange(v, order[0]);
    arrange(w, order[1]);
    const double(&p)[10] = basis[order[0][0]].values;
    const double(&q)[10] = basis[order[1][0]].values;
    for (std::size_t i = 0; i < 9; ++i) fixed[i] = Lanes(p[i], q[i]);
    for (std::size_t k = 0; k < 3; ++k) {
      const double(&a)[10] = basis[order[0][k + 1]].values;
      const double(&b)[10] = basis[order[1][k + 1]].values;
      for (std::size_t i = 0; i < 9; ++i) d[k][i] = Lanes(a[i], b[i]);
      s[k] = Lanes(v[order[0][k + 1]] / v[order[0][0]], w[order[1][k + 1]] / w[order[1][0]]);
    }
  }

  static void arrange(const double (&v)[4], std::size_t (&order)[4]) noexcept {
    std::size_t largest = 0;
    for (std::size_t i = 1; i < 4; ++i) {
      if (std::fabs(v[i]) > std::fabs(v[largest])) largest = i;
    }
    for (std::size_t i = 0; i < 4; ++i) order[i] = (largest + i) % 4;
  }

  // The squares of the residual, and of the step that was then made.
  GSLAM_ALWAYS_INLINE void step(Lanes& residual, Lanes& moved) noexcept {
    Equations equations;
    for (std::size_t i = 0; i < 9; ++i) {
      equations.e[i] = fixed[i] + s[0] * d[0][i] + s[1] * d[1][i] + s[2] * d[2][i];
    }
    equations.evaluate();
    Number j[3][10];
    for (std::size_t k = 0; k < 3; ++k) {
      equations.derivative(d[k], j[k]);
    }
    Number delta[3];
    gaussNewtonStep(j, equations.residual, delta);
    for (std::size_t k = 0; k < 3; ++k) s[k] = s[k] + delta[k];
    residual = dot10(equations.residual, equations.residual);
    moved = dot3(delta, delta);
  }

  void store(std::size_t lane, double (&v)[4]) const noexcept {
    const double x = lane == 0 ? s[0].first() : s[0].second();
    const double y = lane == 0 ? s[1].first() : s[1].second();
    const double z = lane == 0 ? s[2].first() : s[2].second();
    const double scale = 1 / std::sqrt(1 + x * x + y * y + z * z);
    v[order[lane][0]] = scale;
    v[order[lane][1]] = scale * x;
    v[order[lane][2]] = scale * y;
    v[order[lane][3]] = scale * z;
  }
};

}  // namespace

void polishEssential(const EssentialBasis& basis, std::size_t count, double (*solutions)[4],
                     double* first_step) noexcept {
  constexpr int kMostSteps = 30;  // near a double solution each step only halves the error
  // Newton squares the error: below this, one more step would not be seen.
  constexpr double kDone = 1e-15;
  for (std::size_t i = 0; i < count; i += 2) {
    const std::size_t other = i + 1 < count ? i + 1 : i;
    Polisher polisher(basis, solutions[i], solutions[other]);
    Lanes residual = Lanes::both(0), moved = Lanes::both(0);
    polisher.step(residual, moved);
    const double first[2] = {std::sqrt(moved.first()), std::sqrt(moved.second())};
    for (int k = 1; k < kMostSteps && !(moved.first() < kDone && moved.second() < kDone); ++k) {
      polisher.step(residual, moved);
    }
    const bool good[2] = {moved.first() < kDone && residual.first() < 1e-12,
                          moved.second() < kDone && residual.second() < 1e-12};
    first_step[i] = good[0] ? first[0] : std::numeric_limits<double>::infinity();
    polisher.store(0, solutions[i]);
    if (other == i) continue;
    first_step[other] = good[1] ? first[1] : std::numeric_limits<double>::infinity();
    polisher.store(1, solutions[other]);
  }
}

}  // namespace detail
}  // namespace v1
}  // namespace gslam
