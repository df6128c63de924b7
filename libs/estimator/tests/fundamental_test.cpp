#include <gslam/base/error.h>
#include <gslam/estimator/solvers/fundamental_7pt.h>
#include <gslam/estimator/solvers/fundamental_8pt.h>
#include <gtest/gtest.h>

#include <Eigen/SVD>

#include "instances.h"
#include "two_views.h"

#ifdef GSLAM_HAS_OPENCV
#include <opencv2/calib3d.hpp>
#endif

namespace {

using gslam::ArgumentError;
using gslam::Span;
using namespace solver_test;  // NOLINT(google-build-using-namespace)

TEST(Fundamental7pt, FindsTheTruthInPixels) {
  std::mt19937 generator(1);
  for (std::size_t i = 0; i < instances(); ++i) {
    const TwoViews views = i % 2 == 0 ? anyTwoViews(generator, 7) : facingTwoViews(generator, 7);
    std::array<Mat3d, 3> found;
    const std::size_t count =
        gslam::fundamental7pt(pixels(views.first), pixels(views.second), found);
    ASSERT_LE(count, 3U);
    std::array<Mat3d, 3> essentials;
    for (std::size_t k = 0; k < count; ++k) {
      ASSERT_NEAR(norm(found[k]), 1, 1e-14);
      essentials[k] = essentialOfPixels(found[k]);
      essentials[k] *= 1 / norm(essentials[k]);
      ASSERT_LT(std::fabs(determinant(essentials[k])), 1e-9);
      ASSERT_LT(epipolarError(essentials[k], views.first, views.second), 1e-9);
    }
    ASSERT_LT(distanceToNearest(essentials, count, views.essential()), 1e-6) << i;
    ASSERT_TRUE(areDistinct(essentials, count)) << i;
  }
}

TEST(Fundamental7pt, GivesOnlyValidSolutions) {
  std::mt19937 generator(2);
  for (int round = 0; round < 20; ++round) {
    for (const auto& odd : oddTwoViews(generator, 7)) {
      const TwoViews& views = odd.second;
      // Normalised points; those of the second view may lie on the border of what has any.
      std::vector<Vec2d> first, second;
      for (std::size_t i = 0; i < 7; ++i) {
        first.push_back({{views.first[i][0], views.first[i][1]}});
        second.push_back({{views.second[i][0], views.second[i][1]}});
      }
      std::array<Mat3d, 3> found;
      const std::size_t count = gslam::fundamental7pt(first, second, found);
      for (std::size_t k = 0; k < count; ++k) {
        ASSERT_NEAR(norm(found[k]), 1, 1e-14) << odd.first;
        ASSERT_LT(std::fabs(determinant(found[k])), 1e-12) << odd.first;
        for (std::size_t i = 0; i < 7; ++i) {
          const Vec3d a = {{first[i][0], first[i][1], 1}}, b = {{second[i][0], second[i][1], 1}};
          ASSERT_LT(std::fabs(b.dot(found[k] * a)), 1e-12) << odd.first;
        }
      }
    }
  }
}

TEST(Fundamental7pt, SurvivesAbsurdNumbers) {
  std::mt19937 generator(3);
  for (const double number : absurdNumbers()) {
    for (std::size_t i = 0; i < 14; ++i) {
      const TwoViews views = anyTwoViews(generator, 7);
      std::vector<Vec2d> first = pixels(views.first);
      first[i / 2][i % 2] = number;
      std::array<Mat3d, 3> found;
      const std::size_t count = gslam::fundamental7pt(first, pixels(views.second), found);
      for (std::size_t k = 0; k < count; ++k) ASSERT_NEAR(norm(found[k]), 1, 1e-14);
      if (!std::isfinite(number)) {
        ASSERT_EQ(count, 0U);
      }
    }
    const std::vector<Vec2d> all(7, Vec2d{{number, number}});
    std::array<Mat3d, 3> found;
    const std::size_t count = gslam::fundamental7pt(all, all, found);
    for (std::size_t k = 0; k < count; ++k) ASSERT_NEAR(norm(found[k]), 1, 1e-14);
  }
}

TEST(Fundamental7pt, RefusesOtherSizes) {
  const std::vector<Vec2d> seven(7, Vec2d{{1, 2}}), eight(8, Vec2d{{1, 2}});
  std::array<Mat3d, 3> found;
  EXPECT_THROW(gslam::fundamental7pt(seven, eight, found), ArgumentError);
  EXPECT_THROW(gslam::fundamental7pt(eight, seven, found), ArgumentError);
}

#ifdef GSLAM_HAS_OPENCV
TEST(Fundamental7pt, AgreesWithOpenCV) {
  std::mt19937 generator(4);
  for (int i = 0; i < 200; ++i) {
    const TwoViews views = facingTwoViews(generator, 7);
    const std::vector<Vec2d> first = pixels(views.first), second = pixels(views.second);
    std::vector<cv::Point2d> a, b;
    for (std::size_t k = 0; k < 7; ++k) {
      a.emplace_back(first[k][0], first[k][1]);
      b.emplace_back(second[k][0], second[k][1]);
    }
    const cv::Mat all = cv::findFundamentalMat(a, b, cv::FM_7POINT);
    std::array<Mat3d, 3> found;
    const std::size_t count = gslam::fundamental7pt(first, second, found);
    for (std::size_t k = 0; k < count; ++k) found[k] = essentialOfPixels(found[k]);
    for (int row = 0; row < all.rows; row += 3) {
      Mat3d other;
      for (int k = 0; k < 9; ++k) other.values[k] = all.at<double>(row + k / 3, k % 3);
      EXPECT_LT(distanceToNearest(found, count, essentialOfPixels(other)), 1e-3) << i;
    }
  }
}
#endif

TEST(Fundamental8pt, FindsTheTruthInPixels) {
  for (const std::size_t points : {8U, 9U, 30U, 200U}) {
    std::mt19937 generator(5);
    for (std::size_t i = 0; i < instances(points == 8 ? 10000 : 300); ++i) {
      const TwoViews views =
          i % 2 == 0 ? anyTwoViews(generator, points) : facingTwoViews(generator, points);
      Mat3d found;
      ASSERT_EQ(gslam::fundamental8pt(pixels(views.first), pixels(views.second), found), 1U);
      ASSERT_NEAR(norm(found), 1, 1e-14);
      ASSERT_LT(distance(essentialOfPixels(found), views.essential()), 1e-6) << points << ' ' << i;
    }
  }
}

// Hartley's algorithm by singular value decompositions.
Mat3d fundamentalByDecomposition(const std::vector<Vec2d>& first,
                                 const std::vector<Vec2d>& second) {
  const auto scaled = [](const std::vector<Vec2d>& points, Eigen::Matrix3d& t) {
    Eigen::Vector2d mean(0, 0);
    for (const Vec2d& p : points) mean += Eigen::Vector2d(p[0], p[1]);
    mean /= static_cast<double>(points.size());
    double far = 0;
    for (const Vec2d& p : points) far += (Eigen::Vector2d(p[0], p[1]) - mean).norm();
    const double s = std::sqrt(2.0) * static_cast<double>(points.size()) / far;
    t << s, 0, -s * mean[0], 0, s, -s * mean[1], 0, 0, 1;
  };
  Eigen::Matrix3d t1, t2;
  scaled(first, t1);
  scaled(second, t2);
  Eigen::MatrixXd a(first.size(), 9);
  for (std::size_t i = 0; i < first.size(); ++i) {
    const Eigen::Vector3d x = t1 * Eigen::Vector3d(first[i][0], first[i][1], 1);
    const Eigen::Vector3d y = t2 * Eigen::Vector3d(second[i][0], second[i][1], 1);
    for (int j = 0; j < 9; ++j) a(static_cast<Eigen::Index>(i), j) = y[j / 3] * x[j % 3];
  }
  const Eigen::JacobiSVD<Eigen::MatrixXd> svd(a, Eigen::ComputeFullV);
  const Eigen::VectorXd v = svd.matrixV().col(8);
  const Eigen::Matrix3d f =
      Eigen::Map<const Eigen::Matrix<double, 3, 3, Eigen::RowMajor>>(v.data());
  const Eigen::JacobiSVD<Eigen::Matrix3d> small(f, Eigen::ComputeFullU | Eigen::ComputeFullV);
  Eigen::Vector3d values = small.singularValues();
  values[2] = 0;
  Mat3d result;
  Eigen::Map<Eigen::Matrix<double, 3, 3, Eigen::RowMajor>>(result.data()) =
      t2.transpose() * small.matrixU() * values.asDiagonal() * small.matrixV().transpose() * t1;
  return result;
}

TEST(Fundamental8pt, IsHartleysSolution) {
  std::mt19937 generator(6);
  for (const std::size_t points : {8U, 9U, 20U, 100U}) {
    for (int i = 0; i < 50; ++i) {
      const TwoViews views = facingTwoViews(generator, points);
      const std::vector<Vec2d> first = pixels(views.first);
      std::vector<Vec2d> second = pixels(views.second);
      for (Vec2d& p : second) p += gslam::randomNormal<double, 2>(generator);
      Mat3d found;
      ASSERT_EQ(gslam::fundamental8pt(first, second, found), 1U);
      const Mat3d expected = fundamentalByDecomposition(first, second);
      ASSERT_LT(distance(essentialOfPixels(found), essentialOfPixels(expected)), 1e-8)
          << points << ' ' << i;
    }
  }
}

TEST(Fundamental8pt, GivesOnlyFiniteMatricesOfRankTwo) {
  std::mt19937 generator(7);
  for (const std::size_t points : {8U, 11U}) {
    for (const auto& odd : oddTwoViews(generator, points)) {
      std::vector<Vec2d> first, second;
      for (std::size_t i = 0; i < points; ++i) {
        first.push_back({{odd.second.first[i][0], odd.second.first[i][1]}});
        second.push_back({{odd.second.second[i][0], odd.second.second[i][1]}});
      }
      Mat3d found;
      if (gslam::fundamental8pt(first, second, found) == 0) continue;
      EXPECT_NEAR(norm(found), 1, 1e-14) << odd.first;
      EXPECT_LT(std::fabs(determinant(found)), 1e-14) << odd.first;
    }
    for (const double number : absurdNumbers()) {
      const TwoViews views = anyTwoViews(generator, points);
      std::vector<Vec2d> first = pixels(views.first);
      first[4][1] = number;
      const Mat3d before = cameraMatrix();
      Mat3d found = before;
      const std::size_t count = gslam::fundamental8pt(first, pixels(views.second), found);
      if (count > 0) {
        EXPECT_NEAR(norm(found), 1, 1e-14) << number;
      } else {
        EXPECT_EQ(norm(found - before), 0) << number;
      }
      if (!std::isfinite(number)) {
        EXPECT_EQ(count, 0U) << number;
      }
    }
  }
  const std::vector<Vec2d> seven(7, Vec2d{{1, 2}}), eight(8, Vec2d{{1, 2}});
  Mat3d found;
  EXPECT_THROW(gslam::fundamental8pt(seven, seven, found), ArgumentError);
  EXPECT_THROW(gslam::fundamental8pt(eight, seven, found), ArgumentError);
}

}  // namespace
