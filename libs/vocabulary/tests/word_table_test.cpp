// The table of words of a database.
#include <gslam/vocabulary/detail/word_table.h>
#include <gtest/gtest.h>

#include <cstddef>
#include <cstdint>
#include <set>
#include <vector>

namespace {

using gslam::detail::WordTable;

// Where words begin to look for their slots, from where the first of them does.
std::vector<std::ptrdiff_t> placesOf(const WordTable& table,
                                     const std::vector<std::uint32_t>& words) {
  const auto* const first = static_cast<const char*>(table.firstSlot(words[0]));
  std::vector<std::ptrdiff_t> places;
  for (const std::uint32_t word : words) {
    places.push_back(static_cast<const char*>(table.firstSlot(word)) - first);
  }
  return places;
}

// Words whose products with a factor have no high bits: one slot of 2^13 where it is known.
std::vector<std::uint32_t> wordsThatCollide(std::uint64_t factor) {
  std::vector<std::uint32_t> words;
  for (std::uint32_t word = 0; words.size() < 2000; ++word) {
    if (word * factor >> 51 == 0) words.push_back(word);
  }
  return words;
}

TEST(word_table, spreads_words_that_were_made_to_collide) {
  for (const std::uint64_t factor :
       {std::uint64_t(0x9E3779B97F4A7C15u), std::uint64_t(0xBF58476D1CE4E5B9u), std::uint64_t(1)}) {
    const std::vector<std::uint32_t> words = wordsThatCollide(factor);
    const WordTable table(60000);
    const std::vector<std::ptrdiff_t> places = placesOf(table, words);
    EXPECT_GT(std::set<std::ptrdiff_t>(places.begin(), places.end()).size(), 1900u);
  }
}

TEST(word_table, has_an_order_of_its_own) {
  std::vector<std::uint32_t> words;
  for (std::uint32_t word = 0; word < 100; ++word) words.push_back(word);
  const WordTable first(1000), second(1000);
  EXPECT_NE(placesOf(first, words), placesOf(second, words));
}

TEST(word_table, finds_words_when_it_is_full) {
  WordTable table(0);
  std::uint32_t count = 0;
  for (; table.hasRoomFor(1); ++count) table.add(3 * count, count, count + 0.5);
  EXPECT_EQ(table.used(), count);
  EXPECT_EQ(count, 640u);
  const WordTable larger(table, 10 * count);
  for (std::uint32_t i = 0; i < count; ++i) {
    double value = 0;
    EXPECT_EQ(table.find(3 * i, value), gslam::detail::WordSlot::kOneEntry | i);
    EXPECT_EQ(value, i + 0.5);
    EXPECT_EQ(larger.find(3 * i, value = 0), gslam::detail::WordSlot::kOneEntry | i);
    EXPECT_EQ(value, i + 0.5);
    EXPECT_EQ(table.find(3 * i + 1, value), 0u);
    EXPECT_EQ(larger.find(3 * i + 1, value), 0u);
  }
}

}  // namespace
