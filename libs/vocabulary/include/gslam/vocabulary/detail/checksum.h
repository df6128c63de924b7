// XXH64: 64 bits that tell damaged data from whole.
#ifndef GSLAM_VOCABULARY_DETAIL_CHECKSUM_H
#define GSLAM_VOCABULARY_DETAIL_CHECKSUM_H

#include <gslam/vocabulary/detail/little_endian.h>

#include <cstddef>
#include <cstdint>

namespace gslam {
inline namespace v1 {
namespace detail {

// Source: Y. Collet, "xxHash fast digest algorithm", specification of XXH64, 2023.
constexpr std::uint64_t kXxhPrime1 = 0x9E3779B185EBCA87u;
constexpr std::uint64_t kXxhPrime2 = 0xC2B2AE3D27D4EB4Fu;
constexpr std::uint64_t kXxhPrime3 = 0x165667B19E3779F9u;
constexpr std::uint64_t kXxhPrime4 = 0x85EBCA77C2B2AE63u;
constexpr std::uint64_t kXxhPrime5 = 0x27D4EB2F165667C5u;

inline std::uint64_t xxhTurned(std::uint64_t x, int bits) noexcept {
  return (x << bits) | (x >> (64 - bits));
}
inline std::uint64_t xxhRound(std::uint64_t lane, std::uint64_t input) noexcept {
  return xxhTurned(lane + input * kXxhPrime2, 31) * kXxhPrime1;
}

// Whole pieces of 32 bytes: four lanes that do not wait for each other.
inline std::uint64_t xxhStripes(const std::uint8_t* data, std::size_t count) noexcept {
  std::uint64_t lanes[4] = {kXxhPrime1 + kXxhPrime2, kXxhPrime2, 0, 0 - kXxhPrime1};
  for (; count != 0; --count, data += 32) {
    for (std::size_t i = 0; i < 4; ++i) {
      lanes[i] = xxhRound(lanes[i], readLittleEndian<std::uint64_t>(data + 8 * i));
    }
  }
  std::uint64_t hash = xxhTurned(lanes[0], 1) + xxhTurned(lanes[1], 7) + xxhTurned(lanes[2], 12) +
                       xxhTurned(lanes[3], 18);
  for (const std::uint64_t lane : lanes) {
    hash = (hash ^ xxhRound(0, lane)) * kXxhPrime1 + kXxhPrime4;
  }
  return hash;
}

// With seed 0. No protection against forgery.
inline std::uint64_t checksum64(const std::uint8_t* data, std::size_t size) noexcept {
  std::uint64_t hash = size >= 32 ? xxhStripes(data, size / 32) : kXxhPrime5;
  hash += size;
  std::size_t rest = size % 32;
  if (size != 0) data += size - rest;
  for (; rest >= 8; rest -= 8, data += 8) {
    const std::uint64_t input = xxhRound(0, readLittleEndian<std::uint64_t>(data));
    hash = xxhTurned(hash ^ input, 27) * kXxhPrime1 + kXxhPrime4;
  }
  if (rest >= 4) {
    const std::uint64_t input = readLittleEndian<std::uint32_t>(data) * kXxhPrime1;
    hash = xxhTurned(hash ^ input, 23) * kXxhPrime2 + kXxhPrime3;
    rest -= 4;
    data += 4;
  }
  for (; rest != 0; --rest, ++data) {
    hash = xxhTurned(hash ^ (*data * kXxhPrime5), 11) * kXxhPrime1;
  }
  hash = (hash ^ (hash >> 33)) * kXxhPrime2;
  hash = (hash ^ (hash >> 29)) * kXxhPrime3;
  return hash ^ (hash >> 32);
}

}  // namespace detail
}  // namespace v1
}  // namespace gslam

#endif  // GSLAM_VOCABULARY_DETAIL_CHECKSUM_H
