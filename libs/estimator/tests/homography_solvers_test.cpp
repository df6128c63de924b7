#include <gslam/estimator/solvers/homography_4pt.h>
#include <gslam/estimator/solvers/homography_dlt.h>
#include <gtest/gtest.h>

#include "closed_form_helpers.h"
#include "instances.h"

#ifdef GSLAM_HAS_OPENCV
#include <opencv2/calib3d.hpp>
#endif

namespace {

using namespace gslam;
using namespace solver_test;

Vec2d mapped(const Mat3d& h, const Vec2d& p) {
  const Vec3d q = h * Vec3d{{p[0], p[1], 1}};
  return {{q[0] / q[2], q[1] / q[2]}};
}

double worstError(const Mat3d& h, const std::vector<Vec2d>& a, const std::vector<Vec2d>& b) {
  double worst = 0;
  for (std::size_t i = 0; i < a.size(); ++i) {
    const double error = (mapped(h, a[i]) - b[i]).norm();
    if (!(error <= worst)) worst = error;
  }
  return worst;
}

Mat3d ofNormOne(const Mat3d& h) {
  return (1 / frobenius(h)) * h;
}

TEST(Homography4pt, FindsTheTruth) {
  std::mt19937 generator(1);
  const std::size_t count = instances();
  std::size_t lost = 0;
  for (std::size_t i = 0; i < count; ++i) {
    const PlaneScene s = randomPlaneScene(generator, 4);
    Mat3d h;
    const auto a = s.image(SE3d());
    const auto b = s.image(s.T_second_first);
    const std::size_t found = homography4pt(a, b, h);
    const bool is_lost = found != 1 || !(frobenius(h - ofNormOne(s.H())) < 1e-6);
    lost += is_lost;
    // Only sets with three points nearly in line cost digits.
    if (is_lost) {
      EXPECT_LT(leastTriangle(a), 1e-5);
    }
    if (found == 1) {
      EXPECT_LT(worstError(h, a, b), 1e-9);
    }
  }
  EXPECT_LE(lost, 1 + count / 10000);
}

TEST(Homography4pt, WorksInPixels) {
  std::mt19937 generator(2);
  for (std::size_t i = 0; i < instances(2000); ++i) {
    const PlaneScene s = randomPlaneScene(generator, 4);
    const auto a = s.image(SE3d(), 1500, 2000);
    const auto b = s.image(s.T_second_first, 1500, 2000);
    if (leastTriangle(a) < 1e-3) continue;
    Mat3d h;
    ASSERT_EQ(homography4pt(a, b, h), 1u);
    EXPECT_LT(worstError(h, a, b), 1e-7);
    EXPECT_NEAR(frobenius(h), 1, 1e-14);
  }
}

TEST(Homography4pt, GivesPositiveThirdCoordinates) {
  std::mt19937 generator(3);
  for (std::size_t i = 0; i < instances(1000); ++i) {
    PlaneScene s = randomPlaneScene(generator, 4);
    auto a = s.image(SE3d());
    const auto b = s.image(s.T_second_first);
    const bool is_mirrored = i % 2 != 0;
    if (is_mirrored) {
      for (Vec2d& p : a) p[0] = -p[0];
    }
    Mat3d h;
    if (homography4pt(a, b, h) == 0) continue;
    for (const Vec2d& p : a) EXPECT_GT((h * Vec3d{{p[0], p[1], 1}})[2], 0);
    EXPECT_EQ(determinant(h) < 0, is_mirrored);
  }
}

TEST(Homography4pt, IsExactForUnitSquareAndIdentity) {
  const std::vector<Vec2d> square = {{{0, 0}}, {{1, 0}}, {{1, 1}}, {{0, 1}}};
  Mat3d h;
  ASSERT_EQ(homography4pt(square, square, h), 1u);
  EXPECT_LT(frobenius(h - ofNormOne(Mat3d::identity())), 1e-15);
}

TEST(Homography4pt, RefusesThreeInLine) {
  std::mt19937 generator(4);
  for (std::size_t i = 0; i < 4000; ++i) {
    auto a = randomPoints<2>(generator, 4, 1);
    const auto b = randomPoints<2>(generator, 4, 1);
    a[(i + 1) % 4] =
        a[i % 4] + randomUniform<double>(generator, -2, 2) * (a[(i + 2) % 4] - a[i % 4]);
    Mat3d h = Mat3d::identity();
    EXPECT_EQ(homography4pt(a, b, h), 0u);
    EXPECT_EQ(homography4pt(b, a, h), 0u);
    EXPECT_EQ(h, Mat3d::identity());
  }
}

TEST(Homography4pt, RefusesTwistedQuadrilaterals) {
  const std::vector<Vec2d> square = {{{0, 0}}, {{1, 0}}, {{1, 1}}, {{0, 1}}};
  const std::vector<Vec2d> bow = {{{0, 0}}, {{1, 0}}, {{0, 1}}, {{1, 1}}};
  const std::vector<Vec2d> arrow = {{{0, 0}}, {{1, 0}}, {{0.2, 0.2}}, {{0, 1}}};
  Mat3d h;
  EXPECT_EQ(homography4pt(square, bow, h), 0u);
  EXPECT_EQ(homography4pt(square, arrow, h), 0u);
  EXPECT_EQ(homography4pt(bow, arrow, h), 0u);
}

TEST(Homography4pt, SurvivesNearlyCollinearAndFarSets) {
  std::mt19937 generator(5);
  for (std::size_t i = 0; i < instances(1000); ++i) {
    PlaneScene s = randomPlaneScene(generator, 4);
    auto a = s.image(SE3d());
    for (Vec2d& p : a) p[1] *= 1e-4;
    std::vector<Vec2d> b;
    for (const Vec2d& p : a) b.push_back(mapped(s.H(), p));
    Mat3d h;
    if (leastTriangle(a) < 1e-6) continue;
    ASSERT_EQ(homography4pt(a, b, h), 1u);
    EXPECT_LT(worstError(h, a, b), 1e-8);
    // The same set far from the origin.
    for (Vec2d& p : a) p += {{1e4, -1e4}};
    ASSERT_EQ(homography4pt(a, b, h), 1u);
    EXPECT_LT(worstError(h, a, b), 1e-4);
  }
}

template <class Solver>
void feedAbsurdValues(const Solver& solver, std::size_t count) {
  std::mt19937 generator(6);
  for (const double value : absurdValues()) {
    for (std::size_t at = 0; at < 4 * count; ++at) {
      auto a = randomPoints<2>(generator, count, 1);
      auto b = randomPoints<2>(generator, count, 1);
      (at < 2 * count ? a : b)[at / 2 % count][at % 2] = value;
      Mat3d h;
      if (solver(a, b, h) == 1) {
        EXPECT_TRUE(isFinite(h)) << h;
      }
    }
    const std::vector<Vec2d> same(count, Vec2d{{value, value}});
    const auto other = randomPoints<2>(generator, count, 1);
    Mat3d h;
    EXPECT_EQ(solver(same, other, h), 0u);
    EXPECT_EQ(solver(other, same, h), 0u);
    EXPECT_EQ(solver(same, same, h), 0u);
    auto scaled = other;
    for (Vec2d& p : scaled) p *= value;
    if (solver(scaled, other, h) == 1) {
      EXPECT_TRUE(isFinite(h)) << h;
    }
    if (solver(other, scaled, h) == 1) {
      EXPECT_TRUE(isFinite(h)) << h;
    }
  }
}

TEST(Homography4pt, IsNeverNan) {
  feedAbsurdValues(homography4pt, 4);
}
TEST(HomographyDlt, IsNeverNan) {
  feedAbsurdValues(homographyDlt, 4);
  feedAbsurdValues(homographyDlt, 7);
}

TEST(HomographySolvers, RefuseWrongSizes) {
  Mat3d h;
  const std::vector<Vec2d> three(3), four(4), five(5);
  EXPECT_THROW(homography4pt(three, four, h), ArgumentError);
  EXPECT_THROW(homography4pt(four, five, h), ArgumentError);
  EXPECT_THROW(homography4pt({}, {}, h), ArgumentError);
  EXPECT_THROW(homographyDlt(three, three, h), ArgumentError);
  EXPECT_THROW(homographyDlt(five, four, h), ArgumentError);
}

TEST(HomographyDlt, FindsTheTruth) {
  std::mt19937 generator(7);
  const std::size_t count = instances(4000);
  std::size_t lost = 0;
  for (std::size_t i = 0; i < count; ++i) {
    const PlaneScene s = randomPlaneScene(generator, 5 + i % 20);
    const auto a = s.image(SE3d());
    const auto b = s.image(s.T_second_first);
    Mat3d h;
    const std::size_t found = homographyDlt(a, b, h);
    lost += found != 1 || !(frobenius(h - ofNormOne(s.H())) < 1e-6);
    if (found == 1) {
      EXPECT_LT(worstError(h, a, b), 1e-7);
    }
  }
  EXPECT_LE(lost, 1 + count / 10000);
}

TEST(HomographyDlt, KeepsDigitsOfThinAndFarSetsInPixels) {
  std::mt19937 generator(8);
  for (std::size_t i = 0; i < instances(1000); ++i) {
    const PlaneScene s = randomPlaneScene(generator, 12);
    auto a = s.image(SE3d(), 1000, 500);
    for (Vec2d& p : a) p[i % 2] = 1e-4 * p[i % 2] + p[1 - i % 2];
    Mat3d truth = s.H();
    std::vector<Vec2d> b;
    for (const Vec2d& p : a) b.push_back(1000 * mapped(truth, 1e-3 * p));
    Mat3d h;
    ASSERT_EQ(homographyDlt(a, b, h), 1u);
    EXPECT_LT(worstError(h, a, b), 1e-6);
    for (Vec2d& p : a) p += {{1e5, -1e5}};
    ASSERT_EQ(homographyDlt(a, b, h), 1u);
    EXPECT_LT(worstError(h, a, b), 1e-3);
  }
}

TEST(HomographyDlt, RefusesWhatDeterminesNothing) {
  std::mt19937 generator(9);
  for (std::size_t i = 0; i < 1000; ++i) {
    auto a = randomPoints<2>(generator, 8, 1);
    const Vec2d start = a[0], along = a[1] - a[0];
    const bool all_in_line = i % 2 == 0;
    for (std::size_t j = 1; j < a.size(); ++j) {
      if (!all_in_line && j == 5) continue;
      a[j] = start + randomUniform<double>(generator, -1, 1) * along;
    }
    const Mat3d truth = randomPlaneScene(generator, 1).H();
    std::vector<Vec2d> b;
    double nearest = kInf;
    for (const Vec2d& p : a) {
      b.push_back(mapped(truth, p));
      nearest = std::fmin(nearest, std::fabs((truth * Vec3d{{p[0], p[1], 1}})[2]));
    }
    if (nearest < 0.1) continue;  // rounding bends the line near the horizon
    Mat3d h;
    EXPECT_EQ(homographyDlt(a, b, h), 0u);
  }
}

// Gauss-Newton on the distances in the second image, with numeric derivatives: the best there is.
double leastRms(Mat3d h, const std::vector<Vec2d>& a, const std::vector<Vec2d>& b) {
  const auto rms = [&](const Mat3d& m) {
    double sum = 0;
    for (std::size_t i = 0; i < a.size(); ++i) sum += (mapped(m, a[i]) - b[i]).squaredNorm();
    return std::sqrt(sum / static_cast<double>(a.size()));
  };
  // Coordinate descent is enough for a bound within some percent.
  double step = 1e-3;
  double best = rms(h);
  while (step > 1e-8) {
    bool better = false;
    for (double& value : h.values) {
      for (const double sign : {-1.0, 1.0}) {
        const double old = value;
        value += sign * step;
        const double now = rms(h);
        if (now < best) {
          best = now;
          better = true;
        } else {
          value = old;
        }
      }
    }
    if (!better) step *= 0.5;
  }
  return best;
}

TEST(HomographyDlt, IsNearTheBestOnNoisyPoints) {
  std::mt19937 generator(10);
  double ours = 0;
  double best = 0;
  for (std::size_t i = 0; i < 20; ++i) {
    const PlaneScene s = randomPlaneScene(generator, 30);
    const auto a = s.image(SE3d());
    auto b = s.image(s.T_second_first);
    for (Vec2d& p : b) p += 1e-3 * randomNormal<double, 2>(generator);
    Mat3d h;
    ASSERT_EQ(homographyDlt(a, b, h), 1u);
    double sum = 0;
    for (std::size_t j = 0; j < a.size(); ++j) sum += (mapped(h, a[j]) - b[j]).squaredNorm();
    ours += std::sqrt(sum / 30);
    best += leastRms(h, a, b);
  }
  EXPECT_LT(ours, 1.05 * best);
}

#ifdef GSLAM_HAS_OPENCV
TEST(HomographyDlt, IsAsGoodAsOpenCv) {
  std::mt19937 generator(11);
  double ours = 0;
  double theirs = 0;
  for (std::size_t i = 0; i < 200; ++i) {
    const PlaneScene s = randomPlaneScene(generator, 30);
    const auto a = s.image(SE3d());
    auto b = s.image(s.T_second_first);
    const auto clean = b;
    for (Vec2d& p : b) p += 1e-3 * randomNormal<double, 2>(generator);
    std::vector<cv::Point2d> ca, cb;
    for (const Vec2d& p : a) ca.emplace_back(p[0], p[1]);
    for (const Vec2d& p : b) cb.emplace_back(p[0], p[1]);
    const cv::Mat_<double> m = cv::findHomography(ca, cb, 0);
    Mat3d h, other;
    ASSERT_EQ(homographyDlt(a, b, h), 1u);
    for (int r = 0; r < 9; ++r) other.values[r] = m(r / 3, r % 3);
    for (std::size_t j = 0; j < a.size(); ++j) {
      ours += (mapped(h, a[j]) - clean[j]).squaredNorm();
      theirs += (mapped(other, a[j]) - clean[j]).squaredNorm();
    }
  }
  // OpenCV's has been refined by Levenberg and Marquardt.
  EXPECT_LT(ours, 1.1 * theirs);
}
#endif

}  // namespace
