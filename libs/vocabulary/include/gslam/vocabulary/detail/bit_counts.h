// How many rows have each bit, without looking at any bit alone.
#ifndef GSLAM_VOCABULARY_DETAIL_BIT_COUNTS_H
#define GSLAM_VOCABULARY_DETAIL_BIT_COUNTS_H

#include <gslam/base/platform.h>

#include <cstddef>
#include <cstdint>
#include <cstring>

namespace gslam {
inline namespace v1 {
namespace detail {

// Counts are bit-sliced: plane p, a row of `words` 64-bit words, has bit p of the counts of all
// bits. So they are added and compared by logic on whole words: W. Mula, N. Kurz, D. Lemire,
// "Faster Population Counts Using AVX2 Instructions", The Computer Journal 2018, after Harley and
// Seal, there for the count of one word.

// Planes that hold counts up to `count`.
inline std::uint32_t planesFor(std::size_t count) noexcept {
  std::uint32_t planes = 0;
  for (; count != 0; count >>= 1) ++planes;
  return planes;
}

#if GSLAM_HAS_VECTORS
using BitBlock = std::uint64_t __attribute__((vector_size(16)));
#else
using BitBlock = std::uint64_t;
#endif

template <class Block>
Block loadBlock(const std::uint8_t* from) noexcept {
  Block block;
  std::memcpy(&block, from, sizeof block);
  return block;
}

// sum and carry of three bits, in each place
template <class Block>
void addThree(Block& carry, Block& sum, Block a, Block b) noexcept {
  const Block odd = sum ^ a;
  carry = (sum & a) | (odd & b);
  sum = odd ^ b;
}

// Writes the counts of one block of the rows rows[0] to rows[count - 1], from `offset` words on.
// There are planesFor(count) planes, `words` words apart; at most 32.
template <class Block>
void countBlock(const std::uint8_t* const* rows, std::size_t count, std::size_t offset,
                std::uint64_t* planes, std::size_t words) noexcept {
  Block counts[32] = {};
  const std::uint32_t plane_count = planesFor(count);
  std::size_t i = 0;
  for (; i + 8 <= count; i += 8) {
    const auto row = [&](std::size_t k) { return loadBlock<Block>(rows[i + k] + offset * 8); };
    Block twos[2], fours[2], carry;
    addThree(twos[0], counts[0], row(0), row(1));
    addThree(twos[1], counts[0], row(2), row(3));
    addThree(fours[0], counts[1], twos[0], twos[1]);
    addThree(twos[0], counts[0], row(4), row(5));
    addThree(twos[1], counts[0], row(6), row(7));
    addThree(fours[1], counts[1], twos[0], twos[1]);
    addThree(carry, counts[2], fours[0], fours[1]);
    for (std::uint32_t p = 3; p < plane_count; ++p) {
      const Block next = counts[p] & carry;
      counts[p] ^= carry;
      carry = next;
    }
  }
  for (; i < count; ++i) {
    Block carry = loadBlock<Block>(rows[i] + offset * 8);
    for (std::uint32_t p = 0; p < plane_count; ++p) {
      const Block next = counts[p] & carry;
      counts[p] ^= carry;
      carry = next;
    }
  }
  for (std::uint32_t p = 0; p < plane_count; ++p) {
    std::memcpy(planes + p * words + offset, &counts[p], sizeof(Block));
  }
}

// Writes planesFor(count) planes of the counts of rows of `words` words; count is under 2^32.
inline void sumBitRows(const std::uint8_t* const* rows, std::size_t count, std::size_t words,
                       std::uint64_t* planes) noexcept {
  constexpr std::size_t kBlockWords = sizeof(BitBlock) / sizeof(std::uint64_t);
  std::size_t offset = 0;
  for (; offset + kBlockWords <= words; offset += kBlockWords) {
    countBlock<BitBlock>(rows, count, offset, planes, words);
  }
  for (; offset < words; ++offset) {
    countBlock<std::uint64_t>(rows, count, offset, planes, words);
  }
}

// Adds the counts of `planes`, `plane_count` of them, to those of `sums`, which has as many planes
// as its counts need then.
inline void addBitCounts(const std::uint64_t* planes, std::uint32_t plane_count,
                         std::uint64_t* sums, std::uint32_t sum_planes,
                         std::size_t words) noexcept {
  for (std::size_t w = 0; w < words; ++w) {
    std::uint64_t carry = 0;
    for (std::uint32_t p = 0; p < sum_planes; ++p) {
      std::uint64_t& sum = sums[p * words + w];
      std::uint64_t next = carry;
      addThree(next, sum, p < plane_count ? planes[p * words + w] : 0, carry);
      carry = next;
    }
  }
}

// Sets the bits whose count is `least` or more.
inline void bitsCountedAtLeast(const std::uint64_t* planes, std::uint32_t plane_count,
                               std::size_t words, std::size_t least, std::uint64_t* bits) noexcept {
  for (std::size_t w = 0; w < words; ++w) {
    std::uint64_t is_less = 0;  // from the lowest plane up: the highest that differs decides
    for (std::uint32_t p = 0; p < plane_count; ++p) {
      const std::uint64_t plane = planes[p * words + w];
      is_less = ((least >> p) & 1) != 0 ? ~plane | is_less : ~plane & is_less;
    }
    bits[w] = (least >> plane_count) != 0 ? 0 : ~is_less;
  }
}

}  // namespace detail
}  // namespace v1
}  // namespace gslam

#endif  // GSLAM_VOCABULARY_DETAIL_BIT_COUNTS_H
