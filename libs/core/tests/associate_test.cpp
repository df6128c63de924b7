#include <gslam/base/error.h>
#include <gslam/core/associate.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cstdlib>
#include <limits>
#include <random>
#include <set>
#include <utility>

namespace {

using gslam::associate;
using Stamps = std::vector<std::int64_t>;
using Pairs = std::vector<gslam::StampPair>;

std::int64_t sumOf(const Stamps& a, const Stamps& b, const Pairs& pairs) {
  std::int64_t sum = 0;
  for (const gslam::StampPair& pair : pairs) sum += std::abs(a[pair.a] - b[pair.b]);
  return sum;
}

// All ways to pair, crossing ones as well: most pairs, then least sum.
std::pair<std::size_t, std::int64_t> bruteForce(const Stamps& a, const Stamps& b,
                                                std::int64_t tolerance, std::size_t i = 0,
                                                std::set<std::size_t> used = {}) {
  if (i == a.size()) return {0, 0};
  auto best = bruteForce(a, b, tolerance, i + 1, used);
  for (std::size_t j = 0; j < b.size(); ++j) {
    const std::int64_t apart = std::abs(a[i] - b[j]);
    if (apart > tolerance || used.count(j) != 0) continue;
    auto with = used;
    with.insert(j);
    auto rest = bruteForce(a, b, tolerance, i + 1, with);
    ++rest.first;
    rest.second += apart;
    if (rest.first > best.first || (rest.first == best.first && rest.second < best.second)) {
      best = rest;
    }
  }
  return best;
}

Stamps someStamps(std::mt19937& random, int most, std::int64_t range) {
  std::set<std::int64_t> stamps;
  const int count = int(random() % unsigned(most + 1));
  for (int i = 0; i < count; ++i) stamps.insert(std::int64_t(random()) % range - range / 2);
  return Stamps(stamps.begin(), stamps.end());
}

TEST(associate, is_as_good_as_trying_all_ways) {
  std::mt19937 random(1);
  for (int round = 0; round < 3000; ++round) {
    const Stamps a = someStamps(random, 6, 60), b = someStamps(random, 6, 60);
    const std::int64_t tolerance = std::int64_t(random() % 20);
    const Pairs pairs = associate(a, b, tolerance);
    const auto best = bruteForce(a, b, tolerance);
    ASSERT_EQ(pairs.size(), best.first) << "round " << round;
    ASSERT_EQ(sumOf(a, b, pairs), best.second) << "round " << round;
    for (std::size_t i = 0; i < pairs.size(); ++i) {
      ASSERT_LE(std::abs(a[pairs[i].a] - b[pairs[i].b]), tolerance);
      if (i == 0) continue;
      ASSERT_LT(pairs[i - 1].a, pairs[i].a);
      ASSERT_LT(pairs[i - 1].b, pairs[i].b);
    }
  }
}

// TUM's associate.py pairs 10 with 9 first, and leaves 2 and 17 alone.
TEST(associate, takes_more_pairs_before_nearer_ones) {
  const Pairs pairs = associate(Stamps{2, 10}, Stamps{9, 17}, 8);
  ASSERT_EQ(pairs.size(), 2U);
  EXPECT_EQ(pairs[0].b, 0U);
  EXPECT_EQ(pairs[1].b, 1U);
}

TEST(associate, survives_the_ends_of_time) {
  const std::int64_t least = std::numeric_limits<std::int64_t>::min(),
                     most = std::numeric_limits<std::int64_t>::max();
  EXPECT_EQ(associate(Stamps{least, 0}, Stamps{most}, 1).size(), 0U);
  EXPECT_EQ(associate(Stamps{least, most}, Stamps{least, most}, most).size(), 2U);
  EXPECT_EQ(associate(Stamps{}, Stamps{1}, 1).size(), 0U);
  EXPECT_EQ(associate(Stamps{1}, Stamps{}, 1).size(), 0U);
}

TEST(associate, takes_long_lists) {
  Stamps a, b;
  for (std::int64_t i = 0; i < 200000; ++i) {
    a.push_back(i * 33333333);
    b.push_back(i * 33333333 + (i % 7) * 1000000);
  }
  EXPECT_EQ(associate(a, b, 20000000).size(), 200000U);
}

TEST(associate, refuses_a_tolerance_that_takes_all_memory) {
  Stamps many;
  for (std::int64_t i = 0; i < 100000; ++i) many.push_back(i);
  EXPECT_THROW(associate(many, many, 1000000), gslam::ArgumentError);
}

TEST(associate, refuses_what_is_not_ascending) {
  EXPECT_THROW(associate(Stamps{1, 1}, Stamps{}, 0), gslam::ArgumentError);
  EXPECT_THROW(associate(Stamps{}, Stamps{2, 1}, 0), gslam::ArgumentError);
  EXPECT_THROW(associate(Stamps{}, Stamps{}, -1), gslam::ArgumentError);
}

}  // namespace
