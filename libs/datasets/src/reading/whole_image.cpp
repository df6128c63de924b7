#include "whole_image.h"

#include <algorithm>
#include <cstddef>
#include <cstring>

namespace gslam {
inline namespace v1 {
namespace reading {
namespace {

using Bytes = std::vector<std::uint8_t>;

const std::uint8_t kPng[] = {0x89, 'P', 'N', 'G', '\r', '\n', 0x1A, '\n'};
const std::uint8_t kJpeg[] = {0xFF, 0xD8};

template <std::size_t N>
bool beginsWith(const Bytes& bytes, const std::uint8_t (&mark)[N]) noexcept {
  return bytes.size() >= N && std::equal(mark, mark + N, bytes.begin());
}

// Chunks: length of the data, four letters, data, check sum.
bool isWholePng(const Bytes& bytes) noexcept {
  std::size_t at = sizeof(kPng);
  while (bytes.size() - at >= 12) {
    const std::uint8_t* const chunk = bytes.data() + at;
    const std::size_t length = std::size_t(chunk[0]) << 24 | std::size_t(chunk[1]) << 16 |
                               std::size_t(chunk[2]) << 8 | chunk[3];
    if (bytes.size() - at - 12 < length) return false;
    if (std::memcmp(chunk + 4, "IEND", 4) == 0) return true;
    at += 12 + length;
  }
  return false;
}

// Whether a marker stands alone, without a length: RST0 to RST7, SOI, TEM.
bool isLoneMarker(std::uint8_t marker) noexcept {
  return (marker >= 0xD0 && marker <= 0xD8) || marker == 0x01;
}

// Segments: FF, marker, length with itself. After a scan's header come its data, in which FF is
// followed by 0 or the number of a restart.
bool isWholeJpeg(const Bytes& bytes) noexcept {
  const std::uint8_t* at = bytes.data() + sizeof(kJpeg);
  const std::uint8_t* const end = bytes.data() + bytes.size();
  while (at < end) {
    const void* const mark = std::memchr(at, 0xFF, static_cast<std::size_t>(end - at));
    if (mark == nullptr) return false;
    at = static_cast<const std::uint8_t*>(mark) + 1;
    if (at == end) return false;
    const std::uint8_t marker = *at;
    if (marker == 0xFF) continue;  // filling
    ++at;
    if (marker == 0xD9) return true;
    if (marker == 0 || isLoneMarker(marker)) continue;
    if (end - at < 2) return false;
    const std::ptrdiff_t length = at[0] << 8 | at[1];
    if (end - at < length) return false;
    at += length;
  }
  return false;
}

}  // namespace

bool isWholeImage(const Bytes& bytes) noexcept {
  if (beginsWith(bytes, kPng)) return isWholePng(bytes);
  if (beginsWith(bytes, kJpeg)) return isWholeJpeg(bytes);
  return true;
}

}  // namespace reading
}  // namespace v1
}  // namespace gslam
