#include <gslam/base/error.h>
#include <gslam/estimator/solvers/decompose_essential.h>
#include <gslam/estimator/solvers/essential_5pt.h>
#include <gslam/estimator/solvers/rotation_5pt_kneip.h>
#include <gtest/gtest.h>

#include <Eigen/Eigenvalues>

#include "instances.h"
#include "math/real_eigen.h"
#include "two_views.h"

namespace {

using gslam::ArgumentError;
using gslam::Span;
using namespace solver_test;  // NOLINT(google-build-using-namespace)

double angleToNearest(const std::array<SO3d, 20>& found, std::size_t count, const SO3d& truth) {
  double least = std::numeric_limits<double>::infinity();
  for (std::size_t i = 0; i < count; ++i) {
    least = std::min(least, (found[i].inverse() * truth).angle());
  }
  return least;
}

// How far the normals of the epipolar planes are from one plane: the least singular value of the
// matrix of the normals as a part of the second.
double coplanarity(const SO3d& rotation, const TwoViews& views) {
  Eigen::Matrix<double, 3, 5> normals;
  for (int i = 0; i < 5; ++i) {
    const std::size_t k = static_cast<std::size_t>(i);
    const Vec3d n = (rotation * views.first[k]).cross(views.second[k]);
    normals.col(i) << n[0], n[1], n[2];
  }
  const Eigen::JacobiSVD<Eigen::Matrix<double, 3, 5>> svd(normals);
  return svd.singularValues()[2] / std::max(svd.singularValues()[1], 1e-3);
}

TEST(Rotation5ptKneip, FindsTheTruth) {
  std::mt19937 generator(1);
  const std::size_t all = instances(5000);
  std::size_t lost = 0;
  for (std::size_t i = 0; i < all; ++i) {
    const TwoViews views = anyTwoViews(generator, 5);
    std::array<SO3d, 20> found;
    const std::size_t count = gslam::rotation5ptKneip(views.first, views.second, found);
    ASSERT_LE(count, 20U);
    ASSERT_EQ(count % 2, 0U);
    if (!(angleToNearest(found, count, views.T_second_first.rotation()) < 1e-6)) ++lost;
    for (std::size_t k = 0; k < count; ++k) {
      ASSERT_LT(coplanarity(found[k], views), 1e-10) << i;
      ASSERT_GT(angleToNearest(found, k, found[k]), 1e-9) << i;
    }
  }
  EXPECT_LE(static_cast<double>(lost), 0.001 * static_cast<double>(all));
}

// Another algorithm for the same rotations.
TEST(Rotation5ptKneip, FindsThoseOfTheEssentialMatrices) {
  std::mt19937 generator(2);
  std::size_t missed = 0;
  for (std::size_t i = 0; i < instances(500); ++i) {
    const TwoViews views = facingTwoViews(generator, 5);
    std::array<SO3d, 20> found;
    const std::size_t count = gslam::rotation5ptKneip(views.first, views.second, found);
    std::array<Mat3d, 10> essentials;
    const std::size_t others = gslam::essential5pt(views.first, views.second, essentials);
    for (std::size_t k = 0; k < others; ++k) {
      std::array<SE3d, 4> poses;
      ASSERT_EQ(gslam::decomposeEssential(essentials[k], poses), 4U);
      for (const SE3d& pose : poses) {
        missed += angleToNearest(found, count, pose.rotation()) < 1e-5 ? 0 : 1;
      }
    }
  }
  EXPECT_LE(missed, instances(500) / 100);
}

TEST(Rotation5ptKneip, GivesOnlyValidSolutions) {
  std::mt19937 generator(3);
  for (int round = 0; round < 5; ++round) {
    for (const auto& odd : oddTwoViews(generator, 5)) {
      std::array<SO3d, 20> found;
      const std::size_t count = gslam::rotation5ptKneip(odd.second.first, odd.second.second, found);
      for (std::size_t k = 0; k < count; ++k) {
        ASSERT_NEAR(found[k].quaternion().norm(), 1, 1e-14);
        ASSERT_LT(coplanarity(found[k], odd.second), 1e-6) << odd.first;
      }
      if (odd.first == "forwards" || odd.first == "sideways" || odd.first == "plane") {
        EXPECT_LT(angleToNearest(found, count, odd.second.T_second_first.rotation()), 1e-6)
            << odd.first;
      }
    }
  }
}

// Every rotation comes with the one half a turn about the translation away, also where roots are
// near each other and not every one is found.
TEST(Rotation5ptKneip, GivesPairsInHardScenes) {
  std::mt19937 generator(6);
  std::vector<HardScene> scenes = hardScenes();
  scenes.push_back({"next to no motion", 0.5236, 1e-6, false, 2, 10, 1, 1});
  for (const HardScene& hard : scenes) {
    for (std::size_t i = 0; i < instances(300); ++i) {
      const TwoViews views = hardTwoViews(generator, hard, 5);
      std::array<SO3d, 20> found;
      const std::size_t count = gslam::rotation5ptKneip(views.first, views.second, found);
      ASSERT_EQ(count % 2, 0U) << hard.name << ' ' << i;
      for (std::size_t k = 0; k < count; k += 2) {
        ASSERT_NEAR((found[k].inverse() * found[k + 1]).angle(), 3.14159265358979, 1e-7)
            << hard.name << ' ' << i;
      }
    }
  }
}

TEST(Rotation5ptKneip, SurvivesAbsurdNumbersAndSizes) {
  std::mt19937 generator(4);
  std::array<SO3d, 20> found;
  for (const double number : absurdNumbers()) {
    for (std::size_t i = 0; i < 15; ++i) {
      TwoViews views = anyTwoViews(generator, 5);
      views.second[i / 3][i % 3] = number;
      const std::size_t count = gslam::rotation5ptKneip(views.first, views.second, found);
      for (std::size_t k = 0; k < count; ++k) {
        ASSERT_NEAR(found[k].quaternion().norm(), 1, 1e-14);
      }
      if (!std::isfinite(number)) {
        ASSERT_EQ(count, 0U);
      }
    }
  }
  const TwoViews views = anyTwoViews(generator, 6);
  const Span<const Vec3d> first(views.first), second(views.second);
  EXPECT_THROW(gslam::rotation5ptKneip(first, second.first(5), found), ArgumentError);
  EXPECT_THROW(gslam::rotation5ptKneip(first.first(5), second, found), ArgumentError);
}

TEST(RealEigen, AgreesWithEigen) {
  std::mt19937 generator(5);
  for (int round = 0; round < 300; ++round) {
    double a[10][10];
    Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic> m(10, 10);
    for (int i = 0; i < 10; ++i) {
      for (int j = 0; j < 10; ++j) {
        // Sparse ones, too.
        const bool zero = round % 2 == 0 && gslam::randomUniform(generator, 0.0, 1.0) < 0.5;
        m(i, j) = a[i][j] = zero ? 0 : gslam::randomUniform(generator, -1.0, 1.0);
      }
    }
    const gslam::detail::RealEigen<10> eigen(a);
    const Eigen::EigenSolver<Eigen::MatrixXd> other(m, false);
    std::size_t real = 0;
    for (int i = 0; i < 10; ++i) {
      if (other.eigenvalues()[i].imag() != 0) continue;
      ++real;
      double least = 1;
      for (std::size_t k = 0; k < eigen.size(); ++k) {
        least = std::min(least, std::fabs(eigen.value(k) - other.eigenvalues()[i].real()));
      }
      EXPECT_LT(least, 1e-9) << round;
    }
    EXPECT_EQ(eigen.size(), real) << round;
    for (std::size_t k = 0; k < eigen.size(); ++k) {
      double v[10];
      eigen.vector(eigen.value(k), v);
      const Eigen::VectorXd x = Eigen::Map<const Eigen::VectorXd>(v, 10).normalized();
      EXPECT_LT((m * x - eigen.value(k) * x).norm(), 1e-10) << round;
    }
  }
}

TEST(RealEigen, TakesSimpleMatrices) {
  const double zero[4][4] = {};
  EXPECT_EQ(gslam::detail::RealEigen<4>(zero).size(), 4U);
  const double cycle[4][4] = {{0, 0, 0, 1}, {1, 0, 0, 0}, {0, 1, 0, 0}, {0, 0, 1, 0}};
  const gslam::detail::RealEigen<4> eigen(cycle);  // of the same shifts for ever
  ASSERT_EQ(eigen.size(), 2U);
  EXPECT_NEAR(std::fabs(eigen.value(0)), 1, 1e-14);
  EXPECT_NEAR(eigen.value(0) + eigen.value(1), 0, 1e-14);
}

}  // namespace
