// Random numbers of the training.
#include <gslam/vocabulary/detail/random.h>
#include <gtest/gtest.h>

#include <cstdint>
#include <set>

namespace {

using gslam::detail::childSeed;
using gslam::detail::SplitMix64;

// The first numbers of the generator by Sebastiano Vigna, splitmix64.c, for the seed 1234567.
TEST(random, is_splitmix64) {
  SplitMix64 random(1234567);
  EXPECT_EQ(random.next(), 6457827717110365317u);
  EXPECT_EQ(random.next(), 3203168211198807973u);
  EXPECT_EQ(random.next(), 9817491932198370423u);
  EXPECT_EQ(random.next(), 4593380528125082431u);
  EXPECT_EQ(random.next(), 16408922859458223821u);
}

TEST(random, units_are_even_and_below_one) {
  SplitMix64 random(1);
  double sum = 0;
  for (int i = 0; i < 10000; ++i) {
    const double unit = random.unit();
    ASSERT_GE(unit, 0);
    ASSERT_LT(unit, 1);
    sum += unit;
  }
  EXPECT_NEAR(sum / 10000, 0.5, 0.015);  // 5 sigma
}

TEST(random, numbers_are_below_the_count) {
  SplitMix64 random(1);
  std::set<std::uint64_t> seen;
  for (int i = 0; i < 1000; ++i) seen.insert(random.below(7));
  EXPECT_EQ(seen.size(), 7u);
  EXPECT_EQ(*seen.rbegin(), 6u);
}

TEST(random, children_have_seeds_of_their_own) {
  std::set<std::uint64_t> seeds;
  for (std::uint64_t parent = 0; parent < 100; ++parent) {
    for (std::uint32_t i = 0; i < 64; ++i) seeds.insert(childSeed(parent, i));
  }
  EXPECT_EQ(seeds.size(), 6400u);
}

}  // namespace
