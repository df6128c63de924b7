// Absolute pose from n points: sqpnp, epnp, gpnp.
#include <gslam/estimator/solvers/epnp.h>
#include <gslam/estimator/solvers/gpnp.h>
#include <gslam/estimator/solvers/sqpnp.h>
#include <gslam/geometry/random.h>
#include <gslam/geometry/se3.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <random>
#include <string>
#include <utility>
#include <vector>

#include "instances.h"

#ifdef GSLAM_HAS_OPENCV
#include <opencv2/calib3d.hpp>
#endif
#ifdef GSLAM_HAS_OPENGV
#include <opengv/absolute_pose/NoncentralAbsoluteAdapter.hpp>
#include <opengv/absolute_pose/methods.hpp>
#endif

namespace {

using gslam::Mat3d;
using gslam::SE3d;
using gslam::SO3d;
using gslam::Span;
using gslam::Vec;
using gslam::Vec3d;

enum class PointLayout {
  kBox,         // 4 m wide, 6 m away
  kPlanar,      // 4 m wide, 6 m away, any slope
  kNearPlanar,  // the same, 1 mm thick
  kFar,         // 2 m wide, 10 km away
  kFarHalf,     // half of the points 10 km away
  kWide,        // up to 120 degrees off the axis
  kNearLine,    // 4 m long, 0.2 mm thick
  kOffAxis,     // 1 m wide, in a corner of the image
  kCubic,       // on a twisted cubic through the camera, where the relaxed problem is singular
  kUtm          // the box, 1000 km from the origin of the world
};
const PointLayout kLayouts[] = {
    PointLayout::kBox,     PointLayout::kPlanar, PointLayout::kNearPlanar, PointLayout::kFar,
    PointLayout::kFarHalf, PointLayout::kWide,   PointLayout::kNearLine,   PointLayout::kOffAxis,
    PointLayout::kCubic,   PointLayout::kUtm};

const char* nameOf(PointLayout scene) {
  static const char* const kNames[] = {"box",  "planar",      "near planar", "far",   "far half",
                                       "wide", "near a line", "off axis",    "cubic", "UTM"};
  return kNames[static_cast<int>(scene)];
}

struct Instance {
  SE3d truth;  // T_camera_world
  std::vector<Vec3d> origins, bearings, points;
};

// A point in camera coordinates, with the directions of the scene.
Vec3d randomPointIn(std::mt19937& generator, PointLayout scene, const SO3d& slope, bool is_far) {
  const auto within = [&](double reach) {
    return gslam::randomUniform<double>(generator, -reach, reach);
  };
  const Vec3d centre = {0, 0, 6};
  switch (scene) {
    case PointLayout::kPlanar:
      return centre + slope * Vec3d{within(2), within(2), 0};
    case PointLayout::kNearPlanar:
      return centre + slope * Vec3d{within(2), within(2), within(1e-3)};
    case PointLayout::kNearLine:
      return centre + slope * Vec3d{within(2), within(2e-4), within(2e-4)};
    case PointLayout::kFar:
      return {within(1), within(1), 1e4 + within(1)};
    case PointLayout::kWide: {
      Vec3d direction;
      do direction = gslam::randomDirection<double>(generator);
      while (direction[2] < -0.5);
      return gslam::randomUniform<double>(generator, 2, 8) * direction;
    }
    case PointLayout::kOffAxis:
      return {1.5 + within(0.5), 1.5 + within(0.5), 6 + within(2)};
    case PointLayout::kCubic: {
      const double s = gslam::randomUniform<double>(generator, 0.5, 2);
      return {s * s, s * s * s / 2, 3 * s};
    }
    case PointLayout::kFarHalf:
      if (is_far) return {within(1), within(1), 1e4 + within(1)};
      break;
    case PointLayout::kBox:
    case PointLayout::kUtm:
      break;
  }
  return {within(2), within(2), 6 + within(2)};
}

// `rig` is how far from the middle of the rig the rays start, `noise` the standard deviation of the
// bearings in radians.
Instance makeInstance(std::mt19937& generator, std::size_t n, PointLayout scene, double noise = 0,
                      double rig = 0) {
  Instance instance;
  const double reach = scene == PointLayout::kUtm ? 1e6 : 5;
  const SE3d T_world_camera = gslam::randomOf<SE3d>(generator, reach);
  instance.truth = T_world_camera.inverse();
  const SO3d slope = gslam::randomOf<SO3d>(generator);
  for (std::size_t i = 0; i < n; ++i) {
    const Vec3d point = randomPointIn(generator, scene, slope, i >= n / 2);
    const Vec3d origin = rig * gslam::randomDirection<double>(generator);
    const Vec3d direction = (point - origin).normalized();
    const Vec3d error = noise * gslam::randomNormal<double, 3>(generator);
    instance.origins.push_back(origin);
    instance.bearings.push_back((direction + error).normalized());
    instance.points.push_back(T_world_camera * point);
  }
  return instance;
}

// Radians, or the error of the translation as a part of it.
double difference(const SE3d& a, const SE3d& b) {
  const double angle = (a.rotation().inverse() * b.rotation()).angle();
  const double translation =
      (a.translation() - b.translation()).norm() / (1 + b.translation().norm());
  return std::isfinite(translation) ? std::max(angle, translation)
                                    : std::numeric_limits<double>::infinity();
}

// Residuals: vectors from the rays, half lines, to the points.
std::vector<double> residuals(const Instance& instance, const SE3d& T) {
  std::vector<double> result;
  for (std::size_t i = 0; i < instance.points.size(); ++i) {
    const Vec3d p = T * instance.points[i] - instance.origins[i];
    const Vec3d& b = instance.bearings[i];
    const Vec3d off = p - std::max(0.0, p.dot(b)) * b;
    result.insert(result.end(), off.data(), off.data() + 3);
  }
  return result;
}

double costOf(const std::vector<double>& residual) {
  double sum = 0;
  for (const double value : residual) sum += value * value;
  return sum / (static_cast<double>(residual.size()) / 3);
}
double costOf(const Instance& instance, const SE3d& T) {
  return costOf(residuals(instance, T));
}

// Gaussian elimination with pivots, of six unknowns.
Vec<double, 6> solveSix(std::array<std::array<double, 7>, 6> m) {
  for (std::size_t k = 0; k < 6; ++k) {
    std::size_t pivot = k;
    for (std::size_t i = k; i < 6; ++i) {
      if (std::fabs(m[i][k]) > std::fabs(m[pivot][k])) pivot = i;
    }
    std::swap(m[k], m[pivot]);
    for (std::size_t i = k + 1; i < 6; ++i) {
      const double factor = m[i][k] / m[k][k];
      for (std::size_t j = k; j < 7; ++j) m[i][j] -= factor * m[k][j];
    }
  }
  Vec<double, 6> x;
  for (std::size_t k = 6; k-- > 0;) {
    x[k] = m[k][6];
    for (std::size_t j = k + 1; j < 6; ++j) x[k] -= m[k][j] * x[j];
    x[k] /= m[k][k];
  }
  return x;
}

// The minimum next to T, by damped Gauss-Newton with numeric derivatives: shares nothing with the
// solvers.
SE3d refined(const Instance& instance, SE3d T, int iterations = 12) {
  double damping = 1e-6;
  for (int iteration = 0; iteration < iterations; ++iteration) {
    const std::vector<double> r = residuals(instance, T);
    std::array<std::vector<double>, 6> jacobian;
    for (std::size_t k = 0; k < 6; ++k) {
      Vec<double, 6> step{};
      step[k] = 1e-5;
      const std::vector<double> up = residuals(instance, T * SE3d::exp(step));
      const std::vector<double> down = residuals(instance, T * SE3d::exp(-1 * step));
      for (std::size_t i = 0; i < up.size(); ++i) {
        jacobian[k].push_back((up[i] - down[i]) / 2e-5);
      }
    }
    std::array<std::array<double, 7>, 6> m{};
    for (std::size_t i = 0; i < r.size(); ++i) {
      for (std::size_t p = 0; p < 6; ++p) {
        for (std::size_t q = 0; q < 6; ++q) m[p][q] += jacobian[p][i] * jacobian[q][i];
        m[p][6] -= jacobian[p][i] * r[i];
      }
    }
    for (std::size_t p = 0; p < 6; ++p) m[p][p] *= 1 + damping;
    const SE3d next = T * SE3d::exp(solveSix(m));
    if (costOf(instance, next) < costOf(r)) {
      T = next;
      damping *= 0.1;
    } else {
      damping *= 100;
    }
  }
  return T;
}

enum class PnpSolver { kSqpnp, kEpnp, kGpnp };

std::vector<SE3d> solve(PnpSolver solver, const Instance& instance) {
  std::array<SE3d, 4> poses;
  std::size_t count = 0;
  switch (solver) {
    case PnpSolver::kSqpnp:
      count = gslam::sqpnp(instance.bearings, instance.points, poses);
      break;
    case PnpSolver::kEpnp:
      count = gslam::epnp(instance.bearings, instance.points, poses[0]);
      break;
    case PnpSolver::kGpnp:
      count = gslam::gpnp(instance.origins, instance.bearings, instance.points, poses);
      break;
  }
  EXPECT_LE(count, poses.size());
  return {poses.begin(), poses.begin() + static_cast<std::ptrdiff_t>(count)};
}

// Of exact data: parts that lost the truth; every solution must go through the points.
double lostPart(PnpSolver solver, std::size_t n, PointLayout scene, std::size_t instances,
                double rig = 0) {
  std::mt19937 generator(17);
  std::size_t lost = 0;
  for (std::size_t i = 0; i < instances; ++i) {
    const Instance instance = makeInstance(generator, n, scene, 0, rig);
    double nearest = std::numeric_limits<double>::infinity();
    double last_cost = 0;
    for (const SE3d& T : solve(solver, instance)) {
      nearest = std::min(nearest, difference(T, instance.truth));
      const double cost = costOf(instance, T);
      EXPECT_TRUE(std::isfinite(cost));
      EXPECT_GE(cost, last_cost * (1 - 1e-6) - 1e-9) << nameOf(scene);
      last_cost = cost;
    }
    if (!(nearest < 1e-6)) ++lost;
  }
  return static_cast<double>(lost) / static_cast<double>(instances);
}

class Pnp : public testing::TestWithParam<std::size_t> {};  // the number of points

TEST_P(Pnp, SqpnpFindsTheTruth) {
  const std::size_t n = GetParam();
  const std::size_t count = solver_test::instances(n == 100 ? 100 : 500);
  for (const PointLayout scene : kLayouts) {
    const bool is_hard =
        n == 3 && (scene == PointLayout::kNearLine || scene == PointLayout::kFarHalf);
    EXPECT_LE(lostPart(PnpSolver::kSqpnp, n, scene, count), is_hard  ? 0.01
                                                            : n == 3 ? 0.001
                                                                     : 0)
        << nameOf(scene) << ", " << n << " points";
  }
}

TEST(Sqpnp, LosesFewOfThreePoints) {
  EXPECT_LE(lostPart(PnpSolver::kSqpnp, 3, PointLayout::kBox, solver_test::instances()), 2e-4);
}

TEST(Sqpnp, LosesNoneOfFourPoints) {
  EXPECT_EQ(0, lostPart(PnpSolver::kSqpnp, 4, PointLayout::kBox, solver_test::instances()));
}

TEST(Sqpnp, LosesNoneOfSixPoints) {
  EXPECT_EQ(0, lostPart(PnpSolver::kSqpnp, 6, PointLayout::kBox, solver_test::instances()));
}

TEST(Sqpnp, LosesNoPlane) {
  EXPECT_EQ(0, lostPart(PnpSolver::kSqpnp, 6, PointLayout::kPlanar, solver_test::instances()));
}

TEST_P(Pnp, EpnpFindsTheTruth) {
  const std::size_t n = GetParam();
  if (n < 4) return;
  const std::size_t count = solver_test::instances(n == 100 ? 100 : n < 6 ? 200 : 400);
  for (const PointLayout scene : kLayouts) {
    double bound = 0;
    if (n == 4)
      bound = scene == PointLayout::kNearLine ? 0.02 : scene == PointLayout::kCubic ? 0.1 : 0.005;
    if (n == 5) bound = scene == PointLayout::kNearLine || scene == PointLayout::kCubic ? 0.01 : 0;
    if (scene == PointLayout::kPlanar) bound = 0;
    EXPECT_LE(lostPart(PnpSolver::kEpnp, n, scene, count), bound)
        << nameOf(scene) << ", " << n << " points";
  }
}

TEST(Epnp, LosesNoneOfSixPoints) {
  EXPECT_EQ(0, lostPart(PnpSolver::kEpnp, 6, PointLayout::kBox, solver_test::instances()));
}

TEST(Epnp, LosesNoPlane) {
  EXPECT_EQ(0, lostPart(PnpSolver::kEpnp, 4, PointLayout::kPlanar, solver_test::instances()));
}

TEST_P(Pnp, GpnpFindsTheTruth) {
  const std::size_t n = GetParam();
  if (n < 4) return;
  const std::size_t count = solver_test::instances(n == 100 ? 100 : 400);
  for (const PointLayout scene : kLayouts) {
    double bound = n <= 5 ? 0.003 : 0;
    if (scene == PointLayout::kNearLine) bound = n <= 5 ? 0.05 : 0.005;
    if (scene == PointLayout::kPlanar) bound = 0;
    EXPECT_LE(lostPart(PnpSolver::kGpnp, n, scene, count, 0.5), bound)
        << nameOf(scene) << ", " << n << " points";
  }
}

TEST(Gpnp, LosesFewOfFourPoints) {
  EXPECT_LE(lostPart(PnpSolver::kGpnp, 4, PointLayout::kBox, solver_test::instances(), 0.5), 5e-4);
}

TEST(Gpnp, LosesNoneOfTenPoints) {
  EXPECT_EQ(0, lostPart(PnpSolver::kGpnp, 10, PointLayout::kBox, solver_test::instances(), 0.5));
}

TEST(Gpnp, LosesNoPlane) {
  EXPECT_EQ(0, lostPart(PnpSolver::kGpnp, 6, PointLayout::kPlanar, solver_test::instances(), 0.5));
}

TEST(Gpnp, SolvesCentralAndNearlyCentralRigs) {
  for (const double rig : {0.0, 1e-12, 1e-9, 1e-6, 1e-3}) {
    for (const PointLayout scene : {PointLayout::kBox, PointLayout::kPlanar, PointLayout::kWide}) {
      for (const std::size_t n : {4u, 6u, 10u}) {
        EXPECT_LE(lostPart(PnpSolver::kGpnp, n, scene, solver_test::instances(200), rig),
                  n == 4 && scene != PointLayout::kPlanar ? 0.005 : 0)
            << nameOf(scene) << ", " << n << " points, rig of " << rig;
      }
    }
  }
}

TEST(Gpnp, TakesRigsWhoseOriginIsFarOff) {
  std::mt19937 generator(5);
  for (std::size_t i = 0; i < solver_test::instances(300); ++i) {
    Instance instance = makeInstance(generator, 8, PointLayout::kBox, 0, 0.5);
    const Vec3d shift = 1000.0 * gslam::randomDirection<double>(generator);
    for (Vec3d& origin : instance.origins) origin += shift;
    instance.truth = SE3d(SO3d(), shift) * instance.truth;
    const std::vector<SE3d> poses = solve(PnpSolver::kGpnp, instance);
    ASSERT_EQ(1u, poses.size());
    EXPECT_LT(difference(poses[0], instance.truth), 1e-9);
  }
}

TEST(Sqpnp, GivesAllPosesOfThreePoints) {
  std::mt19937 generator(9);
  std::array<std::size_t, 5> counts{};
  for (std::size_t i = 0; i < solver_test::instances(1000); ++i) {
    const Instance instance = makeInstance(generator, 3, PointLayout::kBox);
    const std::vector<SE3d> poses = solve(PnpSolver::kSqpnp, instance);
    ++counts[poses.size()];
    for (const SE3d& T : poses) EXPECT_LT(costOf(instance, T), 1e-15);
    for (std::size_t a = 0; a < poses.size(); ++a) {
      for (std::size_t b = 0; b < a; ++b) EXPECT_GT(difference(poses[a], poses[b]), 1e-6);
    }
  }
  EXPECT_EQ(0u, counts[0]);
  EXPECT_GT(counts[2], counts[1]);
  EXPECT_GT(counts[4], 0u);
}

// With noise of a pixel and of ten the cost must not be above that of the minimum next to the
// truth, nor of the minima next to some random poses.
void expectGlobalMinimum(PnpSolver solver, std::size_t n, PointLayout scene, double noise,
                         double rig) {
  std::mt19937 generator(23);
  std::size_t worse = 0;
  const std::size_t count = solver_test::instances(n > 6 ? 6 : 20);
  for (std::size_t i = 0; i < count; ++i) {
    const Instance instance = makeInstance(generator, n, scene, noise, rig);
    const std::vector<SE3d> poses = solve(solver, instance);
    ASSERT_FALSE(poses.empty()) << nameOf(scene) << ", " << n << " points";
    const double cost = costOf(instance, poses[0]);
    double least = costOf(instance, refined(instance, instance.truth));
    for (int k = 0; k < 3; ++k) {
      const SE3d start(gslam::randomOf<SO3d>(generator), poses[0].translation());
      least = std::min(least, costOf(instance, refined(instance, start)));
    }
    if (cost > least * (1 + 1e-6) + 1e-14) ++worse;
  }
  EXPECT_LE(worse, count / 20) << nameOf(scene) << ", " << n << " points, noise " << noise;
}

TEST_P(Pnp, SqpnpFindsTheGlobalMinimum) {
  const std::size_t n = std::min<std::size_t>(GetParam(), 20);
  if (n < 4) return;
  for (const PointLayout scene :
       {PointLayout::kBox, PointLayout::kPlanar, PointLayout::kNearPlanar, PointLayout::kWide}) {
    for (const double noise : {1e-3, 1e-2}) {
      expectGlobalMinimum(PnpSolver::kSqpnp, n, scene, noise, 0);
    }
  }
}

TEST_P(Pnp, GpnpFindsTheGlobalMinimum) {
  const std::size_t n = std::min<std::size_t>(GetParam(), 20);
  if (n < 4) return;
  for (const PointLayout scene : {PointLayout::kBox, PointLayout::kPlanar, PointLayout::kWide}) {
    expectGlobalMinimum(PnpSolver::kGpnp, n, scene, 1e-3, 0.5);
  }
}

TEST(Epnp, FindsTheMinimum) {
  std::mt19937 generator(29);
  std::size_t worse = 0, all = 0;
  for (const PointLayout scene :
       {PointLayout::kBox, PointLayout::kPlanar, PointLayout::kNearPlanar, PointLayout::kWide}) {
    for (std::size_t i = 0; i < solver_test::instances(40); ++i, ++all) {
      const Instance instance = makeInstance(generator, 10, scene, 1e-3);
      const std::vector<SE3d> poses = solve(PnpSolver::kEpnp, instance);
      ASSERT_EQ(1u, poses.size());
      const double least = costOf(instance, refined(instance, instance.truth));
      if (!(costOf(instance, poses[0]) < (1 + 1e-6) * least)) ++worse;
    }
  }
  EXPECT_LE(worse, all / 100);
}

TEST(Sqpnp, GivesBothPosesOfAPlaneSeenFromAfar) {
  std::mt19937 generator(31);
  std::size_t twofold = 0;
  const std::size_t count = solver_test::instances(300);
  for (std::size_t i = 0; i < count; ++i) {
    Instance instance = makeInstance(generator, 8, PointLayout::kPlanar);
    // 20 m farther off, with the same noise as before: a plane of 4 m.
    for (std::size_t k = 0; k < 8; ++k) {
      const Vec3d p = instance.truth * instance.points[k] + Vec3d{0, 0, 20};
      const Vec3d error = 1e-3 * gslam::randomNormal<double, 3>(generator);
      instance.bearings[k] = (p.normalized() + error).normalized();
    }
    const std::vector<SE3d> poses = solve(PnpSolver::kSqpnp, instance);
    ASSERT_FALSE(poses.empty());
    double last_cost = 0;
    for (const SE3d& T : poses) {
      const double cost = costOf(instance, T);
      EXPECT_GE(cost, last_cost * (1 - 1e-9));
      EXPECT_GT(costOf(instance, refined(instance, T, 3)), cost * (1 - 1e-6));  // a minimum
      last_cost = cost;
    }
    if (poses.size() == 2) ++twofold;
  }
  EXPECT_GT(twofold, count / 10);
}

TEST(PnpSolvers, RefusesSizes) {
  std::array<SE3d, 4> poses;
  SE3d pose;
  const std::vector<Vec3d> two(2), three(3), four(4), five(5);
  EXPECT_THROW(gslam::sqpnp(two, two, poses), gslam::ArgumentError);
  EXPECT_THROW(gslam::sqpnp(three, four, poses), gslam::ArgumentError);
  EXPECT_THROW(gslam::epnp(three, three, pose), gslam::ArgumentError);
  EXPECT_THROW(gslam::epnp(four, five, pose), gslam::ArgumentError);
  EXPECT_THROW(gslam::gpnp(three, three, three, poses), gslam::ArgumentError);
  EXPECT_THROW(gslam::gpnp(five, four, four, poses), gslam::ArgumentError);
  EXPECT_THROW(gslam::gpnp(four, four, five, poses), gslam::ArgumentError);
}

void expectFinite(const Instance& instance) {
  for (const PnpSolver solver : {PnpSolver::kSqpnp, PnpSolver::kEpnp, PnpSolver::kGpnp}) {
    if (instance.points.size() < 4 && solver != PnpSolver::kSqpnp) continue;
    for (const SE3d& T : solve(solver, instance)) {
      for (int i = 0; i < 4; ++i) EXPECT_TRUE(std::isfinite(T.rotation().data()[i]));
      for (std::size_t i = 0; i < 3; ++i) EXPECT_TRUE(std::isfinite(T.translation()[i]));
      EXPECT_NEAR(1, T.rotation().quaternion().norm(), 1e-12);
    }
  }
}

TEST(PnpSolvers, SurvivesAbsurdInput) {
  std::mt19937 generator(37);
  const double kAbsurd[] = {std::numeric_limits<double>::quiet_NaN(),
                            std::numeric_limits<double>::infinity(),
                            -std::numeric_limits<double>::infinity(),
                            0,
                            1e300,
                            -1e160,
                            1e100,
                            1e-300,
                            std::numeric_limits<double>::denorm_min()};
  for (const std::size_t n : {3u, 4u, 5u, 6u, 9u}) {
    for (const double value : kAbsurd) {
      for (int which = 0; which < 60; ++which) {
        Instance instance = makeInstance(
            generator, n, which % 2 ? PointLayout::kBox : PointLayout::kPlanar, 1e-3, 0.1);
        std::vector<Vec3d>* const kinds[] = {&instance.origins, &instance.bearings,
                                             &instance.points};
        std::vector<Vec3d>& kind = *kinds[which % 3];
        const bool is_all = which % 4 == 0;
        for (std::size_t i = 0; i < (is_all ? n : 1); ++i) {
          for (std::size_t k = 0; k < (which % 5 == 0 ? 3u : 1u); ++k) kind[i][k] = value;
        }
        expectFinite(instance);
      }
    }
  }
}

TEST(PnpSolvers, GivesNothingWithoutAPose) {
  std::mt19937 generator(41);
  for (const std::size_t n : {4u, 6u, 10u}) {
    Instance equal = makeInstance(generator, n, PointLayout::kBox);
    for (Vec3d& point : equal.points) point = equal.points[0];
    Instance line = makeInstance(generator, n, PointLayout::kBox);
    for (std::size_t i = 0; i < n; ++i) {
      line.points[i] = line.points[0] + static_cast<double>(i) * Vec3d{1, 2, 4};
      line.bearings[i] = (line.truth * line.points[i]).normalized();
    }
    Instance parallel = makeInstance(generator, n, PointLayout::kBox);
    for (Vec3d& bearing : parallel.bearings) bearing = {0, 0, 1};
    Instance none = makeInstance(generator, n, PointLayout::kBox);
    for (Vec3d& bearing : none.bearings) bearing = {0, 0, 0};
    for (const Instance* instance : {&equal, &line, &parallel, &none}) {
      for (const PnpSolver solver : {PnpSolver::kSqpnp, PnpSolver::kEpnp, PnpSolver::kGpnp}) {
        EXPECT_TRUE(solve(solver, *instance).empty()) << n;
      }
    }
  }
}

// Coordinates full of zeros, as people write them by hand.
TEST(PnpSolvers, SolvesMinimalCoordinates) {
  const SE3d truth(SO3d(), {0, 0, 4});
  std::vector<Vec3d> points = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {1, 1, 0}, {0, 0, 1}, {1, 0, 1}};
  for (const std::size_t n : {4u, 6u}) {
    Instance instance;
    instance.truth = truth;
    for (std::size_t i = 0; i < n; ++i) {
      instance.points.push_back(points[i]);
      instance.bearings.push_back((truth * points[i]).normalized());
      instance.origins.push_back({0, 0, 0});
    }
    for (const PnpSolver solver : {PnpSolver::kSqpnp, PnpSolver::kEpnp, PnpSolver::kGpnp}) {
      const std::vector<SE3d> poses = solve(solver, instance);
      ASSERT_EQ(1u, poses.size());
      EXPECT_LT(difference(poses[0], truth), 1e-12);
    }
  }
}

