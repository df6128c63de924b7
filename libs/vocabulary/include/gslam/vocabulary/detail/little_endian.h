// Numbers as bytes, the least first, whatever the machine. (Names differ from those of core, which
// may be in the same program.)
#ifndef GSLAM_VOCABULARY_DETAIL_LITTLE_ENDIAN_H
#define GSLAM_VOCABULARY_DETAIL_LITTLE_ENDIAN_H

#include <cstddef>
#include <cstdint>
#include <cstring>

namespace gslam {
inline namespace v1 {
namespace detail {

// Whether memory is as files are, so that arrays may be copied, or read where they lie.
#if defined(__BYTE_ORDER__) && __BYTE_ORDER__ == __ORDER_BIG_ENDIAN__
constexpr bool kMemoryIsLittleEndian = false;
#else
constexpr bool kMemoryIsLittleEndian = true;
#endif

// Of numbers of any type but bool. Compilers make one instruction of the loops where they can.
template <class Number>
Number readLittleEndian(const std::uint8_t* bytes) noexcept {
  std::uint8_t ordered[sizeof(Number)];
  for (std::size_t i = 0; i < sizeof(Number); ++i) {
    ordered[i] = bytes[kMemoryIsLittleEndian ? i : sizeof(Number) - 1 - i];
  }
  Number value;
  std::memcpy(&value, ordered, sizeof(value));
  return value;
}

template <class Number>
void writeLittleEndian(std::uint8_t* bytes, Number value) noexcept {
  std::uint8_t ordered[sizeof(Number)];
  std::memcpy(ordered, &value, sizeof(value));
  for (std::size_t i = 0; i < sizeof(Number); ++i) {
    bytes[i] = ordered[kMemoryIsLittleEndian ? i : sizeof(Number) - 1 - i];
  }
}

}  // namespace detail
}  // namespace v1
}  // namespace gslam

#endif  // GSLAM_VOCABULARY_DETAIL_LITTLE_ENDIAN_H
