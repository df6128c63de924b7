// Bags of words for tests and measurements.
#ifndef GSLAM_VOCABULARY_TESTS_RANDOM_BAGS_H
#define GSLAM_VOCABULARY_TESTS_RANDOM_BAGS_H

#include <gslam/vocabulary/score.h>

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <random>
#include <set>
#include <vector>

namespace random_bags {

// Every scoring that there is.
inline std::vector<gslam::Scoring> scorings() {
  using gslam::Scoring;
  return {Scoring::l1, Scoring::l2, Scoring::chi_square, Scoring::kl, Scoring::bhattacharyya,
          Scoring::dot};
}

// `size` words below `word_count`, of which some are as those of `like`, in percent.
inline gslam::BowVector bag(std::mt19937& generator, std::size_t size, std::uint64_t word_count,
                            const gslam::BowVector& like = gslam::BowVector(),
                            unsigned percent = 0) {
  std::uniform_real_distribution<double> value(0.5, 8);
  std::uniform_int_distribution<std::uint64_t> word(0, word_count - 1);
  std::set<std::uint32_t> words;
  for (const std::uint32_t common : like.words) {
    if (words.size() < size && generator() % 100 < percent) words.insert(common);
  }
  while (words.size() < size) words.insert(static_cast<std::uint32_t>(word(generator)));
  gslam::BowVector bow;
  bow.words.assign(words.begin(), words.end());
  for (std::size_t i = 0; i < size; ++i) bow.values.push_back(value(generator));
  return bow;
}

inline gslam::BowVector normalized(gslam::BowVector bow, gslam::Scoring scoring) {
  normalize(bow, scoring);
  return bow;
}

}  // namespace random_bags

#endif  // GSLAM_VOCABULARY_TESTS_RANDOM_BAGS_H