TEST(Epnp, LeavesThePoseAloneWhereThereIsNone) {
  const std::vector<Vec3d> zeros(4, Vec3d{});
  SE3d pose(SO3d(), {1, 2, 3});
  EXPECT_EQ(0u, gslam::epnp(zeros, zeros, pose));
  EXPECT_EQ((Vec3d{1, 2, 3}), pose.translation());
}

INSTANTIATE_TEST_SUITE_P(Points, Pnp, testing::Values(3, 4, 5, 6, 10, 100));

#ifdef GSLAM_HAS_OPENCV
bool solveOpenCv(const Instance& instance, int method, SE3d* pose) {
  std::vector<cv::Point3d> points;
  std::vector<cv::Point2d> pixels;
  for (std::size_t i = 0; i < instance.points.size(); ++i) {
    const Vec3d& p = instance.points[i];
    const Vec3d& b = instance.bearings[i];
    points.emplace_back(p[0], p[1], p[2]);
    pixels.emplace_back(b[0] / b[2], b[1] / b[2]);
  }
  cv::Mat r, t;
  const cv::Mat camera = cv::Mat::eye(3, 3, CV_64F);
  if (!cv::solvePnP(points, pixels, camera, cv::noArray(), r, t, false, method)) return false;
  const double* const w = r.ptr<double>();
  const double* const v = t.ptr<double>();
  *pose = SE3d(SO3d::exp({w[0], w[1], w[2]}), {v[0], v[1], v[2]});
  return true;
}

