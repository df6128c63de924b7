// What counts as a consensus: no noise, however its points are spread, no match given twice; and
// good data whatever one match among them is.
#include <gslam/estimator/estimate_absolute_pose.h>
#include <gslam/estimator/estimate_fundamental.h>
#include <gslam/estimator/estimate_relative_pose.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <random>
#include <string>
#include <vector>

#include "estimate_cases.h"
#include "robust_scenes.h"

using namespace estimate_test;  // NOLINT(google-build-using-namespace): these are its tests
using gslam::Camera;
using gslam::EstimateStatus;
using robust_test::pinhole;

namespace {

Vec2d anyPixel(std::mt19937& g) {
  return {{gslam::randomUniform(g, 0.0, 640.0), gslam::randomUniform(g, 0.0, 480.0)}};
}

Vec2d pixelIn(std::mt19937& g, double half_size) {
  return Vec2d{{320, 240}} + randomPoint<2>(g, -half_size, half_size);
}

Vec3d pointAt(const Vec2d& pixel, double depth) {
  return {{depth * (pixel[0] - 319.5) / 500, depth * (pixel[1] - 239.5) / 500, depth}};
}

// Pixels that have nothing to do with each other, and points where the first ones are.
struct Noise {
  std::vector<Vec2d> first, second;
  std::vector<Vec3d> points;

  using Change = std::function<void(std::mt19937&, std::size_t, Vec2d&, Vec2d&)>;
  Noise(std::mt19937& generator, const Change& change) {
    for (std::size_t i = 0; i < 100; ++i) {
      Vec2d a = anyPixel(generator), b = anyPixel(generator);
      change(generator, i, a, b);
      add(a, b, gslam::randomUniform(generator, 2.0, 8.0));
    }
  }
  void add(const Vec2d& a, const Vec2d& b, double depth) {
    first.push_back(a);
    second.push_back(b);
    points.push_back(pointAt(a, depth));
  }
  // Each match that many times in all.
  void repeat(std::size_t distinct, std::size_t times) {
    first.resize(distinct), second.resize(distinct), points.resize(distinct);
    for (std::size_t i = distinct; i < distinct * times; ++i) {
      first.push_back(first[i - distinct]);
      second.push_back(second[i - distinct]);
      points.push_back(points[i - distinct]);
    }
  }

