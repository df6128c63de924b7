#include <gslam/base/error.h>
#include <gslam/estimator/solvers/decompose_essential.h>
#include <gslam/estimator/solvers/essential_5pt.h>
#include <gslam/estimator/solvers/essential_5pt_nister.h>
#include <gslam/estimator/solvers/essential_5pt_stewenius.h>
#include <gslam/estimator/solvers/essential_8pt.h>
#include <gslam/estimator/solvers/relative_pose_from_essential.h>
#include <gtest/gtest.h>

#include <Eigen/SVD>
#include <functional>

#include "instances.h"
#include "two_views.h"

namespace {

using gslam::ArgumentError;
using gslam::Span;
using namespace solver_test;  // NOLINT(google-build-using-namespace)

using FivePointSolver = std::size_t (*)(Span<const Vec3d>, Span<const Vec3d>,
                                        std::array<Mat3d, 10>&);

struct FivePoints {
  const char* name;
  FivePointSolver solve;
  double most_lost;   // part of the instances
  double most_error;  // of the essential constraint
};

const FivePoints kFivePoints[] = {{"default", gslam::essential5pt, 1e-4, 1e-12},
                                  {"Nister", gslam::essential5ptNister, 0.005, 1e-2},
                                  {"Stewenius", gslam::essential5ptStewenius, 5e-4, 1e-2}};

TEST(Essential5pt, FindsTheTruth) {
  for (const FivePoints& solver : kFivePoints) {
    std::mt19937 generator(1);
    const std::size_t all = instances(solver.solve == &gslam::essential5pt ? 10000 : 3000);
    std::size_t lost = 0, solutions = 0;
    for (std::size_t i = 0; i < all; ++i) {
      const TwoViews views = anyTwoViews(generator, 5);
      std::array<Mat3d, 10> found;
      const std::size_t count = solver.solve(views.first, views.second, found);
      ASSERT_LE(count, 10U);
      solutions += count;
      if (!(distanceToNearest(found, count, views.essential()) < 1e-6)) ++lost;
      for (std::size_t k = 0; k < count; ++k) {
        ASSERT_NEAR(norm(found[k]), std::sqrt(2.0), 1e-14) << solver.name;
        ASSERT_LT(epipolarError(found[k], views.first, views.second), 1e-13) << solver.name;
        ASSERT_LT(essentialError(found[k]), solver.most_error) << solver.name << ' ' << i;
      }
      ASSERT_TRUE(areDistinct(found, count)) << solver.name << ' ' << i;
    }
    EXPECT_LE(static_cast<double>(lost), solver.most_lost * static_cast<double>(all))
        << solver.name;
    RecordProperty(solver.name, static_cast<int>(lost));
    // Half of them complex, about; independent of the solver.
    EXPECT_NEAR(static_cast<double>(solutions) / static_cast<double>(all), 4.74, 0.1);
  }
}

// What one finds, the others find, too: an independent check of the count.
TEST(Essential5pt, AgreesWithTheClassics) {
  std::mt19937 generator(2);
  std::size_t missed = 0;
  const std::size_t all = instances(2000);
  for (std::size_t i = 0; i < all; ++i) {
    const TwoViews views = facingTwoViews(generator, 5);
    std::array<Mat3d, 10> found, other;
    const std::size_t count = gslam::essential5pt(views.first, views.second, found);
    const std::size_t others = gslam::essential5ptStewenius(views.first, views.second, other);
    for (std::size_t k = 0; k < others; ++k) {
      if (!(distanceToNearest(found, count, other[k]) < 1e-3)) ++missed;
    }
    ASSERT_LT(distanceToNearest(found, count, views.essential()), 1e-6) << i;
  }
  EXPECT_LE(missed, all / 1000);
}

TEST(Essential5pt, GivesOnlyValidSolutions) {
  std::mt19937 generator(3);
  for (int round = 0; round < 20; ++round) {
    for (const auto& odd : oddTwoViews(generator, 5)) {
      for (const FivePoints& solver : kFivePoints) {
        std::array<Mat3d, 10> found;
        const TwoViews& views = odd.second;
        const std::size_t count = solver.solve(views.first, views.second, found);
        ASSERT_LE(count, 10U);
        for (std::size_t k = 0; k < count; ++k) {
          ASSERT_LT(epipolarError(found[k], views.first, views.second), 1e-12)
              << solver.name << ' ' << odd.first;
          ASSERT_LT(essentialError(found[k]), std::max(solver.most_error, 1e-6))
              << solver.name << ' ' << odd.first;
        }
      }
    }
  }
}

// These have a solution that the bearings determine, and it is found.
TEST(Essential5pt, FindsTheTruthOfOddScenes) {
  std::mt19937 generator(4);
  for (int round = 0; round < 200; ++round) {
    for (const auto& odd : oddTwoViews(generator, 5)) {
      const std::string& name = odd.first;
      // The rounding of the bearings over the parallax.
      double allowed = 0;
      if (name == "plane" || name == "forwards" || name == "sideways") allowed = 1e-6;
      if (allowed == 0) continue;
      std::array<Mat3d, 10> found;
      const std::size_t count = gslam::essential5pt(odd.second.first, odd.second.second, found);
      EXPECT_LT(distanceToNearest(found, count, odd.second.essential()), allowed) << name;
    }
  }
}

// Roots lie close there: neither may one be lost, nor one be given twice.
TEST(Essential5pt, LosesLittleInHardScenes) {
  std::mt19937 generator(15);
  for (const HardScene& hard : hardScenes()) {
    const std::size_t all = instances(2000);
    std::size_t lost = 0, lost_by_nister = 0;
    for (std::size_t i = 0; i < all; ++i) {
      const TwoViews views = hardTwoViews(generator, hard, 5);
      std::array<Mat3d, 10> found;
      std::size_t count = gslam::essential5pt(views.first, views.second, found);
      if (!(distanceToNearest(found, count, views.essential()) < 1e-4)) ++lost;
      for (std::size_t k = 0; k < count; ++k) {
        ASSERT_LT(epipolarError(found[k], views.first, views.second), 1e-13) << hard.name;
        ASSERT_LT(essentialError(found[k]), 2e-6) << hard.name << ' ' << i;
        ASSERT_GT(distanceToNearest(found, k, found[k]), 1e-8) << hard.name << ' ' << i;
      }
      if (i % 4 > 0) continue;
      count = gslam::essential5ptNister(views.first, views.second, found);
      if (!(distanceToNearest(found, count, views.essential()) < 1e-4)) ++lost_by_nister;
    }
    const double part = static_cast<double>(lost) / static_cast<double>(all);
    const double nister = 4 * static_cast<double>(lost_by_nister) / static_cast<double>(all);
    EXPECT_LE(part, hard.lost_default) << hard.name;
    EXPECT_LE(nister, hard.lost_nister) << hard.name;
    RecordProperty(hard.name, std::to_string(part) + " Nister " + std::to_string(nister));
  }
}

TEST(Essential5pt, SurvivesAbsurdNumbers) {
  std::mt19937 generator(5);
  for (const FivePoints& solver : kFivePoints) {
    for (const double number : absurdNumbers()) {
      for (std::size_t i = 0; i < 15; ++i) {
        TwoViews views = anyTwoViews(generator, 5);
        views.first[i / 3][i % 3] = number;
        std::array<Mat3d, 10> found;
        const std::size_t count = solver.solve(views.first, views.second, found);
        for (std::size_t k = 0; k < count; ++k) {
          ASSERT_TRUE(std::isfinite(norm(found[k]))) << solver.name << ' ' << number;
        }
        if (!std::isfinite(number)) {
          ASSERT_EQ(count, 0U) << solver.name << ' ' << number;
        }
      }
      const std::vector<Vec3d> all(5, Vec3d{{number, number, number}});
      std::array<Mat3d, 10> found;
      const std::size_t count = solver.solve(all, all, found);
      for (std::size_t k = 0; k < count; ++k) ASSERT_TRUE(std::isfinite(norm(found[k])));
    }
  }
}

TEST(Essential5pt, RefusesOtherSizes) {
  std::mt19937 generator(6);
  const TwoViews views = anyTwoViews(generator, 6);
  const Span<const Vec3d> first(views.first), second(views.second);
  std::array<Mat3d, 10> found;
  for (const FivePoints& solver : kFivePoints) {
    EXPECT_THROW(solver.solve(first, second.first(5), found), ArgumentError);
    EXPECT_THROW(solver.solve(first.first(5), second, found), ArgumentError);
    EXPECT_THROW(solver.solve({}, {}, found), ArgumentError);
  }
}

Eigen::Matrix3d toEigen(const Mat3d& m) {
  return Eigen::Map<const Eigen::Matrix<double, 3, 3, Eigen::RowMajor>>(m.data());
}
Mat3d fromEigen(const Eigen::Matrix3d& m) {
  Mat3d result;
  Eigen::Map<Eigen::Matrix<double, 3, 3, Eigen::RowMajor>>(result.data()) = m;
  return result;
}

// By singular value decompositions of everything.
Mat3d essentialByDecomposition(const TwoViews& views) {
  Eigen::MatrixXd a(views.first.size(), 9);
  for (std::size_t i = 0; i < views.first.size(); ++i) {
    for (std::size_t j = 0; j < 9; ++j) {
      a(static_cast<Eigen::Index>(i), static_cast<Eigen::Index>(j)) =
          views.second[i][j / 3] * views.first[i][j % 3];
    }
  }
  const Eigen::JacobiSVD<Eigen::MatrixXd> svd(a, Eigen::ComputeFullV);
  const Eigen::VectorXd v = svd.matrixV().col(8);
  const Eigen::Matrix3d e =
      Eigen::Map<const Eigen::Matrix<double, 3, 3, Eigen::RowMajor>>(v.data());
  const Eigen::JacobiSVD<Eigen::Matrix3d> small(e, Eigen::ComputeFullU | Eigen::ComputeFullV);
  return fromEigen(small.matrixU() * Eigen::Vector3d(1, 1, 0).asDiagonal() *
                   small.matrixV().transpose());
}

TEST(Essential8pt, FindsTheTruth) {
  for (const std::size_t points : {8U, 9U, 17U, 100U}) {
    std::mt19937 generator(7);
    for (std::size_t i = 0; i < instances(points == 8 ? 10000 : 300); ++i) {
      const TwoViews views = anyTwoViews(generator, points);
      Mat3d found;
      ASSERT_EQ(gslam::essential8pt(views.first, views.second, found), 1U);
      ASSERT_LT(distance(found, views.essential()), 1e-6) << points << ' ' << i;
      ASSERT_LT(essentialError(found), 1e-13);
    }
  }
}

TEST(Essential8pt, IsTheLeastSquaresSolution) {
  std::mt19937 generator(8);
  for (const std::size_t points : {8U, 9U, 20U, 50U}) {
    for (int i = 0; i < 50; ++i) {
      TwoViews views = anyTwoViews(generator, points);
      for (Vec3d& b : views.second) {
        b = (b + 1e-3 * gslam::randomNormal<double, 3>(generator)).normalized();
      }
      Mat3d found;
      ASSERT_EQ(gslam::essential8pt(views.first, views.second, found), 1U);
      ASSERT_LT(distance(found, essentialByDecomposition(views)), 1e-8) << points << ' ' << i;
    }
  }
}

TEST(Essential8pt, GivesOnlyValidSolutions) {
  std::mt19937 generator(9);
  for (const std::size_t points : {8U, 12U}) {
    for (const auto& odd : oddTwoViews(generator, points)) {
      Mat3d found;
      if (gslam::essential8pt(odd.second.first, odd.second.second, found) == 0) continue;
      EXPECT_LT(essentialError(found), 1e-12) << odd.first;
    }
    for (const double number : absurdNumbers()) {
      TwoViews views = anyTwoViews(generator, points);
      views.second[3][1] = number;
      Mat3d found{};
      const std::size_t count = gslam::essential8pt(views.first, views.second, found);
      EXPECT_TRUE(std::isfinite(norm(found))) << number;
      if (!std::isfinite(number)) {
        EXPECT_EQ(count, 0U) << number;
      }
    }
    const TwoViews views = anyTwoViews(generator, points);
    const Span<const Vec3d> first(views.first), second(views.second);
    Mat3d found;
    EXPECT_THROW(gslam::essential8pt(first.first(7), second.first(7), found), ArgumentError);
    EXPECT_THROW(gslam::essential8pt(first.first(8), second.first(7), found), ArgumentError);
  }
}

TEST(DecomposeEssential, GivesFourPosesOfTheMatrix) {
  std::mt19937 generator(10);
  for (std::size_t i = 0; i < instances(1000); ++i) {
    const TwoViews views = anyTwoViews(generator, 5);
    const double scale = std::pow(10.0, gslam::randomUniform(generator, -50.0, 50.0));
    std::array<SE3d, 4> poses;
    ASSERT_EQ(gslam::decomposeEssential(-scale * views.essential(), poses), 4U);
    double least = 1;
    for (std::size_t k = 0; k < 4; ++k) {
      least = std::min(least, poseError(poses[k], views.T_second_first));
      ASSERT_NEAR(poses[k].translation().norm(), 1, 1e-14);
      TwoViews same = views;
      same.T_second_first = poses[k];
      ASSERT_LT(distance(same.essential(), views.essential()), 1e-14);
      for (std::size_t l = 0; l < k; ++l) ASSERT_GT(poseError(poses[k], poses[l]), 1);
    }
    ASSERT_LT(least, 1e-13);
  }
}

TEST(DecomposeEssential, TakesTheNextEssentialMatrix) {
  std::mt19937 generator(11);
  for (int i = 0; i < 200; ++i) {
    Mat3d m;
    for (double& value : m.values) value = gslam::randomUniform(generator, -1.0, 1.0);
    const Eigen::JacobiSVD<Eigen::Matrix3d> svd(toEigen(m),
                                                Eigen::ComputeFullU | Eigen::ComputeFullV);
    if (svd.singularValues()[1] < 1.1 * svd.singularValues()[2]) continue;  // not well defined
    const Mat3d next = fromEigen(svd.matrixU() * Eigen::Vector3d(1, 1, 0).asDiagonal() *
                                 svd.matrixV().transpose());
    std::array<SE3d, 4> poses;
    ASSERT_EQ(gslam::decomposeEssential(m, poses), 4U);
    for (const SE3d& pose : poses) {
      TwoViews same;
      same.T_second_first = pose;
      ASSERT_LT(distance(same.essential(), next), 1e-12);
    }
  }
}

TEST(DecomposeEssential, RefusesWhatIsNone) {
  std::array<SE3d, 4> poses;
  EXPECT_EQ(gslam::decomposeEssential(Mat3d{}, poses), 0U);
  EXPECT_EQ(gslam::decomposeEssential(gslam::outer(Vec3d{{1, 2, 3}}, Vec3d{{3, 1, -1}}), poses),
            0U);
  for (const double number : absurdNumbers()) {
    Mat3d m = SO3d::hat({{1, 2, 3}});
    m(1, 1) = number;
    const std::size_t count = gslam::decomposeEssential(m, poses);
    if (!std::isfinite(number)) {
      EXPECT_EQ(count, 0U) << number;
    }
    for (std::size_t i = 0; i < count; ++i) {
      EXPECT_TRUE(std::isfinite(poses[i].translation().norm()));
      EXPECT_NEAR(poses[i].rotation().quaternion().norm(), 1, 1e-14);
    }
  }
}

TEST(RelativePoseFromEssential, FindsTheTruth) {
  std::mt19937 generator(12);
  for (std::size_t i = 0; i < instances(2000); ++i) {
    TwoViews views = anyTwoViews(generator, 10);
    // In all directions of both views.
    for (Vec3d& p : views.points) {
      p = gslam::randomUniform(generator, 0.1, 5.0) * gslam::randomDirection<double>(generator);
    }
    views.project();
    SE3d pose;
    ASSERT_EQ(gslam::relativePoseFromEssential(views.essential(), views.first, views.second, pose),
              10U);
    ASSERT_LT(poseError(pose, views.T_second_first), 1e-12) << i;
    // Still the best where three of ten are wrong.
    for (std::size_t k = 0; k < 3; ++k) views.second[k] = -views.second[k];
    ASSERT_EQ(gslam::relativePoseFromEssential(views.essential(), views.first, views.second, pose),
              7U);
    ASSERT_LT(poseError(pose, views.T_second_first), 1e-12) << i;
  }
}

TEST(RelativePoseFromEssential, CountsPointsAtInfinity) {
  std::mt19937 generator(13);
  for (int i = 0; i < 200; ++i) {
    TwoViews views = anyTwoViews(generator, 6);
    for (std::size_t k = 0; k < 5; ++k) {
      views.first[k] = gslam::randomDirection<double>(generator);
      views.second[k] = views.T_second_first.rotation() * views.first[k];
    }
    SE3d pose;
    ASSERT_EQ(gslam::relativePoseFromEssential(views.essential(), views.first, views.second, pose),
              6U);
    ASSERT_LT(poseError(pose, views.T_second_first), 1e-12) << i;
  }
}

TEST(RelativePoseFromEssential, GivesNothingForNothing) {
  std::mt19937 generator(14);
  const TwoViews views = anyTwoViews(generator, 4);
  SE3d pose;
  EXPECT_EQ(gslam::relativePoseFromEssential(Mat3d{}, views.first, views.second, pose), 0U);
  const std::vector<Vec3d> none(4, Vec3d{{std::nan(""), 0, 1}});
  EXPECT_EQ(gslam::relativePoseFromEssential(views.essential(), none, views.second, pose), 0U);
  EXPECT_THROW(gslam::relativePoseFromEssential(views.essential(), {}, {}, pose), ArgumentError);
}

}  // namespace
