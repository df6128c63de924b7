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
constexpr std::uint8_t kJpegEnd = 0xD9;

template <std::size_t N>
bool beginsWith(const Bytes& bytes, const std::uint8_t (&mark)[N]) noexcept {
  return bytes.size() >= N && std::equal(mark, mark + N, bytes.begin());
}

std::uint32_t bigEndian(const std::uint8_t* bytes) noexcept {
  return std::uint32_t(bytes[0]) << 24 | std::uint32_t(bytes[1]) << 16 |
         std::uint32_t(bytes[2]) << 8 | bytes[3];
}

// Chunks: length of the data, four letters, data, check sum.
bool isWholePng(const Bytes& bytes) noexcept {
  std::size_t at = sizeof(kPng);
  while (bytes.size() - at >= 12) {
    const std::uint8_t* const chunk = bytes.data() + at;
    const std::size_t length = bigEndian(chunk);
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

// Goes through the segments of a JPEG file: FF, marker, length with itself. After a scan's header
// come its data, in which FF is followed by 0 or the number of a restart.
class Segments {
 public:
  explicit Segments(const Bytes& bytes) noexcept
      : at_(bytes.data() + sizeof(kJpeg)), end_(bytes.data() + bytes.size()) {}

  /// The marker of the next segment; 0 where the file ends before.
  std::uint8_t next() noexcept {
    while (at_ < end_) {
      const void* const mark = std::memchr(at_, 0xFF, static_cast<std::size_t>(end_ - at_));
      if (mark == nullptr) return 0;
      at_ = static_cast<const std::uint8_t*>(mark) + 1;
      if (at_ == end_) return 0;
      const std::uint8_t marker = *at_;
      if (marker == 0xFF) continue;  // filling
      ++at_;
      if (marker == kJpegEnd) return marker;
      if (marker != 0 && !isLoneMarker(marker)) return takeBody() ? marker : std::uint8_t(0);
    }
    return 0;
  }
  const std::uint8_t* body() const noexcept { return body_; }  ///< behind the length
  std::ptrdiff_t size() const noexcept { return at_ - body_; }

 private:
  bool takeBody() noexcept {
    if (end_ - at_ < 2) return false;
    const std::ptrdiff_t length = at_[0] << 8 | at_[1];
    if (length < 2 || end_ - at_ < length) return false;
    body_ = at_ + 2;
    at_ += length;
    return true;
  }

  const std::uint8_t* at_;
  const std::uint8_t* end_;
  const std::uint8_t* body_ = nullptr;
};

bool isWholeJpeg(const Bytes& bytes) noexcept {
  Segments segments(bytes);
  std::uint8_t marker = segments.next();
  while (marker != 0 && marker != kJpegEnd) marker = segments.next();
  return marker == kJpegEnd;
}

// SOF0 to SOF15, without DHT, JPG and DAC: precision, height, width.
bool readJpegSize(const Bytes& bytes, std::uint32_t& width, std::uint32_t& height) noexcept {
  Segments segments(bytes);
  for (std::uint8_t marker = segments.next(); marker != 0; marker = segments.next()) {
    const bool is_frame =
        marker >= 0xC0 && marker <= 0xCF && marker != 0xC4 && marker != 0xC8 && marker != 0xCC;
    if (!is_frame) continue;
    if (segments.size() < 5) return false;
    const std::uint8_t* const body = segments.body();
    height = std::uint32_t(body[1]) << 8 | body[2];
    width = std::uint32_t(body[3]) << 8 | body[4];
    return true;
  }
  return false;
}

}  // namespace

bool isWholeImage(const Bytes& bytes) noexcept {
  if (beginsWith(bytes, kPng)) return isWholePng(bytes);
  if (beginsWith(bytes, kJpeg)) return isWholeJpeg(bytes);
  return true;
}

bool readImageSize(const Bytes& bytes, std::uint32_t& width, std::uint32_t& height) noexcept {
  if (beginsWith(bytes, kJpeg)) return readJpegSize(bytes, width, height);
  const std::size_t first_chunk = sizeof(kPng) + 8;
  if (!beginsWith(bytes, kPng) || bytes.size() < first_chunk + 8) return false;
  width = bigEndian(bytes.data() + first_chunk);
  height = bigEndian(bytes.data() + first_chunk + 4);
  return true;
}

}  // namespace reading
}  // namespace v1
}  // namespace gslam
