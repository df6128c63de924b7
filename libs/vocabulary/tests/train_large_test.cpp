// A large tree: 20 000 words, or about a million with GSLAM_TRAIN_WORDS=1000000 (in the full tier).
#include <gslam/vocabulary/quality.h>
#include <gslam/vocabulary/train.h>
#include <gtest/gtest.h>

#include <cstddef>
#include <cstdint>
#include <cstdlib>

#include "training_images.h"

namespace {

std::size_t wantedWords() {
  const char* const wish = std::getenv("GSLAM_TRAIN_WORDS");
  return wish == nullptr ? 20000 : static_cast<std::size_t>(std::strtoul(wish, nullptr, 10));
}

// Twice as many descriptors as words: most are words of their own, and each falls on its word.
TEST(train_large, has_as_many_words_as_there_are_things_to_tell_apart) {
  const std::size_t images = 2 * wantedWords() / 1000;
  const auto set = training_images::binaryImages(images, 1000, 32, images * 50, 1);
  gslam::TrainingOptions options;
  options.depth = 7;
  gslam::TrainingReport report;
  const gslam::Vocabulary vocabulary = trainVocabulary(set.views(), options, &report);
  EXPECT_GT(vocabulary.wordCount(), wantedWords());
  EXPECT_LE(vocabulary.wordCount(), 2 * wantedWords());
  const gslam::VocabularyQuality quality = qualityOf(vocabulary, set.views());
  EXPECT_EQ(quality.unseen_words, 0u);
  EXPECT_EQ(quality.weightless_words, 0u);
  EXPECT_LE(quality.most_depth, 7u);
  EXPECT_GT(quality.balance, 0.95);
  EXPECT_LT(quality.mean_error, 8);  // bits, of the 32 that flip in each
}

}  // namespace
