// Training against plain loops over the same seeds, which share nothing with it but the random
// numbers: no SIMD, no bounds, no counters of bits, no order in place.
#include <gslam/base/simd.h>
#include <gslam/vocabulary/detail/random.h>
#include <gslam/vocabulary/train.h>
#include <gtest/gtest.h>

#include <cstddef>
#include <cstdint>
#include <cstring>
#include <random>
#include <string>
#include <vector>

#include "training_images.h"

namespace {

using gslam::Simd;
using gslam::TrainingOptions;
using gslam::detail::childSeed;
using gslam::detail::SplitMix64;
using training_images::binaryImages;
using training_images::floatImages;

// Numbers of a descriptor: bits, 0 or 1, or floats.
using Row = std::vector<double>;

double distance(const Row& a, const Row& b) {
  double sum = 0;
  for (std::size_t i = 0; i < a.size(); ++i) sum += (a[i] - b[i]) * (a[i] - b[i]);
  return sum;
}

class PlainTraining {
 public:
  PlainTraining(const TrainingOptions& options, bool is_binary)
      : options_(options), is_binary_(is_binary) {}

  // Centres of the tree, depth first.
  std::vector<Row> train(const std::vector<Row>& rows) {
    split(rows, options_.depth, options_.seed);
    return nodes_;
  }

 private:
  void split(const std::vector<Row>& rows, std::uint32_t levels, std::uint64_t seed) {
    if (levels == 0) return;
    centres_.clear();
    chooseSeeds(rows, seed);
    if (centres_.size() == 1) return;
    if (!are_seeds_enough_) refine(rows);
    std::vector<Row> centres;
    std::vector<std::vector<Row>> parts;
    for (std::size_t k = 0; k < centres_.size(); ++k) {
      const std::vector<Row> part = partOf(rows, k);
      if (part.empty()) continue;
      centres.push_back(centres_[k]);
      parts.push_back(part);
    }
    for (std::uint32_t c = 0; c < parts.size(); ++c) {
      nodes_.push_back(centres[c]);
      split(parts[c], levels - 1, childSeed(seed, c));
    }
  }

  void chooseSeeds(const std::vector<Row>& rows, std::uint64_t seed) {
    SplitMix64 random(seed);
    centres_.push_back(rows[random.below(rows.size())]);
    for (;;) {
      label(rows);
      double total = 0;
      for (const double d : distances_) total += d;
      are_seeds_enough_ = total == 0;
      if (are_seeds_enough_ || centres_.size() == options_.branching) return;
      double place = random.unit() * total;
      std::size_t i = 0;
      while (place >= distances_[i]) place -= distances_[i++];
      centres_.push_back(rows[i]);
    }
  }

  void label(const std::vector<Row>& rows) {
    labels_.assign(rows.size(), 0);
    distances_.assign(rows.size(), 0);
    for (std::size_t i = 0; i < rows.size(); ++i) {
      for (std::size_t k = 0; k < centres_.size(); ++k) {
        const double d = distance(rows[i], centres_[k]);
        if (k != 0 && !(d < distances_[i])) continue;
        distances_[i] = d;
        labels_[i] = k;
      }
    }
  }

  void refine(const std::vector<Row>& rows) {
    for (std::uint32_t i = 0; i < options_.most_iterations; ++i) {
      const std::vector<std::size_t> before = labels_;
      fillEmpty(rows);
      const std::vector<std::size_t> filled = labels_;
      for (std::size_t k = 0; k < centres_.size(); ++k) {
        const std::vector<Row> part = partOf(rows, k);
        if (!part.empty()) centres_[k] = middleOf(part);
      }
      label(rows);
      if (labels_ == filled) return;
    }
  }

  void fillEmpty(const std::vector<Row>& rows) {
    for (std::size_t k = 0; k < centres_.size(); ++k) {
      if (!partOf(rows, k).empty()) continue;
      std::size_t far = rows.size();
      for (std::size_t i = 0; i < rows.size(); ++i) {
        if (partOf(rows, labels_[i]).size() < 2 || distances_[i] == 0) continue;
        if (far == rows.size() || distances_[i] > distances_[far]) far = i;
      }
      if (far == rows.size()) return;
      labels_[far] = k;
      distances_[far] = 0;
    }
  }

  std::vector<Row> partOf(const std::vector<Row>& rows, std::size_t k) const {
    std::vector<Row> part;
    for (std::size_t i = 0; i < rows.size(); ++i) {
      if (labels_[i] == k) part.push_back(rows[i]);
    }
    return part;
  }

  Row middleOf(const std::vector<Row>& part) const {
    Row middle(part[0].size(), 0);
    for (const Row& row : part) {
      for (std::size_t i = 0; i < row.size(); ++i) middle[i] += row[i];
    }
    const auto count = static_cast<double>(part.size());
    for (double& number : middle) {
      number = is_binary_ ? (2 * number >= count ? 1 : 0)
                          : static_cast<double>(static_cast<float>(number / count));
    }
    return middle;
  }

