// Scores of two bags, against their definitions in long double, and against each other.
#include <gslam/base/simd.h>
#include <gslam/vocabulary/score.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <limits>
#include <map>
#include <random>
#include <set>
#include <utility>
#include <vector>

#include "random_bags.h"

namespace {

using gslam::BowVector;
using gslam::Scoring;
using random_bags::bag;
using random_bags::normalized;
using random_bags::scorings;

std::map<std::uint32_t, long double> mapOf(const BowVector& bow) {
  std::map<std::uint32_t, long double> map;
  for (std::size_t i = 0; i < bow.size(); ++i) map[bow.words[i]] = bow.values[i];
  return map;
}

// The sum over all words that are in one of the bags, of what the definition says of their values.
template <class Function>
long double sumOver(const BowVector& v, const BowVector& w, const Function& function) {
  const auto v_map = mapOf(v), w_map = mapOf(w);
  std::set<std::uint32_t> words(v.words.begin(), v.words.end());
  words.insert(w.words.begin(), w.words.end());
  long double sum = 0;
  for (const std::uint32_t word : words) {
    const auto in_v = v_map.find(word), in_w = w_map.find(word);
    sum += function(in_v == v_map.end() ? 0 : in_v->second, in_w == w_map.end() ? 0 : in_w->second);
  }
  return sum;
}

// Of bags that are normalised.
long double scoreByDefinition(Scoring scoring, const BowVector& v, const BowVector& w) {
  using Real = long double;
  switch (scoring) {
    case Scoring::l1:
      return 1 - sumOver(v, w, [](Real a, Real b) { return std::fabs(a - b); }) / 2;
    case Scoring::l2:
      return 1 - std::sqrt(sumOver(v, w, [](Real a, Real b) { return (a - b) * (a - b); }) / 2);
    case Scoring::chi_square:  // 1 - chi^2 / 2
      return 1 - sumOver(v, w, [](Real a, Real b) { return (a - b) * (a - b) / (a + b); }) / 2;
    case Scoring::kl:
      return sumOver(v, w, [](Real a, Real b) {
        const Real least = std::numeric_limits<double>::epsilon();
        return a == 0 ? 0 : b == 0 ? a * (std::log(a) - std::log(least)) : a * std::log(a / b);
      });
    case Scoring::bhattacharyya:
      return sumOver(v, w, [](Real a, Real b) { return std::sqrt(a * b); });
    default:
      return sumOver(v, w, [](Real a, Real b) { return a * b; });
  }
}

}  // namespace

TEST(score, is_what_its_definition_says) {
  std::mt19937 generator(1);
  for (int round = 0; round < 60; ++round) {
    const std::size_t v_size = 1 + generator() % 800, w_size = 1 + generator() % 800;
    const BowVector v = bag(generator, v_size, 100000);
    const BowVector w = bag(generator, w_size, 100000, v, static_cast<unsigned>(generator() % 101));
    for (const Scoring scoring : scorings()) {
      const BowVector v_normal = normalized(v, scoring), w_normal = normalized(w, scoring);
      const auto expected = static_cast<double>(scoreByDefinition(scoring, v_normal, w_normal));
      // The square root of L2 makes much of little.
      const double bound = scoring == Scoring::l2 ? 1e-7 : 2e-13 * (1 + std::fabs(expected));
      EXPECT_NEAR(score(scoring, v_normal, w_normal), expected, bound)
          << gslam::scoringName(scoring);
    }
  }
}

TEST(score, is_the_best_of_equal_bags_and_the_worst_of_strangers) {
  std::mt19937 generator(2);
  BowVector low = bag(generator, 700, 5000);
  BowVector high = low;
  for (std::uint32_t& word : high.words) word += 5000;
  for (const Scoring scoring : scorings()) {
    if (scoring == Scoring::dot) continue;
    normalize(low, scoring);
    normalize(high, scoring);
    const double best = score(scoring, low, low), worst = score(scoring, low, high);
    if (scoring == Scoring::kl) {
      EXPECT_EQ(best, 0);
      EXPECT_GT(worst, 20);
    } else {
      EXPECT_NEAR(best, 1, scoring == Scoring::l2 ? 1e-7 : 1e-14);
      EXPECT_EQ(worst, 0);
      EXPECT_FALSE(std::signbit(worst)) << gslam::scoringName(scoring);
    }
    EXPECT_TRUE(isBetter(scoring, best, worst));
    EXPECT_FALSE(isBetter(scoring, worst, best));
    EXPECT_FALSE(isBetter(scoring, best, best));
  }
}

TEST(score, of_empty_bags_has_nothing_in_common) {
  std::mt19937 generator(3);
  const BowVector empty, some = normalized(bag(generator, 20, 1000), Scoring::l1);
  for (const Scoring scoring : scorings()) {
    EXPECT_EQ(score(scoring, empty, empty), 0);
    EXPECT_EQ(score(scoring, empty, some), 0);
    if (scoring == Scoring::kl) {
      const auto expected = static_cast<double>(scoreByDefinition(scoring, some, empty));
      EXPECT_NEAR(score(scoring, some, empty), expected, 1e-13);
    } else {
      EXPECT_EQ(score(scoring, some, empty), 0);
    }
  }
}

