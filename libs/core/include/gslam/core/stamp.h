#ifndef GSLAM_CORE_STAMP_H
#define GSLAM_CORE_STAMP_H

#include <gslam/base/error.h>
#include <gslam/core/detail/stamp_text.h>

#include <cstddef>
#include <cstdint>
#include <string>

/// @file
/// Stamps as decimal text and back, exactly: no double stands between the two.

namespace gslam {
inline namespace v1 {

/// What stamps of a file count.
enum class StampUnit : std::uint8_t { nanoseconds, microseconds, milliseconds, seconds };

/// Its name, such as "seconds"; "unknown" for a number that is no unit.
inline const char* stampUnitName(StampUnit unit) noexcept {
  static const char* const kNames[] = {"nanoseconds", "microseconds", "milliseconds", "seconds"};
  const std::size_t i = static_cast<std::size_t>(unit);
  return i < 4 ? kNames[i] : "unknown";
}

/// A stamp as seconds with all nine decimals: `1305031098.665900000`, `-0.500000000`.
/// @param stamp  nanoseconds
inline std::string secondsText(std::int64_t stamp) {
  char text[detail::kStampRoom];
  return std::string(text, detail::printSeconds(stamp, text));
}

/// The stamp of a decimal number such as `1305031098.6659` or `1.044989e-01`, to the nanosecond. Of
/// more digits the nearest nanosecond is taken, and of two as near the even one.
/// @param text  the number and nothing else
/// @param unit  what it counts
/// @return nanoseconds
/// @throws ParseError when the text is no number, or more than 64 bits of nanoseconds can hold:
///   9223372036.854775807 s, in the year 2262
inline std::int64_t parseStamp(const std::string& text, StampUnit unit = StampUnit::seconds) {
  const char* const end = text.data() + text.size();
  const detail::ParsedStamp parsed =
      detail::parseStamp(text.data(), end, 3 * static_cast<int>(unit));
  if (parsed.status == detail::StampStatus::out_of_range) {
    throw ParseError("stamp", 0, 0,
                     detail::hugeStampText(text, stampUnitName(unit), 3 * int(unit)));
  }
  if (parsed.status != detail::StampStatus::ok || parsed.end != end) {
    throw ParseError("stamp", 0, 0,
                     detail::quotedText(text) + " is no number of " + stampUnitName(unit));
  }
  return parsed.value;
}

}  // namespace v1
}  // namespace gslam

#endif  // GSLAM_CORE_STAMP_H
