#include "features/stereo_matcher.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <opencv2/imgproc.hpp>

#include "features/feature_extractor.h"
#include "features/window_search.h"
#include "images.h"

namespace {

using gslam::Feature;
using gslam::Image;

struct Side {
  std::unique_ptr<visual::FeatureExtractor> extractor = visual::makeFeatureExtractor({}, 1);
  std::vector<Feature> features;
  Image descriptors;

  explicit Side(const cv::Mat& image) { extractor->extract(image, features, descriptors); }
  visual::StereoSide side() { return {features, descriptors, extractor->pyramid()}; }
};

struct Depths {
  std::vector<float> depth, right_u;
};

Depths match(Side& left, Side& right, double focal, double baseline) {
  Depths depths;
  visual::StereoMatcher(focal, baseline)
      .match(left.side(), right.side(), depths.depth, depths.right_u);
  EXPECT_EQ(depths.depth.size(), left.features.size());
  EXPECT_EQ(depths.right_u.size(), left.features.size());
  return depths;
}

// A picture that moves by a part of a pixel, which is known.
TEST(StereoMatcher, DisparityIsRightToAPartOfAPixel) {
  const cv::Mat left = images::room(50);
  Side first(left);
  for (double shift : {3.0, 7.25, 12.5, 30.8}) {
    cv::Mat right;
    const cv::Matx23d move(1, 0, -shift, 0, 1, 0);
    cv::warpAffine(left, right, move, left.size(), cv::INTER_CUBIC);
    Side second(right);
    const Depths depths = match(first, second, 400, 0.1);
    std::vector<double> errors;
    int wrong = 0;
    for (std::size_t i = 0; i < depths.depth.size(); ++i) {
      if (!(depths.depth[i] > 0)) {
        EXPECT_TRUE(std::isnan(depths.right_u[i]));
        continue;
      }
      const double disparity = double(first.features[i].pixel[0]) - double(depths.right_u[i]);
      EXPECT_NEAR(double(depths.depth[i]), 40 / disparity, 1e-4 * double(depths.depth[i]));
      const double error = (disparity - shift) / std::pow(1.2, first.features[i].octave);
      errors.push_back(std::fabs(error));
      wrong += std::fabs(error) > 1 ? 1 : 0;
    }
    ASSERT_GT(errors.size(), 400U) << shift;
    std::sort(errors.begin(), errors.end());
    EXPECT_LT(errors[errors.size() / 2], 0.06) << shift;  // a parabola has 0.1
    EXPECT_LT(wrong, int(errors.size()) / 50) << shift;
  }
}

// Against depth that is measured otherwise: the depth image of the same place.
TEST(StereoMatcher, DepthIsThatOfTheDepthImage) {
  const std::string quiet = "&noise=0&blur=false";
  const auto pair = images::frameOf("synthetic://room?sensors=stereo" + quiet, 40);
  const auto truth = images::frameOf("synthetic://room?sensors=rgbd" + quiet, 40);
  Side left(images::matOf(pair->images[0].image)), right(images::matOf(pair->images[1].image));
  const double focal = pair->images[0].camera.parameter("fx"), baseline = 0.11;
  const Depths depths = match(left, right, focal, baseline);
  const gslam::CameraImage& depth = truth->images[1];
  std::vector<double> errors;
  int wrong = 0;
  for (std::size_t i = 0; i < depths.depth.size(); ++i) {
    if (!(depths.depth[i] > 0)) continue;
    const int u = int(std::lround(left.features[i].pixel[0]));
    const int v = int(std::lround(left.features[i].pixel[1]));
    // Of a feature at an edge either side may be meant.
    double least = 1e9;
    for (int dv = -2; dv <= 2; ++dv) {
      for (int du = -2; du <= 2; ++du) {
        const double metres = depth.depth_scale * depth.image.at<std::uint16_t>(u + du, v + dv);
        if (!(metres > 0)) continue;
        const double expected = focal * baseline / metres;
        const double error = focal * baseline / double(depths.depth[i]) - expected;
        least = std::min(least, std::fabs(error) / std::pow(1.2, left.features[i].octave));
      }
    }
    errors.push_back(least);
    wrong += least > 1.5 ? 1 : 0;
  }
  ASSERT_GT(errors.size(), 400U);
  std::sort(errors.begin(), errors.end());
  EXPECT_LT(errors[errors.size() / 2], 0.03);
  EXPECT_LT(wrong, int(errors.size()) / 100);
}

TEST(StereoMatcher, ADarkerImageIsMatchedAsWell) {
  const cv::Mat left = images::room(50);
  cv::Mat moved, darker;
  cv::warpAffine(left, moved, cv::Matx23d(1, 0, -8, 0, 1, 0), left.size());
  cv::subtract(moved, cv::Scalar(20), darker);
  Side first(left), second(moved), third(darker);
  const auto count = [](const Depths& depths) {
    return std::count_if(depths.depth.begin(), depths.depth.end(), [](float d) { return d > 0; });
  };
  const auto same = count(match(first, second, 400, 0.1));
  EXPECT_GT(same, 400);
  EXPECT_GT(count(match(first, third, 400, 0.1)), same * 8 / 10);
}

TEST(StereoMatcher, NothingIsFoundInNothing) {
  Side room(images::room(50)), black(cv::Mat::zeros(480, 640, CV_8UC1));
  for (float depth : match(room, black, 400, 0.1).depth) EXPECT_EQ(depth, 0);
  EXPECT_TRUE(match(black, room, 400, 0.1).depth.empty());
}

// What is to the right of where it can be is not looked at.
TEST(StereoMatcher, SwappedImagesHaveNoDepth) {
  const cv::Mat left = images::room(50);
  cv::Mat right;
  cv::warpAffine(left, right, cv::Matx23d(1, 0, -20, 0, 1, 0), left.size());
  Side first(left), second(right);
  const Depths depths = match(second, first, 400, 0.1);
  const auto found = std::count_if(depths.depth.begin(), depths.depth.end(),
                                   [](float depth) { return depth > 0; });
  EXPECT_LT(found, 60);
}

TEST(WindowSearch, StaysInsideOfImages) {
  const cv::Mat image = images::room(50);
  visual::WindowMatch match{};
  for (int u : {-1, 0, 4, 635, 639, 640}) {
    EXPECT_FALSE(visual::searchWindow(image, u, 100, image, 100, match));
  }
  for (int right_u : {-1, 0, 9, 630, 640}) {
    EXPECT_FALSE(visual::searchWindow(image, 100, 100, image, right_u, match));
  }
  for (int v : {-1, 0, 4, 475, 480}) {
    EXPECT_FALSE(visual::searchWindow(image, 100, v, image, 100, match));
  }
  const cv::Mat tiny(1, 1, CV_8UC1, cv::Scalar(0));
  EXPECT_FALSE(visual::searchWindow(tiny, 0, 0, tiny, 0, match));
}

}  // namespace
