// Numbers as bytes, the least first, whatever the machine.
#ifndef GSLAM_BASE_DETAIL_LITTLE_ENDIAN_H
#define GSLAM_BASE_DETAIL_LITTLE_ENDIAN_H

#include <cstddef>
#include <cstdint>
#include <cstring>
#include <type_traits>

namespace gslam {
inline namespace v1 {
namespace detail {

// Whether memory is as files are, so that arrays may be copied.
#if defined(__BYTE_ORDER__) && __BYTE_ORDER__ == __ORDER_BIG_ENDIAN__
constexpr bool kIsLittleEndian = false;
#else
constexpr bool kIsLittleEndian = true;
#endif

// Compilers make one instruction of these loops where they can.
template <class Unsigned>
Unsigned loadLittle(const std::uint8_t* bytes) noexcept {
  static_assert(std::is_unsigned<Unsigned>::value, "signs are for who knows what the bits mean");
  Unsigned value = 0;
  if (kIsLittleEndian) {
    std::memcpy(&value, bytes, sizeof(value));
  } else {
    for (std::size_t i = 0; i < sizeof(value); ++i) {
      value = static_cast<Unsigned>(value | (static_cast<Unsigned>(bytes[i]) << (8 * i)));
    }
  }
  return value;
}

template <class Unsigned>
void storeLittle(std::uint8_t* bytes, Unsigned value) noexcept {
  static_assert(std::is_unsigned<Unsigned>::value, "signs are for who knows what the bits mean");
  if (kIsLittleEndian) {
    std::memcpy(bytes, &value, sizeof(value));
  } else {
    for (std::size_t i = 0; i < sizeof(value); ++i) {
      bytes[i] = static_cast<std::uint8_t>(value >> (8 * i));
    }
  }
}

// The unsigned integer with the same bits.
template <std::size_t size>
struct BitsOf;
template <>
struct BitsOf<1> {
  using Type = std::uint8_t;
};
template <>
struct BitsOf<2> {
  using Type = std::uint16_t;
};
template <>
struct BitsOf<4> {
  using Type = std::uint32_t;
};
template <>
struct BitsOf<8> {
  using Type = std::uint64_t;
};

}  // namespace detail
}  // namespace v1
}  // namespace gslam

#endif  // GSLAM_BASE_DETAIL_LITTLE_ENDIAN_H
