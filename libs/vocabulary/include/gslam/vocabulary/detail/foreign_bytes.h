// The bytes of a binary file from elsewhere, and how to say where they are wrong.
#ifndef GSLAM_VOCABULARY_DETAIL_FOREIGN_BYTES_H
#define GSLAM_VOCABULARY_DETAIL_FOREIGN_BYTES_H

#include <gslam/base/detail/little_endian.h>
#include <gslam/base/error.h>

#include <cstddef>
#include <cstdint>
#include <cstring>
#include <string>

namespace gslam {
inline namespace v1 {
namespace detail {

// All of these formats are what was in the memory of a little-endian machine.
class ForeignBytes {
 public:
  ForeignBytes(const std::uint8_t* data, std::size_t size, const std::string& source)
      : data_(data), size_(size), source_(&source) {}

  std::size_t size() const noexcept { return size_; }
  const std::string& source() const noexcept { return *source_; }
  const std::uint8_t* at(std::size_t offset) const noexcept { return data_ + offset; }

  [[noreturn]] void fail(std::size_t offset, const std::string& problem) const {
    throw ParseError(*source_, 0, 0, "byte " + std::to_string(offset) + ": " + problem);
  }

  // Whether so many parts of that size are behind the offset, however many they are.
  void need(std::size_t offset, std::uint64_t count, std::size_t size,
            const std::string& what) const {
    const std::size_t left = offset < size_ ? size_ - offset : 0;
    if (count <= left / size) return;
    fail(offset, "expected " + what + ", " + std::to_string(count) + " times " +
                     std::to_string(size) + " bytes, got " + std::to_string(left) +
                     " bytes up to the end of the file");
  }

  // @{
  // They must be there.
  std::uint32_t u32(std::size_t offset) const noexcept {
    return loadLittle<std::uint32_t>(data_ + offset);
  }
  std::uint64_t u64(std::size_t offset) const noexcept {
    return loadLittle<std::uint64_t>(data_ + offset);
  }
  double float32(std::size_t offset) const noexcept {
    const std::uint32_t bits = u32(offset);
    float value;
    std::memcpy(&value, &bits, sizeof(value));
    return static_cast<double>(value);
  }
  double float64(std::size_t offset) const noexcept {
    const std::uint64_t bits = u64(offset);
    double value;
    std::memcpy(&value, &bits, sizeof(value));
    return value;
  }
  // @}

  // Copies numbers of 1 or 4 bytes in the order of this machine.
  void copyNumbers(std::size_t offset, bool are_bytes, std::size_t size, std::uint8_t* to) const {
    if (are_bytes || kIsLittleEndian) {
      std::memcpy(to, data_ + offset, size);
      return;
    }
    for (std::size_t i = 0; i < size; i += 4) {
      const std::uint32_t bits = u32(offset + i);
      std::memcpy(to + i, &bits, 4);
    }
  }

 private:
  const std::uint8_t* data_;
  std::size_t size_;
  const std::string* source_;
};

}  // namespace detail
}  // namespace v1
}  // namespace gslam

#endif  // GSLAM_VOCABULARY_DETAIL_FOREIGN_BYTES_H
