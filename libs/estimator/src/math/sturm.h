// Real roots of polynomials of fixed degree.
#ifndef GSLAM_ESTIMATOR_MATH_STURM_H
#define GSLAM_ESTIMATOR_MATH_STURM_H

#include <gslam/base/platform.h>
#include <gslam/geometry/detail/pair.h>

#include <cfloat>
#include <cmath>
#include <cstddef>
#include <cstdlib>

namespace gslam {
inline namespace v1 {
namespace detail {

// c[0] + c[1] x + ... + c[N] x^N. The even and the odd powers apart, two chains that overlap.
template <std::size_t N>
GSLAM_ALWAYS_INLINE double valueOf(const double (&c)[N + 1], double x) noexcept {
  constexpr std::size_t kEven = N / 2 * 2;
  constexpr std::size_t kOdd = (N - 1) / 2 * 2 + 1;
  const double square = x * x;
  double even = c[kEven];
  double odd = c[kOdd];
  for (std::size_t i = kEven; i >= 2; i -= 2) even = even * square + c[i - 2];
  for (std::size_t i = kOdd; i >= 3; i -= 2) odd = odd * square + c[i - 2];
  return even + x * odd;
}

// The derivative.
template <std::size_t N>
inline void differentiate(const double (&c)[N + 1], double (&derivative)[N]) noexcept {
  for (std::size_t i = 0; i < N; ++i) derivative[i] = static_cast<double>(i + 1) * c[i + 1];
}

// Sturm's chain p, p', and the negative remainders: p has as many distinct real roots in (a, b] as
// the chain has more changes of sign at a than at b. A remainder whose leading coefficients are not
// above rounding has a lower degree.
template <std::size_t N>
class SturmChain {
 public:
  explicit SturmChain(const double (&c)[N + 1]) noexcept {
    double first[N + 1], second[N + 1];
    double* f = first;
    double* g = second;
    double largest = 0;
    for (const double value : c) largest = std::fabs(value) > largest ? std::fabs(value) : largest;
    // Leading coefficients so far below the largest are rounding of what led to them.
    int f_degree = setScaled(c, static_cast<int>(N), 1e-14 * largest, f);
    if (f_degree < 0) return;
    signs_[0] = f[f_degree];
    degrees_[0] = f_degree;
    int g_degree = f_degree - 1;
    for (int i = 0; i <= g_degree; ++i) g[i] = (i + 1) * f[i + 1];
    int used = 0;
    while (g_degree >= 0) {
      signs_[count_ + 1] = g[g_degree];
      degrees_[count_ + 1] = g_degree;
      // f = q g - r
      double* const q = quotients_ + used;
      const double inverse = 1 / g[g_degree];
      const int q_degree = f_degree - g_degree;
      double noise = 0;
      for (int k = q_degree; k >= 0; --k) {
        q[k] = f[g_degree + k] * inverse;
        for (int i = 0; i < g_degree; ++i) f[i + k] -= q[k] * g[i];
        noise += std::fabs(q[k]);
      }
      for (int i = 0; i < g_degree; ++i) f[i] = -f[i];
      used += q_degree + 1;
      double scaled[N + 1];
      const int r_degree = setScaled(f, g_degree - 1, 4 * DBL_EPSILON * (1 + noise), scaled);
      scales_[count_] = scale_;
      ++count_;
      for (int i = 0; i <= r_degree; ++i) f[i] = scaled[i];
      double* const swap = f;
      f = g;
      g = swap;
      f_degree = g_degree;
      g_degree = r_degree;
    }
  }

  // N less the leading coefficients at rounding; -1 for zero and what is not finite.
  int degree() const noexcept { return degrees_[0]; }

  // Changes of sign at a number.
  int changes(double x) const noexcept {
    if (count_ == 0) return 0;
    // All divided by the last, which is a constant or the common divisor.
    double after = 0;
    double value = 1;
    int changes = 0;
    int end = degrees_[0] - degrees_[count_] + count_;
    for (int i = count_ - 1; i >= 0; --i) {
      const int q_degree = degrees_[i] - degrees_[i + 1];
      end -= q_degree + 1;
      const double* const q = quotients_ + end;
      double quotient = q[q_degree];
      for (int k = q_degree - 1; k >= 0; --k) quotient = quotient * x + q[k];
      const double before = quotient * value - scales_[i] * after;
      changes += (before < 0) != (value < 0) ? 1 : 0;
      after = value;
      value = before;
    }
    return changes;
  }

  // Changes of sign at minus and at plus infinity.
  int changesAtInfinity(bool negative) const noexcept {
    int changes = 0;
    bool last = false;
    for (int i = 0; i <= count_ && count_ > 0; ++i) {
      const bool minus = (signs_[i] < 0) != (negative && degrees_[i] % 2 != 0);
      if (i > 0 && minus != last) ++changes;
      last = minus;
    }
    return changes;
  }

 private:
  // Copies the coefficients up to the last that is above the noise, divided by the largest. Their
  // degree, -1 for none.
  int setScaled(const double* from, int degree, double noise, double* to) noexcept {
    double largest = 0;
    for (int i = 0; i <= degree; ++i) {
      const double size = std::fabs(from[i]);
      largest = size > largest ? size : largest;
    }
    scale_ = largest;
    while (degree >= 0 && !(std::fabs(from[degree]) > noise)) --degree;
    if (!(largest <= DBL_MAX)) return -1;
    const double inverse = 1 / largest;
    for (int i = 0; i <= degree; ++i) to[i] = from[i] * inverse;
    return degree;
  }

  int count_ = 0;  // of quotients; one less than polynomials
  int degrees_[N + 1] = {-1};
  double signs_[N + 1];
  double quotients_[2 * N + 2];
  double scales_[N + 1];
  double scale_ = 0;
};

// Safe Newton iteration in a bracket, at whose ends the values have opposite signs: halves it where
// Newton leaves it. At most so many steps that the bracket is at rounding.
template <std::size_t N>
inline double rootInBracket(const double (&c)[N + 1], const double (&derivative)[N], double low,
                            double high, double tolerance) noexcept {
  const bool rises = valueOf<N>(c, low) < 0;
  double x = 0.5 * (low + high);
  for (int i = 0; i < 80; ++i) {
    const double value = valueOf<N>(c, x);
    if (value == 0) return x;
    if ((value < 0) == rises) {
      low = x;
    } else {
      high = x;
    }
    const double newton = x - value / valueOf<N - 1>(derivative, x);
    const bool inside = newton > low && newton < high;  // false for NaN
    const double next = inside ? newton : 0.5 * (low + high);
    const double moved = std::fabs(next - x);
    x = next;
    if (moved <= tolerance && (inside || high - low <= tolerance)) return x;
  }
  return x;
}

// Points 0 < t <= 1, nearly even in the angle of (t, 1).
template <std::size_t K>
struct RootGrid {
  alignas(16) double points[K];
  constexpr RootGrid() : points() {
    for (std::size_t i = 0; i < K; ++i) {
      const double s = static_cast<double>(i + 1) / static_cast<double>(K);
      points[i] = s * (0.785 + 0.215 * s * s);
    }
  }
};

// The distinct real roots of a polynomial of degree N as ratios t : u, so that a root at infinity
// is one like others: |t|, |u| <= 1 and one of them is 1.
//
// Most are bracketed by the signs at fixed points, found for all at once. Where Sturm's chain
// counts more, two or more lie between neighbours, and the chain is asked where.
template <std::size_t N>
class RealRoots {
 public:
  // Finds them to about `tolerance` (of t and of u); to its square or so, mostly.
  RealRoots(const double (&c)[N + 1], double tolerance) noexcept : tolerance_(tolerance) {
    for (std::size_t i = 0; i <= N; ++i) {
      charts_[0].c[i] = c[i];
      charts_[1].c[i] = c[N - i];
    }
    std::size_t brackets = 0;
    for (Chart& chart : charts_) {
      differentiate<N>(chart.c, chart.derivative);
      evaluateGrid(chart);
      brackets += chart.count;
    }
    const SturmChain<N> chain(charts_[0].c);
    // The chain knows nothing of roots at infinity.
    const int finite = chain.changesAtInfinity(true) - chain.changesAtInfinity(false);
    const bool infinite = chain.degree() < static_cast<int>(N);
    if (finite + (infinite ? 1 : 0) > static_cast<int>(brackets)) {
      isolate(chain);
      if (infinite) add(true, nextToInfinity());
    } else {
      for (int far = 0; far < 2; ++far) takeBrackets(far != 0);
    }
  }

  std::size_t size() const noexcept { return size_; }
  // The root is t / u.
  double t(std::size_t i) const noexcept { return far_[i] ? 1 : roots_[i]; }
  double u(std::size_t i) const noexcept { return far_[i] ? roots_[i] : 1; }

 private:
  static constexpr std::size_t kSide = N <= 10 ? 8 : 16;
  static constexpr RootGrid<kSide> kGrid{};

  // The polynomial in t with u = 1, or in u with t = 1.
  struct Chart {
    double c[N + 1];
    double derivative[N];
    double values[2 * kSide + 1];  // from -1 to 1
    std::size_t starts[N + 1];     // where the sign changes before the next point
    std::size_t count;
  };

  struct Interval {
    double low, high;
    int changes_low, changes_high;
    bool far;
  };

  static double pointOf(std::size_t i) noexcept {
    if (i == kSide) return 0;
    return i > kSide ? kGrid.points[i - kSide - 1] : -kGrid.points[kSide - 1 - i];
  }

  static void evaluateGrid(Chart& chart) noexcept {
    using Values = Pair<double>;
    const double(&c)[N + 1] = chart.c;
    constexpr std::size_t kEven = N / 2 * 2;
    constexpr std::size_t kOdd = (N - 1) / 2 * 2 + 1;
    for (std::size_t i = 0; i < kSide; i += 2) {
      const Values t = Values::load(kGrid.points + i);
      const Values square = t * t;
      Values even = Values::both(c[kEven]);
      Values odd = Values::both(c[kOdd]);
      for (std::size_t k = kEven; k >= 2; k -= 2) even = even * square + Values::both(c[k - 2]);
      for (std::size_t k = kOdd; k >= 3; k -= 2) odd = odd * square + Values::both(c[k - 2]);
      odd = odd * t;
      (even + odd).store(chart.values + kSide + 1 + i);
      (even - odd).swapped().store(chart.values + kSide - 2 - i);
    }
    chart.values[kSide] = c[0];
    chart.count = 0;
    for (std::size_t i = 0; i < 2 * kSide; ++i) {
      // Also at a point itself, but not twice.
      if ((chart.values[i] < 0) == (chart.values[i + 1] < 0)) continue;
      if (chart.count <= N) chart.starts[chart.count++] = i;
    }
  }

  // Of a leading coefficient at rounding.
  double nextToInfinity() const noexcept {
    const double u = -charts_[1].c[0] / charts_[1].c[1];
    return std::fabs(u) < 1e-6 ? u : 0;
  }

  void add(bool far, double root) noexcept {
    if (size_ == N || !std::isfinite(root)) return;
    far_[size_] = far;
    roots_[size_++] = root;
  }

  void takeBrackets(bool far) noexcept {
    const Chart& chart = charts_[far ? 1 : 0];
    for (std::size_t k = 0; k < chart.count; ++k) {
      const std::size_t i = chart.starts[k];
      const double low = pointOf(i), high = pointOf(i + 1);
      // Steps without a branch, so that the next bracket's overlap with them.
      const double f = chart.values[i], g = chart.values[i + 1];
      double x = low + (high - low) * (f / (f - g));
      double last = x;
      for (int step = 0; step < 3; ++step) {
        last = x;
        const double next = x - valueOf<N>(chart.c, x) / valueOf<N - 1>(chart.derivative, x);
        const double least = next > low ? next : low;
        x = least < high ? least : high;
      }
      // A step that was cut off at an end says nothing.
      if (!(std::fabs(x - last) <= tolerance_ && x > low && x < high)) {
        x = rootInBracket<N>(chart.c, chart.derivative, low, high, tolerance_);
      }
      add(far, x);
    }
  }

  GSLAM_COLD void isolate(const SturmChain<N>& chain) noexcept {
    constexpr std::size_t kRoom = 64;
    Interval stack[kRoom];
    const int before = chain.changes(-1), after = chain.changes(1);
    stack[0] = {-1, 1, before, after, false};
    stack[1] = {-1, 0, before, chain.changesAtInfinity(true), true};
    stack[2] = {0, 1, chain.changesAtInfinity(false), after, true};
    std::size_t waiting = 3;
    for (std::size_t budget = 60 * N; waiting > 0 && budget > 0; --budget) {
      const Interval now = stack[--waiting];
      const int roots = std::abs(now.changes_low - now.changes_high);
      if (roots == 0) continue;
      const Chart& chart = charts_[now.far ? 1 : 0];
      const double middle = 0.5 * (now.low + now.high);
      if (roots == 1) {
        const double f = valueOf<N>(chart.c, now.low), g = valueOf<N>(chart.c, now.high);
        if ((f < 0) != (g < 0)) {
          add(now.far, rootInBracket<N>(chart.c, chart.derivative, now.low, now.high, tolerance_));
          continue;
        }
      }
      if (now.high - now.low < 1e-9 || waiting + 2 > kRoom) {
        add(now.far, middle);
        continue;
      }
      const int changes = chain.changes(now.far ? 1 / middle : middle);
      stack[waiting++] = {now.low, middle, now.changes_low, changes, now.far};
      stack[waiting++] = {middle, now.high, changes, now.changes_high, now.far};
    }
  }

  Chart charts_[2];
  double tolerance_;
  std::size_t size_ = 0;
  double roots_[N];
  bool far_[N];
};

}  // namespace detail
}  // namespace v1
}  // namespace gslam

#endif  // GSLAM_ESTIMATOR_MATH_STURM_H
