// Two doubles that are worked on together: a register where there is one.
#ifndef GSLAM_ESTIMATOR_MATH_TWO_H
#define GSLAM_ESTIMATOR_MATH_TWO_H

#include <gslam/base/platform.h>

#include <cmath>
#include <cstdint>
#include <cstring>

#if GSLAM_X86
#include <emmintrin.h>
#elif GSLAM_ARM64
#include <arm_neon.h>
#endif

namespace gslam {
inline namespace v1 {
namespace detail {

// What code that is written for one number or for two calls: the same names for both.
inline double chosenBy(bool condition, double a, double b) {
  return condition ? a : b;
}
inline double rootOf(double x) {
  return std::sqrt(x);
}

#if GSLAM_HAS_VECTORS

// Comparisons of two, each all ones or all zeros.
class TwoFlags {
 public:
  using Bits = std::int64_t __attribute__((vector_size(16)));
  explicit TwoFlags(Bits flags) : bits(flags) {}
  bool operator[](int i) const { return bits[i] != 0; }
  friend TwoFlags operator&(TwoFlags a, TwoFlags b) { return TwoFlags(a.bits & b.bits); }

  Bits bits;
};

class Two {
 public:
  using Lanes = double __attribute__((vector_size(16)));
  using Bits = TwoFlags::Bits;

  Two() = default;
  Two(double both) : lanes{both, both} {}  // NOLINT(google-explicit-constructor)
  Two(double first, double second) : lanes{first, second} {}
  explicit Two(Lanes both) : lanes(both) {}
  static Two load(const double* from) {
    Two two;
    std::memcpy(&two.lanes, from, sizeof(Lanes));
    return two;
  }

  double operator[](int i) const { return lanes[i]; }
  Two operator-() const { return Two(-lanes); }
  friend Two operator+(Two a, Two b) { return Two(a.lanes + b.lanes); }
  friend Two operator-(Two a, Two b) { return Two(a.lanes - b.lanes); }
  friend Two operator*(Two a, Two b) { return Two(a.lanes * b.lanes); }
  friend Two operator/(Two a, Two b) { return Two(a.lanes / b.lanes); }
  friend TwoFlags operator>(Two a, Two b) { return TwoFlags(Bits(a.lanes > b.lanes)); }
  friend TwoFlags operator<(Two a, Two b) { return TwoFlags(Bits(a.lanes < b.lanes)); }
  friend TwoFlags operator==(Two a, Two b) { return TwoFlags(Bits(a.lanes == b.lanes)); }

  friend Two chosenBy(TwoFlags condition, Two a, Two b) {
    return Two(Lanes((Bits(a.lanes) & condition.bits) | (Bits(b.lanes) & ~condition.bits)));
  }
  friend Two magnitudeOf(Two a) { return Two(Lanes(Bits(a.lanes) & Bits{INT64_MAX, INT64_MAX})); }
  // The magnitude of a with the sign of b.
  friend Two signedAs(Two a, Two b) {
    const Bits sign = {INT64_MIN, INT64_MIN};
    return Two(Lanes((Bits(a.lanes) & ~sign) | (Bits(b.lanes) & sign)));
  }
  friend Two rootOf(Two a) {
#if GSLAM_X86
    return Two(Lanes(_mm_sqrt_pd(a.lanes)));
#elif GSLAM_ARM64
    return Two(Lanes(vsqrtq_f64(a.lanes)));
#else
    return Two(std::sqrt(a.lanes[0]), std::sqrt(a.lanes[1]));
#endif
  }

  Lanes lanes;
};

#else

struct TwoFlags {
  bool operator[](int i) const { return flags[i]; }
  friend TwoFlags operator&(TwoFlags a, TwoFlags b) {
    return {{a.flags[0] && b.flags[0], a.flags[1] && b.flags[1]}};
  }

  bool flags[2];
};

class Two {
 public:
  Two() = default;
  Two(double both) : lanes{both, both} {}  // NOLINT(google-explicit-constructor)
  Two(double first, double second) : lanes{first, second} {}
  static Two load(const double* from) { return Two(from[0], from[1]); }

  double operator[](int i) const { return lanes[i]; }
  Two operator-() const { return Two(-lanes[0], -lanes[1]); }
  friend Two operator+(Two a, Two b) { return Two(a[0] + b[0], a[1] + b[1]); }
  friend Two operator-(Two a, Two b) { return Two(a[0] - b[0], a[1] - b[1]); }
  friend Two operator*(Two a, Two b) { return Two(a[0] * b[0], a[1] * b[1]); }
  friend Two operator/(Two a, Two b) { return Two(a[0] / b[0], a[1] / b[1]); }
  friend TwoFlags operator>(Two a, Two b) { return {{a[0] > b[0], a[1] > b[1]}}; }
  friend TwoFlags operator<(Two a, Two b) { return {{a[0] < b[0], a[1] < b[1]}}; }
  friend TwoFlags operator==(Two a, Two b) { return {{a[0] == b[0], a[1] == b[1]}}; }

  friend Two chosenBy(TwoFlags condition, Two a, Two b) {
    return Two(condition[0] ? a[0] : b[0], condition[1] ? a[1] : b[1]);
  }
  friend Two magnitudeOf(Two a) { return Two(std::fabs(a[0]), std::fabs(a[1])); }
  friend Two signedAs(Two a, Two b) {
    return Two(std::copysign(a[0], b[0]), std::copysign(a[1], b[1]));
  }
  friend Two rootOf(Two a) { return Two(std::sqrt(a[0]), std::sqrt(a[1])); }

  double lanes[2];
};

#endif

}  // namespace detail
}  // namespace v1
}  // namespace gslam

#endif  // GSLAM_ESTIMATOR_MATH_TWO_H
