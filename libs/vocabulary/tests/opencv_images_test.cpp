// Real images: the ten of "14 lectures on visual SLAM", and views of them as from other places.
#if defined(GSLAM_HAS_OPENCV) && defined(GSLAM_HAS_ZLIB)

#include <gslam/vocabulary/database.h>
#include <gslam/vocabulary/gzip.h>
#include <gslam/vocabulary/opencv.h>
#include <gslam/vocabulary/score.h>
#include <gslam/vocabulary/train.h>
#include <gslam/vocabulary/transform.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <opencv2/core.hpp>
#include <opencv2/features2d.hpp>
#include <opencv2/imgcodecs.hpp>
#include <opencv2/imgproc.hpp>
#include <string>
#include <vector>

#include "test_data.h"

namespace {

using gslam::BowVector;
using gslam::Vocabulary;

cv::Mat orbOf(const cv::Mat& image) {
  std::vector<cv::KeyPoint> points;
  cv::Mat descriptors;
  cv::ORB::create(500)->detectAndCompute(image, cv::noArray(), points, descriptors);
  return descriptors;
}

// As seen from a little aside: turned, nearer, darker, blurred.
cv::Mat seenFromAside(const cv::Mat& image, int view) {
  const cv::Point2f middle(float(image.cols) / 2, float(image.rows) / 2);
  const cv::Mat turn = cv::getRotationMatrix2D(middle, view * 8 - 8, 1 + view * 0.08);
  cv::Mat seen;
  cv::warpAffine(image, seen, turn, image.size(), cv::INTER_LINEAR, cv::BORDER_REFLECT);
  cv::GaussianBlur(seen, seen, cv::Size(), 0.6 + 0.2 * view);
  seen.convertTo(seen, -1, 0.8, 5);
  return seen;
}

class TenImages : public testing::Test {
 protected:
  // Once for all tests.
  static const std::vector<cv::Mat>& images() {
    static const std::vector<cv::Mat> all = [] {
      std::vector<cv::Mat> read;
      for (int i = 1; i <= 10; ++i) {
        read.push_back(cv::imread(
            test_data::folder() + "/vocabularies/slambook_images/" + std::to_string(i) + ".png",
            cv::IMREAD_GRAYSCALE));
        EXPECT_FALSE(read.back().empty()) << i;
      }
      return read;
    }();
    return all;
  }
  static const std::vector<cv::Mat>& descriptors() {
    static const std::vector<cv::Mat> all = [] {
      std::vector<cv::Mat> found;
      for (const cv::Mat& image : images()) found.push_back(orbOf(image));
      return found;
    }();
    return all;
  }
  static Vocabulary slambook() {
    return gslam::loadGzippedVocabulary(test_data::folder() +
                                        "/vocabularies/slambook_vocabulary.yml.gz");
  }
  static BowVector bagOf(const Vocabulary& vocabulary, const cv::Mat& descriptors) {
    BowVector bow;
    transform(vocabulary, gslam::viewDescriptors(descriptors), bow);
    return bow;
  }
};

// By the words of a walk that OpenCV's norm measures.
TEST_F(TenImages, HaveTheWordsOfTheNearestChildren) {
  NEEDS_TEST_DATA();
  const Vocabulary vocabulary = slambook();
  const gslam::detail::TreeView& tree = vocabulary.tree();
  for (const cv::Mat& image : {descriptors()[0], descriptors()[9]}) {
    std::vector<std::uint32_t> words(static_cast<std::size_t>(image.rows));
    findWords(vocabulary, gslam::viewDescriptors(image), words);
    for (int i = 0; i < image.rows; ++i) {
      std::uint32_t node = 0;
      while (tree.child_counts[node] != 0) {
        const gslam::detail::Children children = childrenOf(tree, node);
        double least = 257;
        for (std::uint32_t c = children.first; c < children.first + children.count; ++c) {
          auto* const bytes = const_cast<std::uint8_t*>(gslam::detail::descriptorOf(tree, c));
          const double distance =
              cv::norm(image.row(i), cv::Mat(1, 32, CV_8UC1, bytes), cv::NORM_HAMMING);
          if (distance < least) node = c;
          least = std::min(least, distance);
        }
      }
      ASSERT_EQ(words[static_cast<std::size_t>(i)], gslam::detail::wordOf(tree, node)) << i;
    }
  }
}

TEST_F(TenImages, AreMostLikeThemselves) {
  NEEDS_TEST_DATA();
  const Vocabulary vocabulary = slambook();
  std::vector<BowVector> bags;
  for (const cv::Mat& image : descriptors()) bags.push_back(bagOf(vocabulary, image));
  for (std::size_t i = 0; i < 10; ++i) {
    EXPECT_NEAR(score(vocabulary.scoring(), bags[i], bags[i]), 1, 1e-12);
    for (std::size_t j = 0; j < i; ++j) {
      const double alike = score(vocabulary.scoring(), bags[i], bags[j]);
      EXPECT_LT(alike, 0.2) << i + 1 << " and " << j + 1;
      EXPECT_EQ(alike, score(vocabulary.scoring(), bags[j], bags[i]));
    }
  }
}

// The camera came back: images 1 and 10 show the same desk.
TEST_F(TenImages, CloseTheLoop) {
  NEEDS_TEST_DATA();
  const Vocabulary vocabulary = slambook();
  gslam::BowDatabase database(vocabulary.scoring());
  for (std::size_t i = 0; i < 9; ++i) database.add(bagOf(vocabulary, descriptors()[i]));
  gslam::QueryOptions options;
  options.count = 2;
  const std::vector<gslam::QueryResult> found =
      database.query(bagOf(vocabulary, descriptors()[9]), options);
  ASSERT_EQ(found.size(), 2U);
  EXPECT_EQ(found[0].id, 0U);
  EXPECT_GT(found[0].score, 1.2 * found[1].score);
}

// Thirty visits from aside, on a vocabulary of our own that never saw images 9 and 10. The best
// match is always the right place, which for image 10 is that of image 1 and for image 9 none; who
// asks for a score of 0.4 finds every place that the vocabulary knows, and nothing else.
TEST_F(TenImages, AreFoundAgainFromAside) {
  NEEDS_TEST_DATA();
  std::vector<gslam::Descriptors> views;
  for (std::size_t i = 0; i < 8; ++i) views.push_back(gslam::viewDescriptors(descriptors()[i]));
  gslam::TrainingOptions options;
  options.branching = 9;
  options.depth = 3;
  const Vocabulary vocabulary = gslam::trainVocabulary(views, options);
  gslam::BowDatabase database(vocabulary.scoring());
  for (std::size_t i = 0; i < 8; ++i) database.add(bagOf(vocabulary, descriptors()[i]));
  gslam::QueryOptions best;
  best.count = 1;
  int best_is_right = 0;
  int right = 0;
  int wrong = 0;
  for (std::size_t i = 0; i < 10; ++i) {
    for (int view = 0; view < 3; ++view) {
      const cv::Mat seen = orbOf(seenFromAside(images()[i], view));
      const auto found = database.query(bagOf(vocabulary, seen), best);
      ASSERT_EQ(found.size(), 1U);
      const bool is_right = i != 8 && found[0].id == i % 9;
      if (is_right) ++best_is_right;
      if (found[0].score > 0.4) ++(is_right ? right : wrong);
    }
  }
  EXPECT_EQ(best_is_right, 27);
  EXPECT_EQ(right, 24);
  EXPECT_EQ(wrong, 0);
}

TEST_F(TenImages, HaveViewsOfRows) {
  cv::Mat wide(5, 40, CV_8UC1, cv::Scalar(7));
  const gslam::Descriptors view = gslam::viewDescriptors(wide.colRange(4, 36));
  EXPECT_EQ(view.count, 5U);
  EXPECT_EQ(view.size, 32U);
  EXPECT_EQ(view.stride, 40U);
  EXPECT_TRUE(view.is_binary);
  EXPECT_EQ(gslam::viewDescriptors(cv::Mat()).count, 0U);
  const int sizes[] = {2, 3, 32};
  EXPECT_THROW(gslam::viewDescriptors(cv::Mat(3, sizes, CV_8UC1)), gslam::ArgumentError);
  const gslam::Descriptors floats = gslam::viewDescriptors(cv::Mat(3, 128, CV_32FC1));
  EXPECT_FALSE(floats.is_binary);
  EXPECT_EQ(floats.size, 128U);
  EXPECT_EQ(floats.stride, 512U);
  EXPECT_THROW(gslam::viewDescriptors(cv::Mat(3, 128, CV_64FC1)), gslam::ArgumentError);
}

}  // namespace

#endif
