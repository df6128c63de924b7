#include "features/grid_orb.h"

#include <gslam/base/simd.h>
#include <gtest/gtest.h>

#include <cmath>
#include <cstring>
#include <opencv2/imgproc.hpp>
#include <set>

#include "images.h"
#include "matching/descriptors.h"

namespace {

using gslam::Feature;
using gslam::Image;
using visual::FeatureOptions;
using visual::GridOrb;

struct Found {
  std::vector<Feature> features;
  Image descriptors;
};

Found find(const cv::Mat& image, const FeatureOptions& options = {}, int workers = 1) {
  Found found;
  visual::makeFeatureExtractor(options, workers)->extract(image, found.features, found.descriptors);
  EXPECT_EQ(int(found.features.size()), found.descriptors.height());
  return found;
}

bool areSame(const Found& a, const Found& b) {
  return a.features.size() == b.features.size() && a.descriptors == b.descriptors &&
         (a.features.empty() || std::memcmp(a.features.data(), b.features.data(),
                                            a.features.size() * sizeof(Feature)) == 0);
}

TEST(GridOrb, FeaturesAreAllOverTheImage) {
  for (std::size_t frame : {std::size_t(0), std::size_t(150), std::size_t(300)}) {
    const cv::Mat room = images::room(frame);
    const Found found = find(room);
    EXPECT_GE(found.features.size(), 990U);
    EXPECT_LE(found.features.size(), 1000U);
    std::set<int> cells;
    for (const Feature& feature : found.features) {
      cells.insert(int(feature.pixel[1] / 60) * 8 + int(feature.pixel[0] / 80));
    }
    EXPECT_GE(cells.size(), 44U) << "of 48";
  }
}

TEST(GridOrb, EveryFeatureIsDescribedAsOpenCvDoes) {
  const cv::Mat room = images::room();
  GridOrb orb({}, 1);
  Found found;
  orb.extract(room, found.features, found.descriptors);
  const auto reference = cv::ORB::create(1000, 1.2F, 1, 19);
  for (std::size_t i = 0; i < found.features.size(); i += 37) {
    const Feature& feature = found.features[i];
    const int level = feature.octave;
    const double u = visual::toLevel(double(feature.pixel[0]), orb.pyramid().ratioU(level));
    const double v = visual::toLevel(double(feature.pixel[1]), orb.pyramid().ratioV(level));
    EXPECT_NEAR(u, std::round(u), 1e-3);
    std::vector<cv::KeyPoint> keys = {cv::KeyPoint(float(std::lround(u)), float(std::lround(v)), 31,
                                                   float(double(feature.angle) * 180 / CV_PI))};
    cv::Mat row;
    reference->compute(orb.pyramid().level(level).clone(), keys, row);
    ASSERT_EQ(row.rows, 1);
    // Angles are radians in between: one pair of pixels may be another one.
    EXPECT_LE(visual::distanceOf(row.data, found.descriptors.bytes(int(i)), found.descriptors),
              2.0F / 256);
  }
}

TEST(GridOrb, SameBitsForAnyNumberOfThreadsAndVariant) {
  const cv::Mat room = images::room(200);  // it has faint corners on all levels
  const Found one = find(room);
  for (int workers : {0, 2, 3, 4, 16}) EXPECT_TRUE(areSame(one, find(room, {}, workers)));
  for (gslam::Simd variant : gslam::availableSimd()) {
    const gslam::ScopedSimd forced(variant);
    EXPECT_TRUE(areSame(one, find(room)));
  }
}

TEST(GridOrb, WhatCameBeforeMakesNoDifference) {
  GridOrb orb({}, 2);
  Found found;
  for (std::size_t frame : {std::size_t(30), std::size_t(200), std::size_t(0)}) {
    const cv::Mat room = images::room(frame);
    orb.extract(room, found.features, found.descriptors);
    EXPECT_TRUE(areSame(found, find(room)));
    const cv::Mat part = room(cv::Rect(10, 20, 300, 200));
    orb.extract(part, found.features, found.descriptors);
    EXPECT_TRUE(areSame(found, find(part)));
  }
}

// Where a feature is seen again that a known map of pixels says, its angle turns with it, and its
// description stays.
TEST(GridOrb, FindsTheSameInAWarpedImage) {
  const cv::Mat room = images::room(100);
  const double angle = 0.3, scale = 1.1;
  const double c = scale * std::cos(angle), s = scale * std::sin(angle);
  const cv::Matx23d warp(c, -s, 320 - c * 320 + s * 240, s, c, 240 - s * 320 - c * 240);
  cv::Mat warped;
  cv::warpAffine(room, warped, warp, room.size());
  const Found a = find(room), b = find(warped);
  int inside = 0, again = 0, alike = 0, turned = 0;
  double squares = 0;
  for (std::size_t i = 0; i < a.features.size(); ++i) {
    const Feature& f = a.features[i];
    const cv::Vec2d at = warp * cv::Vec3d(double(f.pixel[0]), double(f.pixel[1]), 1);
    if (at[0] < 60 || at[0] > 580 || at[1] < 60 || at[1] > 420) continue;
    ++inside;
    double nearest = 1e9;
    std::size_t partner = 0;
    for (std::size_t j = 0; j < b.features.size(); ++j) {
      const Feature& g = b.features[j];
      if (std::abs(g.octave - f.octave) > 1) continue;
      const double distance = std::hypot(double(g.pixel[0]) - at[0], double(g.pixel[1]) - at[1]);
      if (distance < nearest) {
        nearest = distance;
        partner = j;
      }
    }
    if (nearest > 2 * std::pow(1.2, f.octave)) continue;
    ++again;
    squares += nearest * nearest / std::pow(1.44, f.octave);
    if (visual::distanceOf(a.descriptors.bytes(int(i)), b.descriptors.bytes(int(partner)),
                           a.descriptors) > visual::kStrictDistance) {
      continue;
    }
    ++alike;
    const double turn = double(b.features[partner].angle - f.angle);
    if (std::fabs(std::remainder(turn - angle, 2 * CV_PI)) < 0.2) ++turned;
  }
  RecordProperty("inside", inside);
  RecordProperty("again", again);
  RecordProperty("alike", alike);
  RecordProperty("rms_milli", int(1000 * std::sqrt(squares / again)));
  EXPECT_GT(again, inside * 6 / 10) << inside;
  EXPECT_GT(alike, again / 2) << again;
  EXPECT_GT(turned, alike * 9 / 10) << alike;
}

TEST(GridOrb, FaintCornersAreFoundWhereThereAreNoOthers) {
  cv::Mat image(480, 640, CV_8UC1, cv::Scalar(100));
  cv::rectangle(image, {100, 100}, {140, 140}, cv::Scalar(200), -1);
  cv::rectangle(image, {400, 300}, {440, 340}, cv::Scalar(112), -1);
  FeatureOptions options;
  const auto isFaint = [](const Feature& f) { return f.pixel[0] > 380; };
  const Found both = find(image, options);
  EXPECT_GT(std::count_if(both.features.begin(), both.features.end(), isFaint), 4);
  EXPECT_LT(std::count_if(both.features.begin(), both.features.end(), isFaint),
            std::ptrdiff_t(both.features.size()));
  options.least_threshold = options.threshold;
  const Found one = find(image, options);
  EXPECT_EQ(std::count_if(one.features.begin(), one.features.end(), isFaint), 0);
  EXPECT_GT(one.features.size(), 4U);
}

TEST(GridOrb, ImagesWithoutTextureHaveNoFeatures) {
  for (const cv::Size size : {cv::Size(640, 480), cv::Size(1, 1), cv::Size(38, 38),
                              cv::Size(39, 39), cv::Size(2000, 3), cv::Size(3, 700)}) {
    for (int brightness : {0, 128, 255}) {
      for (int workers : {1, 3}) {
        const Found found = find(cv::Mat(size, CV_8UC1, cv::Scalar(brightness)), {}, workers);
        EXPECT_TRUE(found.features.empty());
        EXPECT_TRUE(found.descriptors.empty());
      }
    }
  }
}

TEST(GridOrb, SmallImagesOfNoiseAreNoProblem) {
  cv::RNG random(1);
  for (int side : {2, 20, 38, 39, 40, 45, 60, 75, 110}) {
    cv::Mat image(side, 2 * side + 1, CV_8UC1);
    random.fill(image, cv::RNG::UNIFORM, 0, 256);
    for (const Feature& f : find(image).features) {
      EXPECT_TRUE(f.pixel[0] >= 18 && f.pixel[0] <= float(2 * side - 18)) << f.pixel[0];
      EXPECT_TRUE(f.pixel[1] >= 18 && f.pixel[1] <= float(side - 19)) << f.pixel[1];
      EXPECT_TRUE(std::isfinite(f.angle) && f.size >= 31 && f.octave >= 0 && f.octave < 8);
    }
  }
}

TEST(GridOrb, OneFeatureOrNone) {
  FeatureOptions options;
  options.count = 1;
  EXPECT_EQ(find(images::room(), options).features.size(), 1U);
  options.count = 0;
  EXPECT_EQ(find(images::room(), options).features.size(), 0U);
}

// Brighter and brighter along one direction.
TEST(BrightnessAngle, PointsToWhereItIsBright) {
  for (int degrees = -180; degrees < 180; degrees += 15) {
    const double angle = degrees * CV_PI / 180;
    cv::Mat image(41, 41, CV_8UC1);
    for (int y = 0; y < 41; ++y) {
      for (int x = 0; x < 41; ++x) {
        const double side = (x - 20) * std::cos(angle) + (y - 20) * std::sin(angle);
        image.at<std::uint8_t>(y, x) = std::uint8_t(std::lround(125 + 4 * side));
      }
    }
    for (gslam::Simd variant : gslam::availableSimd()) {
      const gslam::ScopedSimd forced(variant);
      const double found = double(visual::brightnessAngle(image, 20, 20));
      EXPECT_NEAR(std::remainder(found - angle, 2 * CV_PI), 0, 0.01) << degrees;
    }
  }
}

TEST(AnyFeature, EveryDetectorGivesWhatIsPromised) {
  const cv::Mat room = images::room();
  for (const char* name : {"sift", "akaze", "brisk", "kaze"}) {
    FeatureOptions options;
    options.detector = name;
    options.count = 300;
    const Found found = find(room, options);
    EXPECT_GT(found.features.size(), 200U) << name;
    EXPECT_LE(found.features.size(), 300U) << name;
    std::set<int> octaves, cells;
    for (const Feature& f : found.features) {
      octaves.insert(f.octave);
      cells.insert(int(f.pixel[1] / 120) * 4 + int(f.pixel[0] / 160));
      EXPECT_TRUE(f.octave >= 0 && f.octave < 8 && f.size > 0) << name;
      EXPECT_TRUE(f.angle >= 0 && f.angle < 6.3F) << name << f.angle;
    }
    EXPECT_TRUE(octaves.count(0) + octaves.count(1) > 0) << name;
    EXPECT_GE(octaves.size(), 3U) << name;
    EXPECT_GE(cells.size(), 14U) << name << " of 16";
    EXPECT_TRUE(areSame(found, find(room, options))) << name;
    EXPECT_TRUE(find(cv::Mat(1, 1, CV_8UC1, cv::Scalar(9)), options).features.empty());
    EXPECT_TRUE(find(cv::Mat(90, 90, CV_8UC1, cv::Scalar(9)), options).features.empty());
  }
}

TEST(AnyFeature, AnUnknownDetectorIsRefusedWithTheKnownOnes) {
  FeatureOptions options;
  options.detector = "surf";
  try {
    visual::makeFeatureExtractor(options, 1);
    FAIL();
  } catch (const gslam::ArgumentError& error) {
    EXPECT_NE(std::string(error.what()).find("orb, sift, akaze, brisk, kaze"), std::string::npos)
        << error.what();
  }
}

}  // namespace
