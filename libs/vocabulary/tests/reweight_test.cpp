// Weights from other images.
#include <gslam/vocabulary/quality.h>
#include <gslam/vocabulary/reweight.h>
#include <gslam/vocabulary/train.h>
#include <gtest/gtest.h>

#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <string>
#include <vector>

#include "training_images.h"

namespace {

using gslam::ArgumentError;
using gslam::Descriptors;
using gslam::reweighted;
using gslam::Vocabulary;
using gslam::detail::TreeData;
using gslam::detail::treeDataOf;

// Four words of one byte, whose ids and words are in disorder.
Vocabulary fourWords() {
  TreeData data;
  data.format.size = 1;
  data.branching = 2;
  data.depth = 2;
  data.ids = {2, 1, 6, 5, 4, 3};
  data.parents = {0, 0, 1, 1, 2, 2};
  data.words = {gslam::detail::kNone, gslam::detail::kNone, 3, 1, 0, 2};
  data.descriptors = {0x03, 0xF0, 0x70, 0xF0, 0x00, 0x03};
  data.weights.assign(6, 1);
  return gslam::detail::buildVocabulary(data, "made");
}

Descriptors viewOf(const std::vector<std::uint8_t>& bytes) {
  return gslam::binaryDescriptors(bytes.data(), bytes.size(), 1);
}

TEST(reweight, is_the_logarithm_of_images_by_images_with_the_word) {
  const Vocabulary vocabulary = fourWords();
  const std::vector<std::uint8_t> a = {0x70, 0x70, 0x70, 0x00}, b = {0x70, 0x03}, c = {0x70};
  const std::vector<Descriptors> images = {viewOf(a), viewOf(b), viewOf(c), viewOf({})};
  const Vocabulary weighted = reweighted(vocabulary, images);
  EXPECT_DOUBLE_EQ(weighted.weight(3), std::log(4.0 / 3));  // 0x70
  EXPECT_EQ(weighted.weight(1), 0);                         // 0xF0 is in none
  EXPECT_DOUBLE_EQ(weighted.weight(0), std::log(4.0));      // 0x00
  EXPECT_DOUBLE_EQ(weighted.weight(2), std::log(4.0));      // 0x03
}

TEST(reweight, leaves_all_else) {
  const Vocabulary vocabulary = fourWords();
  const std::vector<std::uint8_t> bytes = {0x70, 0x00};
  const TreeData before = treeDataOf(vocabulary);
  const TreeData after =
      treeDataOf(reweighted(vocabulary, std::vector<Descriptors>(3, viewOf(bytes))));
  EXPECT_EQ(after.ids, before.ids);
  EXPECT_EQ(after.words, before.words);
  EXPECT_EQ(after.parents, before.parents);
  EXPECT_EQ(after.descriptors, before.descriptors);
  EXPECT_EQ(treeDataOf(vocabulary).weights, before.weights);
}

TEST(reweight, gives_words_in_all_images_no_weight) {
  const std::vector<std::uint8_t> bytes = {0x70, 0x00, 0xF0, 0x03};
  const Vocabulary weighted = reweighted(fourWords(), std::vector<Descriptors>(3, viewOf(bytes)));
  for (std::uint32_t word = 0; word < 4; ++word) EXPECT_EQ(weighted.weight(word), 0);
}

TEST(reweight, is_one_where_words_count_alike) {
  const std::vector<std::uint8_t> bytes = {0x70};
  for (const gslam::Weighting weighting : {gslam::Weighting::tf, gslam::Weighting::binary}) {
    const Vocabulary weighted = reweighted(fourWords().withWeighting(weighting),
                                           std::vector<Descriptors>(3, viewOf(bytes)));
    for (std::uint32_t word = 0; word < 4; ++word) EXPECT_EQ(weighted.weight(word), 1);
    EXPECT_EQ(weighted.weighting(), weighting);
  }
}

TEST(reweight, gives_what_the_training_gave) {
  const auto images = training_images::binaryImages(30, 50, 32, 300, 1);
  const Vocabulary vocabulary = gslam::trainVocabulary(images.views());
  EXPECT_TRUE(training_images::areSame(reweighted(vocabulary, images.views()), vocabulary));
}

TEST(reweight, is_the_same_from_a_source_and_with_threads) {
  const auto images = training_images::floatImages(30, 50, 9, 300, 1);
  const auto others = training_images::floatImages(50, 50, 9, 400, 2);
  const Vocabulary vocabulary = gslam::trainVocabulary(images.views());
  const Vocabulary expected = reweighted(vocabulary, others.views());
  EXPECT_FALSE(training_images::areSame(expected, vocabulary));
  gslam::ThreadPool pool(4);
  gslam::ParallelOptions parallel;
  parallel.threads = 5;
  parallel.pool = &pool;
  EXPECT_TRUE(training_images::areSame(reweighted(vocabulary, others.views(), parallel), expected));
  const auto source = [&](std::size_t i) { return others.view(others.rows[i]); };
  EXPECT_TRUE(training_images::areSame(reweighted(vocabulary, 50, source), expected));
}

TEST(reweight, refuses_what_does_not_fit) {
  const auto wide = training_images::binaryImages(2, 50, 32, 300, 1);
  const auto floats = training_images::floatImages(2, 50, 1, 300, 1);
  const Vocabulary vocabulary = fourWords();
  const auto source = [&](std::size_t i) { return wide.view(wide.rows[i]); };
  EXPECT_THROW(reweighted(Vocabulary(), wide.views()), ArgumentError);
  EXPECT_THROW(reweighted(Vocabulary(), 2, source), ArgumentError);
  EXPECT_THROW(reweighted(vocabulary, std::vector<Descriptors>()), ArgumentError);
  EXPECT_THROW(reweighted(vocabulary, 0, source), ArgumentError);
  EXPECT_THROW(reweighted(vocabulary, wide.views()), ArgumentError);
  EXPECT_THROW(reweighted(vocabulary, 2, source), ArgumentError);
  EXPECT_THROW(reweighted(vocabulary, floats.views()), ArgumentError);
  Descriptors null = viewOf({});
  null.count = 3;
  null.data = nullptr;
  EXPECT_THROW(reweighted(vocabulary, std::vector<Descriptors>(1, null)), ArgumentError);
}

TEST(reweight, refuses_numbers_that_are_none) {
  std::vector<float> rows = {1, 2, 3, 4, 5, 6, 7, 8};
  const std::vector<Descriptors> images(2, gslam::floatDescriptors(rows.data(), 4, 2));
  const Vocabulary vocabulary = trainVocabulary(images);
  for (const float bad : {std::numeric_limits<float>::quiet_NaN(), 1.1e15f}) {
    rows[5] = bad;
    EXPECT_THROW(reweighted(vocabulary, images), ArgumentError);
    EXPECT_THROW(reweighted(vocabulary, 2, [&](std::size_t i) { return images[i]; }),
                 ArgumentError);
    EXPECT_THROW(reweighted(vocabulary.withWeighting(gslam::Weighting::tf), images), ArgumentError);
    EXPECT_THROW(qualityOf(vocabulary, images), ArgumentError);
  }
}

}  // namespace
