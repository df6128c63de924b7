// What is said about a vocabulary.
#include <gslam/vocabulary/quality.h>
#include <gslam/vocabulary/train.h>
#include <gtest/gtest.h>

#include <cmath>
#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

#include "training_images.h"

namespace {

using gslam::Descriptors;
using gslam::DescriptorType;
using gslam::qualityOf;
using gslam::Vocabulary;
using gslam::VocabularyQuality;
using gslam::detail::TreeData;

// Three words: 0x0F above, 0xF0 and 0x70 below.
Vocabulary threeWords() {
  TreeData data;
  data.format.size = 1;
  data.branching = 2;
  data.depth = 2;
  data.parents = {0, 0, 2, 2};
  data.descriptors = {0x0F, 0xF0, 0xF0, 0x70};
  data.weights = {0.5, 0, 0, 2};
  return gslam::detail::buildVocabulary(data, "made");
}

TEST(quality, describes_the_tree) {
  const VocabularyQuality quality = qualityOf(threeWords(), std::vector<Descriptors>());
  EXPECT_EQ(quality.nodes, 5u);
  EXPECT_EQ(quality.words, 3u);
  EXPECT_EQ(quality.least_depth, 1u);
  EXPECT_EQ(quality.most_depth, 2u);
  EXPECT_DOUBLE_EQ(quality.mean_depth, 5.0 / 3);
  EXPECT_DOUBLE_EQ(quality.mean_children, 2);
  EXPECT_EQ(quality.weightless_words, 1u);
  EXPECT_EQ(quality.images, 0u);
  EXPECT_EQ(quality.descriptors, 0u);
  EXPECT_EQ(quality.unseen_words, 3u);
  EXPECT_EQ(quality.balance, 0);
  EXPECT_EQ(quality.mean_error, 0);
}

TEST(quality, measures_on_images) {
  const std::vector<std::uint8_t> a = {0x0F, 0x0E, 0x0C}, b = {0x70};
  const std::vector<Descriptors> images = {gslam::binaryDescriptors(a.data(), 3, 1),
                                           gslam::binaryDescriptors(b.data(), 1, 1), Descriptors()};
  const VocabularyQuality quality = qualityOf(threeWords(), images);
  EXPECT_EQ(quality.images, 3u);
  EXPECT_EQ(quality.descriptors, 4u);
  EXPECT_EQ(quality.unseen_words, 1u);
  EXPECT_EQ(quality.largest_word, 3u);
  EXPECT_DOUBLE_EQ(quality.mean_error, 3.0 / 4);
  EXPECT_DOUBLE_EQ(quality.rms_error, std::sqrt(5.0 / 4));
  const double entropy = -(0.75 * std::log(0.75) + 0.25 * std::log(0.25));
  EXPECT_DOUBLE_EQ(quality.balance, entropy / std::log(3.0));
}

TEST(quality, of_words_that_are_equally_frequent_is_balanced) {
  const std::vector<std::uint8_t> a = {0x0F, 0xF0, 0x70};
  const std::vector<Descriptors> images(2, gslam::binaryDescriptors(a.data(), 3, 1));
  EXPECT_DOUBLE_EQ(qualityOf(threeWords(), images).balance, 1);
  EXPECT_EQ(qualityOf(threeWords(), images).mean_error, 0);
}

// Against distances taken one by one, in plain loops.
TEST(quality, measures_floats_in_all_storages) {
  const auto images = training_images::floatImages(5, 80, 7, 50, 1);
  for (const DescriptorType storage :
       {DescriptorType::float32, DescriptorType::float16, DescriptorType::int8}) {
    gslam::TrainingOptions options;
    options.branching = 5;
    options.depth = 2;
    options.storage = storage;
    const Vocabulary vocabulary = trainVocabulary(images.views(), options);
    const auto& tree = vocabulary.tree();
    double sum = 0;
    for (const Descriptors& image : images.views()) {
      const auto leaves = gslam::detail::leavesOf(vocabulary, image);
      for (std::size_t i = 0; i < leaves.size(); ++i) {
        const auto* const numbers = reinterpret_cast<const float*>(image.row(i));
        long double square = 0;
        for (std::size_t d = 0; d < 7; ++d) {
          const float centre = gslam::detail::elementOf(
              tree.format, gslam::detail::descriptorOf(tree, leaves[i]), d);
          const long double difference = static_cast<long double>(numbers[d]) - centre;
          square += difference * difference;
        }
        sum += static_cast<double>(square);
      }
    }
    EXPECT_NEAR(qualityOf(vocabulary, images.views()).rms_error, std::sqrt(sum / 400),
                1e-9 * std::sqrt(sum));
  }
}

TEST(quality, does_not_depend_on_threads) {
  const auto images = training_images::floatImages(20, 80, 7, 50, 1);
  const Vocabulary vocabulary = gslam::trainVocabulary(images.views());
  gslam::ParallelOptions parallel;
  parallel.threads = 1;
  const VocabularyQuality expected = qualityOf(vocabulary, images.views(), parallel);
  gslam::ThreadPool pool(4);
  parallel.threads = 5;
  parallel.pool = &pool;
  const VocabularyQuality quality = qualityOf(vocabulary, images.views(), parallel);
  EXPECT_EQ(quality.mean_error, expected.mean_error);
  EXPECT_EQ(quality.rms_error, expected.rms_error);
  EXPECT_EQ(quality.balance, expected.balance);
  EXPECT_EQ(toText(quality), toText(expected));
}

TEST(quality, is_said_in_a_few_lines) {
  VocabularyQuality quality;
  quality.nodes = 11111;
  quality.words = 10000;
  quality.least_depth = 3;
  quality.most_depth = 4;
  quality.mean_depth = 3.987;
  quality.mean_children = 9.5;
  quality.weightless_words = 7;
  quality.images = 400;
  quality.descriptors = 400000;
  quality.unseen_words = 12;
  quality.largest_word = 345;
  quality.balance = 0.9876;
  quality.mean_error = 41.25;
  quality.rms_error = 43.5;
  EXPECT_EQ(toText(quality),
            "11111 nodes, 10000 words 3 to 4 levels below the root, 3.99 on average;\n"
            "9.50 children a node; 7 words of weight 0\n"
            "400 images, 400000 descriptors: 41.2 from their words on average, 43.5 rms;\n"
            "12 words not seen, 345 descriptors in the largest, balance 0.988\n");
}

TEST(quality, refuses_what_does_not_fit) {
  const auto wide = training_images::binaryImages(2, 50, 32, 300, 1);
  const auto floats = training_images::floatImages(2, 50, 1, 300, 1);
  EXPECT_THROW(qualityOf(Vocabulary(), wide.views()), gslam::ArgumentError);
  EXPECT_THROW(qualityOf(threeWords(), wide.views()), gslam::ArgumentError);
  EXPECT_THROW(qualityOf(threeWords(), floats.views()), gslam::ArgumentError);
}

}  // namespace
