// Little-endian numbers and text from bytes in memory, with the place in every error.
#ifndef GSLAM_DATASETS_ROS_SRC_BYTES_BYTE_READER_H
#define GSLAM_DATASETS_ROS_SRC_BYTES_BYTE_READER_H

#include <gslam/base/error.h>
#include <gslam/base/span.h>

#include <cstddef>
#include <cstdint>
#include <string>

namespace gslam {
inline namespace v1 {
namespace ros {

using Bytes = Span<const std::uint8_t>;

/// Goes through bytes from first to last. `name` must outlive it.
class ByteReader {
 public:
  /// @param name    of the file for errors
  /// @param offset  of the first byte in it
  ByteReader(Bytes bytes, const std::string& name, std::uint64_t offset)
      : bytes_(bytes), name_(name), offset_(offset) {}

  std::size_t left() const noexcept { return bytes_.size() - at_; }
  std::size_t at() const noexcept { return at_; }
  std::uint64_t offset() const noexcept { return offset_ + at_; }
  const std::string& name() const noexcept { return name_; }

  /// @throws FileError "name: at byte N: problem"
  [[noreturn]] void fail(const std::string& problem) const {
    throw FileError(name_, "at byte " + std::to_string(offset()) + ": " + problem);
  }

  /// The next bytes. @throws FileError when there are not so many
  Bytes bytes(std::uint64_t size, const char* what) {
    if (size > left()) {
      fail(std::string(what) + " should have " + std::to_string(size) + " bytes, but there are " +
           std::to_string(left()) + " left");
    }
    const Bytes result(bytes_.data() + at_, static_cast<std::size_t>(size));
    at_ += static_cast<std::size_t>(size);
    return result;
  }

  /// A number, least byte first.
  template <class T>
  T number(const char* what) {
    const Bytes raw = bytes(sizeof(T), what);
    std::uint64_t value = 0;
    for (std::size_t i = sizeof(T); i-- > 0;) value = value << 8 | raw[i];
    return static_cast<T>(value);
  }

  /// Text with its length, four bytes, before it.
  std::string text(const char* what) { return textOf(block(what)); }
  /// Bytes with their number, four bytes, before them.
  Bytes block(const char* what) {
    const std::uint32_t size = number<std::uint32_t>(what);
    return bytes(size, what);
  }

  static std::string textOf(Bytes raw) {
    if (raw.size() == 0) return "";
    return std::string(reinterpret_cast<const char*>(raw.data()), raw.size());
  }

 private:
  Bytes bytes_;
  const std::string& name_;
  std::uint64_t offset_;
  std::size_t at_ = 0;
};

}  // namespace ros
}  // namespace v1
}  // namespace gslam

#endif  // GSLAM_DATASETS_ROS_SRC_BYTES_BYTE_READER_H
