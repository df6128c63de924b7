// Training on more descriptors than the memory holds.
#include <gslam/vocabulary/quality.h>
#include <gslam/vocabulary/train.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <set>
#include <stdexcept>
#include <string>
#include <vector>

#include "training_images.h"

namespace {

using gslam::ArgumentError;
using gslam::Descriptors;
using gslam::ImageSource;
using gslam::TrainingOptions;
using gslam::TrainingReport;
using gslam::trainVocabulary;
using gslam::Vocabulary;
using gslam::VocabularyQuality;
using training_images::areSame;
using training_images::binaryImages;
using training_images::floatImages;

// Gives one image at a time, in memory that is used again.
template <class Number>
class Reader {
 public:
  explicit Reader(const training_images::Images<Number>& images) : images_(images) {}
  Descriptors operator()(std::size_t i) {
    EXPECT_EQ(i, next_) << "images come in their order";
    next_ = (i + 1) % images_.rows.size();
    one_.assign(images_.rows[i].begin(), images_.rows[i].end());
    return images_.view(one_);
  }

 private:
  const training_images::Images<Number>& images_;
  std::vector<Number> one_;
  std::size_t next_ = 0;
};

TrainingOptions optionsFor(std::uint32_t branching, std::uint32_t depth, std::size_t rows,
                           std::size_t stride) {
  TrainingOptions options;
  options.branching = branching;
  options.depth = depth;
  options.memory = rows * (stride + 17);
  return options;
}

template <class Number>
Vocabulary trainFromSource(const training_images::Images<Number>& images,
                           const TrainingOptions& options, TrainingReport* report = nullptr) {
  return trainVocabulary(images.rows.size(), Reader<Number>(images), options, report);
}

TEST(train_stream, gives_the_same_tree_where_all_fit) {
  const auto bits = binaryImages(10, 200, 21, 200, 1);
  const auto numbers = floatImages(10, 200, 5, 200, 1);
  TrainingReport report;
  const TrainingOptions bit_options = optionsFor(10, 3, 2000, 24);
  EXPECT_TRUE(areSame(trainFromSource(bits, bit_options, &report),
                      trainVocabulary(bits.views(), bit_options)));
  EXPECT_EQ(report.passes, 2u);
  EXPECT_EQ(report.images, 10u);
  EXPECT_EQ(report.descriptors, 2000u);
  TrainingOptions options = optionsFor(10, 3, 2000, 32);
  options.storage = gslam::DescriptorType::int8;
  EXPECT_TRUE(
      areSame(trainFromSource(numbers, options), trainVocabulary(numbers.views(), options)));
}

// A tenth of the descriptors fits: only the top comes from a sample, so it is hardly worse.
template <class Number>
void expectNearlyAsGood(const training_images::Images<Number>& images,
                        const TrainingOptions& options) {
  TrainingReport report;
  const Vocabulary streamed = trainFromSource(images, options, &report);
  EXPECT_GT(report.passes, 10u);
  EXPECT_LT(report.passes, 30u);
  const VocabularyQuality whole =
      qualityOf(trainVocabulary(images.views(), options), images.views());
  const VocabularyQuality quality = qualityOf(streamed, images.views());
  EXPECT_LT(quality.rms_error, whole.rms_error * 1.02);
  EXPECT_GT(quality.rms_error, whole.rms_error * 0.9);
  EXPECT_GT(quality.words, whole.words * 0.9);
  EXPECT_EQ(quality.unseen_words, 0u);
  EXPECT_EQ(quality.weightless_words, 0u);
}

TEST(train_stream, is_nearly_as_good_with_a_tenth_of_the_memory) {
  expectNearlyAsGood(binaryImages(40, 500, 32, 1000, 1), optionsFor(10, 4, 2000, 32));
  expectNearlyAsGood(floatImages(40, 500, 8, 1000, 1), optionsFor(6, 4, 2000, 32));
}

TEST(train_stream, threads_do_not_change_the_tree) {
  const auto images = binaryImages(50, 1000, 16, 2000, 1);
  TrainingOptions options = optionsFor(8, 4, 12000, 16);
  options.parallel.threads = 1;
  const Vocabulary expected = trainFromSource(images, options);
  for (const unsigned threads : {2u, 8u}) {
    gslam::ThreadPool pool(threads);
    options.parallel.threads = threads;
    options.parallel.pool = &pool;
    EXPECT_TRUE(areSame(trainFromSource(images, options), expected)) << threads;
  }
}

// Three descriptors, each there far more often than fits, and many others.
TEST(train_stream, takes_nodes_that_do_not_fit) {
  auto images = binaryImages(40, 500, 8, 1000, 1);
  for (std::size_t i = 0; i < 30; ++i) {
    for (std::size_t j = 0; j < images.rows[i].size(); ++j) {
      images.rows[i][j] = static_cast<std::uint8_t>(j % 8 == 0 ? i / 10 : 0);
    }
  }
  const Vocabulary vocabulary = trainFromSource(images, optionsFor(10, 6, 1000, 8));
  const VocabularyQuality quality = qualityOf(vocabulary, images.views());
  EXPECT_GT(quality.words, 3000u);
  EXPECT_EQ(quality.unseen_words, 0u);
  std::set<std::uint32_t> leaves;
  for (const std::size_t i : {0u, 10u, 20u}) {
    leaves.insert(gslam::detail::leavesOf(vocabulary, images.views()[i])[0]);
  }
  EXPECT_EQ(leaves.size(), 3u);
  // A few others are in no sample of the nodes where nearly all are equal, and stay with these.
  EXPECT_GE(quality.largest_word, 5000u);
  EXPECT_LT(quality.largest_word, 5100u);
}

TEST(train_stream, takes_equal_descriptors) {
  training_images::Images<std::uint8_t> images;
  images.size = 2;
  images.rows.assign(10, std::vector<std::uint8_t>(2000, 7));
  const Vocabulary vocabulary = trainFromSource(images, optionsFor(2, 4, 1000, 8));
  EXPECT_EQ(vocabulary.wordCount(), 1u);
}

TEST(train_stream, tells_how_far_it_is) {
  const auto images = binaryImages(20, 500, 32, 1000, 1);
  TrainingOptions options = optionsFor(10, 4, 2000, 32);
  std::vector<double> parts;
  options.progress = [&](double part) {
    parts.push_back(part);
    return true;
  };
  trainFromSource(images, options);
  EXPECT_TRUE(std::is_sorted(parts.begin(), parts.end()));
  EXPECT_EQ(parts.back(), 1);
}

TEST(train_stream, ends_when_it_is_told_to) {
  const auto images = binaryImages(20, 500, 32, 1000, 1);
  for (std::size_t calls = 1; calls < 400; calls = calls * 3 / 2 + 1) {
    TrainingOptions options = optionsFor(10, 4, 2000, 32);
    std::size_t asked = 0;
    options.progress = [&](double) { return ++asked < calls; };
    TrainingReport report;
    const Vocabulary vocabulary = trainFromSource(images, options, &report);
    EXPECT_EQ(vocabulary.empty(), report.is_cancelled) << calls;
    EXPECT_EQ(report.is_cancelled, asked >= calls) << calls;
    EXPECT_LE(asked, calls);
  }
}

TEST(train_stream, passes_on_what_the_source_throws) {
  const auto images = binaryImages(20, 500, 32, 1000, 1);
  const ImageSource source = [&](std::size_t i) -> Descriptors {
    if (i == 7) throw std::runtime_error("the file is gone");
    return images.view(images.rows[i]);
  };
  EXPECT_THROW(trainVocabulary(20, source), std::runtime_error);
}

void expectRefused(std::size_t count, const ImageSource& source, const TrainingOptions& options,
                   const std::string& text) {
  try {
    trainVocabulary(count, source, options);
    FAIL() << "expected: " << text;
  } catch (const ArgumentError& error) {
    EXPECT_NE(std::string(error.what()).find(text), std::string::npos) << error.what();
  }
}

TEST(train_stream, refuses_sources_that_change) {
  const auto images = binaryImages(20, 500, 32, 1000, 1);
  const TrainingOptions options = optionsFor(10, 4, 2000, 32);
  for (const std::size_t pass : {1u, 2u, 5u}) {
    for (const bool more : {false, true}) {
      std::size_t calls = 0;
      const ImageSource source = [&](std::size_t i) {
        Descriptors view = images.view(images.rows[i]);
        const bool is_late = calls++ >= 20 * pass;
        if (is_late != more) view.count -= 100;
        return view;
      };
      // Counts are made in the second pass: those of the first may be others.
      if (pass == 1) {
        EXPECT_FALSE(trainVocabulary(20, source, options).empty());
      } else {
        expectRefused(20, source, options, more ? "gave more" : "gave fewer");
      }
    }
  }
}

TEST(train_stream, refuses_bad_images) {
  const auto images = binaryImages(4, 50, 32, 100, 1);
  const auto others = binaryImages(1, 50, 16, 100, 1);
  auto numbers = floatImages(4, 50, 4, 100, 1);
  const TrainingOptions options;
  expectRefused(0, Reader<std::uint8_t>(images), options, "images have no descriptors");
  expectRefused(
      5, [](std::size_t) { return Descriptors(); }, options, "images have no descriptors");
  expectRefused(
      4,
      [&](std::size_t i) {
        return i == 2 ? others.view(others.rows[0]) : images.view(images.rows[i]);
      },
      options, "image 2 has descriptors of 16 bytes of bits, expected 32 bytes of bits");
  numbers.rows[3][8] = std::numeric_limits<float>::quiet_NaN();
  expectRefused(4, Reader<float>(numbers), options, "in descriptor 2,");
  expectRefused(
      4,
      [&](std::size_t i) {
        Descriptors view = images.view(images.rows[i]);
        view.count = i == 1 ? std::size_t(1) << 40 : view.count;
        return view;
      },
      options, "descriptors, expected less than");
}

TEST(train_stream, refuses_too_little_memory) {
  const auto images = binaryImages(4, 50, 32, 100, 1);
  expectRefused(4, Reader<std::uint8_t>(images), optionsFor(10, 3, 639, 32),
                "expected at least 31360 for these descriptors");
  EXPECT_FALSE(trainFromSource(images, optionsFor(10, 3, 640, 32)).empty());
}

}  // namespace
