// A feature detector finds enough, all over the image, and the same things again.
#include <gslam/datasets.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <opencv2/core.hpp>
#include <opencv2/features2d.hpp>
#include <set>
#include <string>
#include <vector>

#include "view.h"

namespace {

class SyntheticFeatures : public testing::TestWithParam<const char*> {};

TEST_P(SyntheticFeatures, AreManyAndWellSpread) {
  for (std::uint64_t seed = 1; seed <= 3; ++seed) {
    gslam::SyntheticOptions options;  // with noise and blur
    options.world = GetParam();
    options.seed = seed;
    options.sensors = "mono";
    const auto dataset = gslam::openSynthetic(options);
    for (std::size_t i = 0; i < 600; i += 100) {
      dataset->seek(i);
      const auto frame = dataset->next();
      std::vector<cv::KeyPoint> corners, orb;
      cv::FAST(view(frame->images[0].image), corners, 20);
      cv::ORB::create(3000)->detect(view(frame->images[0].image), orb);
      EXPECT_GT(corners.size(), 1000U) << seed << " " << i;
      EXPECT_GT(orb.size(), 1000U) << seed << " " << i;
      std::set<int> cells;
      for (const cv::KeyPoint& key : orb) {
        cells.insert(int(key.pt.y / 80) * 8 + int(key.pt.x / 80));
      }
      EXPECT_GE(cells.size(), 28U) << "of 48, " << seed << " " << i;
    }
  }
}

TEST_P(SyntheticFeatures, AreFoundAgainWhereTheLoopCloses) {
  gslam::SyntheticOptions options;
  options.world = GetParam();
  options.sensors = "mono";
  const auto dataset = gslam::openSynthetic(options);
  const auto describe = [&](std::size_t i, std::vector<cv::KeyPoint>& keys) {
    dataset->seek(i);
    cv::Mat descriptors;
    const auto frame = dataset->next();
    cv::ORB::create(1000)->detectAndCompute(view(frame->images[0].image), cv::noArray(), keys,
                                            descriptors);
    return descriptors;
  };
  std::vector<cv::KeyPoint> first_keys, last_keys;
  const cv::Mat first = describe(0, first_keys), last = describe(599, last_keys);
  std::vector<cv::DMatch> matches;
  cv::BFMatcher(cv::NORM_HAMMING, true).match(first, last, matches);
  const auto near = std::count_if(matches.begin(), matches.end(), [&](const cv::DMatch& match) {
    return cv::norm(first_keys[std::size_t(match.queryIdx)].pt -
                    last_keys[std::size_t(match.trainIdx)].pt) < 8;
  });
  EXPECT_GT(near, 300);
}

INSTANTIATE_TEST_SUITE_P(All, SyntheticFeatures,
                         testing::Values("room", "corridor", "street", "aerial"));

}  // namespace
