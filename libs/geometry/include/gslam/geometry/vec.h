#ifndef GSLAM_GEOMETRY_VEC_H
#define GSLAM_GEOMETRY_VEC_H

#include <gslam/base/error.h>

#include <cmath>
#include <cstddef>
#include <iosfwd>
#include <limits>
#include <type_traits>

/// @file
/// Small vectors of fixed size.

namespace gslam {
inline namespace v1 {

namespace detail {

// Whether a sum of squares is so far from both ends of T's range that no term was harmed: what
// underflowed is below an ulp of the sum.
template <class T>
bool isSafeSquare(T squared) noexcept {
  return squared >= std::numeric_limits<T>::min() / std::numeric_limits<T>::epsilon() &&
         squared <= std::numeric_limits<T>::max();
}

}  // namespace detail

/// N numbers of type T: a point, a direction, a tangent. No unit of its own.
///
/// Layout: exactly `T[N]`, an aggregate, trivially copyable, aligned as T, so that it may cross
/// plugin borders and that an array of it is an array of T. `Vec3d v;` leaves the elements
/// uninitialised, `Vec3d v{}` sets them to zero, `Vec3d v{1, 2, 3}` gives them.
/// Arithmetic is IEEE arithmetic: what is not finite passes through.
/// Thread-safety: as a number; it may be read by many threads, or written by one.
template <class T, std::size_t N>
struct Vec {
  static_assert(std::is_floating_point<T>::value, "Vec is made of floating-point numbers");
  static_assert(N > 0, "Vec has at least one element");

  using value_type = T;  ///< type of an element

  T values[N];  ///< the elements; public, because that makes Vec an aggregate

  /// Number of elements, N.
  static constexpr std::size_t size() noexcept { return N; }
  /// The first of N contiguous elements.
  T* data() noexcept { return values; }
  /// The first of N contiguous elements.
  constexpr const T* data() const noexcept { return values; }

  /// Element i, unchecked.
  T& operator[](std::size_t i) noexcept { return values[i]; }
  /// Element i, unchecked.
  constexpr const T& operator[](std::size_t i) const noexcept { return values[i]; }

  /// The M elements from number `first` on; they must lie inside, unchecked.
  template <std::size_t M>
  Vec<T, M> segment(std::size_t first) const noexcept {
    Vec<T, M> result;
    for (std::size_t i = 0; i < M; ++i) result[i] = values[first + i];
    return result;
  }
  /// Overwrites the M elements from number `first` on; unchecked.
  template <std::size_t M>
  void setSegment(std::size_t first, const Vec<T, M>& part) noexcept {
    for (std::size_t i = 0; i < M; ++i) values[first + i] = part[i];
  }

  /// The same elements as numbers of another type.
  template <class U>
  Vec<U, N> cast() const noexcept {
    Vec<U, N> result;
    for (std::size_t i = 0; i < N; ++i) result[i] = static_cast<U>(values[i]);
    return result;
  }

  /// Sum of the products of the elements.
  T dot(const Vec& other) const noexcept {
    T sum = values[0] * other.values[0];
    for (std::size_t i = 1; i < N; ++i) sum += values[i] * other.values[i];
    return sum;
  }

  /// Right-handed cross product; only for N = 3.
  template <std::size_t M = N, class = typename std::enable_if<M == 3 && M == N>::type>
  Vec cross(const Vec& other) const noexcept {
    const T* const a = values;
    const T* const b = other.values;
    return {{a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]}};
  }

  /// Sum of the squares; overflows and underflows where the squares do (see norm()).
  T squaredNorm() const noexcept { return dot(*this); }

  /// Euclidean length. Right for elements of every size: where the squares would overflow or
  /// underflow, the elements are scaled first.
  T norm() const noexcept {
    const T squared = squaredNorm();
    if (detail::isSafeSquare(squared)) return std::sqrt(squared);
    const T scale = largestMagnitude();
    if (!(scale > 0)) return squared;  // all zero, or NaN
    if (!(scale <= std::numeric_limits<T>::max())) return scale;
    return scale * std::sqrt((*this / scale).squaredNorm());
  }

  /// The vector of length 1 in the same direction; right for elements of every size.
  /// @throws ArgumentError when all elements are zero or one is not finite
  Vec normalized() const {
    const T squared = squaredNorm();
    if (detail::isSafeSquare(squared)) return *this / std::sqrt(squared);
    const T scale = largestMagnitude();
    const Vec scaled = *this / scale;
    const T scaled_squared = scaled.squaredNorm();
    if (!detail::isSafeSquare(scaled_squared)) {  // 0 / 0, inf / inf, or NaN from the start
      throw ArgumentError("vector", "has no direction, expected finite elements, not all zero");
    }
    return scaled / std::sqrt(scaled_squared);
  }

  /// Adds element by element.
  Vec& operator+=(const Vec& other) noexcept {
    for (std::size_t i = 0; i < N; ++i) values[i] += other.values[i];
    return *this;
  }
  /// Subtracts element by element.
  Vec& operator-=(const Vec& other) noexcept {
    for (std::size_t i = 0; i < N; ++i) values[i] -= other.values[i];
    return *this;
  }
  /// Multiplies every element.
  Vec& operator*=(T factor) noexcept {
    for (std::size_t i = 0; i < N; ++i) values[i] *= factor;
    return *this;
  }
  /// Divides every element; by zero as IEEE says.
  Vec& operator/=(T divisor) noexcept {
    for (std::size_t i = 0; i < N; ++i) values[i] /= divisor;
    return *this;
  }

  // Friends, not templates, so that `2 * v` and `v / 2` convert the integer.
  /// Sum, element by element.
  friend Vec operator+(Vec a, const Vec& b) noexcept { return a += b; }
  /// Difference, element by element.
  friend Vec operator-(Vec a, const Vec& b) noexcept { return a -= b; }
  /// The opposite vector.
  friend Vec operator-(Vec a) noexcept { return a *= T(-1); }
  /// Every element times a number.
  friend Vec operator*(Vec a, T factor) noexcept { return a *= factor; }
  /// Every element times a number.
  friend Vec operator*(T factor, Vec a) noexcept { return a *= factor; }
  /// Every element divided by a number; by zero as IEEE says.
  friend Vec operator/(Vec a, T divisor) noexcept { return a /= divisor; }

  /// Exact comparison, element by element; NaN equals nothing.
  friend bool operator==(const Vec& a, const Vec& b) noexcept {
    for (std::size_t i = 0; i < N; ++i) {
      if (!(a.values[i] == b.values[i])) return false;
    }
    return true;
  }
  /// The opposite of ==.
  friend bool operator!=(const Vec& a, const Vec& b) noexcept { return !(a == b); }

  /// The elements with a blank between them, with the precision of the stream.
  template <class Char, class Traits>
  friend std::basic_ostream<Char, Traits>& operator<<(std::basic_ostream<Char, Traits>& out,
                                                      const Vec& v) {
    out << v.values[0];
    for (std::size_t i = 1; i < N; ++i) out << ' ' << v.values[i];
    return out;
  }

 private:
  T largestMagnitude() const noexcept {
    T largest = 0;
    for (std::size_t i = 0; i < N; ++i) {
      const T magnitude = std::fabs(values[i]);
      if (magnitude > largest) largest = magnitude;
    }
    return largest;
  }
};

using Vec2d = Vec<double, 2>;  ///< 2 numbers, double
using Vec3d = Vec<double, 3>;  ///< 3 numbers, double
using Vec4d = Vec<double, 4>;  ///< 4 numbers, double
using Vec2f = Vec<float, 2>;   ///< 2 numbers, float
using Vec3f = Vec<float, 3>;   ///< 3 numbers, float
using Vec4f = Vec<float, 4>;   ///< 4 numbers, float

}  // namespace v1
}  // namespace gslam

#endif  // GSLAM_GEOMETRY_VEC_H