TEST(Sqpnp, IsNoWorseThanOpenCv) {
  std::mt19937 generator(43);
  for (const std::size_t n : {4u, 6u, 20u}) {
    for (const PointLayout scene : {PointLayout::kBox, PointLayout::kPlanar}) {
      for (std::size_t i = 0; i < solver_test::instances(100); ++i) {
        const Instance instance = makeInstance(generator, n, scene, 1e-3);
        SE3d theirs;
        if (!solveOpenCv(instance, cv::SOLVEPNP_SQPNP, &theirs)) continue;
        const std::vector<SE3d> poses = solve(PnpSolver::kSqpnp, instance);
        ASSERT_FALSE(poses.empty());
        // Their cost is another one, by the image plane: its minimum is above ours in ours.
        EXPECT_LE(costOf(instance, poses[0]), costOf(instance, theirs) * (1 + 1e-6));
      }
    }
  }
}

TEST(Epnp, IsRightWhereOpenCvIsNot) {
  std::mt19937 generator(47);
  std::size_t ours_lost = 0, theirs_lost = 0;
  for (std::size_t i = 0; i < solver_test::instances(300); ++i) {
    const Instance instance = makeInstance(generator, 6, PointLayout::kPlanar);
    SE3d theirs;
    const bool is_solved = solveOpenCv(instance, cv::SOLVEPNP_EPNP, &theirs);
    if (!is_solved || difference(theirs, instance.truth) > 1e-6) ++theirs_lost;
    const std::vector<SE3d> poses = solve(PnpSolver::kEpnp, instance);
    if (poses.empty() || difference(poses[0], instance.truth) > 1e-6) ++ours_lost;
  }
  EXPECT_EQ(0u, ours_lost);
  EXPECT_LT(ours_lost, theirs_lost);
}
#endif

