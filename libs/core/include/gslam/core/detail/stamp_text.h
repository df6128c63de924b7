// Stamps to text and back, with integers only.
#ifndef GSLAM_CORE_DETAIL_STAMP_TEXT_H
#define GSLAM_CORE_DETAIL_STAMP_TEXT_H

#include <gslam/svar/detail/parse_number.h>
#include <gslam/svar/detail/print_number.h>

#include <cstddef>
#include <cstdint>
#include <string>

namespace gslam {
inline namespace v1 {
namespace detail {

constexpr std::size_t kStampRoom = 24;  // -9223372036.854775808 has 21

/// Writes seconds with nine decimals.
/// @param out  room for kStampRoom characters; no zero byte ends them
/// @return how many were written
inline std::size_t printSeconds(std::int64_t stamp, char* out) noexcept {
  const std::uint64_t bits = static_cast<std::uint64_t>(stamp);
  const std::uint64_t magnitude = stamp < 0 ? 0 - bits : bits;
  char* p = out;
  if (stamp < 0) *p++ = '-';
  const std::uint64_t seconds = magnitude / 1000000000;
  const std::size_t count = digitCount(seconds);
  writeDigits(seconds, count, p);
  p += count;
  *p++ = '.';
  writeDigits(magnitude % 1000000000, 9, p);
  return static_cast<std::size_t>(p + 9 - out);
}

enum class StampStatus {
  ok,
  malformed,    ///< no number begins like this
  out_of_range  ///< beyond int64
};

struct ParsedStamp {
  const char* end;     ///< after the number, or where it goes wrong
  std::int64_t value;  ///< else 0
  bool is_exact;       ///< whether it was a whole number
  StampStatus status;
};

// The digits of a decimal number, and where they end.
struct StampDigits {
  const char* begin;      // the first digit, or the point before it
  const char* last;       // after the last digit
  const char* end;        // after the exponent
  std::int64_t whole;     // how many digits stand before the point
  std::int64_t all;       // how many digits there are
  std::int64_t exponent;  // of ten, bounded
};

inline StampDigits findStampDigits(const char* p, const char* end) noexcept {
  StampDigits found = {p, p, p, 0, 0, 0};
  for (; p != end && isDigit(*p); ++p) ++found.whole;
  found.all = found.whole;
  if (p != end && *p == '.') {
    for (++p; p != end && isDigit(*p); ++p) ++found.all;
  }
  found.last = found.end = p;
  if (p != end && (*p == 'e' || *p == 'E')) {
    const char* const after = readExponent(p + 1, end, found.exponent);
    found.end = after;
    if (!isDigit(after[-1])) found.all = 0;  // e without digits
  }
  return found;
}

// The first `count` digits as a number, the rest rounded to the nearest, ties to even.
class StampRounder {
 public:
  void add(unsigned digit, std::int64_t place, std::int64_t count) noexcept {
    if (place < count) {
      push(digit);
    } else if (place == count) {
      next_ = digit;
    } else {
      rest_ = rest_ || digit != 0;
    }
  }
  // Zeros that the text leaves out.
  void fill(std::int64_t count) noexcept {
    for (; count > 0 && value_ != 0 && !is_large_; --count) push(0);
  }
  void round() noexcept {
    const bool up = next_ > 5 || (next_ == 5 && (rest_ || (value_ & 1) != 0));
    value_ += up ? 1 : 0;
  }
  bool isExact() const noexcept { return next_ == 0 && !rest_; }
  bool fits(std::uint64_t limit) const noexcept { return !is_large_ && value_ <= limit; }
  std::uint64_t value() const noexcept { return value_; }

 private:
  void push(unsigned digit) noexcept {
    if (value_ > UINT64_MAX / 10 - 1) {
      is_large_ = true;
    } else {
      value_ = value_ * 10 + digit;
    }
  }

  std::uint64_t value_ = 0;
  unsigned next_ = 0;      // the digit behind the last one kept
  bool rest_ = false;      // whether one behind that is not 0
  bool is_large_ = false;  // beyond what value_ holds
};

/// Reads the number that begins at p, times 10^places, rounded to the nearest, ties to even. What
/// follows it is not looked at. Never reads at or past `end`.
inline ParsedStamp parseStamp(const char* p, const char* end, int places) noexcept {
  const bool negative = p != end && *p == '-';
  if (p != end && (*p == '-' || *p == '+')) ++p;
  const StampDigits digits = findStampDigits(p, end);
  if (digits.all == 0) return {digits.end, 0, false, StampStatus::malformed};
  const std::int64_t kept = digits.whole + digits.exponent + places;
  StampRounder rounder;
  std::int64_t place = kept < 0 ? 1 : 0;  // of numbers below 0.1 no digit rounds up
  for (p = digits.begin; p != digits.last; ++p) {
    if (*p != '.') rounder.add(static_cast<unsigned>(*p - '0'), place++, kept < 0 ? 0 : kept);
  }
  rounder.fill(kept - digits.all);
  rounder.round();
  const std::uint64_t limit = (std::uint64_t(1) << 63) - (negative ? 0 : 1);
  if (!rounder.fits(limit)) return {digits.end, 0, false, StampStatus::out_of_range};
  const std::uint64_t bits = negative ? 0 - rounder.value() : rounder.value();
  const std::int64_t value =
      bits >> 63 == 0 ? static_cast<std::int64_t>(bits) : -static_cast<std::int64_t>(~bits) - 1;
  return {digits.end, value, rounder.isExact(), StampStatus::ok};
}

/// The text in quotes, for messages: no longer than a line, and without control characters.
inline std::string quotedText(const std::string& text) {
  const std::size_t most = 40;
  std::string shown = "'";
  for (std::size_t i = 0; i < text.size() && i < most; ++i) {
    const unsigned char byte = static_cast<unsigned char>(text[i]);
    static const char kHex[] = "0123456789abcdef";
    if (byte >= 0x20 && byte < 0x7F) {
      shown += text[i];
    } else {
      shown += std::string("\\x") + kHex[byte >> 4] + kHex[byte & 15];
    }
  }
  return shown + (text.size() > most ? "...'" : "'");
}

/// Says of a stamp that is out of range what it might be: the usual mistake is another unit.
/// @param text    the number
/// @param unit    what it was taken for
/// @param places  how many decimals that has
inline std::string hugeStampText(const std::string& text, const std::string& unit, int places) {
  std::string problem = quotedText(text) + " " + unit +
                        " is more than 64 bits of nanoseconds can hold (the year 2262)";
  static const char* const kUnits[] = {"nanoseconds", "microseconds", "milliseconds"};
  for (int smaller = places - 3; smaller >= 0; smaller -= 3) {
    const ParsedStamp other = parseStamp(text.data(), text.data() + text.size(), smaller);
    if (other.status == StampStatus::ok) return problem + "; is it in " + kUnits[smaller / 3] + "?";
  }
  return problem;
}

}  // namespace detail
}  // namespace v1
}  // namespace gslam

#endif  // GSLAM_CORE_DETAIL_STAMP_TEXT_H
