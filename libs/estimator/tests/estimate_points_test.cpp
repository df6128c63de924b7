// The estimate functions on plain points: what they find, and what they say of it.
#include <gslam/base/simd.h>
#include <gslam/geometry/camera.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <numeric>
#include <random>
#include <vector>

#include "estimate_cases.h"
#include "instances.h"

using namespace estimate_test;  // NOLINT(google-build-using-namespace): these are its tests
using gslam::Degeneracy;
using gslam::EstimateSampling;
using gslam::EstimateScoring;
using gslam::EstimateStatus;

namespace {

template <class Case>
class EstimateMaps : public ::testing::Test {};

TYPED_TEST_SUITE(EstimateMaps, Cases, );

EstimateOptions optionsWith(double threshold) {
  EstimateOptions options;
  options.threshold = threshold;
  return options;
}

template <class Result>
void expectSameEstimate(const Result& a, const Result& b) {
  EXPECT_EQ(a.covariance, b.covariance);
  EXPECT_EQ(a.inliers, b.inliers);
  EXPECT_EQ(a.iterations, b.iterations);
  EXPECT_EQ(a.score, b.score);
  EXPECT_EQ(a.message, b.message);
}

TYPED_TEST(EstimateMaps, FindTheTruthWithEveryScoringAndSampling) {
  std::mt19937 generator(1);
  for (const EstimateScoring scoring : {EstimateScoring::Msac, EstimateScoring::Ransac,
                                        EstimateScoring::Lmeds, EstimateScoring::Magsac}) {
    for (const EstimateSampling sampling : {EstimateSampling::Uniform, EstimateSampling::Prosac}) {
      for (std::uint64_t trial = 0; trial < 10; ++trial) {
        typename TypeParam::Model truth;
        const double outliers = scoring == EstimateScoring::Lmeds ? 0.25 : 0.5;
        const auto pairs = makePairsOf<TypeParam>(generator, {200, outliers, 0.5}, truth);
        const std::vector<float> quality(pairs.is_inlier.begin(), pairs.is_inlier.end());
        EstimateOptions options = optionsWith(scoring == EstimateScoring::Magsac ? 10 : 3);
        options.scoring = scoring;
        options.sampling = sampling;
        options.quality = quality;
        options.seed = trial;
        const auto result = TypeParam::estimate(pairs, options);
        ASSERT_TRUE(result.ok()) << result.message;
        EXPECT_LT(distanceOf<TypeParam>(result.model, truth), 2.5);
        EXPECT_NEAR(result.rms, 0.5 * std::sqrt(double(TypeParam::kPoint)), 0.25);
        std::size_t wrong = 0;
        for (std::size_t i = 0; i < 200; ++i) {
          wrong += result.inliers[i] != pairs.is_inlier[i] ? 1 : 0;
        }
        EXPECT_LE(wrong, 12u);
      }
    }
  }
}

TYPED_TEST(EstimateMaps, AreExactWithoutNoise) {
  std::mt19937 generator(2);
  for (const EstimateScoring scoring : {EstimateScoring::Msac, EstimateScoring::Ransac,
                                        EstimateScoring::Lmeds, EstimateScoring::Magsac}) {
    for (int trial = 0; trial < 20; ++trial) {
      typename TypeParam::Model truth;
      const auto pairs = makePairsOf<TypeParam>(generator, {60, 0.3, 0}, truth);
      EstimateOptions options = optionsWith(1);
      options.scoring = scoring;
      const auto result = TypeParam::estimate(pairs, options);
      ASSERT_TRUE(result.ok()) << result.message;
      EXPECT_LT(distanceOf<TypeParam>(result.model, truth), 1e-8);
      EXPECT_LT(result.rms, 1e-8);
    }
  }
}

TYPED_TEST(EstimateMaps, HaveMasksOfTheReturnedModel) {
  std::mt19937 generator(3);
  for (const EstimateScoring scoring : {EstimateScoring::Msac, EstimateScoring::Ransac,
                                        EstimateScoring::Lmeds, EstimateScoring::Magsac}) {
    typename TypeParam::Model truth;
    const auto pairs = makePairsOf<TypeParam>(generator, {300, 0.4, 1}, truth);
    EstimateOptions options = optionsWith(3);
    options.scoring = scoring;
    const auto result = TypeParam::estimate(pairs, options);
    ASSERT_TRUE(result.ok());
    std::size_t count = 0;
    for (std::size_t i = 0; i < 300; ++i) {
      const double r = (TypeParam::apply(result.model, pairs.first[i]) - pairs.second[i]).norm();
      if (std::fabs(r - result.threshold) > 1e-9) {
        EXPECT_EQ(r < result.threshold ? 1 : 0, result.inliers[i]);
      }
      count += result.inliers[i];
    }
    EXPECT_EQ(count, result.inlier_count);
  }
}

TYPED_TEST(EstimateMaps, HaveTheSameBitsForAnyNumberOfThreads) {
  std::mt19937 generator(4);
  for (int trial = 0; trial < 5; ++trial) {
    typename TypeParam::Model truth;
    const auto pairs = makePairsOf<TypeParam>(generator, {150, 0.6, 0.5}, truth);
    EstimateOptions options = optionsWith(3);
    const auto one = TypeParam::estimate(pairs, options);
    for (const unsigned threads : {2u, 3u, 8u}) {
      options.threads = threads;
      const auto several = TypeParam::estimate(pairs, options);
      expectSameEstimate(one, several);
      EXPECT_EQ(0, distanceOf<TypeParam>(one.model, several.model));
    }
  }
}

TYPED_TEST(EstimateMaps, DoNotDependOnTheOrderOrOnTheSimd) {
  std::mt19937 generator(5);
  for (int trial = 0; trial < 5; ++trial) {
    typename TypeParam::Model truth;
    const auto pairs = makePairsOf<TypeParam>(generator, {150, 0.5, 0.5}, truth);
    const EstimateOptions options = optionsWith(3);
    const auto before = TypeParam::estimate(pairs, options);
    std::vector<std::size_t> order(150);
    std::iota(order.begin(), order.end(), 0u);
    std::shuffle(order.begin(), order.end(), generator);
    auto shuffled = pairs;
    for (std::size_t i = 0; i < 150; ++i) {
      shuffled.first[i] = pairs.first[order[i]];
      shuffled.second[i] = pairs.second[order[i]];
    }
    const auto after = TypeParam::estimate(shuffled, options);
    EXPECT_LT(distanceOf<TypeParam>(before.model, after.model), 1e-9);
    for (std::size_t i = 0; i < 150; ++i) EXPECT_EQ(before.inliers[order[i]], after.inliers[i]);
    for (const gslam::Simd variant : gslam::availableSimd()) {
      const gslam::ScopedSimd scoped(variant);
      const auto other = TypeParam::estimate(pairs, options);
      EXPECT_LT(distanceOf<TypeParam>(before.model, other.model), 1e-9);
      EXPECT_EQ(before.inliers, other.inliers);
    }
  }
}

TYPED_TEST(EstimateMaps, FindNothingInNoise) {
  std::mt19937 generator(6);
  const std::size_t trials = solver_test::instances(50) * (solver_test::instances(1) == 1 ? 1 : 2);
  std::size_t found = 0;
  for (std::size_t trial = 0; trial < trials; ++trial) {
    typename TypeParam::Model truth;
    const auto pairs = makePairsOf<TypeParam>(generator, {100, 1.0, 0}, truth);
    EstimateOptions options = optionsWith(15);
    options.max_iterations = 1000;
    options.seed = trial;
    const auto result = TypeParam::estimate(pairs, options);
    found += result.ok() ? 1 : 0;
    EXPECT_NE(std::string::npos, result.message.find("chance explains")) << result.message;
  }
  EXPECT_EQ(0u, found);
}

TYPED_TEST(EstimateMaps, FindOneInTenOrAdmitThatTheyDidNot) {
  std::mt19937 generator(7);
  int found = 0;
  for (int trial = 0; trial < 6; ++trial) {
    typename TypeParam::Model truth;
    const auto pairs = makePairsOf<TypeParam>(generator, {500, 0.9, 0.5}, truth);
    EstimateOptions options = optionsWith(3);
    options.max_iterations = 60000;
    const auto result = TypeParam::estimate(pairs, options);
    if (result.ok()) {
      ++found;
      EXPECT_LT(distanceOf<TypeParam>(result.model, truth), 8);
    }
    options.max_iterations = 3;
    const auto few = TypeParam::estimate(pairs, options);
    if (few.ok()) {
      EXPECT_LT(distanceOf<TypeParam>(few.model, truth), 8);
    } else {
      EXPECT_EQ(EstimateStatus::NoConsensus, few.status);
      EXPECT_NE(std::string::npos, few.message.find("more iterations"));
    }
  }
  EXPECT_GE(found, 5);
}

TYPED_TEST(EstimateMaps, PredictTheirErrors) {
  std::mt19937 generator(8);
  constexpr std::size_t kN = TypeParam::kPoint;
  const std::size_t trials = solver_test::instances(150);
  double normalised = 0;
  for (std::size_t trial = 0; trial < trials; ++trial) {
    typename TypeParam::Model truth;
    const auto pairs = makePairsOf<TypeParam>(generator, {80, 0.3, 1}, truth);
    const auto result = TypeParam::estimate(pairs, optionsWith(4.5));
    ASSERT_TRUE(result.ok());
    const auto at = randomPoint<kN>(generator, 0, 500);
    const auto error = TypeParam::apply(result.model, at) - TypeParam::apply(truth, at);
    const auto j = TypeParam::jacobian(result.model, at);
    const auto predicted = j * result.covariance * j.transpose();
    for (std::size_t k = 0; k < kN; ++k) normalised += error[k] * error[k] / predicted(k, k);
  }
  const double numbers = static_cast<double>(trials * kN);
  EXPECT_NEAR(1, normalised / numbers, 5 / std::sqrt(numbers) + 0.05);
}

TYPED_TEST(EstimateMaps, KeepTheirDigitsFarFromTheOrigin) {
  std::mt19937 generator(9);
  constexpr std::size_t kN = TypeParam::kPoint;
  typename TypeParam::Model truth;
  const auto pairs = makePairsOf<TypeParam>(generator, {100, 0.3, 0}, truth);
  auto far = pairs;
  Vec<double, kN> offset;
  for (std::size_t k = 0; k < kN; ++k) offset[k] = 1e6 * static_cast<double>(k + 1);
  for (auto& p : far.first) p += offset;
  for (auto& p : far.second) p -= offset;
  const auto result = TypeParam::estimate(far, optionsWith(0.5));
  ASSERT_TRUE(result.ok()) << result.message;
  EXPECT_LT(result.rms, 1e-6);
  for (std::size_t i = 0; i < 100; ++i) {
    if (pairs.is_inlier[i] == 0) continue;
    EXPECT_LT((TypeParam::apply(result.model, far.first[i]) - far.second[i]).norm(), 1e-6);
  }
}

TYPED_TEST(EstimateMaps, SayWhenPointsAreDegenerate) {
  std::mt19937 generator(10);
  constexpr std::size_t kN = TypeParam::kPoint;
  for (const double noise : {0.0, 0.3}) {
    for (int trial = 0; trial < 5; ++trial) {
      typename TypeParam::Model truth;
      auto pairs = makePairsOf<TypeParam>(generator, {100, 0, noise}, truth);
      const auto direction = randomPoint<kN>(generator, -1, 1);
      for (std::size_t i = 0; i < 100; ++i) {  // on a line, some nowhere
        for (std::size_t k = 0; k < kN; ++k) {
          pairs.first[i][k] = 250 + 200 * direction[k] * (static_cast<double>(i) / 50 - 1);
        }
        pairs.second[i] = TypeParam::apply(truth, pairs.first[i]) +
                          noise * gslam::randomNormal<double, kN>(generator);
        if (i % 4 == 0 && noise > 0) {
          pairs.first[i] = randomPoint<kN>(generator, 0, 500);
          pairs.second[i] = randomPoint<kN>(generator, 0, 500);
        }
        if (noise > 0) pairs.first[i] += 0.1 * gslam::randomNormal<double, kN>(generator);
      }
      const auto line = TypeParam::estimate(pairs, optionsWith(3));
      EXPECT_FALSE(line.ok()) << line.message;
      if (noise == 0) {
        EXPECT_EQ(EstimateStatus::Degenerate, line.status) << line.message;
        EXPECT_EQ(Degeneracy::Collinear, line.degeneracy);
      }
      for (const double element : line.covariance.values) EXPECT_EQ(0, element);
      for (std::size_t i = 0; i < 100; ++i) {
        pairs.first[i] = pairs.first[0];
        pairs.second[i] = pairs.second[0];
      }
      const auto point = TypeParam::estimate(pairs, optionsWith(3));
      EXPECT_EQ(EstimateStatus::Degenerate, point.status);
      EXPECT_EQ(Degeneracy::Coincident, point.degeneracy);
    }
  }
}

TEST(EstimateMap, AffineMapsOfPlanesInSpaceAreDegenerate) {
  std::mt19937 generator(11);
  for (const double outliers : {0.0, 0.3}) {
    Affine3DCase::Model truth;
    auto pairs = makePairsOf<Affine3DCase>(generator, {150, outliers, 0}, truth);
    for (std::size_t i = 0; i < 150; ++i) {
      if (pairs.is_inlier[i] == 0) continue;
      pairs.first[i][2] = 0.3 * pairs.first[i][0] + 100;
      pairs.second[i] = Affine3DCase::apply(truth, pairs.first[i]) +
                        0.2 * gslam::randomNormal<double, 3>(generator);
    }
    const auto result = Affine3DCase::estimate(pairs, optionsWith(1.5));
    EXPECT_FALSE(result.ok());
    EXPECT_TRUE(outliers > 0 || result.degeneracy == Degeneracy::Planar) << result.message;
    // A plane determines a similarity.
    SimilarityCase::Model similar = SimilarityCase::truth(generator);
    for (std::size_t i = 0; i < 150; ++i) {
      if (pairs.is_inlier[i] != 0) pairs.second[i] = similar * pairs.first[i];
    }
    const auto similarity = SimilarityCase::estimate(pairs, optionsWith(1.5));
    EXPECT_TRUE(similarity.ok()) << similarity.message;
    EXPECT_LT(distanceOf<SimilarityCase>(similarity.model, similar), 1e-6);
  }
}

TEST(EstimateHomography, BetweenCameras) {
  std::mt19937 generator(12);
  const gslam::Camera pinhole =
      gslam::Camera::fromParameters("pinhole", 640, 480, {500, 510, 320, 240});
  const gslam::Camera fisheye = gslam::Camera::fromParameters(
      "kannala_brandt", 512, 512, {190, 191, 255, 257, 0.003, 0.001, 0, 0});
  for (int trial = 0; trial < 20; ++trial) {
    const SO3d rotation = SO3d::exp(0.3 * randomPoint<3>(generator, -1, 1));
    const Vec3d move = randomPoint<3>(generator, -0.3, 0.3);
    // The plane n X = 2 in the first camera.
    const Vec3d n = (Vec3d{{0, 0, 1}} + 0.3 * randomPoint<3>(generator, -1, 1)).normalized();
    const Mat3d truth = rotation.matrix() + outer(move, n) * 0.5;
    std::vector<Vec2d> first, second;
    std::vector<std::uint8_t> is_inlier;
    while (first.size() < 150) {
      const Vec2d pixel = {{gslam::randomUniform(generator, 0.0, 639.0),
                            gslam::randomUniform(generator, 0.0, 479.0)}};
      Vec3d bearing;
      Vec2d seen;
      ASSERT_TRUE(pinhole.unproject(pixel, bearing));
      if (!fisheye.project(truth * bearing, seen)) continue;
      is_inlier.push_back(first.size() % 2 == 0 ? 1 : 0);
      first.push_back(pixel);
      second.push_back(seen + 0.5 * gslam::randomNormal<double, 2>(generator));
      if (is_inlier.back() == 0) second.back() = randomPoint<2>(generator, 0, 511);
    }
    const auto result = gslam::estimateHomography(first, second, pinhole, fisheye);
    ASSERT_TRUE(result.ok()) << result.message;
    EXPECT_EQ(3, result.threshold);
    double squares = 0;
    for (std::size_t i = 0; i < first.size(); ++i) {
      if (is_inlier[i] == 0) continue;
      Vec3d bearing;
      Vec2d by_result, by_truth;
      ASSERT_TRUE(pinhole.unproject(first[i], bearing));
      ASSERT_TRUE(fisheye.project(result.model * bearing, by_result));
      ASSERT_TRUE(fisheye.project(truth * bearing, by_truth));
      squares += (by_result - by_truth).squaredNorm();
      EXPECT_EQ(1, result.inliers[i]);
    }
    EXPECT_LT(std::sqrt(squares / 75), 0.4);
    double norm = 0;
    for (const double value : result.model.values) norm += value * value;
    EXPECT_NEAR(1, norm, 1e-12);
    expectSameEstimate(result, gslam::estimateHomography(first, second, pinhole, fisheye));
  }
  const std::vector<Vec2d> some(10, Vec2d{{1, 2}});
  EXPECT_EQ(EstimateStatus::InvalidInput,
            gslam::estimateHomography(some, some, gslam::Camera(), fisheye).status);
  EXPECT_EQ(EstimateStatus::Degenerate,
            gslam::estimateHomography(some, some, pinhole, fisheye).status);
}

TEST(EstimatePlane, FindsThePlaneWithEveryScoring) {
  std::mt19937 generator(13);
  for (const EstimateScoring scoring : {EstimateScoring::Msac, EstimateScoring::Ransac,
                                        EstimateScoring::Lmeds, EstimateScoring::Magsac}) {
    for (int trial = 0; trial < 10; ++trial) {
      const double outliers = scoring == EstimateScoring::Lmeds ? 0.3 : 0.6;
      const PlaneData data(generator, {300, outliers, 1});
      EstimateOptions options = optionsWith(3);
      options.scoring = scoring;
      const auto result = gslam::estimatePlane(data.points, options);
      ASSERT_TRUE(result.ok()) << result.message;
      EXPECT_GE(result.model[3], 0);
      const Vec3d n = {{result.model[0], result.model[1], result.model[2]}};
      EXPECT_NEAR(1, n.norm(), 1e-12);
      EXPECT_LT((result.model - data.plane).segment<3>(0).norm(), 0.01);
      for (std::size_t i = 0; i < 300; ++i) {
        const double r = std::fabs(n.dot(data.points[i]) + result.model[3]);
        if (std::fabs(r - result.threshold) < 1e-9) continue;
        EXPECT_EQ(r < result.threshold ? 1 : 0, result.inliers[i]);
      }
    }
  }
}

TEST(EstimatePlane, PredictsItsErrors) {
  std::mt19937 generator(14);
  const std::size_t trials = solver_test::instances(300);
  double normalised = 0;
  for (std::size_t trial = 0; trial < trials; ++trial) {
    const PlaneData data(generator, {80, 0.1, 1});
    const auto result = gslam::estimatePlane(data.points, optionsWith(4));
    ASSERT_TRUE(result.ok());
    Vec3d p = randomPoint<3>(generator, 0, 500);
    const Vec3d n = {{data.plane[0], data.plane[1], data.plane[2]}};
    p -= (n.dot(p) + data.plane[3]) * n;  // on the true plane, so this far from the other
    const Vec4d row = {{p[0], p[1], p[2], 1}};
    const double error = row.dot(result.model);
    normalised += error * error / row.dot(result.covariance * row);
  }
  EXPECT_NEAR(1, normalised / static_cast<double>(trials),
              5 / std::sqrt(static_cast<double>(trials)) + 0.05);
}

TEST(EstimatePlane, TakesFloorsAndRefusesLines) {
  std::mt19937 generator(15);
  std::vector<Vec3d> floor, line;
  for (int i = 0; i < 100; ++i) {
    Vec3d p = randomPoint<3>(generator, 0, 10);
    p[2] = 0.01 * gslam::randomNormal<double, 1>(generator)[0];
    floor.push_back(p);
    line.push_back({{p[0], 2 * p[0] + 0.001 * p[1], 3 + p[2] * 0.1}});
  }
  const auto result = gslam::estimatePlane(floor, optionsWith(0.03));
  EXPECT_TRUE(result.ok()) << result.message;
  EXPECT_NEAR(1, std::fabs(result.model[2]), 1e-3);
  const auto refused = gslam::estimatePlane(line, optionsWith(0.03));
  EXPECT_EQ(EstimateStatus::Degenerate, refused.status) << refused.message;
  EXPECT_EQ(Degeneracy::Collinear, refused.degeneracy);
}

TEST(EstimatePlane, FindsNothingInNoise) {
  std::mt19937 generator(16);
  const std::size_t trials = solver_test::instances(50) * (solver_test::instances(1) == 1 ? 1 : 2);
  for (std::size_t trial = 0; trial < trials; ++trial) {
    const PlaneData data(generator, {100, 1.0, 0});
    EstimateOptions options = optionsWith(10);
    options.max_iterations = 1000;
    EXPECT_FALSE(gslam::estimatePlane(data.points, options).ok());
  }
}

}  // namespace