  const TrainingOptions options_;
  const bool is_binary_;
  std::vector<Row> centres_;
  std::vector<std::size_t> labels_;
  std::vector<double> distances_;
  bool are_seeds_enough_ = false;
  std::vector<Row> nodes_;
};

Row rowOf(const std::uint8_t* bytes, std::size_t size) {
  Row row;
  for (std::size_t i = 0; i < size * 8; ++i) row.push_back((bytes[i / 8] >> (i % 8)) & 1);
  return row;
}
Row rowOf(const float* numbers, std::size_t size) {
  return Row(numbers, numbers + size);
}

template <class Number>
std::vector<Row> rowsOf(const training_images::Images<Number>& images) {
  std::vector<Row> rows;
  for (const std::vector<Number>& image : images.rows) {
    for (std::size_t i = 0; i < image.size(); i += images.size) {
      rows.push_back(rowOf(&image[i], images.size));
    }
  }
  return rows;
}

// Centres of a vocabulary, depth first.
template <class Number>
void collect(const gslam::Vocabulary& vocabulary, std::uint32_t node, std::vector<Row>& rows) {
  const auto& tree = vocabulary.tree();
  const gslam::detail::Children children = gslam::detail::childrenOf(tree, node);
  for (std::uint32_t c = children.first; c < children.first + children.count; ++c) {
    std::vector<Number> numbers(tree.format.size);
    std::memcpy(numbers.data(), gslam::detail::descriptorOf(tree, c),
                numbers.size() * sizeof(Number));
    rows.push_back(rowOf(numbers.data(), tree.format.size));
    collect<Number>(vocabulary, c, rows);
  }
}

// Returns how many centres without rows were moved.
template <class Number>
std::uint64_t expectPlain(const training_images::Images<Number>& images,
                          const TrainingOptions& options, bool is_binary) {
  const std::vector<Row> expected = PlainTraining(options, is_binary).train(rowsOf(images));
  std::vector<Row> trained;
  gslam::TrainingReport report;
  collect<Number>(gslam::trainVocabulary(images.views(), options, &report), 0, trained);
  EXPECT_EQ(trained, expected);
  return report.moved_centres;
}

TEST(train_reference, binary_trees_are_those_of_plain_loops) {
  for (const std::uint32_t branching : {2u, 5u, 10u}) {
    for (const std::uint64_t seed : {0u, 1u, 2u}) {
      TrainingOptions options;
      options.branching = branching;
      options.depth = 3;
      options.seed = seed;
      SCOPED_TRACE(std::to_string(branching) + " children, seed " + std::to_string(seed));
      expectPlain(binaryImages(6, 100, 9, 40, 3), options, true);
    }
  }
}

// Few bits, many equal descriptors: distances that are equal.
TEST(train_reference, binary_trees_of_few_bits_are_those_of_plain_loops) {
  for (const std::uint64_t seed : {0u, 1u, 2u, 3u, 4u, 5u, 6u, 7u}) {
    TrainingOptions options;
    options.branching = 7;
    options.depth = 4;
    options.seed = seed;
    SCOPED_TRACE(seed);
    expectPlain(binaryImages(2, 200, 1, 50, 3), options, true);
    expectPlain(binaryImages(2, 200, 2, 50, 3), options, true);
  }
}

TEST(train_reference, binary_clusters_without_rows_move_as_in_plain_loops) {
  TrainingOptions options;
  options.branching = 10;
  options.depth = 4;
  EXPECT_GT(expectPlain(binaryImages(1, 1000, 9, 40, 3), options, true), 0u);
}

// Sets that were searched for: floats hardly ever leave a cluster empty.
TEST(train_reference, float_clusters_without_rows_move_as_in_plain_loops) {
  for (const std::uint32_t seed : {4411u, 28245u, 31411u, 33416u}) {
    std::mt19937 random(seed);
    training_images::Images<float> images;
    images.size = 1 + static_cast<std::uint32_t>(random() % 3);
    const std::size_t count = 12 + random() % 60;
    TrainingOptions options;
    options.branching = 3 + static_cast<std::uint32_t>(random() % 10);
    options.depth = 1;
    const std::uint_fast32_t range = 2 + random() % 200;
    images.rows.resize(1);
    for (std::size_t i = 0; i < count * images.size; ++i) {
      images.rows[0].push_back(static_cast<float>(random() % range));
      if (random() % 4 == 0) images.rows[0].back() *= 10;
    }
    EXPECT_EQ(expectPlain(images, options, false), 1u) << seed;
  }
}

TEST(train_reference, binary_trees_that_are_not_finished_are_those_of_plain_loops) {
  for (const std::uint32_t most : {1u, 2u, 3u}) {
    TrainingOptions options;
    options.branching = 8;
    options.depth = 3;
    options.most_iterations = most;
    SCOPED_TRACE(most);
    expectPlain(binaryImages(4, 150, 4, 60, 3), options, true);
  }
}

// Sums of whole numbers are exact.
TEST(train_reference, float_trees_are_those_of_plain_loops) {
  for (const Simd variant : gslam::availableSimd()) {
    const gslam::ScopedSimd scope(variant);
    SCOPED_TRACE(gslam::simdName(variant));
    for (const std::uint64_t seed : {0u, 1u, 2u}) {
      TrainingOptions options;
      options.branching = 6;
      options.depth = 3;
      options.seed = seed;
      SCOPED_TRACE(seed);
      expectPlain(floatImages(5, 100, 7, 30, 3), options, false);
    }
  }
}

// Sums of fractions are rounded: on another way, but hardly further.
TEST(train_reference, float_trees_of_fractions_are_nearly_those_of_plain_loops) {
  training_images::Images<float> images = floatImages(5, 100, 7, 30, 3);
  for (std::vector<float>& image : images.rows) {
    for (float& number : image) number /= 3;
  }
  TrainingOptions options;
  options.branching = 6;
  options.depth = 3;
  const std::vector<Row> expected = PlainTraining(options, false).train(rowsOf(images));
  std::vector<Row> trained;
  collect<float>(gslam::trainVocabulary(images.views(), options), 0, trained);
  ASSERT_EQ(trained.size(), expected.size());
  for (std::size_t i = 0; i < expected.size(); ++i) {
    ASSERT_LT(distance(trained[i], expected[i]), 1e-9) << i;
  }
}

}  // namespace
