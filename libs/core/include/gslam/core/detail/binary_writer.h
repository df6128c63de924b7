// Bytes, one number after the other.
#ifndef GSLAM_CORE_DETAIL_BINARY_WRITER_H
#define GSLAM_CORE_DETAIL_BINARY_WRITER_H

#include <gslam/base/detail/little_endian.h>
#include <gslam/base/error.h>

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <memory>
#include <string>
#include <utility>

namespace gslam {
inline namespace v1 {
namespace detail {

// Bytes that grow, with numbers in little-endian order.
class BinaryWriter {
 public:
  std::size_t size() const noexcept { return size_; }
  const std::uint8_t* data() const noexcept { return data_.get(); }
  void clear() noexcept { size_ = 0; }

  // Of an integer, float or double; the type says how many bytes.
  template <class Number>
  void number(Number value) {
    typename BitsOf<sizeof(Number)>::Type bits;
    std::memcpy(&bits, &value, sizeof(bits));
    storeLittle(grow(sizeof(bits)), bits);
  }
  template <class Number>
  void numbers(const Number* values, std::size_t count) {
    if (kIsLittleEndian || sizeof(Number) == 1) {
      bytes(values, count * sizeof(Number));
    } else {
      for (std::size_t i = 0; i < count; ++i) number(values[i]);
    }
  }

  void bytes(const void* values, std::size_t count) {
    if (count != 0) std::memcpy(grow(count), values, count);
  }

  // A count of elements.
  void count(std::size_t value) {
    if (value > 0xFFFFFFFF) throw Error("more than 4294967295 elements cannot be written");
    number(static_cast<std::uint32_t>(value));
  }

  // Its length and its bytes.
  void text(const std::string& value) {
    count(value.size());
    bytes(value.data(), value.size());
  }

  // Overwrites what was written at a place.
  template <class Number>
  void numberAt(std::size_t place, Number value) noexcept {
    typename BitsOf<sizeof(Number)>::Type bits;
    std::memcpy(&bits, &value, sizeof(bits));
    storeLittle(data_.get() + place, bits);
  }

  // Room for that many bytes, to be filled by the caller.
  std::uint8_t* grow(std::size_t count) {
    if (count > capacity_ - size_) reserve(count);
    std::uint8_t* const place = data_.get() + size_;
    size_ += count;
    return place;
  }

 private:
  void reserve(std::size_t more) {
    const std::size_t capacity = std::max(size_ + more, 2 * capacity_ + 1024);
    std::unique_ptr<std::uint8_t[]> data(new std::uint8_t[capacity]);
    if (size_ != 0) std::memcpy(data.get(), data_.get(), size_);
    data_ = std::move(data);
    capacity_ = capacity;
  }

  std::unique_ptr<std::uint8_t[]> data_;
  std::size_t size_ = 0;
  std::size_t capacity_ = 0;
};

}  // namespace detail
}  // namespace v1
}  // namespace gslam

#endif  // GSLAM_CORE_DETAIL_BINARY_WRITER_H
