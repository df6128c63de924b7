// Fundamental and essential matrices and relative poses among outliers, end to end.
#include <gslam/estimator/estimate_essential.h>
#include <gslam/estimator/estimate_fundamental.h>
#include <gslam/estimator/estimate_relative_pose.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstring>
#include <limits>
#include <numeric>
#include <string>
#include <vector>

#include "robust_scenes.h"

namespace {

using namespace gslam;        // NOLINT(google-build-using-namespace)
using namespace robust_test;  // NOLINT(google-build-using-namespace)

struct CameraPair {
  std::string name;
  Camera first, second;
};
std::vector<CameraPair> cameraPairs() {
  return {{"pinhole", pinhole(), pinhole()},    {"unequal pinholes", pinhole(), unequalPinhole()},
          {"radtan", radtan(), radtan()},       {"fisheye", fisheye(), fisheye()},
          {"panorama", panorama(), panorama()}, {"pinhole and fisheye", pinhole(), fisheye()}};
}

std::size_t trueInliers(const EstimateSummary& estimate, const std::vector<std::uint8_t>& is_true) {
  std::size_t count = 0;
  for (std::size_t i = 0; i < is_true.size(); ++i) count += is_true[i] != 0 && estimate.inliers[i];
  return count;
}

// Sampson's error of pixels, from the definition with numeric derivatives of the camera.
double sampsonOfPixels(const Mat3d& e, const Camera& first_camera, const Camera& second_camera,
                       const Vec2d& first, const Vec2d& second) {
  Vec3d a, b;
  if (!first_camera.unproject(first, a) || !second_camera.unproject(second, b)) return 1e9;
  double square = 0;
  for (std::size_t k = 0; k < 2; ++k) {
    const double step = 1e-4;
    Vec2d more = first, less = first;
    more[k] += step, less[k] -= step;
    Vec3d x = a, y = a;
    first_camera.unproject(more, x), first_camera.unproject(less, y);
    const double by_first = b.dot(e * (x - y)) / (2 * step);
    more = less = second;
    more[k] += step, less[k] -= step;
    x = y = b;
    second_camera.unproject(more, x), second_camera.unproject(less, y);
    const double by_second = (x - y).dot(e * a) / (2 * step);
    square += by_first * by_first + by_second * by_second;
  }
  return std::abs(b.dot(e * a)) / std::sqrt(square);
}

TEST(EstimateRelativePoseTest, FindsThePoseForAllCameras) {
  for (const CameraPair& pair : cameraPairs()) {
    Generator generator(1);
    for (int trial = 0; trial < trials(5); ++trial) {
      const MatchedPixels views =
          makeMatchedPixels(generator, pair.first, pair.second, SceneRecipe());
      EstimateOptions options;
      options.threshold = 3;
      const RelativePoseEstimate found =
          estimateRelativePose(views.first, views.second, pair.first, pair.second, options);
      ASSERT_EQ(found.status, EstimateStatus::Ok) << pair.name << ' ' << found.message;
      EXPECT_EQ(found.degeneracy, Degeneracy::None) << pair.name;
      EXPECT_LT(rotationError(found.model, views.T_second_first), 1.5 * kDegree) << pair.name;
      EXPECT_LT(directionError(found.model, views.T_second_first), 7 * kDegree) << pair.name;
      EXPECT_NEAR(found.model.translation().norm(), 1, 1e-12);
      EXPECT_GT(trueInliers(found, views.is_true), 90u);
      EXPECT_LT(found.inlier_count, 112u);
    }
  }
}

TEST(EstimateRelativePoseTest, FindsThePoseOfBearings) {
  Generator generator(2);
  for (const Camera& camera : {pinhole(), fisheye(), panorama()}) {
    const MatchedPixels views = makeMatchedPixels(generator, camera, camera, SceneRecipe());
    const std::vector<Vec3d> first = bearingsOf(camera, views.first);
    std::vector<Vec3d> second = bearingsOf(camera, views.second);
    for (Vec3d& b : second) b *= 7;  // any length
    EstimateOptions options;
    options.threshold = 0.01;
    const RelativePoseEstimate found = estimateRelativePose(first, second, options);
    ASSERT_EQ(found.status, EstimateStatus::Ok) << found.message;
    EXPECT_LT(rotationError(found.model, views.T_second_first), 2 * kDegree);
    EXPECT_LT(directionError(found.model, views.T_second_first), 8 * kDegree);
  }
}

TEST(EstimateRelativePoseTest, IsExactWithoutNoise) {
  SceneRecipe scene;
  scene.sigma = 0;
  for (const CameraPair& pair : cameraPairs()) {
    Generator generator(3);
    const MatchedPixels views = makeMatchedPixels(generator, pair.first, pair.second, scene);
    EstimateOptions options;
    options.threshold = 0.1;
    const RelativePoseEstimate found =
        estimateRelativePose(views.first, views.second, pair.first, pair.second, options);
    ASSERT_TRUE(found.ok()) << pair.name << found.message;
    // A few outliers may be within the threshold.
    EXPECT_LT(rotationError(found.model, views.T_second_first), 1e-3) << pair.name;
    EXPECT_EQ(trueInliers(found, views.is_true), 100u) << pair.name;
  }
}

TEST(EstimateRelativePoseTest, MaskIsThatOfTheReturnedModel) {
  for (const CameraPair& pair : cameraPairs()) {
    Generator generator(4);
    const MatchedPixels views =
        makeMatchedPixels(generator, pair.first, pair.second, SceneRecipe());
    const RelativePoseEstimate found =
        estimateRelativePose(views.first, views.second, pair.first, pair.second);
    ASSERT_TRUE(found.ok());
    EXPECT_EQ(found.threshold, kRelativePosePixelThreshold);
    const Mat3d e = SO3d::hat(found.model.translation()) * found.model.rotation().matrix();
    std::size_t count = 0;
    double sum = 0;
    for (std::size_t i = 0; i < views.first.size(); ++i) {
      const double residual =
          sampsonOfPixels(e, pair.first, pair.second, views.first[i], views.second[i]);
      if (found.inliers[i] != 0) {
        EXPECT_LT(residual, found.threshold + 1e-3);
        ++count;
        sum += residual * residual;
      } else if (residual < found.threshold - 1e-3) {  // behind a camera
        Vec3d a, b;
        pair.first.unproject(views.first[i], a);
        pair.second.unproject(views.second[i], b);
        const Vec3d turned = found.model.rotation() * a;
        const Vec3d across = turned.cross(b);
        EXPECT_FALSE(across.dot(b.cross(found.model.translation())) > 0 &&
                     across.dot(turned.cross(found.model.translation())) > 0);
      }
    }
    EXPECT_EQ(count, found.inlier_count);
    EXPECT_NEAR(found.rms, std::sqrt(sum / static_cast<double>(count)), 1e-3);
  }
}

TEST(EstimateEssentialTest, IsThatOfTheRelativePose) {
  Generator generator(5);
  const MatchedPixels views = makeMatchedPixels(generator, radtan(), radtan(), SceneRecipe());
  const RelativePoseEstimate pose =
      estimateRelativePose(views.first, views.second, radtan(), radtan());
  const EssentialEstimate essential =
      estimateEssential(views.first, views.second, radtan(), radtan());
  ASSERT_TRUE(pose.ok() && essential.ok());
  const Mat3d e = SO3d::hat(pose.model.translation()) * pose.model.rotation().matrix();
  for (std::size_t k = 0; k < 9; ++k) EXPECT_NEAR(essential.model.values[k], e.values[k], 1e-12);
  EXPECT_EQ(essential.inliers, pose.inliers);
  for (std::size_t k = 0; k < 9; ++k) EXPECT_GE(essential.covariance(k, k), 0);
  const EssentialEstimate bearings =
      estimateEssential(bearingsOf(radtan(), views.first), bearingsOf(radtan(), views.second));
  EXPECT_TRUE(bearings.ok());
}

TEST(EstimateRelativePoseTest, FlagsPureRotation) {
  SceneRecipe scene;
  scene.baseline = 0;
  int flagged = 0, wrong = 0;
  const int count = trials(20);
  for (const Camera& camera : {pinhole(), fisheye()}) {
    Generator generator(6);
    for (int trial = 0; trial < count; ++trial) {
      const MatchedPixels views = makeMatchedPixels(generator, camera, camera, scene);
      const RelativePoseEstimate found =
          estimateRelativePose(views.first, views.second, camera, camera);
      wrong += found.ok();
      if (found.degeneracy != Degeneracy::PureRotation) continue;
      ++flagged;
      EXPECT_EQ(found.status, EstimateStatus::Degenerate);
      EXPECT_EQ(found.covariance(0, 0), 0);
      EXPECT_LT(rotationError(found.model, views.T_second_first), 0.5 * kDegree);
    }
  }
  EXPECT_GE(flagged, 2 * count * 95 / 100);
  EXPECT_LE(wrong, 2 * count / 100);
}

TEST(EstimateRelativePoseTest, FindsBothPosesOfAPlane) {
  SceneRecipe scene;
  scene.planar = 1;
  scene.outliers = 0.3;
  const int count = trials(40);
  int right = 0, planar = 0;
  Generator generator(7);
  for (int trial = 0; trial < count; ++trial) {
    const MatchedPixels views = makeMatchedPixels(generator, pinhole(), pinhole(), scene);
    const RelativePoseEstimate found =
        estimateRelativePose(views.first, views.second, pinhole(), pinhole());
    planar += found.degeneracy == Degeneracy::Planar;
    const auto isRight = [&](const SE3d& pose) {
      return rotationError(pose, views.T_second_first) < 1 * kDegree &&
             directionError(pose, views.T_second_first) < 5 * kDegree;
    };
    right +=
        found.ok() && (isRight(found.model) || (found.alternative && isRight(*found.alternative)));
  }
  EXPECT_GE(planar, count * 95 / 100);
  EXPECT_GE(right, count * 90 / 100);
}

TEST(EstimateFundamentalTest, FindsTheMatrix) {
  Generator generator(8);
  for (int trial = 0; trial < trials(5); ++trial) {
    const Camera a = pinhole(), b = unequalPinhole();
    const MatchedPixels views = makeMatchedPixels(generator, a, b, SceneRecipe());
    EstimateOptions options;
    options.threshold = 3;
    const FundamentalEstimate found = estimateFundamental(views.first, views.second, options);
    ASSERT_EQ(found.status, EstimateStatus::Ok) << found.message;
    EXPECT_EQ(found.degeneracy, Degeneracy::None);
    EXPECT_GE(trueInliers(found, views.is_true), 90u);
    const Mat3d& f = found.model;
    double square = 0;
    for (const double x : f.values) square += x * x;
    EXPECT_NEAR(square, 1, 1e-12);
    EXPECT_NEAR(f.row(0).dot(f.row(1).cross(f.row(2))), 0, 1e-15);
    for (std::size_t i = 0; i < views.first.size(); ++i) {  // the mask, from the definition
      const Vec3d x = {views.first[i][0], views.first[i][1], 1};
      const Vec3d y = {views.second[i][0], views.second[i][1], 1};
      const Vec3d n = f * x, m = f.transpose() * y;
      const double residual =
          std::abs(y.dot(n)) / std::sqrt(n[0] * n[0] + n[1] * n[1] + m[0] * m[0] + m[1] * m[1]);
      if (std::abs(residual - 3) < 1e-6) continue;
      EXPECT_EQ(found.inliers[i] != 0, residual < 3) << i;
    }
  }
}

TEST(EstimateFundamentalTest, SeesPlanesAndTurns) {
  const int count = trials(10);
  Generator generator(9);
  for (int trial = 0; trial < count; ++trial) {
    SceneRecipe scene;
    scene.outliers = 0.3;
    scene.planar = 1;
    MatchedPixels views = makeMatchedPixels(generator, pinhole(), pinhole(), scene);
    FundamentalEstimate found = estimateFundamental(views.first, views.second);
    EXPECT_EQ(found.status, EstimateStatus::Degenerate) << found.message;
    EXPECT_EQ(found.degeneracy, Degeneracy::Planar);
    scene.planar = 0;
    scene.baseline = 0;
    views = makeMatchedPixels(generator, pinhole(), pinhole(), scene);
    found = estimateFundamental(views.first, views.second);
    EXPECT_EQ(found.degeneracy, Degeneracy::Planar);
  }
}

TEST(EstimateFundamentalTest, FindsTheMatrixOfADominantPlane) {
  SceneRecipe scene;
  scene.count = 300;
  scene.outliers = 0.3;
  scene.planar = 0.8;
  const int count = trials(20);
  int right = 0;
  Generator generator(10);
  for (int trial = 0; trial < count; ++trial) {
    const MatchedPixels views = makeMatchedPixels(generator, pinhole(), pinhole(), scene);
    const FundamentalEstimate found = estimateFundamental(views.first, views.second);
    std::size_t off_plane = 0;  // the last true ones
    for (std::size_t i = 168; i < 210; ++i) off_plane += found.inliers[i];
    right += found.ok() && off_plane >= 30;
  }
  EXPECT_GE(right, count * 95 / 100);
}

// Covariances against many draws of the noise.
TEST(EstimateRelativePoseTest, CovarianceIsThatOfManyTrials) {
  SceneRecipe scene;
  scene.outliers = 0;
  scene.sigma = 0;
  for (const Camera& camera : {pinhole(), fisheye()}) {
    Generator generator(11);
    const MatchedPixels clean = makeMatchedPixels(generator, camera, camera, scene);
    EstimateOptions options;
    options.threshold = 5;
    Vec<double, 6> squares{}, predicted{};
    const int count = 100;
    SE3d truth = clean.T_second_first;
    truth.setTranslation(truth.translation().normalized());
    for (int trial = 0; trial < count; ++trial) {
      MatchedPixels views = clean;
      for (Vec2d& p : views.first) p += noise(generator, 1);
      for (Vec2d& p : views.second) p += noise(generator, 1);
      const RelativePoseEstimate found =
          estimateRelativePose(views.first, views.second, camera, camera, options);
      ASSERT_TRUE(found.ok());
      const SE3d::Tangent error = (truth.inverse() * found.model).log();
      for (std::size_t k = 0; k < 6; ++k) {
        squares[k] += error[k] * error[k] / count;
        predicted[k] += found.covariance(k, k) / count;
      }
    }
    for (std::size_t k = 0; k < 6; ++k) {
      EXPECT_LT(squares[k], 2 * predicted[k] + 1e-12) << camera.modelName() << k;
      EXPECT_GT(squares[k], predicted[k] / 2 - 1e-12) << camera.modelName() << k;
    }
  }
}

TEST(EstimateFundamentalTest, CovarianceIsThatOfManyTrials) {
  SceneRecipe scene;
  scene.outliers = 0;
  scene.sigma = 0;
  Generator generator(12);
  const MatchedPixels clean = makeMatchedPixels(generator, pinhole(), pinhole(), scene);
  EstimateOptions options;
  options.threshold = 5;
  const Mat3d truth = estimateFundamental(clean.first, clean.second, options).model;
  Vec<double, 9> squares{}, predicted{};
  const int count = 100;
  for (int trial = 0; trial < count; ++trial) {
    MatchedPixels views = clean;
    for (Vec2d& p : views.first) p += noise(generator, 0.3);
    for (Vec2d& p : views.second) p += noise(generator, 0.3);
    const FundamentalEstimate found = estimateFundamental(views.first, views.second, options);
    ASSERT_TRUE(found.ok());
    double along = 0;
    for (std::size_t k = 0; k < 9; ++k) along += truth.values[k] * found.model.values[k];
    for (std::size_t k = 0; k < 9; ++k) {
      const double error = std::copysign(1, along) * found.model.values[k] - truth.values[k];
      squares[k] += error * error / count;
      predicted[k] += found.covariance(k, k) / count;
    }
  }
  for (std::size_t k = 0; k < 9; ++k) {
    EXPECT_LT(squares[k], 2 * predicted[k]) << k;
    EXPECT_GT(squares[k], predicted[k] / 2) << k;
  }
}

// Few iterations at many outliers: whatever is found, nothing wrong is Ok.
TEST(EstimateTwoViewsTest, NeverCallsAWrongModelOk) {
  EstimateOptions options;
  options.max_iterations = 200;
  for (const double outliers : {0.9, 1.0}) {
    Generator generator(13);
    SceneRecipe scene;
    scene.outliers = outliers;
    for (int trial = 0; trial < trials(50); ++trial) {
      const MatchedPixels views = makeMatchedPixels(generator, pinhole(), pinhole(), scene);
      const RelativePoseEstimate pose =
          estimateRelativePose(views.first, views.second, pinhole(), pinhole(), options);
      EXPECT_FALSE(pose.ok() && trueInliers(pose, views.is_true) < 15) << pose.message;
      const FundamentalEstimate f = estimateFundamental(views.first, views.second, options);
      EXPECT_FALSE(f.ok() && trueInliers(f, views.is_true) < 15) << f.message;
    }
  }
}

TEST(EstimateTwoViewsTest, ThreadsAndOrderDoNotMatter) {
  Generator generator(14);
  SceneRecipe scene;
  scene.outliers = 0.4;
  scene.sigma = 0.3;
  const MatchedPixels views = makeMatchedPixels(generator, radtan(), radtan(), scene);
  EstimateOptions options;
  const RelativePoseEstimate one =
      estimateRelativePose(views.first, views.second, radtan(), radtan(), options);
  options.threads = 4;
  const RelativePoseEstimate four =
      estimateRelativePose(views.first, views.second, radtan(), radtan(), options);
  ASSERT_TRUE(one.ok());
  EXPECT_EQ(std::memcmp(one.model.data(), four.model.data(), 7 * sizeof(double)), 0);
  EXPECT_EQ(one.inliers, four.inliers);
  EXPECT_EQ(one.iterations, four.iterations);
  std::vector<std::size_t> order(views.first.size());
  std::iota(order.begin(), order.end(), std::size_t{0});
  std::shuffle(order.begin(), order.end(), generator);
  MatchedPixels shuffled = views;
  for (std::size_t i = 0; i < order.size(); ++i) {
    shuffled.first[i] = views.first[order[i]];
    shuffled.second[i] = views.second[order[i]];
  }
  const RelativePoseEstimate other =
      estimateRelativePose(shuffled.first, shuffled.second, radtan(), radtan());
  for (std::size_t i = 0; i < order.size(); ++i) {
    EXPECT_EQ(other.inliers[i], one.inliers[order[i]]) << i;
  }
}

TEST(EstimateTwoViewsTest, AnswersBadInputWithAStatus) {
  std::vector<Vec2d> few(4), seven(7), eight(8);
  EXPECT_EQ(estimateFundamental(few, few).status, EstimateStatus::TooFewPoints);
  EXPECT_EQ(estimateFundamental(seven, eight).status, EstimateStatus::InvalidInput);
  EXPECT_EQ(estimateRelativePose(few, few, pinhole(), pinhole()).status,
            EstimateStatus::TooFewPoints);
  EXPECT_EQ(estimateRelativePose(seven, seven, pinhole(), Camera()).status,
            EstimateStatus::InvalidInput);
  std::vector<Vec3d> bearings(9, Vec3d{0, 0, 1});
  EXPECT_FALSE(estimateRelativePose(bearings, bearings).ok());
  bearings[4] = {0, 0, 0};
  EXPECT_EQ(estimateRelativePose(bearings, bearings).status, EstimateStatus::InvalidInput);
  eight[3][1] = std::nan("");
  EXPECT_EQ(estimateFundamental(eight, eight).status, EstimateStatus::InvalidInput);
  // All at one place, or the same in both views.
  EXPECT_FALSE(estimateFundamental(seven, seven).ok());
  Generator generator(15);
  std::vector<Vec2d> same(50);
  for (Vec2d& p : same) p = uniformPixel(generator, pinhole());
  EXPECT_FALSE(estimateFundamental(same, same).ok());
  EXPECT_FALSE(estimateRelativePose(same, same, pinhole(), pinhole()).ok());
  EstimateOptions options;
  options.threshold = -1;
  EXPECT_EQ(estimateFundamental(same, same, options).status, EstimateStatus::InvalidInput);
}

TEST(EstimateRelativePoseTest, PixelsWithoutBearingsAreOutliers) {
  Generator generator(16);
  const Camera camera =
      Camera::fromParameters("double_sphere", 640, 480, {300, 300, 319.5, 239.5, -0.2, 0.7});
  MatchedPixels views = makeMatchedPixels(generator, camera, camera, SceneRecipe());
  Vec3d unused;
  ASSERT_FALSE(camera.unproject({1e6, 1e6}, unused));
  for (std::size_t i = 0; i < 200; i += 20) views.first[i] = {1e6, 1e6};
  const RelativePoseEstimate found =
      estimateRelativePose(views.first, views.second, camera, camera);
  ASSERT_TRUE(found.ok()) << found.message;
  ASSERT_EQ(found.inliers.size(), 200u);
  for (std::size_t i = 0; i < 200; i += 20) EXPECT_EQ(found.inliers[i], 0);
  EXPECT_NEAR(found.inlier_ratio, static_cast<double>(found.inlier_count) / 200, 1e-12);
  EXPECT_GT(trueInliers(found, views.is_true), 80u);
}

}  // namespace
