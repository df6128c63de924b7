// XXH64: 64 bits that tell damaged data from whole.
#ifndef GSLAM_BASE_DETAIL_CHECKSUM_H
#define GSLAM_BASE_DETAIL_CHECKSUM_H

#include <gslam/base/detail/little_endian.h>

#include <cstddef>
#include <cstdint>
#include <initializer_list>

namespace gslam {
inline namespace v1 {
namespace detail {

// Source: Y. Collet, "xxHash fast digest algorithm", specification of XXH64, 2023. Chosen because
// it is faster than memory and found in every language; it is no protection against forgery.
class Xxh64 {
 public:
  // Of all bytes at once, with seed 0.
  static std::uint64_t of(const std::uint8_t* data, std::size_t size) noexcept {
    const std::uint8_t* const end = data + size;
    std::uint64_t hash = k5;
    if (size >= 32) hash = stripes(data, size / 32);
    data += size / 32 * 32;
    hash += size;
    for (; end - data >= 8; data += 8) {
      hash = turned(hash ^ round(0, loadLittle<std::uint64_t>(data)), 27) * k1 + k4;
    }
    if (end - data >= 4) {
      hash = turned(hash ^ (loadLittle<std::uint32_t>(data) * k1), 23) * k2 + k3;
      data += 4;
    }
    for (; data != end; ++data) hash = turned(hash ^ (*data * k5), 11) * k1;
    hash = (hash ^ (hash >> 33)) * k2;
    hash = (hash ^ (hash >> 29)) * k3;
    return hash ^ (hash >> 32);
  }

 private:
  static constexpr std::uint64_t k1 = 0x9E3779B185EBCA87u;
  static constexpr std::uint64_t k2 = 0xC2B2AE3D27D4EB4Fu;
  static constexpr std::uint64_t k3 = 0x165667B19E3779F9u;
  static constexpr std::uint64_t k4 = 0x85EBCA77C2B2AE63u;
  static constexpr std::uint64_t k5 = 0x27D4EB2F165667C5u;

  static std::uint64_t turned(std::uint64_t x, int bits) noexcept {
    return (x << bits) | (x >> (64 - bits));
  }
  static std::uint64_t round(std::uint64_t lane, std::uint64_t input) noexcept {
    return turned(lane + input * k2, 31) * k1;
  }

  // Four lanes that do not wait for each other.
  static std::uint64_t stripes(const std::uint8_t* data, std::size_t count) noexcept {
    std::uint64_t a = k1 + k2, b = k2, c = 0, d = 0 - k1;
    for (; count != 0; --count, data += 32) {
      a = round(a, loadLittle<std::uint64_t>(data));
      b = round(b, loadLittle<std::uint64_t>(data + 8));
      c = round(c, loadLittle<std::uint64_t>(data + 16));
      d = round(d, loadLittle<std::uint64_t>(data + 24));
    }
    std::uint64_t hash = turned(a, 1) + turned(b, 7) + turned(c, 12) + turned(d, 18);
    for (const std::uint64_t lane : {a, b, c, d}) hash = (hash ^ round(0, lane)) * k1 + k4;
    return hash;
  }
};

}  // namespace detail
}  // namespace v1
}  // namespace gslam

#endif  // GSLAM_BASE_DETAIL_CHECKSUM_H