#ifdef GSLAM_HAS_OPENGV
TEST(Gpnp, IsNoWorseThanOpenGv) {
  std::mt19937 generator(53);
  for (const PointLayout scene : {PointLayout::kBox, PointLayout::kPlanar}) {
    for (std::size_t i = 0; i < solver_test::instances(30); ++i) {
      const Instance instance = makeInstance(generator, 10, scene, 1e-3, 0.5);
      opengv::bearingVectors_t bearings;
      opengv::points_t points;
      opengv::translations_t origins;
      opengv::rotations_t rotations;
      std::vector<int> cameras;
      for (std::size_t k = 0; k < 10; ++k) {
        const Vec3d &b = instance.bearings[k], &p = instance.points[k], &o = instance.origins[k];
        bearings.emplace_back(b[0], b[1], b[2]);
        points.emplace_back(p[0], p[1], p[2]);
        origins.emplace_back(o[0], o[1], o[2]);
        rotations.push_back(opengv::rotation_t::Identity());
        cameras.push_back(static_cast<int>(k));
      }
      opengv::absolute_pose::NoncentralAbsoluteAdapter adapter(bearings, cameras, points, origins,
                                                               rotations);
      opengv::transformations_t theirs = opengv::absolute_pose::upnp(adapter);
      theirs.push_back(opengv::absolute_pose::gpnp(adapter));
      const std::vector<SE3d> poses = solve(PnpSolver::kGpnp, instance);
      ASSERT_FALSE(poses.empty());
      for (const opengv::transformation_t& T : theirs) {
        Mat3d m;
        for (int r = 0; r < 3; ++r) {
          for (int c = 0; c < 3; ++c)
            m(static_cast<std::size_t>(r), static_cast<std::size_t>(c)) = T(r, c);
        }
        SE3d pose;
        try {
          pose = SE3d(SO3d::fromMatrix(m), {T(0, 3), T(1, 3), T(2, 3)}).inverse();
        } catch (const gslam::ArgumentError&) {
          continue;  // not a rotation
        }
        EXPECT_LE(costOf(instance, poses[0]), costOf(instance, pose) * (1 + 1e-6));
      }
    }
  }
}
#endif

}  // namespace
