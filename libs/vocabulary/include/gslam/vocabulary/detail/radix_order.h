// Keys in ascending order with the index of each, in time that grows with their number.
#ifndef GSLAM_VOCABULARY_DETAIL_RADIX_ORDER_H
#define GSLAM_VOCABULARY_DETAIL_RADIX_ORDER_H

#include <cstddef>
#include <cstdint>
#include <utility>
#include <vector>

namespace gslam {
inline namespace v1 {
namespace detail {

// A key above, an index below.
inline std::uint64_t keyed(std::uint32_t key, std::uint32_t index) noexcept {
  return (std::uint64_t(key) << 32) | index;
}
inline std::uint32_t keyOf(std::uint64_t item) noexcept {
  return static_cast<std::uint32_t>(item >> 32);
}
inline std::uint32_t indexOf(std::uint64_t item) noexcept {
  return static_cast<std::uint32_t>(item);
}

// Sorts by key; equal keys keep their order. Keys are below 2^bits. Radix sort from the lowest
// digit (D. Knuth, "The Art of Computer Programming" 3, 5.2.5), with two digits for up to 22 bits.
inline void orderByKey(std::vector<std::uint64_t>& items, std::vector<std::uint64_t>& spare,
                       unsigned bits) {
  const unsigned passes = bits <= 11 ? 1 : bits <= 22 ? 2 : 3;
  const unsigned digit_bits = (bits + passes - 1) / passes;
  const std::size_t digits = std::size_t(1) << digit_bits;
  std::uint32_t begins[2048];
  spare.resize(items.size());
  for (unsigned pass = 0; pass < passes; ++pass) {
    const unsigned shift = 32 + pass * digit_bits;
    for (std::size_t i = 0; i < digits; ++i) begins[i] = 0;
    for (const std::uint64_t item : items) ++begins[(item >> shift) & (digits - 1)];
    std::uint32_t begin = 0;
    for (std::size_t i = 0; i < digits; ++i) {
      const std::uint32_t count = begins[i];
      begins[i] = begin;
      begin += count;
    }
    for (const std::uint64_t item : items) spare[begins[(item >> shift) & (digits - 1)]++] = item;
    items.swap(spare);
  }
}

// Bits of numbers below `end`.
inline unsigned bitsBelow(std::uint32_t end) noexcept {
  unsigned bits = 1;
  while (bits < 32 && (end - 1) >> bits != 0) ++bits;
  return bits;
}

}  // namespace detail
}  // namespace v1
}  // namespace gslam

#endif  // GSLAM_VOCABULARY_DETAIL_RADIX_ORDER_H
