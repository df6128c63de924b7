// What must not be called certain: short baselines, planes seen twice, targets seen from afar.
#include <gslam/estimator/estimate_absolute_pose.h>
#include <gslam/estimator/estimate_relative_pose.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <vector>

#include "robust/examination.h"
#include "robust/stopping.h"
#include "robust/translation_survey.h"
#include "robust_scenes.h"

namespace {

using namespace gslam;        // NOLINT(google-build-using-namespace)
using namespace robust_test;  // NOLINT(google-build-using-namespace)

double leastDirectionError(const RelativePoseEstimate& found, const SE3d& truth) {
  const double error = directionError(found.model, truth);
  return found.alternative ? std::min(error, directionError(*found.alternative, truth)) : error;
}

// Probability of fewer than `wanted` successes.
double probabilityOfFewer(std::size_t wanted, std::size_t draws, double success) {
  double sum = 0;
  for (std::size_t k = 0; k < wanted && k <= draws; ++k) {
    const double n = static_cast<double>(draws), i = static_cast<double>(k);
    sum += std::exp(std::lgamma(n + 1) - std::lgamma(i + 1) - std::lgamma(n - i + 1) +
                    i * std::log(success) + (n - i) * std::log1p(-success));
  }
  return sum;
}

TEST(SamplesNeededTest, AreEnoughForAsManyGoodSamplesAsWanted) {
  for (const std::size_t inliers : std::initializer_list<std::size_t>{30, 60, 100, 150, 195}) {
    double good = 1;
    for (std::size_t i = 0; i < 5; ++i) {
      good *= static_cast<double>(inliers - i) / static_cast<double>(200 - i);
    }
    for (const double confidence : {0.5, 0.99, 0.999, 1 - 1e-9}) {
      double fewer = 0;
      for (const std::size_t wanted : std::initializer_list<std::size_t>{1, 2, 3, 8}) {
        const double needed = detail::samplesNeeded(inliers, 200, 5, confidence, wanted);
        const auto draws = static_cast<std::size_t>(needed);
        EXPECT_LE(probabilityOfFewer(wanted, draws, good), (1 - confidence) * (1 + 1e-6));
        // No more than a few too many.
        const auto less = static_cast<std::size_t>(std::max(0.0, 0.9 * needed - 10));
        EXPECT_GT(probabilityOfFewer(wanted, less, good), 1 - confidence);
        EXPECT_GT(needed, fewer);
        fewer = needed;
      }
    }
  }
}

TEST(CutOffFactorTest, IsThatOfNormalNoise) {
  for (const double k : {1.5, 2.0, 2.5, 3.0, 5.0}) {
    // By the trapezium rule: P(|x| < k), E[x^2; |x| < k], and the density at k.
    double within = 0, squares = 0;
    const int steps = 20000;
    for (int i = 0; i <= steps; ++i) {
      const double x = k * (2.0 * i / steps - 1);
      const double density = std::exp(-0.5 * x * x) / std::sqrt(2 * 3.14159265358979323846);
      const double weight = (i == 0 || i == steps ? 0.5 : 1) * 2 * k / steps;
      within += weight * density;
      squares += weight * density * x * x;
    }
    const double at_end = std::exp(-0.5 * k * k) / std::sqrt(2 * 3.14159265358979323846);
    const double slope = within - 2 * k * at_end;  // derivative of the mean of what is kept
    const double asymptotic = squares / (slope * slope);
    const double naive = squares / within / within;
    EXPECT_NEAR(detail::cutOffFactor(squares / within / (k * k)), asymptotic / naive, 1e-4) << k;
  }
}

TEST(WithoutChanceParallaxTest, KeepsWhatMovesLikeTheOthers) {
  Generator generator(5);
  SceneRecipe scene;
  scene.baseline = 0.2;
  std::size_t lost = 0, wrong = 0;
  for (int trial = 0; trial < 20; ++trial) {
    const MatchedPixels views = makeMatchedPixels(generator, pinhole(), pinhole(), scene);
    const detail::RandomOrder order = detail::randomOrder(scene.count, 3);
    const auto matches = detail::EpipolarMatches::fromPinholes(views.first, views.second, pinhole(),
                                                               pinhole(), order);
    const detail::EssentialProblem problem(matches, 3);
    const auto model = detail::EssentialProblem::modelOf(views.T_second_first.rotation(),
                                                         views.T_second_first.translation());
    std::vector<double> squared(scene.count);
    problem.exactSquaredResiduals(model, squared.data());
    std::vector<std::uint8_t> inliers(scene.count);
    for (std::size_t i = 0; i < scene.count; ++i) inliers[i] = squared[i] <= 9;
    std::size_t kept_true = 0, kept_wrong = 0;
    for (const std::uint32_t i : detail::withoutChanceParallax(
             matches, views.T_second_first.rotation(), inliers.data(), problem.chance(3))) {
      ++(views.is_true[order[i]] != 0 ? kept_true : kept_wrong);
    }
    lost += 100 - kept_true;
    wrong += kept_wrong;
  }
  EXPECT_LT(lost, 20u);
  EXPECT_LT(wrong, 60u);
}

TEST(ShortBaselineTest, IsNotOkAndWrong) {
  for (const double baseline : {0.1, 0.15, 0.2}) {
    Generator generator(11);
    SceneRecipe scene;
    scene.baseline = baseline;
    int ok = 0, wrong = 0, beyond = 0;
    const int count = trials(60);
    for (int trial = 0; trial < count; ++trial) {
      const MatchedPixels views = makeMatchedPixels(generator, pinhole(), pinhole(), scene);
      EstimateOptions options;
      options.threshold = 3;
      const RelativePoseEstimate found =
          estimateRelativePose(views.first, views.second, pinhole(), pinhole(), options);
      if (!found.ok()) continue;
      ++ok;
      const double error = leastDirectionError(found, views.T_second_first);
      const double sigma =
          std::sqrt(found.covariance(0, 0) + found.covariance(1, 1) + found.covariance(2, 2));
      wrong += error > 15 * kDegree;
      beyond += error > 4 * sigma;
    }
    EXPECT_LE(wrong, count / 60) << baseline;
    EXPECT_LE(beyond, 1 + count / 20) << baseline;
    if (baseline > 0.19) {
      EXPECT_GT(ok, count / 2);
    }
  }
}

TEST(PlaneSeenTwiceTest, OneOfTheTwoPosesIsRight) {
  Generator generator(12);
  SceneRecipe scene;
  scene.outliers = 0.3;
  scene.planar = 1;
  int ok = 0, wrong = 0;
  const int count = trials(60);
  for (int trial = 0; trial < count; ++trial) {
    const MatchedPixels views = makeMatchedPixels(generator, pinhole(), pinhole(), scene);
    EstimateOptions options;
    options.threshold = 3;
    const RelativePoseEstimate found =
        estimateRelativePose(views.first, views.second, pinhole(), pinhole(), options);
    ok += found.ok();
    wrong += found.ok() && leastDirectionError(found, views.T_second_first) > 15 * kDegree;
    if (found.alternative) {
      EXPECT_GT(directionError(*found.alternative, found.model) +
                    rotationError(*found.alternative, found.model),
                0.1 * kDegree);
    }
  }
  EXPECT_GE(ok, count * 9 / 10);
  EXPECT_LE(wrong, count / 60);
}

TEST(TwoViewsTest, EndInNoLocalOptimum) {
  Generator generator(13);
  int wrong = 0;
  const int count = trials(150);
  for (int trial = 0; trial < count; ++trial) {
    const MatchedPixels views = makeMatchedPixels(generator, pinhole(), pinhole(), SceneRecipe());
    EstimateOptions options;
    options.threshold = 3;
    options.seed = static_cast<std::uint64_t>(trial);
    const RelativePoseEstimate found =
        estimateRelativePose(views.first, views.second, pinhole(), pinhole(), options);
    ASSERT_TRUE(found.ok()) << found.message;
    const double sigma =
        std::sqrt(found.covariance(0, 0) + found.covariance(1, 1) + found.covariance(2, 2));
    wrong += directionError(found.model, views.T_second_first) > 4 * sigma;
  }
  EXPECT_LE(wrong, count / 75);
}

TEST(PlanarTargetTest, MirroredPoseIsTheAlternative) {
  Generator generator(14);
  int wrong = 0, ambiguous = 0;
  const int count = trials(100);
  for (int trial = 0; trial < count; ++trial) {
    const SE3d T_camera_target(
        SO3d::exp(0.8 * randomDirection<double>(generator)),
        {randomUniform<double>(generator, -1, 1), randomUniform<double>(generator, -1, 1), 5});
    const SE3d T_world_target = randomOf<SE3d>(generator, 5.0);
    std::vector<Vec2d> pixels(50);
    std::vector<Vec3d> points(50);
    for (std::size_t i = 0; i < points.size(); ++i) {
      const Vec3d on_target = {randomUniform<double>(generator, -0.2, 0.2),
                               randomUniform<double>(generator, -0.2, 0.2), 0};
      ASSERT_TRUE(pinhole().project(T_camera_target * on_target, pixels[i]));
      pixels[i] += noise(generator, 1);
      points[i] = T_world_target * on_target;
    }
    const AbsolutePoseEstimate found = estimateAbsolutePose(pixels, pinhole(), points);
    ASSERT_NE(found.status, EstimateStatus::NoConsensus) << found.message;
    if (!found.ok()) continue;
    const SE3d truth = T_world_target * T_camera_target.inverse();
    double error = rotationError(found.model, truth);
    if (found.alternative) {
      ++ambiguous;
      EXPECT_EQ(found.degeneracy, Degeneracy::Planar);
      EXPECT_GT(rotationError(found.model, *found.alternative), 0.02);
      error = std::min(error, rotationError(*found.alternative, truth));
    }
    const double sigma =
        std::sqrt(found.covariance(3, 3) + found.covariance(4, 4) + found.covariance(5, 5));
    wrong += error > 0.1 && error > 5 * sigma;
  }
  EXPECT_LE(wrong, count / 100);
  EXPECT_GT(ambiguous, count / 10);
}

TEST(PanoramaTest, HasNoEdge) {
  Generator generator(15);
  const Camera camera = panorama();
  const double width = camera.width();
  const SE3d T_world_camera = randomOf<SE3d>(generator, 5.0);
  std::vector<Vec2d> pixels(60);
  std::vector<Vec3d> points(60);
  for (std::size_t i = 0; i < pixels.size(); ++i) {
    pixels[i] = {-0.5 + 0.01 * randomUniform<double>(generator, 0, 1),
                 randomUniform<double>(generator, 100, 400)};
    Vec3d bearing;
    ASSERT_TRUE(camera.unproject(pixels[i], bearing));
    points[i] = T_world_camera * (randomUniform<double>(generator, 3, 9) * bearing);
    pixels[i] = pixels[i] + noise(generator, 0.5);
    if (pixels[i][0] < -0.5) pixels[i][0] += width;
    if (i % 2 == 0) {  // others elsewhere, so that the pose is determined
      pixels[i] = uniformPixel(generator, camera);
      ASSERT_TRUE(camera.unproject(pixels[i], bearing));
      points[i] = T_world_camera * (randomUniform<double>(generator, 3, 9) * bearing);
    }
  }
  const AbsolutePoseEstimate found = estimateAbsolutePose(pixels, camera, points);
  ASSERT_TRUE(found.ok()) << found.message;
  EXPECT_GE(found.inlier_count, 59u);
}

}  // namespace
