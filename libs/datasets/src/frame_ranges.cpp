#include <gslam/base/error.h>
#include <gslam/datasets/frame_ranges.h>

#include <algorithm>
#include <cstddef>

namespace gslam {
inline namespace v1 {
namespace {

constexpr std::size_t kMostDigits = 9;  // so that it is an int

int frameOf(const std::string& digits, const std::string& part) {
  if (digits.empty() || digits.size() > kMostDigits ||
      digits.find_first_not_of("0123456789") != std::string::npos) {
    throw ArgumentError("frames \"" + part + "\"",
                        "are no range, expected one such as 100-119, or a number");
  }
  return std::stoi(digits);
}

FrameRange rangeOf(const std::string& part) {
  const std::size_t dash = part.find('-');
  const int first = frameOf(part.substr(0, dash), part);
  const int last = dash == std::string::npos ? first : frameOf(part.substr(dash + 1), part);
  if (last < first) throw ArgumentError("frames \"" + part + "\"", "end before they begin");
  return {first, last};
}

}  // namespace

bool FrameRanges::contains(int frame) const noexcept {
  for (const FrameRange& range : ranges) {
    if (frame >= range.first && frame <= range.last) return true;
  }
  return false;
}

std::string FrameRanges::text() const {
  std::string text;
  for (const FrameRange& range : ranges) {
    text += (text.empty() ? "" : ",") + std::to_string(range.first);
    if (range.last != range.first) text += "-" + std::to_string(range.last);
  }
  return text;
}

FrameRanges FrameRanges::fromText(const std::string& text) {
  FrameRanges result;
  std::size_t begin = 0;
  while (begin < text.size()) {
    const std::size_t comma = std::min(text.find(',', begin), text.size());
    result.ranges.push_back(rangeOf(text.substr(begin, comma - begin)));
    begin = comma + 1;
    if (begin == text.size()) rangeOf("");  // a comma at the end
  }
  return result;
}

}  // namespace v1
}  // namespace gslam
