#ifndef GSLAM_GEOMETRY_DETAIL_LANES_SCALAR_H
#define GSLAM_GEOMETRY_DETAIL_LANES_SCALAR_H

#include <gslam/geometry/detail/pair.h>

#include <cmath>
#include <cstddef>

/// @file
/// What batches need to know of plain C++: one number at once.

namespace gslam {
inline namespace v1 {
namespace detail {
namespace scalar {

template <class T>
struct Registers {
  using Register = T;
  static constexpr std::size_t kWidth = 1;

  static T load(const T* from) noexcept { return *from; }
  static void store(T* to, T r) noexcept { *to = r; }
  static T all(T value) noexcept { return value; }
  static T multiplyAdd(T a, T x, T b) noexcept { return detail::multiplyAdd(a, x, b); }
  static T subtractProduct(T b, T a, T x) noexcept { return detail::multiplyAdd(-a, x, b); }
  static T magnitude(T r) noexcept { return std::fabs(r); }
  static T timesSign(T r, T sign) noexcept { return std::signbit(sign) ? -r : r; }
  static bool areAtMost(T r, T bound) noexcept { return r <= bound; }

  static void load3(const T* from, T* r) noexcept {
    r[0] = from[0];
    r[1] = from[1];
    r[2] = from[2];
  }
  static void store3(T* to, const T* r) noexcept {
    to[0] = r[0];
    to[1] = r[1];
    to[2] = r[2];
  }
  static void load4(const T* from, std::size_t, T* r) noexcept {
    r[0] = from[0];
    r[1] = from[1];
    r[2] = from[2];
    r[3] = from[3];
  }
  static void store4(T* to, std::size_t, const T* r) noexcept {
    to[0] = r[0];
    to[1] = r[1];
    to[2] = r[2];
    to[3] = r[3];
  }
};

}  // namespace scalar
}  // namespace detail
}  // namespace v1
}  // namespace gslam

#endif  // GSLAM_GEOMETRY_DETAIL_LANES_SCALAR_H
