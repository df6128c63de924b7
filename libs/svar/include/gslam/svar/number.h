#ifndef GSLAM_SVAR_NUMBER_H
#define GSLAM_SVAR_NUMBER_H

#include <gslam/svar/error.h>

#include <cstdint>
#include <limits>
#include <string>
#include <type_traits>

/// @file
/// Conversions between number types that never change the value behind the caller's back.

namespace gslam {
inline namespace v1 {
namespace detail {

template <bool condition>
using EnableIf = typename std::enable_if<condition, int>::type;

// The integers that are numbers: neither bool nor the character types, nor those of 128 bits that
// some compilers have. signed and unsigned char are numbers, for they are int8_t and uint8_t.
template <class T>
struct IsInteger : std::integral_constant<bool, std::is_integral<T>::value &&
                                                    sizeof(T) <= sizeof(std::int64_t)> {};
template <>
struct IsInteger<bool> : std::false_type {};
template <>
struct IsInteger<char> : std::false_type {};
template <>
struct IsInteger<wchar_t> : std::false_type {};
template <>
struct IsInteger<char16_t> : std::false_type {};
template <>
struct IsInteger<char32_t> : std::false_type {};
#ifdef __cpp_char8_t
template <>
struct IsInteger<char8_t> : std::false_type {};
#endif

template <class T>
struct IsReal : std::false_type {};
template <>
struct IsReal<float> : std::true_type {};
template <>
struct IsReal<double> : std::true_type {};

constexpr double kTwoTo63 = 9223372036854775808.0;

/// False, with `to` untouched, where T cannot hold the value.
template <class T, EnableIf<IsInteger<T>::value> = 0>
bool convertNumber(std::int64_t from, T& to) noexcept {
  using Limits = std::numeric_limits<T>;
  const bool fits = Limits::is_signed ? from >= static_cast<std::int64_t>(Limits::min()) &&
                                            from <= static_cast<std::int64_t>(Limits::max())
                                      : from >= 0 && static_cast<std::uint64_t>(from) <=
                                                         static_cast<std::uint64_t>(Limits::max());
  if (fits) to = static_cast<T>(from);
  return fits;
}

/// Exact or not at all: 2^53 + 1 is no double.
template <class T, EnableIf<IsReal<T>::value> = 0>
bool convertNumber(std::int64_t from, T& to) noexcept {
  const T real = static_cast<T>(from);
  // Rounding up may have left the range of int64, where casting back is undefined.
  const bool exact =
      static_cast<double>(real) < kTwoTo63 && static_cast<std::int64_t>(real) == from;
  if (exact) to = real;
  return exact;
}

/// Only whole numbers: no rounding, no NaN.
template <class T, EnableIf<IsInteger<T>::value> = 0>
bool convertNumber(double from, T& to) noexcept {
  if (!(from >= -kTwoTo63 && from < kTwoTo63)) return false;
  const std::int64_t whole = static_cast<std::int64_t>(from);
  return static_cast<double>(whole) == from && convertNumber(whole, to);
}

inline bool convertNumber(double from, double& to) noexcept {
  to = from;
  return true;
}

/// Rounds to the nearest float, for that is what a float is; refuses what would become infinite.
inline bool convertNumber(double from, float& to) noexcept {
  const double limit = static_cast<double>(std::numeric_limits<float>::max());
  const bool finite =
      from >= std::numeric_limits<double>::lowest() && from <= std::numeric_limits<double>::max();
  if (finite && (from < -limit || from > limit)) return false;
  to = static_cast<float>(from);
  return true;
}

/// @throws SvarError for a uint64 that int64 cannot hold
template <class T>
std::int64_t toInt64(T value) {
  if (!std::numeric_limits<T>::is_signed &&
      static_cast<std::uint64_t>(value) >
          static_cast<std::uint64_t>(std::numeric_limits<std::int64_t>::max())) {
    throw SvarError("", "expected at most 9223372036854775807, the largest int64, found " +
                            std::to_string(static_cast<std::uint64_t>(value)));
  }
  return static_cast<std::int64_t>(value);
}

/// "int8" to "uint64", "float" and "double", for messages.
template <class T>
std::string numberName() {
  if (IsReal<T>::value) return sizeof(T) == sizeof(float) ? "float" : "double";
  return (std::numeric_limits<T>::is_signed ? "int" : "uint") + std::to_string(8 * sizeof(T));
}

}  // namespace detail
}  // namespace v1
}  // namespace gslam

#endif  // GSLAM_SVAR_NUMBER_H
