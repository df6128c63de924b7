// Counts of bits by logic on words, against counts of each bit.
#include <gslam/vocabulary/detail/bit_counts.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <random>
#include <vector>

namespace {

using gslam::detail::addBitCounts;
using gslam::detail::bitsCountedAtLeast;
using gslam::detail::planesFor;
using gslam::detail::sumBitRows;

using Rows = std::vector<std::vector<std::uint8_t>>;

// Rows of so many words, of whose bits some are often set, and some always or never.
Rows randomRows(std::size_t count, std::size_t words, std::uint32_t seed) {
  std::mt19937 random(seed);
  Rows rows(count, std::vector<std::uint8_t>(words * 8));
  for (std::vector<std::uint8_t>& row : rows) {
    for (std::size_t i = 0; i < row.size(); ++i) {
      const std::uint_fast32_t noise = i % 3 == 0 ? random() : random() | random() | random();
      row[i] = static_cast<std::uint8_t>(i % 8 == 7 ? 0xF0 : noise);
    }
  }
  return rows;
}

std::vector<const std::uint8_t*> pointersTo(const Rows& rows) {
  std::vector<const std::uint8_t*> pointers;
  for (const std::vector<std::uint8_t>& row : rows) pointers.push_back(row.data());
  return pointers;
}

std::vector<std::uint64_t> planesOf(const Rows& rows, std::size_t words) {
  std::vector<std::uint64_t> planes(planesFor(rows.size()) * words + 1);
  sumBitRows(pointersTo(rows).data(), rows.size(), words, planes.data());
  return planes;
}

std::size_t countOf(const std::vector<std::uint64_t>& planes, std::uint32_t plane_count,
                    std::size_t words, std::size_t bit) {
  std::size_t count = 0;
  for (std::uint32_t p = 0; p < plane_count; ++p) {
    count |= ((planes[p * words + bit / 64] >> (bit % 64)) & 1) << p;
  }
  return count;
}

// Bit number `bit` of words in the order of this machine.
bool hasBit(const std::vector<std::uint8_t>& row, std::size_t bit) {
  std::uint64_t word;
  std::memcpy(&word, &row[bit / 64 * 8], 8);
  return ((word >> (bit % 64)) & 1) != 0;
}

TEST(bit_counts, planes_hold_the_count) {
  EXPECT_EQ(planesFor(0), 0u);
  EXPECT_EQ(planesFor(1), 1u);
  EXPECT_EQ(planesFor(2), 2u);
  EXPECT_EQ(planesFor(7), 3u);
  EXPECT_EQ(planesFor(8), 4u);
  EXPECT_EQ(planesFor(2048), 12u);
}

TEST(bit_counts, are_those_of_each_bit) {
  for (const std::size_t words : {1u, 2u, 3u, 4u, 5u, 8u}) {
    for (const std::size_t count :
         {0u, 1u, 2u, 7u, 8u, 9u, 15u, 16u, 17u, 63u, 64u, 100u, 1000u, 2048u}) {
      const Rows rows = randomRows(count, words, static_cast<std::uint32_t>(count + words));
      const std::vector<std::uint64_t> planes = planesOf(rows, words);
      for (std::size_t bit = 0; bit < words * 64; ++bit) {
        std::size_t expected = 0;
        for (const std::vector<std::uint8_t>& row : rows) expected += hasBit(row, bit) ? 1 : 0;
        ASSERT_EQ(countOf(planes, planesFor(count), words, bit), expected)
            << count << " rows of " << words << " words, bit " << bit;
      }
    }
  }
}

TEST(bit_counts, add_up) {
  const std::size_t words = 3;
  const Rows all = randomRows(300, words, 5);
  const std::uint32_t sum_planes = planesFor(all.size());
  std::vector<std::uint64_t> sums(sum_planes * words);
  for (std::size_t begin = 0, size = 1; begin < all.size(); begin += size, size += 7) {
    const std::size_t end = std::min(begin + size, all.size());
    const Rows part(all.begin() + static_cast<std::ptrdiff_t>(begin),
                    all.begin() + static_cast<std::ptrdiff_t>(end));
    addBitCounts(planesOf(part, words).data(), planesFor(part.size()), sums.data(), sum_planes,
                 words);
  }
  std::vector<std::uint64_t> expected = planesOf(all, words);
  expected.pop_back();
  EXPECT_EQ(sums, expected);
}

TEST(bit_counts, are_compared) {
  const std::size_t words = 2;
  for (const std::size_t count : {1u, 2u, 3u, 10u, 31u, 32u}) {
    const Rows rows = randomRows(count, words, static_cast<std::uint32_t>(count));
    const std::vector<std::uint64_t> planes = planesOf(rows, words);
    for (std::size_t least = 1; least <= count + 40; ++least) {
      std::uint64_t bits[words];
      bitsCountedAtLeast(planes.data(), planesFor(count), words, least, bits);
      for (std::size_t bit = 0; bit < words * 64; ++bit) {
        ASSERT_EQ((bits[bit / 64] >> (bit % 64)) & 1,
                  countOf(planes, planesFor(count), words, bit) >= least ? 1u : 0u)
            << count << " rows, bit " << bit << ", at least " << least;
      }
    }
  }
}

}  // namespace
