// The bytes of a file or of memory, piece by piece.
#ifndef GSLAM_CORE_DETAIL_BINARY_FILE_H
#define GSLAM_CORE_DETAIL_BINARY_FILE_H

#include <gslam/base/error.h>

#include <algorithm>
#include <cerrno>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <fstream>
#include <string>
#include <vector>

namespace gslam {
inline namespace v1 {
namespace detail {

// The bytes of a file, or of a block in memory, from the first to the last.
class ByteSource {
 public:
  explicit ByteSource(const std::string& path) : name_(path) {
    errno = 0;
    file_.open(path, std::ios::binary | std::ios::ate);
    if (!file_) throw FileError(path, "cannot be opened", errno);
    const std::streamoff size = file_.tellg();
    if (size < 0) throw FileError(path, "has no size: it is no ordinary file", errno);
    remaining_ = static_cast<std::uint64_t>(size);
    file_.seekg(0);
  }
  // The block must outlive it.
  ByteSource(const std::uint8_t* data, std::size_t size, const std::string& name)
      : name_(name), memory_(data), remaining_(size) {}

  const std::string& name() const noexcept { return name_; }
  std::uint64_t remaining() const noexcept { return remaining_; }
  std::uint64_t offset() const noexcept { return offset_; }

  // There must be as many.
  void read(std::uint8_t* bytes, std::size_t count) {
    if (memory_ != nullptr) {
      if (count != 0) std::memcpy(bytes, memory_ + offset_, count);
    } else {
      errno = 0;
      file_.read(reinterpret_cast<char*>(bytes), static_cast<std::streamsize>(count));
      if (file_.eof()) throw FileError(name_, "became shorter while it was read");
      if (!file_) throw FileError(name_, "cannot be read", errno);
    }
    offset_ += count;
    remaining_ -= count;
  }

 private:
  std::string name_;
  std::ifstream file_;
  const std::uint8_t* memory_ = nullptr;
  std::uint64_t remaining_ = 0;
  std::uint64_t offset_ = 0;
};

// All that is left. It grows as it is read: a folder, for one, has a size that means nothing.
inline std::vector<std::uint8_t> readAll(ByteSource& source) {
  std::vector<std::uint8_t> bytes;
  while (source.remaining() != 0) {
    const std::size_t before = bytes.size();
    const std::uint64_t step = std::max<std::uint64_t>(before, 1 << 20);
    bytes.resize(before + static_cast<std::size_t>(std::min(step, source.remaining())));
    source.read(bytes.data() + before, bytes.size() - before);
  }
  return bytes;
}

}  // namespace detail
}  // namespace v1
}  // namespace gslam

#endif  // GSLAM_CORE_DETAIL_BINARY_FILE_H