TEST(score, takes_bags_that_are_not_normalised_as_they_are) {
  const BowVector v = {{3, 7, 0xFFFFFFFF}, {2, 4, 8}};
  const BowVector w = {{0, 7, 0xFFFFFFFF}, {1, 9, 2}};
  EXPECT_EQ(score(Scoring::l1, v, w), (4 + 4 + 2 + 2) / 2.);  // min(4, 9) + min(8, 2)
  EXPECT_EQ(score(Scoring::dot, v, w), 52);
  EXPECT_EQ(score(Scoring::l2, v, w), 1);  // as DBoW: not the root of a negative number
  EXPECT_DOUBLE_EQ(score(Scoring::chi_square, v, w), 2 * (36. / 13 + 16. / 10));
  EXPECT_DOUBLE_EQ(score(Scoring::bhattacharyya, v, w), 6 + 4);
}

TEST(score, leaves_out_values_of_zero) {
  const BowVector v = {{1, 2, 3}, {0, 0.5, 0.5}}, w = {{1, 2, 3}, {0, 0, 1}};
  for (const Scoring scoring : scorings()) {
    EXPECT_TRUE(std::isfinite(score(scoring, v, w))) << gslam::scoringName(scoring);
  }
  EXPECT_NEAR(score(Scoring::kl, v, w), 0.5 * std::log(0.5), 1e-14);  // as DBoW
  EXPECT_DOUBLE_EQ(score(Scoring::chi_square, v, w), 2 * 0.5 / 1.5);
}

TEST(score, refuses_what_is_no_bag_and_no_scoring) {
  const BowVector good = {{1}, {1}}, bad = {{1, 2}, {1}};
  EXPECT_THROW(score(Scoring::l1, good, bad), gslam::ArgumentError);
  EXPECT_THROW(score(Scoring::l1, bad, good), gslam::ArgumentError);
  EXPECT_THROW(score(static_cast<Scoring>(6), good, good), gslam::ArgumentError);
}

TEST(score, has_the_same_bits_with_every_instruction_set) {
  std::mt19937 generator(4);
  for (int round = 0; round < 30; ++round) {
    const BowVector v = bag(generator, generator() % 900, 3000);
    const BowVector w = bag(generator, generator() % 900, 3000);
    for (const Scoring scoring : scorings()) {
      std::set<double> scores;
      for (const gslam::Simd simd : gslam::availableSimd()) {
        const gslam::ScopedSimd forced(simd);
        scores.insert(score(scoring, v, w));
      }
      EXPECT_EQ(scores.size(), 1u) << gslam::scoringName(scoring);
    }
  }
}

namespace {

#if GSLAM_X86
GSLAM_TARGET_AVX2  // has fused additions, as arm64 always has
#endif

    double
    sumOfProducts(const BowVector& v, const BowVector& w) {
  double sum = 0;
  for (std::size_t i = 0; i < v.size(); ++i) {
    sum += gslam::detail::DotTerm::common(v.values[i], 0, w.values[i]);
  }
  return sum;
}
double sumOfLogarithms(const BowVector& v, const BowVector& w) {
  double sum = 0;
  for (std::size_t i = 0; i < v.size(); ++i) {
    const double own = gslam::detail::KlTerm::own(w.values[i]);
    sum += gslam::detail::KlTerm::common(v.values[i], own, w.values[i]);
  }
  return sum;
}

#if GSLAM_X86
GSLAM_TARGET_END
#endif

}  // namespace

// The square root of L2 makes much of the last bit.
TEST(score, adds_what_was_rounded_where_the_processor_could_fuse) {
#if GSLAM_X86
  const std::vector<gslam::Simd> simd = gslam::availableSimd();
  if (std::count(simd.begin(), simd.end(), gslam::Simd::avx2) == 0) GTEST_SKIP() << "no AVX2";
#endif
  std::mt19937 generator(8);
  for (int round = 0; round < 200; ++round) {
    const BowVector v = bag(generator, 5, 5000), w = bag(generator, 5, 5000);
    volatile double products = 0, logarithms = 0;
    for (std::size_t i = 0; i < v.size(); ++i) {
      const double a = v.values[i], b = w.values[i];
      const volatile double product = a * b, own = b * (std::log(b) + 52 * std::log(2.0));
      const volatile double logarithm = a * std::log(a / b);
      products = products + product;
      logarithms = logarithms + (logarithm - own);
    }
    EXPECT_EQ(sumOfProducts(v, w), products);
    EXPECT_EQ(sumOfLogarithms(v, w), logarithms);
  }
}

