// Training from memory.
#include <gslam/base/simd.h>
#include <gslam/vocabulary/quality.h>
#include <gslam/vocabulary/train.h>
#include <gslam/vocabulary/transform.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <limits>
#include <random>
#include <set>
#include <stdexcept>
#include <string>
#include <vector>

#include "training_images.h"

namespace {

using gslam::ArgumentError;
using gslam::Descriptors;
using gslam::DescriptorType;
using gslam::Simd;
using gslam::TrainingOptions;
using gslam::TrainingReport;
using gslam::trainVocabulary;
using gslam::Vocabulary;
using gslam::VocabularyQuality;
using training_images::areSame;
using training_images::binaryImages;
using training_images::floatImages;

TrainingOptions optionsFor(std::uint32_t branching, std::uint32_t depth) {
  TrainingOptions options;
  options.branching = branching;
  options.depth = depth;
  return options;
}

std::string descriptorOf(const Vocabulary& vocabulary, std::uint32_t node) {
  const auto* const bytes = gslam::detail::descriptorOf(vocabulary.tree(), node);
  return std::string(reinterpret_cast<const char*>(bytes), gslam::bytesOf(vocabulary.format()));
}

// No two children of a node are equal.
void expectDifferentChildren(const Vocabulary& vocabulary) {
  for (std::uint32_t node = 0; node < vocabulary.nodeCount(); ++node) {
    const auto children = gslam::detail::childrenOf(vocabulary.tree(), node);
    std::set<std::string> seen;
    for (std::uint32_t c = 0; c < children.count; ++c) {
      seen.insert(descriptorOf(vocabulary, children.first + c));
    }
    ASSERT_EQ(seen.size(), children.count) << "of node " << node;
    ASSERT_NE(children.count, node == 0 ? 0u : 1u) << "of node " << node;
  }
}

// Enough rows that the threads share nodes, and have subtrees of their own.
TEST(train, threads_do_not_change_a_binary_tree) {
  const auto images = binaryImages(40, 1000, 32, 2000, 1);
  TrainingOptions options = optionsFor(10, 3);
  options.parallel.threads = 1;
  const Vocabulary expected = trainVocabulary(images.views(), options);
  EXPECT_EQ(expected.nodeCount(), 1111u);
  for (const unsigned threads : {2u, 8u}) {
    gslam::ThreadPool pool(threads);
    options.parallel.threads = threads;
    options.parallel.pool = &pool;
    EXPECT_TRUE(areSame(trainVocabulary(images.views(), options), expected)) << threads;
  }
}

TEST(train, threads_do_not_change_a_float_tree) {
  auto images = floatImages(40, 1000, 4, 500, 1);
  for (auto& image : images.rows) {
    for (float& number : image) number /= 7;  // so that sums are rounded
  }
  TrainingOptions options = optionsFor(8, 2);
  options.parallel.threads = 1;
  const Vocabulary expected = trainVocabulary(images.views(), options);
  for (const unsigned threads : {2u, 8u}) {
    gslam::ThreadPool pool(threads);
    options.parallel.threads = threads;
    options.parallel.pool = &pool;
    EXPECT_TRUE(areSame(trainVocabulary(images.views(), options), expected)) << threads;
  }
}

TEST(train, simd_does_not_change_a_binary_tree) {
  for (const std::uint32_t size : {1u, 5u, 32u, 61u, 64u}) {
    const auto images = binaryImages(4, 700, size, 300, size);
    Vocabulary expected;
    for (const Simd variant : gslam::availableSimd()) {
      const gslam::ScopedSimd scope(variant);
      const Vocabulary trained = trainVocabulary(images.views(), optionsFor(9, 4));
      if (expected.empty()) expected = trained;
      EXPECT_TRUE(areSame(trained, expected)) << size << " bytes, " << gslam::simdName(variant);
    }
  }
}

TEST(train, seeds_give_trees_of_their_own) {
  const auto images = binaryImages(4, 300, 32, 300, 1);
  TrainingOptions options = optionsFor(5, 3);
  const Vocabulary first = trainVocabulary(images.views(), options);
  EXPECT_TRUE(areSame(trainVocabulary(images.views(), options), first));
  options.seed = 1;
  EXPECT_FALSE(areSame(trainVocabulary(images.views(), options), first));
}

// DBoW2 and DBoW3 write their means over the descriptors of the caller.
TEST(train, leaves_the_descriptors_alone) {
  const auto bits = binaryImages(3, 200, 32, 30, 1);
  const auto numbers = floatImages(3, 200, 9, 30, 1);
  const auto bits_before = bits.rows;
  const auto numbers_before = numbers.rows;
  trainVocabulary(bits.views(), optionsFor(4, 3));
  trainVocabulary(numbers.views(), optionsFor(4, 3));
  EXPECT_EQ(bits.rows, bits_before);
  EXPECT_EQ(numbers.rows, numbers_before);
}

// Rows with something in between, at odd addresses; what is in between does not count.
TEST(train, takes_descriptors_with_gaps) {
  const auto images = binaryImages(3, 200, 10, 60, 1);
  const Vocabulary expected = trainVocabulary(images.views(), optionsFor(5, 3));
  std::vector<std::vector<std::uint8_t>> wide(3, std::vector<std::uint8_t>(2601, 0xAB));
  std::vector<Descriptors> views;
  for (std::size_t i = 0; i < 3; ++i) {
    for (std::size_t j = 0; j < 200; ++j) {
      std::memcpy(&wide[i][1 + j * 13], &images.rows[i][j * 10], 10);
    }
    views.push_back(gslam::binaryDescriptors(wide[i].data() + 1, 200, 10, 13));
  }
  EXPECT_TRUE(areSame(trainVocabulary(views, optionsFor(5, 3)), expected));
}

// Clusters far from each other: the middles that the descriptors were made from.
TEST(train, finds_the_centres_of_binary_clusters) {
  std::mt19937 random(1);
  std::vector<std::vector<std::uint8_t>> centres(8, std::vector<std::uint8_t>(32));
  for (auto& centre : centres) {
    for (auto& byte : centre) byte = static_cast<std::uint8_t>(random());
  }
  std::vector<std::uint8_t> rows;
  for (int i = 0; i < 2000; ++i) {
    std::vector<std::uint8_t> row = centres[random() % 8];
    for (int flip = 0; flip < 12; ++flip) {
      const auto bit = random() % 256;
      row[bit / 8] = static_cast<std::uint8_t>(row[bit / 8] ^ (1u << (bit % 8)));
    }
    rows.insert(rows.end(), row.begin(), row.end());
  }
  const std::vector<Descriptors> images(1, gslam::binaryDescriptors(rows.data(), 2000, 32));
  const Vocabulary vocabulary = trainVocabulary(images, optionsFor(8, 1));
  std::set<std::string> expected, found;
  for (const auto& centre : centres) expected.insert(std::string(centre.begin(), centre.end()));
  for (std::uint32_t n = 1; n < vocabulary.nodeCount(); ++n) {
    found.insert(descriptorOf(vocabulary, n));
  }
  EXPECT_EQ(found, expected);
}

TEST(train, finds_the_means_of_float_clusters) {
  std::mt19937 random(1);
  std::vector<float> rows;
  std::vector<double> sums(30, 0);
  for (int i = 0; i < 600; ++i) {
    for (std::size_t d = 0; d < 5; ++d) {
      const std::size_t cluster = static_cast<std::size_t>(i) % 6;
      const float corner = cluster == d ? 100.0f : 0.0f;
      rows.push_back(corner + static_cast<float>(random() % 1000) / 1000);
      sums[cluster * 5 + d] += static_cast<double>(rows.back());
    }
  }
  const std::vector<Descriptors> images(1, gslam::floatDescriptors(rows.data(), 600, 5));
  const Vocabulary vocabulary = trainVocabulary(images, optionsFor(6, 1));
  std::set<std::vector<float>> expected, found;
  for (std::size_t c = 0; c < 6; ++c) {
    std::vector<float> mean;
    for (std::size_t d = 0; d < 5; ++d) mean.push_back(static_cast<float>(sums[c * 5 + d] / 100));
    expected.insert(mean);
  }
  for (std::uint32_t n = 1; n < vocabulary.nodeCount(); ++n) {
    std::vector<float> centre(5);
    std::memcpy(centre.data(), gslam::detail::descriptorOf(vocabulary.tree(), n), 20);
    found.insert(centre);
  }
  ASSERT_EQ(found.size(), 6u);
  auto f = found.begin();
  for (auto e = expected.begin(); e != expected.end(); ++e, ++f) {
    for (std::size_t d = 0; d < 5; ++d) EXPECT_FLOAT_EQ((*f)[d], (*e)[d]);
  }
}

// A word for each, and nothing below, however deep the tree may be.
TEST(train, makes_leaves_of_few_descriptors) {
  const auto some = binaryImages(1, 7, 32, 100, 1);
  std::vector<std::uint8_t> rows;
  for (int copy = 0; copy < 50; ++copy) {
    rows.insert(rows.end(), some.rows[0].begin(), some.rows[0].end());
  }
  const std::vector<Descriptors> images(1, gslam::binaryDescriptors(rows.data(), 350, 32));
  const Vocabulary vocabulary = trainVocabulary(images, optionsFor(10, 6));
  EXPECT_EQ(vocabulary.wordCount(), 7u);
  EXPECT_EQ(vocabulary.nodeCount(), 8u);
  std::set<std::string> expected, found;
  for (std::size_t i = 0; i < 7; ++i) {
    expected.insert(std::string(some.rows[0].begin() + static_cast<std::ptrdiff_t>(32 * i),
                                some.rows[0].begin() + static_cast<std::ptrdiff_t>(32 * i + 32)));
  }
  for (std::uint32_t n = 1; n < 8; ++n) found.insert(descriptorOf(vocabulary, n));
  EXPECT_EQ(found, expected);
}

TEST(train, gives_equal_descriptors_one_word) {
  const std::vector<float> rows(1500, 2.5f);
  const std::vector<Descriptors> images(2, gslam::floatDescriptors(rows.data(), 500, 3));
  for (const DescriptorType storage :
       {DescriptorType::float32, DescriptorType::float16, DescriptorType::int8}) {
    TrainingOptions options = optionsFor(10, 3);
    options.storage = storage;
    const Vocabulary vocabulary = trainVocabulary(images, options);
    EXPECT_EQ(vocabulary.wordCount(), 1u);
    EXPECT_EQ(qualityOf(vocabulary, images).mean_error, 0);
  }
}

TEST(train, takes_one_descriptor) {
  const std::uint8_t row[] = {1, 2, 3};
  const std::vector<Descriptors> images(1, gslam::binaryDescriptors(row, 1, 3));
  const Vocabulary vocabulary = trainVocabulary(images, optionsFor(2, 1));
  EXPECT_EQ(vocabulary.wordCount(), 1u);
  EXPECT_EQ(descriptorOf(vocabulary, 1), std::string("\1\2\3"));
}

// Half of the descriptors are copies of a few: no empty child, none twice.
TEST(train, keeps_copies_together) {
  for (const std::uint32_t size : {1u, 2u, 32u}) {
    auto images = binaryImages(4, 500, size, 40, size);
    for (auto& image : images.rows) {
      for (std::size_t i = 0; i < 250; ++i) {
        std::memcpy(&image[i * size], &image[(300 + i % 3) * size], size);
      }
    }
    const Vocabulary vocabulary = trainVocabulary(images.views(), optionsFor(6, 4));
    expectDifferentChildren(vocabulary);
    EXPECT_EQ(qualityOf(vocabulary, images.views()).unseen_words, 0u) << size;
  }
}

// DBoW2 leaves 27 % of the words without a weight.
template <class Number>
void expectAllWordsSeen(const training_images::Images<Number>& images,
                        const TrainingOptions& options) {
  const Vocabulary vocabulary = trainVocabulary(images.views(), options);
  expectDifferentChildren(vocabulary);
  const VocabularyQuality quality = qualityOf(vocabulary, images.views());
  EXPECT_EQ(quality.unseen_words, 0u);
  EXPECT_EQ(quality.weightless_words, 0u);
  EXPECT_GT(vocabulary.wordCount(), 300u);
}

TEST(train, gives_every_word_a_weight) {
  expectAllWordsSeen(binaryImages(30, 100, 32, 700, 1), optionsFor(10, 3));
  expectAllWordsSeen(binaryImages(30, 100, 61, 700, 1), optionsFor(64, 2));
  expectAllWordsSeen(binaryImages(30, 100, 4, 700, 1), optionsFor(2, 10));
}

TEST(train, gives_every_word_of_floats_a_weight) {
  for (const DescriptorType storage :
       {DescriptorType::float32, DescriptorType::float16, DescriptorType::int8}) {
    SCOPED_TRACE(gslam::descriptorTypeName(storage));
    TrainingOptions options = optionsFor(10, 3);
    options.storage = storage;
    expectAllWordsSeen(floatImages(30, 100, 17, 700, 1), options);
  }
}

TEST(train, weighs_words_by_their_images) {
  const auto images = binaryImages(20, 60, 32, 300, 1);
  std::vector<Descriptors> views = images.views();
  views.push_back(Descriptors());  // counts, though it has none
  const Vocabulary vocabulary = trainVocabulary(views, optionsFor(6, 3));
  std::vector<std::set<std::size_t>> images_of(vocabulary.wordCount());
  gslam::TransformMemory memory;
  gslam::BowVector bow;
  for (std::size_t i = 0; i < views.size(); ++i) {
    transform(vocabulary, views[i], bow);
    for (const std::uint32_t word : bow.words) images_of[word].insert(i);
  }
  for (std::uint32_t word = 0; word < vocabulary.wordCount(); ++word) {
    ASSERT_GT(images_of[word].size(), 0u);
    EXPECT_DOUBLE_EQ(vocabulary.weight(word),
                     std::log(21.0 / static_cast<double>(images_of[word].size())));
  }
}

TEST(train, weighs_all_words_alike_where_it_is_asked_to) {
  const auto images = binaryImages(5, 60, 32, 300, 1);
  for (const gslam::Weighting weighting : {gslam::Weighting::tf, gslam::Weighting::binary}) {
    TrainingOptions options = optionsFor(4, 2);
    options.weighting = weighting;
    options.scoring = gslam::Scoring::dot;
    const Vocabulary vocabulary = trainVocabulary(images.views(), options);
    EXPECT_EQ(vocabulary.weighting(), weighting);
    EXPECT_EQ(vocabulary.scoring(), gslam::Scoring::dot);
    for (std::uint32_t w = 0; w < vocabulary.wordCount(); ++w) EXPECT_EQ(vocabulary.weight(w), 1);
  }
}

// A byte a number costs little: the error grows by less than a step of the range.
TEST(train, keeps_floats_in_less) {
  const auto images = floatImages(10, 200, 16, 100, 1);
  TrainingOptions options = optionsFor(8, 3);
  const VocabularyQuality exact =
      qualityOf(trainVocabulary(images.views(), options), images.views());
  for (const DescriptorType storage : {DescriptorType::float16, DescriptorType::int8}) {
    options.storage = storage;
    const Vocabulary vocabulary = trainVocabulary(images.views(), options);
    EXPECT_EQ(vocabulary.format().type, storage);
    const VocabularyQuality quality = qualityOf(vocabulary, images.views());
    EXPECT_NEAR(quality.rms_error, exact.rms_error, exact.rms_error * 0.02)
        << gslam::descriptorTypeName(storage);
  }
}

// Means closer than what a byte tells apart become one.
TEST(train, joins_what_the_storage_cannot_tell_apart) {
  std::vector<float> rows = {0, 0, 0, 1000, 0.001f, 0, 0, 1000, 0.002f, 0, 500, 0, 0, 0, 500, 3};
  const std::vector<Descriptors> images(2, gslam::floatDescriptors(rows.data(), 8, 2));
  TrainingOptions options = optionsFor(6, 3);
  options.storage = DescriptorType::int8;
  const Vocabulary vocabulary = trainVocabulary(images, options);
  expectDifferentChildren(vocabulary);
  EXPECT_EQ(vocabulary.wordCount(), 4u);
  EXPECT_EQ(qualityOf(vocabulary, images).unseen_words, 0u);
}

TEST(train, tells_what_happened) {
  const auto images = binaryImages(5, 300, 32, 300, 1);
  TrainingOptions options = optionsFor(6, 3);
  TrainingReport report;
  trainVocabulary(images.views(), options, &report);
  EXPECT_FALSE(report.is_cancelled);
  EXPECT_EQ(report.images, 5u);
  EXPECT_EQ(report.descriptors, 1500u);
  EXPECT_EQ(report.passes, 1u);
  EXPECT_GT(report.iterations, 43u);
  EXPECT_EQ(report.unfinished_nodes, 0u);
  options.most_iterations = 1;
  trainVocabulary(images.views(), options, &report);
  EXPECT_GT(report.unfinished_nodes, 10u);
  EXPECT_LE(report.unfinished_nodes, report.iterations);
}

TEST(train, tells_how_far_it_is) {
  const auto images = binaryImages(35, 1000, 8, 2000, 1);
  TrainingOptions options = optionsFor(10, 4);
  std::vector<double> parts;
  options.progress = [&](double part) {
    parts.push_back(part);
    return true;
  };
  trainVocabulary(images.views(), options);
  EXPECT_GT(parts.size(), 50u);
  EXPECT_TRUE(std::is_sorted(parts.begin(), parts.end()));
  EXPECT_GE(parts.front(), 0);
  EXPECT_EQ(parts.back(), 1);
}

// Nothing that takes long is silent: not the copies, the seeds of a large node and the weights.
TEST(train, asks_in_every_phase) {
  const auto images = binaryImages(20, 1000, 8, 2000, 1);
  TrainingOptions options = optionsFor(30, 1);
  options.most_iterations = 1;
  std::size_t at_begin = 0, at_end = 0;
  options.progress = [&](double part) {
    at_begin += part == 0 ? 1 : 0;
    at_end += part == 1 ? 1 : 0;
    return true;
  };
  trainVocabulary(images.views(), options);
  EXPECT_GE(at_begin, 20u + 29u);
  EXPECT_GE(at_end, 20u);
  for (const std::size_t end : {5u, 25u, 60u, 70u}) {  // in each of them
    std::size_t calls = 0;
    options.progress = [&](double) { return ++calls < end; };
    TrainingReport report;
    EXPECT_TRUE(trainVocabulary(images.views(), options, &report).empty());
    EXPECT_TRUE(report.is_cancelled);
    EXPECT_EQ(calls, end);
  }
}

TEST(train, ends_when_it_is_told_to) {
  const auto images = binaryImages(35, 1000, 8, 2000, 1);
  for (const double end : {0.0, 0.1, 0.5, 1.0}) {
    TrainingOptions options = optionsFor(10, 3);
    int asked_after = 0;
    bool is_over = false;
    options.progress = [&](double part) {
      asked_after += is_over ? 1 : 0;
      is_over = is_over || part >= end;
      return !is_over;
    };
    TrainingReport report;
    EXPECT_TRUE(trainVocabulary(images.views(), options, &report).empty());
    EXPECT_TRUE(report.is_cancelled);
    EXPECT_EQ(asked_after, 0);
  }
}

TEST(train, passes_on_what_the_callback_throws) {
  const auto images = binaryImages(35, 1000, 8, 2000, 1);
  TrainingOptions options = optionsFor(10, 3);
  options.progress = [](double part) {
    if (part > 0.6) throw std::runtime_error("enough");
    return true;
  };
  EXPECT_THROW(trainVocabulary(images.views(), options), std::runtime_error);
}

// Expects an ArgumentError whose text has this.
void expectRefused(const std::vector<Descriptors>& images, const TrainingOptions& options,
                   const std::string& text) {
  try {
    trainVocabulary(images, options);
    FAIL() << "expected: " << text;
  } catch (const ArgumentError& error) {
    EXPECT_NE(std::string(error.what()).find(text), std::string::npos) << error.what();
  }
}

TEST(train, refuses_options_out_of_range) {
  const auto images = binaryImages(2, 20, 8, 10, 1);
  expectRefused(images.views(), optionsFor(1, 3), "options.branching is 1, expected 2 to 64");
  expectRefused(images.views(), optionsFor(65, 3), "options.branching is 65");
  expectRefused(images.views(), optionsFor(10, 0), "options.depth is 0, expected 1 to 64");
  expectRefused(images.views(), optionsFor(10, 65), "options.depth is 65");
  TrainingOptions options;
  options.most_iterations = 0;
  expectRefused(images.views(), options, "options.most_iterations is 0");
  options = TrainingOptions();
  options.weighting = static_cast<gslam::Weighting>(4);
  expectRefused(images.views(), options, "options.weighting is 4, expected 0 to 3");
  options = TrainingOptions();
  options.scoring = static_cast<gslam::Scoring>(6);
  expectRefused(images.views(), options, "options.scoring is 6, expected 0 to 5");
}

TEST(train, refuses_storage_that_floats_have_not) {
  const auto bits = binaryImages(2, 20, 8, 10, 1);
  const auto numbers = floatImages(2, 20, 8, 10, 1);
  for (const auto storage : {DescriptorType::binary, static_cast<DescriptorType>(9)}) {
    TrainingOptions options;
    options.storage = storage;
    expectRefused(numbers.views(), options, "options.storage is ");
    EXPECT_TRUE(areSame(trainVocabulary(bits.views(), options), trainVocabulary(bits.views())));
  }
}

TEST(train, forgets_what_was_told_of_another_training) {
  TrainingReport report;
  report.images = 77;
  EXPECT_THROW(trainVocabulary({}, optionsFor(1, 3), &report), ArgumentError);
  EXPECT_EQ(report.images, 0u);
}

TEST(train, refuses_sets_without_descriptors) {
  expectRefused({}, TrainingOptions(), "images have no descriptors");
  expectRefused(std::vector<Descriptors>(3), TrainingOptions(), "images have no descriptors");
}

TEST(train, refuses_descriptors_of_different_kinds) {
  const auto narrow = binaryImages(2, 20, 8, 10, 1);
  const auto wide = binaryImages(1, 20, 9, 10, 1);
  const auto floats = floatImages(1, 20, 8, 10, 1);
  std::vector<Descriptors> images = narrow.views();
  images.push_back(wide.views()[0]);
  expectRefused(images, TrainingOptions(),
                "image 2 has descriptors of 9 bytes of bits, expected 8 bytes of bits");
  images[2] = floats.views()[0];
  expectRefused(images, TrainingOptions(),
                "image 2 has descriptors of 8 floats, expected 8 bytes of bits");
}

TEST(train, refuses_views_that_make_no_sense) {
  const auto good = binaryImages(1, 20, 8, 10, 1);
  std::vector<Descriptors> images = good.views();
  images[0].data = nullptr;
  expectRefused(images, TrainingOptions(), "image 0 has descriptors at null");
  images = good.views();
  images[0].stride = 7;
  expectRefused(images, TrainingOptions(), "image 0 has a descriptor every 7 bytes, expected 8");
  for (const std::uint32_t size : {0u, 4097u, 0xFFFFFFFFu}) {
    images = good.views();
    images[0].size = size;
    expectRefused(images, TrainingOptions(), "expected 1 to 4096");
  }
  images = good.views();
  images[0].count = std::size_t(1) << 32;
  expectRefused(images, TrainingOptions(), "4294967296 descriptors, expected less than 858993459");
  images.assign(3, images[0]);
  for (Descriptors& image : images) image.count = std::numeric_limits<std::size_t>::max() / 2;
  expectRefused(images, TrainingOptions(), "descriptors, expected less than");
}

TEST(train, refuses_numbers_that_are_none) {
  for (const float bad :
       {std::numeric_limits<float>::quiet_NaN(), std::numeric_limits<float>::infinity(),
        -std::numeric_limits<float>::infinity(), 1.1e15f, -3e38f}) {
    auto images = floatImages(3, 20, 6, 10, 1);
    images.rows[1][17 * 6 + 5] = bad;
    expectRefused(images.views(), TrainingOptions(), "image 1 has the number");
    expectRefused(images.views(), TrainingOptions(), "in descriptor 17");
  }
  auto images = floatImages(3, 20, 6, 10, 1);
  images.rows[1][3] = -70000;
  EXPECT_FALSE(trainVocabulary(images.views()).empty());
  TrainingOptions options;
  options.storage = DescriptorType::float16;
  expectRefused(images.views(), options, "up to 65504; there is -70000");
}

TEST(train, takes_large_and_small_numbers) {
  for (const float scale : {1e12f, 1e-15f, 1e-17f}) {
    auto images = floatImages(3, 100, 6, 10, 1);
    for (auto& image : images.rows) {
      for (float& number : image) number *= scale;
    }
    const Vocabulary vocabulary = trainVocabulary(images.views(), optionsFor(4, 3));
    EXPECT_GT(vocabulary.wordCount(), 50u);
    EXPECT_EQ(qualityOf(vocabulary, images.views()).unseen_words, 0u);
  }
}

}  // namespace
