#include <gslam/estimator/solvers/decompose_homography.h>
#include <gslam/estimator/solvers/homography_4pt.h>
#include <gslam/estimator/solvers/relative_poses_from_homography.h>
#include <gtest/gtest.h>

#include "closed_form_helpers.h"
#include "instances.h"

#ifdef GSLAM_HAS_OPENCV
#include <opencv2/calib3d.hpp>
#endif

namespace {

using namespace gslam;
using namespace solver_test;

using Motions = std::array<HomographyMotion, 4>;

double difference(const HomographyMotion& m, const SE3d& T, const Vec3d& translation,
                  const Vec3d& normal) {
  return (m.T_second_first.rotation().inverse() * T.rotation()).angle() +
         (m.T_second_first.translation() - translation).norm() + (m.normal_first - normal).norm();
}

double leastDifference(const Motions& motions, std::size_t count, const PlaneScene& s) {
  double least = kInf;
  for (std::size_t i = 0; i < count; ++i) {
    least =
        std::fmin(least, difference(motions[i], s.T_second_first,
                                    (1 / s.distance) * s.T_second_first.translation(), s.normal));
  }
  return least;
}

// Each solution makes the homography up to scale and sign.
void expectValid(const Motions& motions, std::size_t count, const Mat3d& h) {
  const Mat3d one = (1 / frobenius(h)) * h;
  for (std::size_t i = 0; i < count; ++i) {
    const HomographyMotion& m = motions[i];
    const Mat3d r = m.T_second_first.rotation().matrix();
    const Mat3d back = r + outer(m.T_second_first.translation(), m.normal_first);
    const Mat3d back_one = (1 / frobenius(back)) * back;
    EXPECT_LT(std::fmin(frobenius(back_one - one), frobenius(back_one + one)), 1e-8);
    if (count > 1) {
      EXPECT_NEAR(m.normal_first.norm(), 1, 1e-12);
    }
  }
}

TEST(DecomposeHomography, FindsTheTruth) {
  for (const double baseline : {0.5, 1e-2, 1e-4}) {
    std::mt19937 generator(1);
    const std::size_t count = instances(baseline == 0.5 ? 10000 : 1000);
    std::size_t lost = 0;
    for (std::size_t i = 0; i < count; ++i) {
      const PlaneScene s = randomPlaneScene(generator, 4, baseline);
      Motions motions;
      const double factor = randomUniform<double>(generator, -3, 3);
      const std::size_t found = decomposeHomography(factor * s.H(), motions);
      EXPECT_EQ(found, 4u);
      expectValid(motions, found, s.H());
      lost += !(leastDifference(motions, found, s) < 1e-6);
    }
    EXPECT_LE(lost, count / 1000) << baseline;
  }
}

TEST(DecomposeHomography, GivesOneSolutionAtPureRotation) {
  std::mt19937 generator(2);
  for (std::size_t i = 0; i < instances(1000); ++i) {
    const SO3d r = randomOf<SO3d>(generator);
    Motions motions;
    const double factor = i % 2 ? 0.1 : -7;
    ASSERT_EQ(decomposeHomography(factor * r.matrix(), motions), 1u);
    EXPECT_TRUE(motions[0].T_second_first.rotation().isApprox(r, 1e-14));
    EXPECT_EQ(motions[0].T_second_first.translation(), Vec3d{});
    EXPECT_EQ(motions[0].normal_first, Vec3d{});
  }
}

TEST(DecomposeHomography, GivesTwoAlongTheNormal) {
  std::mt19937 generator(3);
  for (std::size_t i = 0; i < instances(1000); ++i) {
    PlaneScene s = randomPlaneScene(generator, 4);
    // x2 = R (x1 - k n), towards the plane or back.
    const double k = randomUniform<double>(generator, -0.9, 0.9) * s.distance;
    const SO3d r = s.T_second_first.rotation();
    s.T_second_first = SE3d(r, r * (-k * s.normal));
    Motions motions;
    const std::size_t found = decomposeHomography(s.H(), motions);
    EXPECT_GE(found, 2u);
    expectValid(motions, found, s.H());
    EXPECT_LT(leastDifference(motions, found, s), 1e-6 + 1e-7 / std::fabs(k));
  }
}

TEST(DecomposeHomography, IsNeverNan) {
  std::mt19937 generator(4);
  for (const double value : absurdValues()) {
    for (std::size_t at = 0; at < 9; ++at) {
      Mat3d h = randomPlaneScene(generator, 4).H();
      h.values[at] = value;
      Motions motions;
      std::size_t found = decomposeHomography(h, motions);
      for (std::size_t i = 0; i < found; ++i) EXPECT_TRUE(isFinite(motions[i].T_second_first));
      found = decomposeHomography(value * h, motions);
      for (std::size_t i = 0; i < found; ++i) EXPECT_TRUE(isFinite(motions[i].T_second_first));
    }
  }
  Motions motions;
  EXPECT_EQ(decomposeHomography(Mat3d{}, motions), 0u);
  EXPECT_EQ(decomposeHomography(outer(Vec3d{{1, 2, 3}}, Vec3d{{3, 2, 1}}), motions), 0u);
  // Rank 2: the second camera is on the plane.
  const std::size_t found = decomposeHomography({{1, 0, 0, 0, 1, 0, 0, 0, 0}}, motions);
  expectValid(motions, found, {{1, 0, 0, 0, 1, 0, 0, 0, 0}});
}

TEST(RelativePosesFromHomography, KeepsTheTruthAndUsuallyTwo) {
  std::mt19937 generator(5);
  std::size_t kept = 0;
  std::size_t lost = 0;
  const std::size_t count = instances(2000);
  for (std::size_t i = 0; i < count; ++i) {
    const PlaneScene s = randomPlaneScene(generator, 10);
    const auto a = s.bearings(SE3d());
    auto b = s.bearings(s.T_second_first);
    if (i % 3 == 0) b[3] = -b[3];  // one wrong match must not matter
    Motions motions;
    const std::size_t found = relativePosesFromHomography(i % 2 ? s.H() : -s.H(), a, b, motions);
    EXPECT_GE(found, 1u);
    EXPECT_LE(found, 2u);
    kept += found;
    lost += !(leastDifference(motions, found, s) < 1e-6);
  }
  EXPECT_LE(lost, count / 1000);
  EXPECT_LE(kept, 2 * count);
}

// The plane between the cameras: the second one looks back from the other side.
TEST(RelativePosesFromHomography, AllowsThePlaneBetween) {
  std::mt19937 generator(6);
  for (int i = 0; i < 200; ++i) {
    PlaneScene s = randomPlaneScene(generator, 10);
    const SO3d back = SO3d::exp({{0, 3.0, 0}});
    const SE3d T_first_second(back, {{0.1, 0.2, 3 * s.distance / s.normal[2]}});
    s.T_second_first = T_first_second.inverse();
    const auto a = s.bearings(SE3d());
    const auto b = s.bearings(s.T_second_first);
    ASSERT_LT(determinant(s.H()), 0);
    Motions motions;
    const std::size_t found = relativePosesFromHomography(s.H(), a, b, motions);
    EXPECT_GE(found, 1u);
    EXPECT_LT(leastDifference(motions, found, s), 1e-6);
  }
}

TEST(RelativePosesFromHomography, KeepsAPureRotation) {
  std::mt19937 generator(7);
  for (int i = 0; i < 200; ++i) {
    const PlaneScene s = randomPlaneScene(generator, 4, 0);
    const auto a = s.bearings(SE3d());
    const auto b = s.bearings(s.T_second_first);
    Mat3d h;
    ASSERT_EQ(homography4pt(s.image(SE3d()), s.image(s.T_second_first), h), 1u);
    Motions motions;
    ASSERT_EQ(relativePosesFromHomography(s.T_second_first.rotation().matrix(), a, b, motions), 1u);
    EXPECT_TRUE(motions[0].T_second_first.rotation().isApprox(s.T_second_first.rotation(), 1e-14));
    // What four points make of it is a turn as well, but for their rounding.
    const std::size_t found = relativePosesFromHomography(h, a, b, motions);
    ASSERT_GE(found, 1u);
    EXPECT_TRUE(motions[0].T_second_first.rotation().isApprox(s.T_second_first.rotation(), 1e-6));
  }
  Motions motions;
  const std::vector<Vec3d> one(1), two(2);
  EXPECT_THROW(relativePosesFromHomography(Mat3d::identity(), {}, {}, motions), ArgumentError);
  EXPECT_THROW(relativePosesFromHomography(Mat3d::identity(), one, two, motions), ArgumentError);
  EXPECT_EQ(relativePosesFromHomography(Mat3d::identity(), one, one, motions), 0u);
}

#ifdef GSLAM_HAS_OPENCV
TEST(DecomposeHomography, AgreesWithOpenCv) {
  std::mt19937 generator(8);
  for (int i = 0; i < 300; ++i) {
    const PlaneScene s = randomPlaneScene(generator, 4);
    const Mat3d h = s.H();
    cv::Mat_<double> m(3, 3), k(3, 3, 0.0);
    for (int e = 0; e < 9; ++e) m(e / 3, e % 3) = h.values[e];
    for (int e = 0; e < 3; ++e) k(e, e) = 1;
    std::vector<cv::Mat> rotations, translations, normals;
    const int theirs = cv::decomposeHomographyMat(m, k, rotations, translations, normals);
    Motions motions;
    ASSERT_EQ(decomposeHomography(h, motions), static_cast<std::size_t>(theirs));
    for (const HomographyMotion& ours : motions) {
      double least = kInf;
      for (std::size_t j = 0; j < rotations.size(); ++j) {
        const cv::Mat_<double> r = rotations[j], t = translations[j], n = normals[j];
        double sum = 0;
        const Mat3d r_ours = ours.T_second_first.rotation().matrix();
        for (int e = 0; e < 9; ++e) sum += std::fabs(r_ours.values[e] - r(e / 3, e % 3));
        for (int e = 0; e < 3; ++e) {
          const auto at = static_cast<std::size_t>(e);
          sum += std::fabs(ours.T_second_first.translation()[at] - t(e)) +
                 std::fabs(ours.normal_first[at] - n(e));
        }
        least = std::fmin(least, sum);
      }
      EXPECT_LT(least, 1e-5);
    }
  }
}
#endif

}  // namespace
