#include <gslam/estimator/solvers/affine_2d.h>
#include <gslam/estimator/solvers/affine_3d.h>
#include <gslam/estimator/solvers/rigid_3d.h>
#include <gslam/estimator/solvers/rotation_2pt.h>
#include <gslam/estimator/solvers/similarity_3d.h>
#include <gtest/gtest.h>

#include <Eigen/Geometry>

#include "closed_form_helpers.h"
#include "instances.h"

#ifdef GSLAM_HAS_OPENCV
#include <opencv2/calib3d.hpp>
#endif

namespace {

using namespace gslam;
using namespace solver_test;

using Mat23 = Mat<double, 2, 3>;
using Mat34 = Mat<double, 3, 4>;

template <std::size_t N>
using Points = std::vector<Vec<double, N>>;

template <std::size_t N>
Vec<double, N> mapped(const Mat<double, N, N + 1>& m, const Vec<double, N>& p) {
  return m.template block<N, N>(0, 0) * p + m.col(N);
}

template <std::size_t N>
double cost(const Mat<double, N, N + 1>& m, const Points<N>& a, const Points<N>& b) {
  double sum = 0;
  for (std::size_t i = 0; i < a.size(); ++i) sum += (mapped(m, a[i]) - b[i]).squaredNorm();
  return sum;
}

// Volume of the simplex of the first N + 1 points, relative to its extent.
double flatness(const Points<2>& p) {
  const Vec2d u = p[1] - p[0], v = p[2] - p[0];
  return std::fabs(u[0] * v[1] - u[1] * v[0]) / (u.squaredNorm() + v.squaredNorm());
}
double flatness(const Points<3>& p) {
  const Vec3d u = p[1] - p[0], v = p[2] - p[0], w = p[3] - p[0];
  const double extent = u.squaredNorm() + v.squaredNorm() + w.squaredNorm();
  return std::fabs(u.dot(v.cross(w))) / std::pow(extent, 1.5);
}

template <std::size_t N, class Solver>
void expectAffineTruth(const Solver& solver, std::size_t n, unsigned seed) {
  std::mt19937 generator(seed);
  const std::size_t count = instances(n == N + 1 ? 10000 : 1000);
  std::size_t lost = 0;
  for (std::size_t i = 0; i < count; ++i) {
    const Points<N> a = randomPoints<N>(generator, n, 1);
    Mat<double, N, N + 1> truth, found;
    for (double& value : truth.values) value = randomUniform<double>(generator, -3, 3);
    Points<N> b;
    for (const auto& p : a) b.push_back(mapped(truth, p));
    const bool is_lost = solver(a, b, found) != 1 || !(frobenius(found - truth) < 1e-6);
    lost += is_lost;
    if (is_lost) {
      EXPECT_LT(flatness(a), 1e-8);
    }
  }
  EXPECT_LE(lost, 1 + count / 10000);
}

TEST(Affine2D, FindsTheTruth) {
  expectAffineTruth<2>(affine2D, 3, 1);
  expectAffineTruth<2>(affine2D, 4, 2);
  expectAffineTruth<2>(affine2D, 30, 3);
}
TEST(Affine3D, FindsTheTruth) {
  expectAffineTruth<3>(affine3D, 4, 4);
  expectAffineTruth<3>(affine3D, 5, 5);
  expectAffineTruth<3>(affine3D, 30, 6);
}

// No small change of an element makes the sum of squares less.
template <std::size_t N, class Solver>
void expectAffineOptimum(const Solver& solver, unsigned seed) {
  std::mt19937 generator(seed);
  for (int i = 0; i < 100; ++i) {
    const Points<N> a = randomPoints<N>(generator, 12, 1);
    const Points<N> b = randomPoints<N>(generator, 12, 1);
    Mat<double, N, N + 1> best;
    ASSERT_EQ(solver(a, b, best), 1u);
    const double least = cost(best, a, b);
    for (std::size_t e = 0; e < N * (N + 1); ++e) {
      for (const double step : {-1e-4, 1e-4}) {
        auto other = best;
        other.values[e] += step;
        EXPECT_GT(cost(other, a, b), least);
      }
    }
  }
}
TEST(Affine2D, IsLeastSquares) {
  expectAffineOptimum<2>(affine2D, 7);
}
TEST(Affine3D, IsLeastSquares) {
  expectAffineOptimum<3>(affine3D, 8);
}

TEST(Affine2D, RefusesCollinearPoints) {
  std::mt19937 generator(9);
  for (const std::size_t n : {std::size_t(3), std::size_t(10)}) {
    for (int i = 0; i < 1000; ++i) {
      Points<2> a = randomPoints<2>(generator, n, 1);
      const Points<2> b = randomPoints<2>(generator, n, 1);
      for (std::size_t j = 2; j < n; ++j) {
        a[j] = a[0] + randomUniform<double>(generator, -1, 1) * (a[1] - a[0]);
      }
      Mat23 m = {};
      EXPECT_EQ(affine2D(a, b, m), 0u);
      EXPECT_EQ(m, Mat23{});
      // A line as the image is no obstacle.
      ASSERT_EQ(affine2D(b, a, m), 1u);
      EXPECT_NEAR(m(0, 0) * m(1, 1), m(0, 1) * m(1, 0), 1e-6 * (1 + frobenius(m) * frobenius(m)));
    }
  }
}

TEST(Affine3D, RefusesCoplanarPoints) {
  std::mt19937 generator(10);
  for (const std::size_t n : {std::size_t(4), std::size_t(10)}) {
    for (int i = 0; i < 1000; ++i) {
      Points<3> a = randomPoints<3>(generator, n, 1);
      const Points<3> b = randomPoints<3>(generator, n, 1);
      for (std::size_t j = 3; j < n; ++j) {
        a[j] = a[0] + randomUniform<double>(generator, -1, 1) * (a[1] - a[0]) +
               randomUniform<double>(generator, -1, 1) * (a[2] - a[0]);
      }
      Mat34 m = {};
      EXPECT_EQ(affine3D(a, b, m), 0u);
      EXPECT_EQ(m, Mat34{});
    }
  }
}

#ifdef GSLAM_HAS_OPENCV
TEST(Affine2D, AgreesWithOpenCv) {
  std::mt19937 generator(11);
  for (int i = 0; i < 100; ++i) {
    const Points<2> a = randomPoints<2>(generator, 3, 100);
    const Points<2> b = randomPoints<2>(generator, 3, 100);
    if (flatness(a) < 0.01) continue;
    cv::Point2f p[3], q[3];
    Points<2> single_a(3), single_b(3);  // OpenCV takes floats
    for (std::size_t j = 0; j < 3; ++j) {
      p[j] = cv::Point2f(float(a[j][0]), float(a[j][1]));
      q[j] = cv::Point2f(float(b[j][0]), float(b[j][1]));
      single_a[j] = {{p[j].x, p[j].y}};
      single_b[j] = {{q[j].x, q[j].y}};
    }
    std::vector<cv::Point2f> from(p, p + 3), to(q, q + 3);
    const cv::Mat_<double> other = cv::estimateAffine2D(from, to);
    Mat23 m;
    ASSERT_EQ(affine2D(single_a, single_b, m), 1u);
    ASSERT_EQ(other.rows, 2);
    for (int e = 0; e < 6; ++e) EXPECT_NEAR(m.values[e], other(e / 3, e % 3), 1e-4 * frobenius(m));
  }
}
#endif

Points<3> transformed(const SIM3d& s, const Points<3>& a) {
  Points<3> b;
  for (const Vec3d& p : a) b.push_back(s * p);
  return b;
}

double sineOf(const Points<3>& p) {
  const Vec3d u = p[1] - p[0], v = p[2] - p[0];
  return u.cross(v).norm() / (u.norm() * v.norm());
}

TEST(Rigid3D, FindsTheTruth) {
  std::mt19937 generator(12);
  for (const std::size_t n : {std::size_t(3), std::size_t(4), std::size_t(20)}) {
    const std::size_t count = instances(n == 3 ? 10000 : 1000);
    std::size_t lost = 0;
    for (std::size_t i = 0; i < count; ++i) {
      const Points<3> a = randomPoints<3>(generator, n, 2);
      const SE3d truth = randomOf<SE3d>(generator, 5.0);
      SE3d found;
      const Points<3> b = transformed(SIM3d(truth), a);
      const bool is_lost = rigid3D(a, b, found) != 1 || !found.isApprox(truth, 1e-6);
      lost += is_lost;
      if (is_lost && n == 3) {
        EXPECT_LT(sineOf(a), 1e-7);
      }
    }
    EXPECT_EQ(lost, 0u) << n;
  }
}

TEST(Similarity3D, FindsTheTruth) {
  std::mt19937 generator(13);
  for (const std::size_t n : {std::size_t(3), std::size_t(4), std::size_t(20)}) {
    const std::size_t count = instances(n == 3 ? 10000 : 1000);
    std::size_t lost = 0;
    for (std::size_t i = 0; i < count; ++i) {
      const Points<3> a = randomPoints<3>(generator, n, 2);
      const SIM3d truth = randomOf<SIM3d>(generator, 5.0, 100.0);
      SIM3d found;
      const bool is_lost = similarity3D(a, transformed(truth, a), found) != 1 ||
                           !found.rigid().isApprox(truth.rigid(), 1e-6 * (1 + truth.scale())) ||
                           !(std::fabs(found.scale() / truth.scale() - 1) < 1e-6);
      lost += is_lost;
    }
    EXPECT_EQ(lost, 0u) << n;
  }
}

TEST(Similarity3D, FindsHalfTurnsAndTheIdentity) {
  std::mt19937 generator(14);
  std::vector<Vec3d> turns = {{{0, 0, 0}},
                              {{3.141592653589793, 0, 0}},
                              {{0, 3.141592653589793, 0}},
                              {{0, 0, 3.141592653589793}},
                              {{2.221441469079183, 2.221441469079183, 0}}};
  for (const Vec3d& turn : turns) {
    for (const std::size_t n : {std::size_t(3), std::size_t(5)}) {
      const Points<3> a = randomPoints<3>(generator, n, 1);
      const SIM3d truth(SO3d::exp(turn), {{1, 2, 3}}, 2);
      SIM3d found;
      ASSERT_EQ(similarity3D(a, transformed(truth, a), found), 1u);
      EXPECT_TRUE(found.isApprox(truth, 1e-9)) << found;
    }
  }
}

Eigen::Matrix3Xd columns(const Points<3>& points) {
  Eigen::Matrix3Xd m(3, points.size());
  for (std::size_t i = 0; i < points.size(); ++i) {
    m.col(static_cast<Eigen::Index>(i)) << points[i][0], points[i][1], points[i][2];
  }
  return m;
}

double difference(const Mat4d& m, const Eigen::Matrix4d& other) {
  double sum = 0;
  for (int e = 0; e < 16; ++e) sum += std::fabs(m.values[e] - other(e / 4, e % 4));
  return sum;
}

// From nearly no noise to sets that have nothing to do with each other.
TEST(Similarity3D, AgreesWithUmeyamaOfEigen) {
  std::mt19937 generator(15);
  for (std::size_t i = 0; i < instances(2000); ++i) {
    const std::size_t n = 3 + i % 10;
    const Points<3> a = randomPoints<3>(generator, n, 2);
    const SIM3d truth = randomOf<SIM3d>(generator, 2.0, 3.0);
    Points<3> b = transformed(truth, a);
    const double noise = std::pow(10.0, randomUniform<double>(generator, -8, 1.5));
    for (Vec3d& p : b) p += noise * randomNormal<double, 3>(generator);
    SIM3d found;
    SE3d rigid;
    const Eigen::Matrix4d other = Eigen::umeyama(columns(a), columns(b), true);
    const Eigen::Matrix4d other_rigid = Eigen::umeyama(columns(a), columns(b), false);
    ASSERT_EQ(similarity3D(a, b, found), 1u);
    EXPECT_LT(difference(found.matrix(), other), 1e-7 * (1 + other.norm())) << n << ' ' << noise;
    ASSERT_EQ(rigid3D(a, b, rigid), 1u);
    EXPECT_LT(difference(rigid.matrix(), other_rigid), 1e-7 * (1 + other_rigid.norm())) << n;
  }
}

double weightedCost(const SIM3d& s, const Points<3>& a, const Points<3>& b,
                    const std::vector<double>& weights) {
  double sum = 0;
  for (std::size_t i = 0; i < a.size(); ++i) sum += weights[i] * (s * a[i] - b[i]).squaredNorm();
  return sum;
}

TEST(Similarity3D, IsTheWeightedOptimum) {
  std::mt19937 generator(16);
  for (int i = 0; i < 500; ++i) {
    const std::size_t n = 3 + static_cast<std::size_t>(i) % 4;
    const Points<3> a = randomPoints<3>(generator, n, 1);
    Points<3> b = transformed(randomOf<SIM3d>(generator, 1.0), a);
    for (Vec3d& p : b) p += 0.1 * randomNormal<double, 3>(generator);
    std::vector<double> weights(n);
    for (double& w : weights) w = randomUniform<double>(generator, 0.1, 10);
    SIM3d s;
    ASSERT_EQ(similarity3D(a, b, s, weights), 1u);
    SE3d t;
    ASSERT_EQ(rigid3D(a, b, t, weights), 1u);
    for (std::size_t e = 0; e < 7; ++e) {
      for (const double step : {-1e-4, 1e-4}) {
        Vec<double, 7> delta{};
        delta[e] = step;
        EXPECT_GE(weightedCost(s * SIM3d::exp(delta), a, b, weights),
                  weightedCost(s, a, b, weights));
        if (e == 6) continue;
        EXPECT_GE(weightedCost(SIM3d(t) * SIM3d::exp(delta), a, b, weights),
                  weightedCost(SIM3d(t), a, b, weights));
      }
    }
  }
}

TEST(Rigid3D, TakesWeightsAsRepetitions) {
  std::mt19937 generator(17);
  for (int i = 0; i < 200; ++i) {
    const std::size_t n = 3 + static_cast<std::size_t>(i) % 3;
    const Points<3> a = randomPoints<3>(generator, n, 1);
    const Points<3> b = randomPoints<3>(generator, n, 1);
    Points<3> more_a, more_b;
    std::vector<double> weights;
    for (std::size_t j = 0; j < n; ++j) {
      weights.push_back(static_cast<double>(j + 1));
      for (std::size_t k = 0; k <= j; ++k) {
        more_a.push_back(a[j]);
        more_b.push_back(b[j]);
      }
    }
    SE3d t, same;
    ASSERT_EQ(rigid3D(a, b, t, weights), rigid3D(more_a, more_b, same));
    EXPECT_TRUE(t.isApprox(same, 1e-7));
  }
}

TEST(Rigid3D, RefusesCollinearPoints) {
  std::mt19937 generator(18);
  for (const std::size_t n : {std::size_t(3), std::size_t(4), std::size_t(10)}) {
    for (int i = 0; i < 1000; ++i) {
      Points<3> a = randomPoints<3>(generator, n, 1);
      for (std::size_t j = 2; j < n; ++j) {
        a[j] = a[0] + randomUniform<double>(generator, -1, 1) * (a[1] - a[0]);
      }
      const Points<3> b = transformed(randomOf<SIM3d>(generator, 1.0), a);
      SE3d t;
      SIM3d s;
      EXPECT_EQ(rigid3D(a, b, t), 0u);
      EXPECT_EQ(similarity3D(a, b, s), 0u);
      EXPECT_EQ(rigid3D(a, randomPoints<3>(generator, n, 1), t), 0u);
    }
  }
}

TEST(Rigid3D, KeepsDigitsOfThinAndFarSets) {
  std::mt19937 generator(19);
  for (const std::size_t n : {std::size_t(3), std::size_t(4), std::size_t(30)}) {
    for (std::size_t i = 0; i < instances(1000); ++i) {
      Points<3> a = randomPoints<3>(generator, n, 1);
      const SO3d axis = randomOf<SO3d>(generator);
      for (Vec3d& p : a) {
        p[1] *= 1e-4;
        p[2] *= 1e-4;
        p = axis * p;
      }
      if (n == 3 && sineOf(a) < 1e-6) continue;
      const SE3d truth = randomOf<SE3d>(generator, 1.0);
      SE3d found;
      ASSERT_EQ(rigid3D(a, transformed(SIM3d(truth), a), found), 1u);
      // From the second moments: the square of the width counts. Three are solved without.
      EXPECT_TRUE(found.isApprox(truth, n == 3 ? 1e-9 : 1e-6)) << n << ' ' << sineOf(a);
    }
    for (std::size_t i = 0; i < instances(1000); ++i) {
      Points<3> a = randomPoints<3>(generator, n, 1);
      for (Vec3d& p : a) p += {{1e4, -1e4, 1e4}};
      if (n == 3 && sineOf(a) < 1e-3) continue;
      const SE3d truth = randomOf<SE3d>(generator, 1.0);
      SE3d found;
      ASSERT_EQ(rigid3D(a, transformed(SIM3d(truth), a), found), 1u);
      EXPECT_TRUE(found.rotation().isApprox(truth.rotation(), 1e-8));
      EXPECT_LT((found * a[0] - truth * a[0]).norm(), 1e-8);
    }
  }
}

TEST(Rigid3D, TurnsMirroredSetsAndRefusesAmbiguousOnes) {
  std::mt19937 generator(20);
  for (int i = 0; i < 300; ++i) {
    const Points<3> a = randomPoints<3>(generator, 8, 1);
    Points<3> b = a;
    for (Vec3d& p : b) p[2] = -p[2];
    SE3d t;
    ASSERT_EQ(rigid3D(a, b, t), 1u);
    const Eigen::Matrix4d other = Eigen::umeyama(columns(a), columns(b), false);
    EXPECT_LT(difference(t.matrix(), other), 1e-8);
  }
  const Points<3> octahedron = {{{1, 0, 0}},  {{-1, 0, 0}}, {{0, 1, 0}},
                                {{0, -1, 0}}, {{0, 0, 1}},  {{0, 0, -1}}};
  Points<3> mirrored = octahedron;
  for (Vec3d& p : mirrored) p[2] = -p[2];
  SE3d t;
  SIM3d s;
  EXPECT_EQ(rigid3D(octahedron, mirrored, t), 0u);
  EXPECT_EQ(similarity3D(octahedron, mirrored, s), 0u);
}

TEST(AlignmentSolvers, AreNeverNan) {
  std::mt19937 generator(21);
  for (const std::size_t n : {std::size_t(3), std::size_t(4), std::size_t(6)}) {
    for (const double value : absurdValues()) {
      for (std::size_t at = 0; at < 6 * n + n; ++at) {
        Points<3> a = randomPoints<3>(generator, n, 1);
        Points<3> b = randomPoints<3>(generator, n, 1);
        std::vector<double> weights(n, 1);
        if (at >= 6 * n) {
          weights[at - 6 * n] = value;
        } else {
          (at < 3 * n ? a : b)[at / 3 % n][at % 3] = value;
        }
        if (at % 7 == 0) {
          for (Vec3d& p : a) p *= value;
        }
        SE3d t;
        SIM3d s;
        SO3d r;
        Mat34 m;
        if (rigid3D(a, b, t, weights) == 1) {
          EXPECT_TRUE(isFinite(t)) << t;
        }
        if (similarity3D(a, b, s, weights) == 1) {
          EXPECT_TRUE(isFinite(s.rigid()) && std::isfinite(s.scale())) << s;
        }
        if (rotation2pt(a, b, r) == 1) {
          EXPECT_TRUE(isFinite(r.quaternion())) << r;
        }
        if (rotation2pt(Span<const Vec3d>(a).first(2), Span<const Vec3d>(b).first(2), r) == 1) {
          EXPECT_TRUE(isFinite(r.quaternion())) << r;
        }
        if (n > 3 && affine3D(a, b, m) == 1) {
          EXPECT_TRUE(isFinite(m)) << m;
        }
        Points<2> p = randomPoints<2>(generator, n, 1);
        Points<2> q = randomPoints<2>(generator, n, 1);
        (at % 2 ? p : q)[at % n][at / n % 2] = value;
        Mat23 f;
        if (affine2D(p, q, f) == 1) {
          EXPECT_TRUE(isFinite(f)) << f;
        }
      }
      const Points<3> same(n, Vec3d{{value, value, value}});
      const Points<3> other = randomPoints<3>(generator, n, 1);
      SE3d t;
      SIM3d s;
      EXPECT_EQ(rigid3D(same, other, t), 0u);
      EXPECT_EQ(rigid3D(other, same, t), 0u);
      EXPECT_EQ(similarity3D(same, other, s), 0u);
      EXPECT_EQ(similarity3D(other, same, s), 0u);
    }
  }
}

TEST(AlignmentSolvers, RefuseWrongSizes) {
  const Points<3> two(2), three(3), four(4);
  const Points<2> plane2(2), plane3(3), plane4(4);
  const std::vector<double> weights(2, 1);
  SE3d t;
  SIM3d s;
  SO3d r;
  Mat34 m;
  Mat23 f;
  EXPECT_THROW(rigid3D(two, two, t), ArgumentError);
  EXPECT_THROW(rigid3D(three, four, t), ArgumentError);
  EXPECT_THROW(rigid3D(three, three, t, weights), ArgumentError);
  EXPECT_THROW(similarity3D(two, two, s), ArgumentError);
  EXPECT_THROW(similarity3D(four, three, s), ArgumentError);
  EXPECT_THROW(similarity3D(three, three, s, weights), ArgumentError);
  EXPECT_THROW(rotation2pt(Span<const Vec3d>(two).first(1), Span<const Vec3d>(two).first(1), r),
               ArgumentError);
  EXPECT_THROW(rotation2pt(two, three, r), ArgumentError);
  EXPECT_THROW(affine3D(three, three, m), ArgumentError);
  EXPECT_THROW(affine3D(four, three, m), ArgumentError);
  EXPECT_THROW(affine2D(plane2, plane2, f), ArgumentError);
  EXPECT_THROW(affine2D(plane3, plane4, f), ArgumentError);
}

TEST(Rotation2pt, FindsTheTruth) {
  std::mt19937 generator(22);
  for (const std::size_t n : {std::size_t(2), std::size_t(3), std::size_t(20)}) {
    const std::size_t count = instances(n == 2 ? 10000 : 1000);
    for (std::size_t i = 0; i < count; ++i) {
      const SO3d truth = randomOf<SO3d>(generator);
      Points<3> a, b;
      for (std::size_t j = 0; j < n; ++j) {
        a.push_back(randomDirection<double>(generator));
        b.push_back(truth * a.back());
      }
      SO3d found;
      ASSERT_EQ(rotation2pt(a, b, found), 1u);
      EXPECT_TRUE(found.isApprox(truth, 1e-9));
    }
  }
}

TEST(Rotation2pt, IsLeastSquares) {
  std::mt19937 generator(23);
  for (int i = 0; i < 1000; ++i) {
    const std::size_t n = 2 + static_cast<std::size_t>(i) % 4;
    Points<3> a, b;
    for (std::size_t j = 0; j < n; ++j) {
      a.push_back(randomDirection<double>(generator));
      b.push_back(randomDirection<double>(generator));
    }
    const auto sum = [&](const SO3d& r) {
      double result = 0;
      for (std::size_t j = 0; j < n; ++j) result += (b[j] - r * a[j]).squaredNorm();
      return result;
    };
    SO3d best;
    ASSERT_EQ(rotation2pt(a, b, best), 1u);
    const double least = sum(best);
    for (int k = 0; k < 30; ++k) EXPECT_GE(sum(randomOf<SO3d>(generator)), least - 1e-12);
    for (int k = 0; k < 6; ++k) {
      Vec3d delta{};
      delta[static_cast<std::size_t>(k) % 3] = k < 3 ? 1e-4 : -1e-4;
      EXPECT_GE(sum(best * SO3d::exp(delta)), least - 1e-12);
    }
  }
}

TEST(Rotation2pt, RefusesParallelBearingsAndKeepsDigitsOfNearOnes) {
  std::mt19937 generator(24);
  for (int i = 0; i < 1000; ++i) {
    const Vec3d a = randomDirection<double>(generator);
    const SO3d truth = randomOf<SO3d>(generator);
    const Vec3d side = a.cross(randomDirection<double>(generator));
    const Vec3d near = (a + 1e-4 * side).normalized();
    SO3d r;
    const double sign = i % 2 ? 1 : -1;
    EXPECT_EQ(rotation2pt(Points<3>{a, sign * a}, Points<3>{a, near}, r), 0u);
    EXPECT_EQ(rotation2pt(Points<3>{a, near}, Points<3>{a, sign * a}, r), 0u);
    EXPECT_EQ(rotation2pt(Points<3>{a, a, -a}, Points<3>{a, a, -a}, r), 0u);
    ASSERT_EQ(rotation2pt(Points<3>{a, near}, Points<3>{truth * a, truth * near}, r), 1u);
    EXPECT_TRUE(r.isApprox(truth, 1e-15 / (1e-4 * side.norm()) * 10));
  }
}

}  // namespace