namespace {

using Places = std::vector<std::pair<std::uint32_t, std::uint32_t>>;

Places placesByKernel(gslam::detail::FindCommon find, const BowVector& v, const BowVector& w) {
  gslam::detail::WordLists lists = {v.words.data(), v.size(), w.words.data(), w.size(), 0, 0};
  gslam::detail::CommonWords found;
  std::memset(&found, 0xFF, sizeof found);  // what is not written is nowhere
  Places places;
  while (!lists.areDone()) {
    const std::size_t count = find(lists, found);
    EXPECT_LE(count, std::size_t(gslam::detail::CommonWords::kCapacity));
    for (std::size_t i = 0; i < count; ++i) places.emplace_back(found.in_a[i], found.in_b[i]);
  }
  return places;
}

Places placesByBruteForce(const BowVector& v, const BowVector& w) {
  Places places;
  for (std::uint32_t i = 0; i < v.size(); ++i) {
    for (std::uint32_t j = 0; j < w.size(); ++j) {
      if (v.words[i] == w.words[j]) places.emplace_back(i, j);
    }
  }
  return places;
}

void expectPlacesInside(const Places& places, const BowVector& v, const BowVector& w) {
  for (const auto& place : places) {
    ASSERT_LT(place.first, v.words.size());
    ASSERT_LT(place.second, w.words.size());
  }
}

}  // namespace

TEST(common_words, are_found_by_every_kernel) {
  const auto& kernel = gslam::detail::findCommonKernel();
  std::mt19937 generator(5);
  for (const gslam::Simd simd : kernel.variants()) {
    for (std::size_t v_size = 0; v_size < 40; ++v_size) {
      for (std::size_t w_size = 0; w_size < 40; ++w_size) {
        const BowVector v = bag(generator, v_size, 90), w = bag(generator, w_size, 90);
        ASSERT_EQ(placesByKernel(kernel.exact(simd), v, w), placesByBruteForce(v, w))
            << gslam::simdName(simd) << " " << v_size << " " << w_size;
      }
    }
  }
}

TEST(common_words, may_be_more_than_are_handed_over_at_once) {
  const auto& kernel = gslam::detail::findCommonKernel();
  std::mt19937 generator(6);
  for (const gslam::Simd simd : kernel.variants()) {
    for (const std::size_t size : {255u, 256u, 257u, 263u, 264u, 265u, 511u, 512u, 513u, 2000u}) {
      for (const unsigned percent : {60u, 97u, 100u}) {
        const BowVector v = bag(generator, size, 0x100000000u);
        const BowVector w = bag(generator, size, 0x100000000u, v, percent);
        ASSERT_EQ(placesByKernel(kernel.exact(simd), v, w), placesByBruteForce(v, w))
            << gslam::simdName(simd) << " " << size;
      }
    }
  }
}

TEST(common_words, of_lists_that_do_not_ascend_are_inside_them) {
  const auto& kernel = gslam::detail::findCommonKernel();
  std::mt19937 generator(7);
  BowVector v = bag(generator, 300, 400), w = bag(generator, 333, 400);
  std::shuffle(v.words.begin(), v.words.end(), generator);
  std::shuffle(w.words.begin(), w.words.end(), generator);
  for (const gslam::Simd simd : kernel.variants()) {
    expectPlacesInside(placesByKernel(kernel.exact(simd), v, w), v, w);
  }
}

// As a map with several values of a key would have it.
TEST(common_words, of_lists_with_a_word_many_times_are_inside_them) {
  const auto& kernel = gslam::detail::findCommonKernel();
  for (const gslam::Simd simd : kernel.variants()) {
    for (std::uint32_t v_step = 1; v_step <= 16; v_step *= 2) {
      for (std::uint32_t w_step = 1; w_step <= 16; w_step *= 2) {
        BowVector v, w;
        for (std::uint32_t i = 0; i < 64; ++i) v.words.push_back(i / v_step);
        for (std::uint32_t i = 0; i < 64; ++i) w.words.push_back(i / w_step);
        expectPlacesInside(placesByKernel(kernel.exact(simd), v, w), v, w);
      }
    }
  }
}

TEST(normalize, gives_bags_the_length_that_a_scoring_needs) {
  const BowVector bow = {{1, 5}, {3, 4}};
  EXPECT_EQ(normalized(bow, Scoring::dot), bow);
  EXPECT_EQ(normalized(bow, Scoring::l2).values, (std::vector<double>{3. / 5, 4. / 5}));
  for (const Scoring scoring :
       {Scoring::l1, Scoring::chi_square, Scoring::kl, Scoring::bhattacharyya}) {
    EXPECT_EQ(normalized(bow, scoring).values, (std::vector<double>{3. / 7, 4. / 7}));
  }
}

TEST(normalize, leaves_what_has_no_length) {
  const BowVector zeros = {{1, 5}, {0, 0}};
  for (const Scoring scoring : scorings()) {
    EXPECT_EQ(normalized(zeros, scoring), zeros);
    EXPECT_EQ(normalized(BowVector(), scoring), BowVector());
  }
}
