// Numbers out of bytes that may be wrong.
#ifndef GSLAM_CORE_DETAIL_BINARY_READER_H
#define GSLAM_CORE_DETAIL_BINARY_READER_H

#include <gslam/base/detail/little_endian.h>
#include <gslam/base/error.h>

#include <cstddef>
#include <cstdint>
#include <cstring>
#include <string>

namespace gslam {
inline namespace v1 {
namespace detail {

// Reads what BinaryWriter wrote. The bytes must outlive it. Nothing is believed: what goes beyond
// the end throws ParseError, and so does a count of more elements than there are bytes for.
class BinaryReader {
 public:
  // `source` and `offset` are for errors: the file, and where in it the bytes begin.
  BinaryReader(const std::uint8_t* data, std::size_t size, const std::string& source,
               std::uint64_t offset = 0)
      : begin_(data), place_(data), end_(data + size), source_(source), offset_(offset) {}

  std::size_t remaining() const noexcept { return static_cast<std::size_t>(end_ - place_); }

  // Of an integer, float or double; the type says how many bytes.
  template <class Number>
  Number number() {
    const auto bits = loadLittle<typename BitsOf<sizeof(Number)>::Type>(take(sizeof(Number)));
    Number value;
    std::memcpy(&value, &bits, sizeof(value));
    return value;
  }
  template <class Number>
  void numbers(Number* values, std::size_t count) {
    if (count > remaining() / sizeof(Number)) fail("ends too early");
    if (kIsLittleEndian || sizeof(Number) == 1) {
      bytes(values, count * sizeof(Number));
    } else {
      for (std::size_t i = 0; i < count; ++i) values[i] = number<Number>();
    }
  }

  void bytes(void* values, std::size_t count) {
    const std::uint8_t* const from = take(count);
    if (count != 0) std::memcpy(values, from, count);
  }

  // Of elements that take `element_size` bytes at least, each: so many there are bytes for.
  std::size_t count(std::size_t element_size) {
    const std::size_t value = number<std::uint32_t>();
    if (value > remaining() / element_size) {
      fail("has a count of " + std::to_string(value) + " with " + std::to_string(remaining()) +
           " bytes left");
    }
    return value;
  }

  std::string text() {
    const std::size_t size = count(1);
    return std::string(reinterpret_cast<const char*>(take(size)), size);
  }

  // A number below `end`, such as that of an enumeration.
  std::uint8_t choice(std::uint8_t end, const char* what) {
    const std::uint8_t value = number<std::uint8_t>();
    if (value < end) return value;
    fail(std::string("has the ") + what + " " + std::to_string(value) + ", expected 0 to " +
         std::to_string(end - 1));
  }

  // For what is of no use yet.
  void zeros(std::size_t count) {
    for (std::size_t i = 0; i < count; ++i) choice(1, "reserved byte");
  }

  void end() const {
    if (remaining() != 0) fail("has " + std::to_string(remaining()) + " bytes too many");
  }

  // The bytes themselves.
  const std::uint8_t* take(std::size_t count) {
    if (count > remaining()) fail("ends too early");
    const std::uint8_t* const taken = place_;
    place_ += count;
    return taken;
  }

  // Says where.
  [[noreturn]] void fail(const std::string& problem) const {
    const std::uint64_t place = offset_ + static_cast<std::uint64_t>(place_ - begin_);
    throw ParseError(source_, 0, 0, "byte " + std::to_string(place) + ": " + problem);
  }

 private:
  const std::uint8_t* begin_;
  const std::uint8_t* place_;
  const std::uint8_t* end_;
  std::string source_;
  std::uint64_t offset_;
};

}  // namespace detail
}  // namespace v1
}  // namespace gslam

#endif  // GSLAM_CORE_DETAIL_BINARY_READER_H