  // How often something is found in it.
  int found(std::uint64_t seed) const {
    const Camera camera = pinhole();
    EstimateOptions options;
    options.max_iterations = 400;
    options.seed = seed;
    int count = 0;
    for (const auto status :
         {gslam::estimateFundamental(first, second, options).status,
          gslam::estimateHomography(first, second, options).status,
          gslam::estimateHomography(first, second, camera, camera, options).status,
          gslam::estimateAffine2D(first, second, options).status,
          gslam::estimateRelativePose(first, second, camera, camera, options).status,
          gslam::estimateAbsolutePose(second, camera, points, options).status}) {
      count += status == EstimateStatus::Ok ? 1 : 0;
    }
    return count;
  }
};

void expectNothing(const char* name, const Noise::Change& change) {
  std::mt19937 generator(1);
  int found = 0;
  for (std::uint64_t seed = 0; seed < 4; ++seed) found += Noise(generator, change).found(seed);
  EXPECT_EQ(0, found) << name;
}

void anywhere(std::mt19937&, std::size_t, Vec2d&, Vec2d&) {}

TEST(EstimateEvidence, ClustersAreNoConsensus) {
  expectNothing("half in a small cluster", [](std::mt19937& g, std::size_t i, Vec2d&, Vec2d& b) {
    if (i % 2 != 0) b = pixelIn(g, 10);
  });
  expectNothing("most in a cluster", [](std::mt19937& g, std::size_t i, Vec2d&, Vec2d& b) {
    if (i % 10 != 0) b = pixelIn(g, 20);
  });
  expectNothing("at three places", [](std::mt19937&, std::size_t i, Vec2d&, Vec2d& b) {
    const Vec2d places[3] = {{{100, 100}}, {{400, 300}}, {{500, 50}}};
    b = places[i % 3];
  });
}

TEST(EstimateEvidence, LinesAndGridsAreNoConsensus) {
  expectNothing("most on a line", [](std::mt19937& g, std::size_t i, Vec2d&, Vec2d& b) {
    if (i % 5 != 0) b[1] = 200 + 0.3 * gslam::randomNormal<double, 1>(g)[0];
  });
  expectNothing("on a grid", [](std::mt19937&, std::size_t, Vec2d& a, Vec2d& b) {
    for (std::size_t k = 0; k < 2; ++k) {
      a[k] = 64 * std::floor(a[k] / 64);
      b[k] = 64 * std::floor(b[k] / 64);
    }
  });
}

TEST(EstimateEvidence, OneFarPointMakesNoConsensus) {
  expectNothing("one far", [](std::mt19937&, std::size_t i, Vec2d&, Vec2d& b) {
    if (i == 0) b = {{1e6, 1e6}};
  });
  expectNothing("a small image and one far", [](std::mt19937& g, std::size_t i, Vec2d&, Vec2d& b) {
    b = i == 0 ? Vec2d{{1e6, 1e6}} : pixelIn(g, 50);
  });
}

TEST(EstimateEvidence, RepeatedMatchesCountOnce) {
  std::mt19937 generator(2);
  int found = 0;
  for (std::uint64_t seed = 0; seed < 4; ++seed) {
    for (const std::size_t distinct : {3u, 5u, 7u, 8u}) {
      for (const std::size_t times : {2u, 20u}) {
        Noise noise(generator, anywhere);
        noise.repeat(distinct, times);
        found += noise.found(seed);
      }
    }
    Noise noise(generator, anywhere);  // and among others
    noise.repeat(60, 1);
    for (int k = 0; k < 50; ++k) noise.add(noise.first[0], noise.second[0], 3);
    found += noise.found(seed);
  }
  EXPECT_EQ(0, found);
}

TEST(EstimateEvidence, PlanesOfNoiseAreNone) {
  std::mt19937 generator(3);
  EstimateOptions options;
  options.threshold = 0.2;
  options.max_iterations = 500;
  for (int trial = 0; trial < 10; ++trial) {
    std::vector<Vec3d> noise, cluster, repeated;
    for (std::size_t i = 0; i < 100; ++i) {
      noise.push_back(randomPoint<3>(generator, 0, 10));
      cluster.push_back(randomPoint<3>(generator, 0, i % 10 == 0 ? 100 : 3));
      repeated.push_back(noise[i % 3]);
    }
    noise[0] = {{1e4, 1e4, 1e4}};
    EXPECT_FALSE(gslam::estimatePlane(noise, options).ok());
    EXPECT_FALSE(gslam::estimatePlane(cluster, options).ok());
    EXPECT_FALSE(gslam::estimatePlane(repeated, options).ok());
  }
}

TEST(EstimateEvidence, FloorsAndCeilingsArePlanes) {
  std::mt19937 generator(4);
  EstimateOptions options;
  options.threshold = 0.05;
  for (int trial = 0; trial < 10; ++trial) {
    std::vector<Vec3d> points;
    for (int i = 0; i < 100; ++i) {
      Vec3d p = randomPoint<3>(generator, 0, 10);
      p[2] = 3 * (i % 2) + 0.01 * gslam::randomNormal<double, 1>(generator)[0];
      points.push_back(p);
    }
    const auto result = gslam::estimatePlane(points, options);
    EXPECT_TRUE(result.ok()) << result.message;
  }
}

// A few clean matches are enough where chance is small, as far as there are no more.
TEST(EstimateEvidence, AFewCleanMatchesAreAConsensus) {
  std::mt19937 generator(5);
  int poses = 0, homographies = 0;
  for (std::uint64_t seed = 0; seed < 20; ++seed) {
    std::vector<Vec2d> first, pixels, second;
    std::vector<Vec3d> points;
    for (int i = 0; i < 8; ++i) {
      first.push_back(anyPixel(generator));
      pixels.push_back(first.back() + gslam::randomNormal<double, 2>(generator));
      second.push_back(0.9 * pixels.back() + Vec2d{{5, 20}});
      points.push_back(pointAt(first.back(), gslam::randomUniform(generator, 2.0, 8.0)));
    }
    EstimateOptions options;
    options.seed = seed;
    homographies += gslam::estimateHomography(first, second, options).ok() ? 1 : 0;
    pixels.resize(6), points.resize(6);
    poses += gslam::estimateAbsolutePose(pixels, pinhole(), points, options).ok() ? 1 : 0;
  }
  EXPECT_GE(poses, 17);  // some of six are beyond the threshold
  EXPECT_GE(homographies, 19);
}

// Given twice, matches say no more of the model.
TEST(EstimateEvidence, RepeatedMatchesDoNotChangeTheCovariance) {
  std::mt19937 generator(6);
  HomographyCase::Model truth;
  const auto once = makePairsOf<HomographyCase>(generator, {80, 0, 1}, truth);
  auto twice = once;
  twice.first.insert(twice.first.end(), once.first.begin(), once.first.end());
  twice.second.insert(twice.second.end(), once.second.begin(), once.second.end());
  EstimateOptions options;
  options.threshold = 5;
  const auto a = HomographyCase::estimate(once, options);
  const auto b = HomographyCase::estimate(twice, options);
  ASSERT_TRUE(a.ok() && b.ok());
  EXPECT_EQ(2 * a.inlier_count, b.inlier_count);
  EXPECT_GE(b.log10_false_alarms, a.log10_false_alarms - 1e-9);
  for (std::size_t k = 0; k < 81; ++k) {
    EXPECT_NEAR(
        a.covariance.values[k], b.covariance.values[k],
        1e-4 * std::sqrt(a.covariance.values[k / 9 * 10] * a.covariance.values[k % 9 * 10]));
  }
}

template <class Case>
class EstimateWithOneAbsurdMatch : public ::testing::Test {};

TYPED_TEST_SUITE(EstimateWithOneAbsurdMatch, Cases, );

constexpr double kFarCoordinates[] = {1e4, 1e6, 1e9, 1e12, 1e20, 1e160, 1e308};

TYPED_TEST(EstimateWithOneAbsurdMatch, LosesNothing) {
  std::mt19937 generator(7);
  for (const double far : kFarCoordinates) {
    for (int side = 1; side <= 3; ++side) {
      typename TypeParam::Model truth;
      auto pairs = makePairsOf<TypeParam>(generator, {100, 0.3, 0.5}, truth);
      for (std::size_t k = 0; k < TypeParam::kPoint; ++k) {
        if ((side & 1) != 0) pairs.first[7][k] = k == 1 ? -far : far;
        if ((side & 2) != 0) pairs.second[7][k] = far;
      }
      EstimateOptions options;
      options.threshold = 3;
      const auto result = TypeParam::estimate(pairs, options);
      ASSERT_TRUE(result.ok()) << far << ": " << result.message;
      EXPECT_EQ(0, result.inliers[7]);
      EXPECT_LT(distanceOf<TypeParam>(result.model, truth), 2.5);
      for (const double element : result.covariance.values) EXPECT_TRUE(std::isfinite(element));
    }
  }
}

TEST(EstimatePlane, LosesNothingByOneAbsurdPoint) {
  std::mt19937 generator(8);
  for (const double far : kFarCoordinates) {
    PlaneData data(generator, {100, 0.3, 0.5});
    data.points[7] = {{far, -far, far}};
    EstimateOptions options;
    options.threshold = 3;
    const auto result = gslam::estimatePlane(data.points, options);
    ASSERT_TRUE(result.ok()) << far << ": " << result.message;
    EXPECT_EQ(0, result.inliers[7]);
    EXPECT_LT((result.model - data.plane).segment<3>(0).norm(), 0.02);
  }
}

TEST(EstimateHomography, LosesNothingByOneAbsurdPixelOfACamera) {
  std::mt19937 generator(9);
  for (const double far : kFarCoordinates) {
    std::vector<Vec2d> first, second;
    for (int i = 0; i < 60; ++i) {
      first.push_back(anyPixel(generator));
      second.push_back(0.9 * first.back() + gslam::randomNormal<double, 2>(generator));
    }
    first[3] = second[5] = {{far, -far}};
    const auto result = gslam::estimateHomography(first, second, pinhole(), pinhole());
    EXPECT_TRUE(result.ok()) << far << ": " << result.message;
    EXPECT_GE(result.inlier_count, 55u);
  }
}

bool says(const std::string& message, const char* part) {
  return message.find(part) != std::string::npos;
}

TEST(EstimateMessages, SayHowManyMatchesAreNeeded) {
  std::mt19937 generator(10);
  HomographyCase::Model truth;
  auto pairs = makePairsOf<HomographyCase>(generator, {200, 0, 0.3}, truth);
  pairs.first.resize(5), pairs.second.resize(5);
  EstimateOptions options;
  options.threshold = 40;
  const auto few = HomographyCase::estimate(pairs, options);
  EXPECT_EQ(EstimateStatus::NoConsensus, few.status);
  EXPECT_TRUE(says(few.message, "chance explains even all")) << few.message;
  EXPECT_TRUE(says(few.message, " or more different matches")) << few.message;
  EXPECT_TRUE(says(few.message, "smaller threshold")) << few.message;
  options.scoring = gslam::EstimateScoring::Lmeds;  // has no threshold to be changed
  Noise noise(generator, anywhere);
  for (const std::size_t count : {6u, 100u}) {
    noise.repeat(std::min(count, noise.first.size()), 1);
    const auto none = gslam::estimateHomography(noise.first, noise.second, options);
    EXPECT_EQ(EstimateStatus::NoConsensus, none.status);
    EXPECT_FALSE(says(none.message, "smaller threshold")) << none.message;
    EXPECT_FALSE(says(none.message, "another threshold")) << none.message;
  }
}

TEST(EstimateMessages, SayThatMatchesAreRepeated) {
  std::mt19937 generator(11);
  Noise noise(generator, anywhere);
  noise.repeat(5, 20);
  const auto result = gslam::estimateHomography(noise.first, noise.second);
  EXPECT_EQ(EstimateStatus::NoConsensus, result.status);
  EXPECT_TRUE(says(result.message, " of 5 without repeated ones")) << result.message;
}

// With a threshold below all noise no model fits anything, which is no degeneracy.
TEST(EstimateMessages, DoNotCallSamplesDegenerateWhereTheThresholdIsTiny) {
  std::mt19937 generator(12);
  HomographyCase::Model truth;
  const auto pairs = makePairsOf<HomographyCase>(generator, {300, 0.3, 1}, truth);
  EstimateOptions options;
  options.max_iterations = 500;
  for (const double threshold : {1e-6, 1e-9, 1e-12}) {
    options.threshold = threshold;
    const auto result = HomographyCase::estimate(pairs, options);
    EXPECT_EQ(EstimateStatus::NoConsensus, result.status);
    EXPECT_FALSE(says(result.message, "degenerate")) << result.message;
  }
}

// Rankings with all outliers first.
TEST(EstimateEvidence, BadRankingsEndInTime) {
  std::mt19937 generator(13);
  int found = 0;
  for (std::uint64_t seed = 0; seed < 10; ++seed) {
    Affine3DCase::Model truth;
    const auto pairs = makePairsOf<Affine3DCase>(generator, {1000, 0.4, 0.5}, truth);
    std::vector<float> quality;
    for (const std::uint8_t is_inlier : pairs.is_inlier) quality.push_back(1.0f - is_inlier);
    EstimateOptions options;
    options.threshold = 3;
    options.seed = seed;
    options.sampling = gslam::EstimateSampling::Prosac;
    options.quality = quality;
    options.max_iterations = 2000;
    found += Affine3DCase::estimate(pairs, options).ok() ? 1 : 0;
  }
  EXPECT_EQ(10, found);
}

}  // namespace
