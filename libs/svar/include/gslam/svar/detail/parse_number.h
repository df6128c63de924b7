// From the text of a number to int64 or double, correctly rounded.
//
// [1] D. Lemire, "Number Parsing at a Gigabyte per Second", Software: Practice and Experience, 2021
// [2] N. Mushtak, D. Lemire, "Fast Number Parsing Without Fallback", the same, 2023
//
// Computes with integers only: Clinger's way for short numbers, one division of doubles, would save
// half a nanosecond, but go wrong in other rounding modes and with -ffast-math.
#ifndef GSLAM_SVAR_DETAIL_PARSE_NUMBER_H
#define GSLAM_SVAR_DETAIL_PARSE_NUMBER_H

#include <gslam/svar/detail/json_text.h>
#include <gslam/svar/detail/powers_of_five.h>

#include <cstddef>
#include <cstdint>

// Compilers would not inline functions of this length, though that saves a twentieth of the time
// that JSON takes.
#ifdef __GNUC__
#define GSLAM_DETAIL_INLINE inline __attribute__((always_inline))
#else
#define GSLAM_DETAIL_INLINE inline
#endif

namespace gslam {
inline namespace v1 {
namespace detail {

enum class NumberStatus {
  ok,
  malformed,          ///< no number begins like this: a digit is missing at `end`
  out_of_range,       ///< too large for a double, such as 1e400, be it an integer or not
  integer_as_double,  ///< an integer beyond int64, which is exactly `real`, such as 2^63
  integer_rounded     ///< an integer beyond int64, to which `real` is the nearest double
};

struct ParsedNumber {
  const char* end;       ///< after the number, or where it goes wrong
  bool is_integer;       ///< the value is `integer`, else `real`; only so with status ok
  std::int64_t integer;  ///< else 0
  double real;           ///< else 0; never infinite
  NumberStatus status;
};

/// The digits of a number, and a power of ten for the last of them.
struct DecimalText {
  const char* begin;      ///< the first digit
  std::ptrdiff_t count;   ///< of digits; there may be a point among them
  std::uint64_t digits;   ///< all of them as one number, modulo 2^64
  std::int64_t exponent;  ///< the value is digits * 10^exponent, but for the sign
};

inline bool isDigit(char c) noexcept {
  return c >= '0' && c <= '9';
}

/// Bits of the upper halves of bytes, of which the lowest is in the first byte that is no digit; 0
/// where all are digits.
inline std::uint64_t markNoDigits(std::uint64_t text) noexcept {
  const std::uint64_t ones = 0x0101010101010101u;
  // The upper half of a digit is 3, also with 6 added to the lower half. What that carries changes
  // only bytes above one that is no digit.
  return ((text ^ ones * 0x30) | ((text + ones * 6) ^ ones * 0x30)) & ones * 0xF0;
}

/// Joins neighbours to numbers of two digits, these to four, these to eight.
inline std::uint64_t valueOfEightDigits(std::uint64_t text) noexcept {
  text &= 0x0F0F0F0F0F0F0F0Fu;
  text = (text * (1 + (10 << 8))) >> 8 & 0x00FF00FF00FF00FFu;
  text = (text * (1 + (100 << 16))) >> 16 & 0x0000FFFF0000FFFFu;
  return text * (1 + (std::uint64_t(10000) << 32)) >> 32;
}

struct Digits {
  const char* end;      ///< after the last of them
  std::uint64_t value;  ///< modulo 2^64
};

/// The digits from p on, joined to those of `value`.
inline Digits readDigits(const char* p, const char* end, std::uint64_t value) noexcept {
  for (; end - p >= 8; p += 8) {
    const std::uint64_t text = eightBytes(p);
    if (markNoDigits(text) != 0) break;
    value = value * 100000000 + valueOfEightDigits(text);
  }
  for (; p != end && isDigit(*p); ++p) value = value * 10 + static_cast<unsigned>(*p - '0');
  return {p, value};
}

/// The bits of the double next to digits * 10^exponent, of the even one where two are [1][2].
/// @param digits    not 0
/// @param exponent  from PowersOfFive::kMin to 308
inline std::uint64_t roundToDouble(std::uint64_t digits, int exponent) noexcept {
  const Uint128 power = PowersOfFive::table()[exponent];
  const int shift = leadingZeros(digits);
  digits <<= shift;
  Uint128 product = multiplyWide(digits, power.high);
  if ((product.high & 0x1FF) == 0x1FF) {  // only then may the lower word carry into what we use
    const std::uint64_t carry = multiplyWide(digits, power.low).high;
    product.low += carry;
    product.high += product.low < carry ? 1 : 0;
  }
  // 53 bits and one to round with; that the rest is lost matters for ties alone.
  const int top = static_cast<int>(product.high >> 63);
  std::uint64_t mantissa = product.high >> (top + 9);
  int biased = floorLog2OfTenToThe(exponent) + 63 + top - shift + 1023;
  if (biased <= 0) {  // subnormal: fewer bits
    if (biased <= -63) return 0;
    mantissa >>= 1 - biased;
    return (mantissa + 1) >> 1;  // the exponent becomes 1 by itself where this carries into bit 52
  }
  // Half way between two: nothing is lost. That needs 5^exponent in one word, or 5^-exponent as a
  // factor of the digits.
  if (product.low <= 1 && exponent >= -4 && exponent <= 23) {
    const bool is_tie = (mantissa & 1) != 0 && mantissa << (top + 9) == product.high;
    if (is_tie && (mantissa & 2) == 0) --mantissa;
  }
  mantissa = (mantissa + 1) >> 1;
  // Bit 52 adds one to the exponent, or two with 0 behind it where rounding carried into bit 53.
  const std::uint64_t bits = (static_cast<std::uint64_t>(biased - 1) << 52) + mantissa;
  return bits < kInfinityBits ? bits : kInfinityBits;
}

/// A natural number of up to 2816 bits: 780 digits have 2592, and what they are compared with by
/// compareExactly() has hardly more.
class BigNatural {
 public:
  void multiplyAdd(std::uint64_t factor, std::uint64_t carry) noexcept {
    for (int i = 0; i < size_; ++i) {
      const Uint128 product = multiplyWide(words_[i], factor);
      words_[i] = product.low + carry;
      carry = product.high + (words_[i] < carry ? 1 : 0);
    }
    if (carry != 0) words_[size_++] = carry;
  }

  void multiplyByPowerOfFive(std::int64_t n) noexcept {
    const std::uint64_t five_to_the_27 = 7450580596923828125u;
    for (; n >= 27; n -= 27) multiplyAdd(five_to_the_27, 0);
    for (; n > 0; --n) multiplyAdd(5, 0);
  }

  void multiplyByPowerOfTwo(std::int64_t n) noexcept {
    for (; n >= 63; n -= 63) multiplyAdd(std::uint64_t(1) << 63, 0);
    if (n > 0) multiplyAdd(std::uint64_t(1) << n, 0);
  }

  /// Less than, equal to or greater than 0.
  int compare(const BigNatural& other) const noexcept {
    if (size_ != other.size_) return size_ < other.size_ ? -1 : 1;
    for (int i = size_; i-- > 0;) {
      if (words_[i] != other.words_[i]) return words_[i] < other.words_[i] ? -1 : 1;
    }
    return 0;
  }

 private:
  std::uint64_t words_[44];  // the lowest first
  int size_ = 0;             // the highest of them is not 0
};

/// Goes from digit to digit, past the point.
class DigitReader {
 public:
  /// Begins at the first digit that is not 0.
  explicit DigitReader(const DecimalText& text) noexcept : at_(text.begin), left_(text.count) {
    for (; left_ > 0 && (*at_ == '0' || *at_ == '.'); ++at_) left_ -= *at_ == '0' ? 1 : 0;
  }

  std::ptrdiff_t left() const noexcept { return left_; }

  unsigned next() noexcept {
    if (*at_ == '.') ++at_;
    --left_;
    return static_cast<unsigned>(*at_++ - '0');
  }

  /// The next 19 digits, or as many as are left.
  std::uint64_t nextWord() noexcept {
    std::uint64_t word = 0;
    for (int i = 0; i < 19 && left_ > 0; ++i) word = word * 10 + next();
    return word;
  }

 private:
  const char* at_;
  std::ptrdiff_t left_;
};

/// All digits of a number, and the power of ten they are to be multiplied by.
///
/// Beyond 779 digits only whether one is not 0 counts: as decimals, doubles and what lies half way
/// between two have at most 768 digits.
struct BigDecimal {
  explicit BigDecimal(const DecimalText& text) noexcept : exponent(text.exponent) {
    DigitReader reader(text);
    for (int i = 0; i < 41 && reader.left() > 0; ++i) {
      const std::size_t count = reader.left() < 19 ? static_cast<std::size_t>(reader.left()) : 19;
      digits.multiplyAdd(tenToThe(count), reader.nextWord());
    }
    exponent += reader.left();
    bool rest = false;
    while (reader.left() > 0 && !rest) rest = reader.next() != 0;
    if (rest) {
      digits.multiplyAdd(10, 1);
      --exponent;
    }
  }

  BigNatural digits;
  std::int64_t exponent;
};

/// Less than, equal to or greater than 0: the number against significand * 2^exponent, which must
/// be of its magnitude, so that the products fit.
inline int compareExactly(DecimalText text, std::uint64_t significand, int exponent) noexcept {
  BigDecimal left(text);
  BigNatural right;
  right.multiplyAdd(1, significand);
  left.digits.multiplyByPowerOfFive(left.exponent);
  right.multiplyByPowerOfFive(-left.exponent);
  left.digits.multiplyByPowerOfTwo(left.exponent - exponent);
  right.multiplyByPowerOfTwo(exponent - left.exponent);
  return left.digits.compare(right);
}

/// As roundToDouble(), for any exponent and for 0.
inline std::uint64_t roundAnyToDouble(std::uint64_t digits, std::int64_t exponent) noexcept {
  if (digits == 0 || exponent < PowersOfFive::kMin) return 0;  // 2^64 * 10^-343 < 2^-1075
  return exponent > 308 ? kInfinityBits : roundToDouble(digits, static_cast<int>(exponent));
}

/// As nearestBits(), for more than 19 digits.
inline std::uint64_t nearestBitsOfLong(DecimalText text) noexcept {
  DigitReader reader(text);
  if (reader.left() <= 19) return roundAnyToDouble(text.digits, text.exponent);
  const std::uint64_t first = reader.nextWord();
  const std::int64_t exponent = text.exponent + reader.left();
  const std::uint64_t low = roundAnyToDouble(first, exponent);
  if (low == roundAnyToDouble(first + 1, exponent)) return low;
  // The number lies between these two, hence near the middle of two doubles: all digits count.
  const BinaryParts below(low);
  const int order = compareExactly(text, 2 * below.significand + 1, below.exponent - 1);
  return low + (order > 0 || (order == 0 && (low & 1) != 0) ? 1 : 0);
}

/// The bits of the double next to the number, but for the sign; those of infinity if too large.
inline std::uint64_t nearestBits(DecimalText text) noexcept {
  return text.count <= 19 ? roundAnyToDouble(text.digits, text.exponent) : nearestBitsOfLong(text);
}

inline ParsedNumber parsedReal(const char* end, std::uint64_t bits, bool negative,
                               NumberStatus status = NumberStatus::ok) noexcept {
  if (bits == kInfinityBits) return {end, false, 0, 0, NumberStatus::out_of_range};
  return {end, false, 0, doubleOf(bits | static_cast<std::uint64_t>(negative) << 63), status};
}

inline ParsedNumber parsedLargeInteger(const char* end, DecimalText text, bool negative) noexcept {
  const std::uint64_t bits = nearestBits(text);
  if (bits == kInfinityBits) return parsedReal(end, bits, negative);
  const BinaryParts parts(bits);
  const bool exact = compareExactly(text, parts.significand, parts.exponent) == 0;
  return parsedReal(end, bits, negative,
                    exact ? NumberStatus::integer_as_double : NumberStatus::integer_rounded);
}

inline ParsedNumber parsedInteger(const char* end, DecimalText text, bool negative) noexcept {
  const std::uint64_t limit = (std::uint64_t(1) << 63) - (negative ? 0 : 1);
  if (text.count > 19 || text.digits > limit) return parsedLargeInteger(end, text, negative);
  if (text.digits == 0 && negative) return parsedReal(end, 0, true);  // int64 has no -0
  const std::int64_t integer = negative ? -static_cast<std::int64_t>(text.digits - 1) - 1
                                        : static_cast<std::int64_t>(text.digits);
  return {end, true, integer, 0, NumberStatus::ok};
}

/// Adds what stands after the letter e. Far beyond any double, digits no longer count.
inline const char* readExponent(const char* p, const char* end, std::int64_t& exponent) noexcept {
  const bool negative = p != end && *p == '-';
  if (p != end && (*p == '-' || *p == '+')) ++p;
  std::int64_t value = 0;
  for (; p != end && isDigit(*p); ++p) {
    if (value < 100000000000000000) value = value * 10 + (*p - '0');
  }
  exponent += negative ? -value : value;
  return p;
}

/// The bits of the double next to digits / 10^places, which is far from being subnormal or
/// infinite.
/// @param digits  not 0
/// @param places  from 1 to 19
GSLAM_DETAIL_INLINE std::uint64_t roundFraction(std::uint64_t digits, std::size_t places) noexcept {
  const RoughPower power = tenToTheMinus(places);
  const int shift = leadingZeros(digits);
  const std::uint64_t product = multiplyWide(digits << shift, power.digits).high;
  const int top = static_cast<int>(product >> 63);
  // 53 bits to keep, one to round with, ten that are left. The exact product is less than two above
  // (but for the factor 2^(1 - top)), and never equal: it may round to another double only where
  // all that is left is set, and the bit to round with is not.
  const std::uint64_t bits = product << (1 - top);
  if (((bits | 1) & 0x7FF) == 0x3FF) return roundToDouble(digits, -static_cast<int>(places));
  const std::int64_t biased = power.exponent + 63 + top - shift + 1023;
  return (static_cast<std::uint64_t>(biased - 1) << 52) + (((bits >> 10) + 1) >> 1);
}

/// An int64 or a double, either as 64 bits: in place of ParsedNumber, to stay in registers.
struct ShortNumber {
  bool is_integer;
  std::uint64_t bits;

  std::int64_t integer() const noexcept {
    return bits >> 63 == 0 ? static_cast<std::int64_t>(bits)
                           : -static_cast<std::int64_t>(~bits) - 1;
  }
  double real() const noexcept { return doubleOf(bits); }
};

/// Goes on with parseShortNumber() at the point, after the digits from `whole` on.
GSLAM_DETAIL_INLINE const char* parseShortReal(const char* whole, const char* point,
                                               const char* end, std::uint64_t digits,
                                               std::uint64_t& magnitude) noexcept {
  const char* const fraction = point + 1;
  const char* p = fraction;
  std::uint64_t text = eightBytes(p);
  std::uint64_t others = markNoDigits(text);
  for (; others == 0; others = markNoDigits(text)) {
    digits = digits * 100000000 + valueOfEightDigits(text);
    p += 8;
    if (end - p < 9) return nullptr;
    text = eightBytes(p);
  }
  // What is left, be it one digit or seven, takes the same steps: no processor foresees how many.
  const int bits = trailingZeros(others) & ~7;
  p += bits / 8;
  if (p == fraction || p - whole > 20 || (*p | 0x20) == 'e') return nullptr;
  digits = digits * tenToThe(static_cast<std::size_t>(bits / 8)) +
           valueOfEightDigits(text << 8 << (56 - bits));
  magnitude = digits == 0 ? 0 : roundFraction(digits, static_cast<std::size_t>(p - fraction));
  return p;
}

/// Reads an integer or a double such as -12.345, of at most 19 digits and without exponent, as most
/// are.
/// @return its end; null where there is something else, or the text ends within 32 bytes
GSLAM_DETAIL_INLINE const char* parseShortNumber(const char* begin, const char* end,
                                                 ShortNumber& number) noexcept {
  if (end - begin < 32) return nullptr;
  // A number, not a bool, lest compilers make a branch of it, which no processor foresees.
  const std::uint64_t negative = *begin == '-' ? 1 : 0;
  const char* const whole = begin + negative;
  const char* p = whole;
  std::uint64_t digits = 0;
  for (; isDigit(*p); ++p) {
    if (p - whole == 19) return nullptr;
    digits = digits * 10 + static_cast<unsigned>(*p - '0');
  }
  if (p == whole || (p - whole > 1 && *whole == '0')) return nullptr;
  number.is_integer = *p != '.';
  if (!number.is_integer) {
    p = parseShortReal(whole, p, end, digits, number.bits);
    number.bits |= negative << 63;
    return p;
  }
  const bool minus_zero = digits < negative;  // which is a double
  if (minus_zero || digits >> 63 != 0 || (*p | 0x20) == 'e') return nullptr;
  number.bits = (digits ^ (0 - negative)) + negative;
  return p;
}

/// As parseNumber(), for any number.
inline ParsedNumber parseAnyNumber(const char* begin, const char* end) noexcept {
  const bool negative = begin != end && *begin == '-';
  const char* const whole = begin + (negative ? 1 : 0);
  Digits digits = {whole, 0};
  if (whole != end && *whole == '0') {
    ++digits.end;
  } else {
    digits = readDigits(whole, end, 0);
  }
  const char* p = digits.end;
  bool complete = p != whole;
  bool is_real = false;
  DecimalText text = {whole, p - whole, digits.value, 0};
  if (complete && p != end && *p == '.') {
    const char* const fraction = p + 1;
    digits = readDigits(fraction, end, digits.value);
    p = digits.end;
    text = {whole, p - whole - 1, digits.value, fraction - p};
    complete = p != fraction;
    is_real = true;
  }
  if (complete && p != end && (*p == 'e' || *p == 'E')) {
    p = readExponent(p + 1, end, text.exponent);
    complete = isDigit(p[-1]);
    is_real = true;
  }
  if (!complete) return {p, false, 0, 0, NumberStatus::malformed};
  return is_real ? parsedReal(p, nearestBits(text), negative) : parsedInteger(p, text, negative);
}

/// Reads the number that begins at `begin`: -?(0|[1-9][0-9]*)(\.[0-9]+)?([eE][+-]?[0-9]+)? as of
/// RFC 8259, section 6. What follows it is not looked at: "01" is the number 0 and something else.
///
/// Without fraction and exponent it is an integer, except that -0 is the double -0.0. What is not
/// is the nearest double, of two as near the one with an even significand; tiny numbers are 0.
/// Never reads at or past `end`, never allocates. May be called from many threads.
inline ParsedNumber parseNumber(const char* begin, const char* end) noexcept {
  ShortNumber number = {false, 0};
  const char* const after = parseShortNumber(begin, end, number);
  if (after == nullptr) return parseAnyNumber(begin, end);
  if (number.is_integer) return {after, true, number.integer(), 0, NumberStatus::ok};
  return {after, false, 0, number.real(), NumberStatus::ok};
}

}  // namespace detail
}  // namespace v1
}  // namespace gslam

#undef GSLAM_DETAIL_INLINE

#endif  // GSLAM_SVAR_DETAIL_PARSE_NUMBER_H
