#include <gslam/estimator/solvers/triangulate_linear.h>
#include <gslam/estimator/solvers/triangulate_midpoint.h>
#include <gslam/estimator/solvers/triangulate_optimal.h>
#include <gslam/estimator/solvers/triangulate_views.h>
#include <gtest/gtest.h>

#include <Eigen/Dense>
#include <algorithm>

#include "closed_form_helpers.h"
#include "instances.h"

#ifdef GSLAM_HAS_OPENCV
#include <opencv2/calib3d.hpp>
#endif

namespace {

using namespace gslam;
using namespace solver_test;

std::size_t viaViews(const SE3d& t, const Vec3d& f, const Vec3d& g, Vec3d& point) {
  const SE3d poses[2] = {SE3d(), t};
  const Vec3d bearings[2] = {f, g};
  return triangulateViews(poses, bearings, point);
}

using TwoView = std::size_t (*)(const SE3d&, const Vec3d&, const Vec3d&, Vec3d&);
struct Named {
  const char* name;
  TwoView solve;
};
const std::vector<Named> kSolvers = {
    {"midpoint", [](const SE3d& t, const Vec3d& f, const Vec3d& g,
                    Vec3d& p) { return triangulateMidpoint(t, f, g, p); }},
    {"optimal", [](const SE3d& t, const Vec3d& f, const Vec3d& g,
                   Vec3d& p) { return triangulateOptimal(t, f, g, p); }},
    {"linear", [](const SE3d& t, const Vec3d& f, const Vec3d& g,
                  Vec3d& p) { return triangulateLinear(t, f, g, p); }},
    {"views", viaViews}};

// Two cameras and a point, all around.
struct SeenPoint {
  SE3d t;
  Vec3d point, f, g;
  double parallax;
};
template <class Generator>
SeenPoint randomSeenPoint(Generator& generator, double baseline, double reach) {
  SeenPoint s;
  s.t = SE3d(randomOf<SO3d>(generator), baseline * randomDirection<double>(generator));
  s.point = randomUniform<double>(generator, 0.2, 1) * reach * randomDirection<double>(generator);
  s.f = s.point.normalized();
  s.g = (s.t * s.point).normalized();
  s.parallax = s.f.cross(s.t.rotation().inverse() * s.g).norm();
  return s;
}

TEST(Triangulation, FindsTheTruth) {
  for (const Named& solver : kSolvers) {
    std::mt19937 generator(1);
    std::size_t lost = 0;
    const std::size_t count = instances();
    for (std::size_t i = 0; i < count; ++i) {
      const SeenPoint s = randomSeenPoint(generator, 1, 10);
      Vec3d found;
      const bool is_lost =
          solver.solve(s.t, s.f, s.g, found) != 1 || !((found - s.point).norm() < 1e-6);
      lost += is_lost;
      if (is_lost) {
        EXPECT_LT(s.parallax, 1e-5) << solver.name;
      }
    }
    EXPECT_LE(lost, 1 + count / 10000) << solver.name;
  }
}

// The relative error of the depth is that of the parallax, which is 1e-16 / parallax.
TEST(Triangulation, KeepsDigitsAtSmallParallax) {
  for (const Named& solver : kSolvers) {
    std::mt19937 generator(2);
    for (const double baseline : {1e-2, 1e-4, 1e-6}) {
      for (std::size_t i = 0; i < instances(500); ++i) {
        const SeenPoint s = randomSeenPoint(generator, baseline, 10);
        if (s.parallax < 0.02 * baseline) continue;
        Vec3d found;
        ASSERT_EQ(solver.solve(s.t, s.f, s.g, found), 1u) << solver.name << ' ' << s.parallax;
        EXPECT_LT((found - s.point).norm(), 1e-14 / s.parallax * s.point.norm())
            << solver.name << ' ' << s.parallax;
      }
    }
  }
}

TEST(Triangulation, RefusesParallelRaysAndPointsBehind) {
  for (const Named& solver : kSolvers) {
    std::mt19937 generator(3);
    for (int i = 0; i < 1000; ++i) {
      const SeenPoint s = randomSeenPoint(generator, 1, 3);
      Vec3d found = {{7, 8, 9}};
      // At infinity.
      EXPECT_EQ(solver.solve(s.t, s.f, s.t.rotation() * s.f, found), 0u) << solver.name;
      // Without a motion.
      EXPECT_EQ(solver.solve(SE3d(s.t.rotation(), {{0, 0, 0}}), s.f, s.g, found), 0u)
          << solver.name;
      // On the other side of one camera or both.
      EXPECT_EQ(solver.solve(s.t, -s.f, s.g, found), 0u) << solver.name;
      EXPECT_EQ(solver.solve(s.t, s.f, -s.g, found), 0u) << solver.name;
      EXPECT_EQ(solver.solve(s.t, -s.f, -s.g, found), 0u) << solver.name;
      EXPECT_EQ(found, (Vec3d{{7, 8, 9}}));
    }
  }
}

// Rays that have nothing to do with each other: none, or a point in front of both.
TEST(Triangulation, IsInFrontOfBothWhateverTheRays) {
  for (const Named& solver : kSolvers) {
    std::mt19937 generator(4);
    std::size_t found = 0;
    for (std::size_t i = 0; i < instances(2000); ++i) {
      const SE3d t = randomOf<SE3d>(generator);
      const Vec3d f = randomDirection<double>(generator);
      const Vec3d g = randomDirection<double>(generator);
      Vec3d p;
      if (solver.solve(t, f, g, p) == 0) continue;
      ++found;
      EXPECT_GT(p.dot(f), 0) << solver.name;
      EXPECT_GT((t * p).dot(g), 0) << solver.name;
    }
    EXPECT_GT(found, instances(2000) / 8) << solver.name;
  }
}

TEST(Triangulation, IsNeverNan) {
  for (const Named& solver : kSolvers) {
    std::mt19937 generator(5);
    for (const double value : absurdValues()) {
      for (std::size_t at = 0; at < 10; ++at) {
        SeenPoint s = randomSeenPoint(generator, 1, 3);
        Vec3d t = s.t.translation();
        if (at < 3) s.f[at] = value;
        if (at >= 3 && at < 6) s.g[at - 3] = value;
        if (at >= 6 && at < 9) t[at - 6] = value;
        if (at == 9) {
          s.f *= value;
          s.g *= value;
          t *= value;
        }
        Vec3d p;
        if (solver.solve(SE3d(s.t.rotation(), t), s.f, s.g, p) == 1) {
          EXPECT_TRUE(isFinite(p)) << solver.name << ' ' << p;
        }
      }
    }
  }
}

double sine2(const Vec3d& bearing, const Vec3d& to_point) {
  return bearing.cross(to_point.normalized()).squaredNorm();
}

// Against a search around the result.
TEST(TriangulateOptimal, HasTheLeastSumOfSquaredSines) {
  std::mt19937 generator(6);
  for (int i = 0; i < 300; ++i) {
    const SeenPoint s = randomSeenPoint(generator, 1, 3);
    if (s.parallax < 0.1) continue;
    const Vec3d f = (s.f + 0.02 * randomNormal<double, 3>(generator)).normalized();
    const Vec3d g = (s.g + 0.02 * randomNormal<double, 3>(generator)).normalized();
    Vec3d p;
    if (triangulateOptimal(s.t, f, g, p) == 0) continue;
    const auto cost = [&](const Vec3d& q) { return sine2(f, q) + sine2(g, s.t * q); };
    const double least = cost(p);
    for (const double reach : {1e-4, 1e-2, 1.0}) {
      for (int k = 0; k < 50; ++k) {
        const Vec3d other = p + reach * p.norm() * randomNormal<double, 3>(generator);
        EXPECT_GE(cost(other), least * (1 - 1e-12));
      }
    }
    Vec3d views;
    ASSERT_EQ(viaViews(s.t, f, g, views), 1u);
    EXPECT_LT((views - p).norm(), 1e-2 * p.norm());  // chords for sines
  }
}

// The linear problem, solved by Eigen in full.
TEST(TriangulateLinear, IsTheNullVectorOfTheFourByFourMatrix) {
  std::mt19937 generator(7);
  for (std::size_t i = 0; i < instances(2000); ++i) {
    const SeenPoint s = randomSeenPoint(generator, 1, 5);
    const double noise = i % 2 ? 0.01 : 0.3;
    const Vec3d f = (s.f + noise * randomNormal<double, 3>(generator)).normalized();
    const Vec3d g = (s.g + noise * randomNormal<double, 3>(generator)).normalized();
    Eigen::Matrix<double, 6, 4> a = Eigen::Matrix<double, 6, 4>::Zero();
    const Mat3d fx = SO3d::hat(f);
    const Mat<double, 3, 4> gx = SO3d::hat(g) * s.t.matrix3x4();
    for (int r = 0; r < 3; ++r) {
      for (int c = 0; c < 4; ++c) {
        if (c < 3) a(r, c) = fx.values[3 * r + c];
        a(3 + r, c) = gx.values[4 * r + c];
      }
    }
    const Eigen::JacobiSVD<Eigen::Matrix<double, 6, 4>> svd(a, Eigen::ComputeFullV);
    const Eigen::Vector4d x = svd.matrixV().col(3);
    const Vec3d other = {{x[0] / x[3], x[1] / x[3], x[2] / x[3]}};
    const bool in_front = other.dot(f) > 0 && (s.t * other).dot(g) > 0;
    Vec3d p;
    const bool found = triangulateLinear(s.t, f, g, p) == 1;
    // Where two singular values are near, the vector is not defined.
    const double gap = svd.singularValues()[2] - svd.singularValues()[3];
    if (gap < 1e-4 || std::fabs(x[3]) < 1e-4) continue;
    EXPECT_EQ(found, in_front);
    if (found) {
      EXPECT_LT((p - other).norm(), 1e-6 * (1 + other.squaredNorm()));
    }
  }
}

TEST(TriangulateMidpoint, IsBetweenTheRays) {
  std::mt19937 generator(8);
  for (int i = 0; i < 500; ++i) {
    const SE3d t = randomOf<SE3d>(generator);
    const Vec3d f = randomDirection<double>(generator);
    const Vec3d g = randomDirection<double>(generator);
    Vec3d p;
    if (triangulateMidpoint(t, f, g, p) == 0) continue;
    // The feet on the rays are at the same distance on opposite sides.
    const Vec3d foot = p.dot(f) * f;
    const Vec3d q = t * p;
    const Vec3d other = t.rotation().inverse() * (q.dot(g) * g - q);
    EXPECT_LT((foot - p + other).norm(), 1e-9 * (1 + p.norm()));
  }
}

double chords(Span<const SE3d> poses, Span<const Vec3d> bearings, const Vec3d& p) {
  double sum = 0;
  for (std::size_t i = 0; i < poses.size(); ++i) {
    sum += ((poses[i] * p).normalized() - bearings[i]).squaredNorm();
  }
  return sum;
}

TEST(TriangulateViews, HasTheLeastSumOfSquaredChords) {
  std::mt19937 generator(9);
  std::size_t solved = 0;
  for (int i = 0; i < 300; ++i) {
    const std::size_t n = 2 + static_cast<std::size_t>(i) % 10;
    const Vec3d point = {{100, -200, 50}};
    std::vector<SE3d> poses;
    std::vector<Vec3d> bearings;
    for (std::size_t j = 0; j < n; ++j) {
      const SE3d T_world_camera(randomOf<SO3d>(generator),
                                point + 3 * randomNormal<double, 3>(generator));
      poses.push_back(T_world_camera.inverse());
      bearings.push_back((poses.back() * point).normalized());
    }
    Vec3d p;
    ASSERT_EQ(triangulateViews(poses, bearings, p), 1u);
    EXPECT_LT((p - point).norm(), 1e-9);
    for (Vec3d& f : bearings) f = (f + 0.01 * randomNormal<double, 3>(generator)).normalized();
    if (triangulateViews(poses, bearings, p) == 0) continue;
    ++solved;
    const double least = chords(poses, bearings, p);
    for (const double reach : {1e-4, 1e-2, 1.0}) {
      for (int k = 0; k < 50; ++k) {
        const Vec3d other = p + reach * randomNormal<double, 3>(generator);
        EXPECT_GE(chords(poses, bearings, other), least * (1 - 1e-9));
      }
    }
  }
  EXPECT_GT(solved, 290u);
}

TEST(TriangulateViews, RefusesOnePointBehindAndWrongSizes) {
  std::mt19937 generator(10);
  const Vec3d point = {{1, 2, 3}};
  std::vector<SE3d> poses;
  std::vector<Vec3d> bearings;
  for (int j = 0; j < 5; ++j) {
    poses.push_back(randomOf<SE3d>(generator, 4.0));
    bearings.push_back((poses.back() * point).normalized());
  }
  Vec3d p;
  EXPECT_EQ(triangulateViews(poses, bearings, p), 1u);
  bearings[3] = -bearings[3];
  EXPECT_EQ(triangulateViews(poses, bearings, p), 0u);
  EXPECT_THROW(
      triangulateViews(Span<const SE3d>(poses).first(1), Span<const Vec3d>(bearings).first(1), p),
      ArgumentError);
  EXPECT_THROW(triangulateViews(poses, Span<const Vec3d>(bearings).first(4), p), ArgumentError);
}

#ifdef GSLAM_HAS_OPENCV
// In pixels, with a normal stereo pair, the two should be as good.
TEST(TriangulateOptimal, IsAsGoodAsOpenCv) {
  std::mt19937 generator(11);
  std::vector<double> ours, theirs;
  for (int i = 0; i < 2000; ++i) {
    const SE3d t(SO3d::exp(0.1 * randomDirection<double>(generator)),
                 randomDirection<double>(generator));
    const Vec3d point = {{randomUniform<double>(generator, -2, 2),
                          randomUniform<double>(generator, -2, 2),
                          randomUniform<double>(generator, 3, 8)}};
    const Vec3d q = t * point;
    const Vec2d noise_a = 1e-3 * randomNormal<double, 2>(generator);
    const Vec2d noise_b = 1e-3 * randomNormal<double, 2>(generator);
    const Vec3d a = {{point[0] / point[2] + noise_a[0], point[1] / point[2] + noise_a[1], 1}};
    const Vec3d b = {{q[0] / q[2] + noise_b[0], q[1] / q[2] + noise_b[1], 1}};
    Vec3d p;
    if (triangulateOptimal(t, a.normalized(), b.normalized(), p) == 0) continue;
    const Mat<double, 3, 4> second = t.matrix3x4();
    cv::Mat_<double> m1(3, 4, 0.0), m2(3, 4), x;
    for (int d = 0; d < 3; ++d) m1(d, d) = 1;
    for (int e = 0; e < 12; ++e) m2(e / 4, e % 4) = second.values[e];
    const cv::Mat_<double> pa = (cv::Mat_<double>(2, 1) << a[0], a[1]);
    const cv::Mat_<double> pb = (cv::Mat_<double>(2, 1) << b[0], b[1]);
    cv::triangulatePoints(m1, m2, pa, pb, x);
    ours.push_back((p - point).norm());
    theirs.push_back((Vec3d{{x(0), x(1), x(2)}} / x(3) - point).norm());
  }
  const auto median = [](std::vector<double>& v) {
    std::nth_element(v.begin(), v.begin() + static_cast<std::ptrdiff_t>(v.size() / 2), v.end());
    return v[v.size() / 2];
  };
  EXPECT_GT(ours.size(), 1900u);
  EXPECT_LT(median(ours), 1.05 * median(theirs));
}
#endif

}  // namespace
