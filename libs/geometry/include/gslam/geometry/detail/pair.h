#ifndef GSLAM_GEOMETRY_DETAIL_PAIR_H
#define GSLAM_GEOMETRY_DETAIL_PAIR_H

#include <gslam/base/platform.h>

#include <cstddef>
#include <cstdint>
#include <cstring>

/// @file
/// Two numbers that are worked on together: one instruction for doubles where there is one.

namespace gslam {
inline namespace v1 {
namespace detail {

/// a x + b with one rounding where the code is compiled for a processor with such an instruction,
/// else with two. (In ISO mode compilers do not fuse on their own.)
template <class T>
inline T multiplyAdd(T a, T x, T b) noexcept {
#if GSLAM_HAS_FMA
  return __builtin_fma(a, x, b);
#else
  return a * x + b;
#endif
}
#if GSLAM_HAS_FMA
inline float multiplyAdd(float a, float x, float b) noexcept {
  return __builtin_fmaf(a, x, b);
}
#endif

/// In general two variables.
template <class T>
class Pair {
 public:
  Pair(T first, T second) noexcept : first_(first), second_(second) {}
  static Pair both(T value) noexcept { return Pair(value, value); }
  static Pair load(const T* from) noexcept { return Pair(from[0], from[1]); }

  void store(T* to) const noexcept {
    to[0] = first_;
    to[1] = second_;
  }
  T first() const noexcept { return first_; }
  T second() const noexcept { return second_; }
  Pair swapped() const noexcept { return Pair(second_, first_); }
  /// The sign of the second changed.
  Pair conjugate() const noexcept { return Pair(first_, -second_); }
  Pair operator-() const noexcept { return Pair(-first_, -second_); }

  friend Pair operator+(Pair a, Pair b) noexcept {
    return Pair(a.first_ + b.first_, a.second_ + b.second_);
  }
  friend Pair operator-(Pair a, Pair b) noexcept {
    return Pair(a.first_ - b.first_, a.second_ - b.second_);
  }
  friend Pair operator*(Pair a, Pair b) noexcept {
    return Pair(a.first_ * b.first_, a.second_ * b.second_);
  }
  friend Pair multiplyAdd(Pair a, Pair x, Pair b) noexcept {
    return Pair(detail::multiplyAdd(a.first_, x.first_, b.first_),
                detail::multiplyAdd(a.second_, x.second_, b.second_));
  }

 private:
  T first_, second_;
};

#if GSLAM_HAS_VECTORS
/// For doubles a register of 128 bits, which x86-64 and arm64 always have.
template <>
class Pair<double> {
  using Lanes = double __attribute__((vector_size(16)));
  using Bits = std::int64_t __attribute__((vector_size(16)));

 public:
  Pair(double first, double second) noexcept : lanes_{first, second} {}
  static Pair both(double value) noexcept { return Pair(value, value); }
  static Pair load(const double* from) noexcept {
    Pair pair;
    std::memcpy(&pair.lanes_, from, sizeof(Lanes));
    return pair;
  }

  void store(double* to) const noexcept { std::memcpy(to, &lanes_, sizeof(Lanes)); }
  double first() const noexcept { return lanes_[0]; }
  double second() const noexcept { return lanes_[1]; }
  Pair swapped() const noexcept { return Pair(lanes_[1], lanes_[0]); }
  Pair conjugate() const noexcept { return flipped(Bits{0, INT64_MIN}); }
  Pair operator-() const noexcept { return flipped(Bits{INT64_MIN, INT64_MIN}); }

  friend Pair operator+(Pair a, Pair b) noexcept { return Pair(a.lanes_ + b.lanes_); }
  friend Pair operator-(Pair a, Pair b) noexcept { return Pair(a.lanes_ - b.lanes_); }
  friend Pair operator*(Pair a, Pair b) noexcept { return Pair(a.lanes_ * b.lanes_); }
  friend Pair multiplyAdd(Pair a, Pair x, Pair b) noexcept {
#if GSLAM_HAS_FMA && GSLAM_X86
    return Pair(__builtin_ia32_vfmaddpd(a.lanes_, x.lanes_, b.lanes_));
#else
    return Pair(a.lanes_ * x.lanes_ + b.lanes_);
#endif
  }

 private:
  Pair() noexcept = default;
  explicit Pair(Lanes lanes) noexcept : lanes_(lanes) {}
  Pair flipped(Bits signs) const noexcept {
    return Pair(reinterpret_cast<Lanes>(reinterpret_cast<Bits>(lanes_) ^ signs));
  }

  Lanes lanes_;
};
#endif

/// Every second coefficient up to number I, as polynomials of x^2 by Horner's scheme. A recursion,
/// because compilers keep loops as loops at -O2.
template <class T, std::size_t N, std::size_t I>
struct EverySecond {
  static GSLAM_ALWAYS_INLINE Pair<T> sum(const T (&coefficients)[N][2], Pair<T> square) noexcept {
    return multiplyAdd(EverySecond<T, N, I - 2>::sum(coefficients, square), square,
                       Pair<T>::load(coefficients[I]));
  }
};
template <class T, std::size_t N>
struct EverySecond<T, N, 0> {
  static GSLAM_ALWAYS_INLINE Pair<T> sum(const T (&coefficients)[N][2], Pair<T>) noexcept {
    return Pair<T>::load(coefficients[0]);
  }
};
template <class T, std::size_t N>
struct EverySecond<T, N, 1> {
  static GSLAM_ALWAYS_INLINE Pair<T> sum(const T (&coefficients)[N][2], Pair<T>) noexcept {
    return Pair<T>::load(coefficients[1]);
  }
};

/// A polynomial for each of the two, highest power first, at x. The even and the odd powers are
/// summed apart, two chains of operations that overlap; the constant is added last, so that at
/// small x its rounding is the only one.
template <class T, std::size_t N>
GSLAM_ALWAYS_INLINE Pair<T> polynomials(const T (&coefficients)[N][2], T x) noexcept {
  const Pair<T> both_x = Pair<T>::both(x);
  const Pair<T> square = Pair<T>::both(x * x);
  const Pair<T> slope = multiplyAdd(EverySecond<T, N, N - 3>::sum(coefficients, square), both_x,
                                    EverySecond<T, N, N - 2>::sum(coefficients, square));
  return multiplyAdd(slope, both_x, Pair<T>::load(coefficients[N - 1]));
}

}  // namespace detail
}  // namespace v1
}  // namespace gslam

#endif  // GSLAM_GEOMETRY_DETAIL_PAIR_H
