// From int64 and double to text; the shortest that reads back as the same double.
//
// [1] R. Giulietti, "The Schubfach way to render doubles", 2020
#ifndef GSLAM_SVAR_DETAIL_PRINT_NUMBER_H
#define GSLAM_SVAR_DETAIL_PRINT_NUMBER_H

#include <gslam/svar/detail/powers_of_five.h>

#include <cstddef>
#include <cstdint>
#include <cstring>

namespace gslam {
inline namespace v1 {
namespace detail {

/// How many digits the number has; 1 for 0.
inline std::size_t digitCount(std::uint64_t number) noexcept {
  number |= 1;
  // 1233 / 4096 is log10(2), well enough for 64 bits (Hacker's Delight, 11-4).
  const std::size_t guess = static_cast<std::size_t>(64 - leadingZeros(number)) * 1233 >> 12;
  return guess + (number >= tenToThe(guess) ? 1 : 0);
}

/// Writes two digits, of a number below 100.
inline void writeTwo(std::uint32_t number, char* out) noexcept {
  static const char kPairs[] =
      "00010203040506070809101112131415161718192021222324252627282930313233343536373839404142434445"
      "46474849505152535455565758596061626364656667686970717273747576777879808182838485868788899091"
      "9293949596979899";
  std::memcpy(out, kPairs + std::size_t(2) * number, 2);
}

/// Writes eight digits, of a number below 10^8. The divisions do not wait for one another.
inline void writeEight(std::uint32_t number, char* out) noexcept {
  const std::uint32_t high = number / 10000;
  const std::uint32_t low = number % 10000;
  writeTwo(high / 100, out);
  writeTwo(high % 100, out + 2);
  writeTwo(low / 100, out + 4);
  writeTwo(low % 100, out + 6);
}

/// Writes the lowest `count` digits.
inline void writeDigits(std::uint64_t number, std::size_t count, char* out) noexcept {
  for (; count > 8; number /= 100000000) {
    count -= 8;
    writeEight(static_cast<std::uint32_t>(number % 100000000), out + count);
  }
  std::uint32_t rest = static_cast<std::uint32_t>(number);
  for (; count > 1; rest /= 100) {
    count -= 2;
    writeTwo(rest % 100, out + count);
  }
  if (count == 1) *out = static_cast<char>('0' + rest);
}

/// digits * 10^exponent
struct ShortDecimal {
  std::uint64_t digits;
  int exponent;
};

/// power * factor / 2^128, rounded to odd: the lowest bit is set where anything was lost, so that
/// even numbers compare with it as with the exact product, though the power was rounded up [1].
inline std::uint64_t multiplyToOdd(Uint128 power, std::uint64_t factor) noexcept {
  const std::uint64_t carry = multiplyWide(power.low, factor).high;
  const Uint128 product = multiplyWide(power.high, factor);
  const std::uint64_t rest = product.low + carry;
  return (product.high + (rest < carry ? 1 : 0)) | (rest > 1 ? 1 : 0);
}

/// floor(log10(2^n)), or that of 3/4 * 2^n, for |n| <= 1100. See floorLog2OfTenToThe().
inline int floorLog10OfTwoToThe(int n, bool three_quarters) noexcept {
  const int far = 400;
  const int product = n * 1262611 - (three_quarters ? 524031 : 0);
  return static_cast<int>((static_cast<unsigned>(product) + (far << 22)) >> 22) - far;
}

/// The number with the fewest digits (some may be zeros at the end) that rounds to a double, and
/// of these the one next to it [1].
/// @param parts  not 0
inline ShortDecimal shortestDecimal(BinaryParts parts) noexcept {
  // Where the significand wraps around, the double below is but half as far away.
  const bool closer_below = parts.significand == std::uint64_t(1) << 52 && parts.exponent > -1074;
  const std::uint64_t is_odd = parts.significand & 1;  // the ends of the interval are not its own

  // 10^k is at most the width of the interval that rounds to the double, 10^(k+1) is more: there
  // is a multiple of 10^k inside, and at most one of 10^(k+1). All are compared in units of
  // 10^k / 4.
  const int k = floorLog10OfTwoToThe(parts.exponent, closer_below);
  const Uint128 power = PowersOfFive::table().roundedUp(-k);
  const int shift = parts.exponent + floorLog2OfTenToThe(-k) + 1;
  const std::uint64_t quarters = 4 * parts.significand;
  const std::uint64_t middle = multiplyToOdd(power, quarters << shift);
  const std::uint64_t lower =
      multiplyToOdd(power, (quarters - (closer_below ? 1 : 2)) << shift) + is_odd;
  const std::uint64_t upper = multiplyToOdd(power, (quarters + 2) << shift) - is_odd;

  const std::uint64_t tens = middle / 40;
  const bool tens_below = lower <= 40 * tens;
  const bool tens_above = 40 * tens + 40 <= upper;
  if (tens_below != tens_above) return {tens + (tens_above ? 1 : 0), k + 1};

  const std::uint64_t ones = middle / 4;
  const bool ones_below = lower <= 4 * ones;
  const bool ones_above = 4 * ones + 4 <= upper;
  if (ones_below != ones_above) return {ones + (ones_above ? 1 : 0), k};
  const bool up = middle > 4 * ones + 2 || (middle == 4 * ones + 2 && (ones & 1) != 0);
  return {ones + (up ? 1 : 0), k};
}

/// Writes a number of digits with a point after the first `before` of them; returns the end.
inline char* writeWithPoint(std::uint64_t digits, std::size_t count, std::size_t before,
                            char* out) noexcept {
  writeDigits(digits, count, out + 1);
  std::memmove(out, out + 1, before);
  out[before] = '.';
  return out + count + 1;
}

/// Writes digits * 10^-5 and the like without an exponent.
/// @param before  how many digits stand before the point, from -4 to 16
inline char* writeFixed(std::uint64_t digits, std::size_t count, int before, char* out) noexcept {
  if (before <= 0) {
    std::memcpy(out, "0.0000", 6);
    out += 2 - before;
    writeDigits(digits, count, out);
    return out + count;
  }
  const std::size_t places = static_cast<std::size_t>(before);
  if (count > places) return writeWithPoint(digits, count, places, out);
  writeDigits(digits * tenToThe(places - count), places, out);
  std::memcpy(out + places, ".0", 2);
  return out + places + 2;
}

/// Writes such as 1e22 and 2.5e-7. The exponent is not 0.
inline char* writeScientific(std::uint64_t digits, std::size_t count, int exponent,
                             char* out) noexcept {
  char* p = writeWithPoint(digits, count, 1, out);
  if (count == 1) --p;
  *p++ = 'e';
  if (exponent < 0) *p++ = '-';
  const std::uint64_t magnitude = static_cast<std::uint64_t>(exponent < 0 ? -exponent : exponent);
  const std::size_t length = digitCount(magnitude);
  writeDigits(magnitude, length, p);
  return p + length;
}

/// Writes a double that is finite and greater than 0.
inline char* writePositive(BinaryParts parts, char* out) noexcept {
  ShortDecimal decimal = shortestDecimal(parts);
  for (; decimal.digits % 100000000 == 0; decimal.exponent += 8) decimal.digits /= 100000000;
  for (; decimal.digits % 10 == 0; ++decimal.exponent) decimal.digits /= 10;
  const std::size_t count = digitCount(decimal.digits);
  const int exponent = decimal.exponent + static_cast<int>(count) - 1;  // of the first digit
  return exponent >= -5 && exponent <= 15 ? writeFixed(decimal.digits, count, exponent + 1, out)
                                          : writeScientific(decimal.digits, count, exponent, out);
}

/// Writes a whole number of at most 16 digits as a double.
inline char* writeWhole(std::uint64_t number, char* out) noexcept {
  const std::size_t count = digitCount(number);
  return writeFixed(number, count, static_cast<int>(count), out);
}

/// Whether a double is a whole number from 1 to 2^53 - 1. It then needs all its digits, for the
/// doubles beside it are at most 1 away.
inline bool isSmallWhole(BinaryParts parts) noexcept {
  const std::uint64_t one = 1;
  return parts.exponent <= 0 && parts.exponent >= -52 &&
         (parts.significand & ((one << -parts.exponent) - 1)) == 0;
}

/// Writes the shortest text that reads back as the same double, and of these the one next to it.
/// It has a point or an exponent, so that it reads as no integer: 30.0, 0.00001, 1e16, 5e-324,
/// -0.0. Exponents are written below 10^-5 and from 10^16 on. Allocates nothing, and may be called
/// from many threads. Computes with integers only, whatever the rounding mode and the compiler's
/// flags make of doubles.
/// @param out  room for 32 characters; no zero byte ends them
/// @return how many were written, at most 24; none for NaN and infinity
inline std::size_t printDouble(double value, char* out) noexcept {
  const std::uint64_t bits = bitsOf(value) << 1 >> 1;
  if (bits >= kInfinityBits) return 0;
  char* p = out;
  if (bits != bitsOf(value)) *p++ = '-';
  const BinaryParts parts(bits);
  if (bits == 0) {
    p = writeWhole(0, p);
  } else if (isSmallWhole(parts)) {
    p = writeWhole(parts.significand >> -parts.exponent, p);
  } else {
    p = writePositive(parts, p);
  }
  return static_cast<std::size_t>(p - out);
}

/// Writes an integer.
/// @param out  room for 20 characters; no zero byte ends them
/// @return how many were written
inline std::size_t printInt64(std::int64_t value, char* out) noexcept {
  const std::uint64_t bits = static_cast<std::uint64_t>(value);
  const std::uint64_t magnitude = value < 0 ? 0 - bits : bits;
  const std::size_t sign = value < 0 ? 1 : 0;
  *out = '-';
  const std::size_t count = digitCount(magnitude);
  writeDigits(magnitude, count, out + sign);
  return sign + count;
}

}  // namespace detail
}  // namespace v1
}  // namespace gslam

#endif  // GSLAM_SVAR_DETAIL_PRINT_NUMBER_H
