// From digits to numbers, at the speed that files of 100 MB need, whatever the locale.
//
// All functions begin at p, and return the place behind the number; null: there is no such number.
#ifndef GSLAM_VOCABULARY_DETAIL_DIGITS_H
#define GSLAM_VOCABULARY_DETAIL_DIGITS_H

#include <cmath>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <locale>
#include <sstream>
#include <string>

namespace gslam {
inline namespace v1 {
namespace detail {

inline unsigned digitOf(char c) noexcept {  // over 9: none
  return static_cast<unsigned>(static_cast<unsigned char>(c)) - '0';
}

// Up to `largest`.
inline const char* scanUnsigned(const char* p, const char* end, std::uint32_t largest,
                                std::uint32_t& value) noexcept {
  if (p == end || digitOf(*p) > 9) return nullptr;
  std::uint64_t sum = 0;
  for (; p != end && digitOf(*p) <= 9; ++p) {
    sum = sum * 10 + digitOf(*p);
    if (sum > largest) return nullptr;
  }
  value = static_cast<std::uint32_t>(sum);
  return p;
}

// 0 to 255 in at most three digits.
inline const char* scanByte(const char* p, const char* end, std::uint8_t& value) noexcept {
  if (end - p < 4) {
    std::uint32_t number = 0;
    p = scanUnsigned(p, end, 255, number);
    value = static_cast<std::uint8_t>(number);
    return p;
  }
  // One to three digits follow each other as chance has it: choosing costs less than guessing.
  const unsigned a = digitOf(p[0]);
  const unsigned b = digitOf(p[1]);
  const unsigned c = digitOf(p[2]);
  const unsigned has_two = b <= 9 ? 1 : 0;
  const unsigned has_three = has_two & (c <= 9 ? 1U : 0U);
  unsigned number = has_two != 0 ? a * 10 + b : a;
  number = has_three != 0 ? number * 10 + c : number;
  p += 1 + has_two + has_three;
  if (a > 9 || number > 255 || digitOf(*p) <= 9) return nullptr;
  value = static_cast<std::uint8_t>(number);
  return p;
}

// The double next to digits / 10^exponent, by long division: 18 digits and an exponent of 27 fit.
inline double quotientOf(std::uint64_t digits, int exponent) noexcept {
  if (digits == 0) return 0;
  std::uint64_t divisor = 1;
  for (int i = 0; i < exponent; ++i) divisor *= 5;
  int shift = -exponent;
  const std::uint64_t top = std::uint64_t(1) << 62;
  for (; digits < top; digits <<= 1) --shift;
  for (; divisor < top; divisor <<= 1) ++shift;
  std::uint64_t quotient = 0;
  std::uint64_t rest = digits;
  for (int i = 0; i < 57; ++i) {  // three bits more than a double has, the last for all that follow
    const bool is_in = rest >= divisor;
    quotient = quotient << 1 | (is_in ? 1 : 0);
    rest = (rest - (is_in ? divisor : 0)) << 1;
  }
  if (rest != 0) quotient |= 1;
  return std::ldexp(static_cast<double>(quotient), shift - 56);
}

// Those of the classic locale. False: too large.
template <class Real>
bool realByStream(const char* p, const char* end, Real& value) {
  std::istringstream stream(std::string(p, end));
  stream.imbue(std::locale::classic());
  return static_cast<bool>(stream >> value);
}

struct ScannedReal {
  const char* end = nullptr;  // null: no number
  std::uint64_t digits = 0;   // modulo 2^64
  int count = 0;              // of digits, without zeros in front, up to 1000
  int exponent = 0;           // the value is digits * 10^exponent; +-10000: any that is far off
  bool is_negative = false;
};

inline const char* scanDigits(const char* p, const char* end, ScannedReal& real) noexcept {
  for (; p != end && digitOf(*p) <= 9; ++p) {
    real.digits = real.digits * 10 + digitOf(*p);
    if ((real.digits != 0 || real.count != 0) && real.count < 1000) ++real.count;
  }
  return p;
}

inline const char* scanExponent(const char* p, const char* end, ScannedReal& real) noexcept {
  if (p == end || (*p != 'e' && *p != 'E')) return p;
  ++p;
  const bool is_negative = p != end && *p == '-';
  if (p != end && (*p == '-' || *p == '+')) ++p;
  if (p == end || digitOf(*p) > 9) return nullptr;
  int exponent = 0;
  for (; p != end && digitOf(*p) <= 9; ++p) {
    if (exponent < 10000) exponent = exponent * 10 + static_cast<int>(digitOf(*p));
  }
  real.exponent += is_negative ? -exponent : exponent;
  return p;
}

// [+-]digits[.[digits]][e[+-]digits], or with the point first.
inline ScannedReal scanRealText(const char* p, const char* end) noexcept {
  ScannedReal real;
  if (p != end && (*p == '-' || *p == '+')) real.is_negative = *p++ == '-';
  const char* const whole = p;
  p = scanDigits(p, end, real);
  std::ptrdiff_t digits = p - whole;
  if (p != end && *p == '.') {
    const char* const part = ++p;
    p = scanDigits(p, end, real);
    digits += p - part;
    real.exponent = p - part > 10000 ? -10000 : -static_cast<int>(p - part);
  }
  if (digits != 0) real.end = scanExponent(p, end, real);
  return real;
}

// Whether a real could be made exactly in a few steps.
inline bool isQuickReal(const ScannedReal& real, double& value) noexcept {
  static const double powers[] = {1e0,  1e1,  1e2,  1e3,  1e4,  1e5,  1e6,  1e7,
                                  1e8,  1e9,  1e10, 1e11, 1e12, 1e13, 1e14, 1e15,
                                  1e16, 1e17, 1e18, 1e19, 1e20, 1e21, 1e22};
  if (real.count > 18 || real.exponent < -27 || real.exponent > 22) return false;
  // Both sides are doubles, so the result is rounded once: W. Clinger, "How to Read Floating Point
  // Numbers Accurately", PLDI 1990.
  const bool is_short = real.count <= 15 && real.exponent >= -22;
  if (!is_short && real.exponent > 0) return false;
  if (!is_short) {
    value = quotientOf(real.digits, -real.exponent);
  } else if (real.exponent < 0) {
    value = static_cast<double>(real.digits) / powers[-real.exponent];
  } else {
    value = static_cast<double>(real.digits) * powers[real.exponent];
  }
  if (real.is_negative) value = -value;
  return true;
}

// Finite; the nearest double.
inline const char* scanDouble(const char* p, const char* end, double& value) {
  const ScannedReal real = scanRealText(p, end);
  if (real.end == nullptr || isQuickReal(real, value)) return real.end;
  return realByStream(p, real.end, value) ? real.end : nullptr;
}

// Finite; the nearest float.
inline const char* scanFloat(const char* p, const char* end, float& value) {
  const ScannedReal real = scanRealText(p, end);
  double wide;
  if (real.end == nullptr) return nullptr;
  if (isQuickReal(real, wide)) {
    const double size = std::fabs(wide);
    std::uint64_t bits;
    std::memcpy(&bits, &wide, sizeof(bits));
    // Rounding twice goes wrong where the first step ends half way between two floats.
    const bool is_between = (bits & 0x1FFFFFFF) == 0x10000000;
    if (size == 0 || (size > 1e-37 && size < 1e38 && !is_between)) {
      value = static_cast<float>(wide);
      return real.end;
    }
  }
  return realByStream(p, real.end, value) ? real.end : nullptr;
}

}  // namespace detail
}  // namespace v1
}  // namespace gslam

#endif  // GSLAM_VOCABULARY_DETAIL_DIGITS_H
