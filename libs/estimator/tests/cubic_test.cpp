#include "math/cubic.h"

#include <gslam/geometry/random.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <random>

#include "instances.h"

namespace {

using gslam::randomUniform;
using gslam::detail::cubicRoots;
using gslam::detail::quadraticRoots;

// A number of any size from 10^-decades to 10^decades.
double anySize(std::mt19937& generator, double decades) {
  const double size = std::pow(10.0, randomUniform(generator, -decades, decades));
  return randomUniform(generator, -1.0, 1.0) < 0 ? -size : size;
}

// The polynomial with these roots, rounded once.
std::array<double, 4> polynomial(double factor, double r0, double r1, double r2) {
  const long double a = factor, x = r0, y = r1, z = r2;
  return {{static_cast<double>(a), static_cast<double>(-a * (x + y + z)),
           static_cast<double>(a * (x * y + y * z + z * x)), static_cast<double>(-a * x * y * z)}};
}

double distanceToNearestRoot(const std::array<double, 3>& roots, std::size_t count, double truth) {
  double least = std::numeric_limits<double>::infinity();
  for (std::size_t i = 0; i < count; ++i) least = std::min(least, std::fabs(roots[i] - truth));
  return least;
}

// How far a root is from a sign change of the polynomial, in units of the rounding of its terms.
double residual(const std::array<double, 4>& p, double x) {
  const long double l = x;
  const long double value = ((p[0] * l + p[1]) * l + p[2]) * l + p[3];
  const long double terms =
      std::fabs(p[0] * l * l * l) + std::fabs(p[1] * l * l) + std::fabs(p[2] * l) + std::fabs(p[3]);
  return static_cast<double>(std::fabs(value) / (terms * std::numeric_limits<double>::epsilon()));
}

TEST(Cubic, FindsThreeRootsOfAllSizes) {
  std::mt19937 generator(1);
  for (std::size_t i = 0; i < solver_test::instances(); ++i) {
    const double r[3] = {anySize(generator, 3), anySize(generator, 3), anySize(generator, 3)};
    const auto p = polynomial(anySize(generator, 5), r[0], r[1], r[2]);
    std::array<double, 3> roots;
    const std::size_t count = cubicRoots(p[0], p[1], p[2], p[3], roots);
    ASSERT_EQ(count, 3U) << i << ": " << r[0] << ' ' << r[1] << ' ' << r[2];
    for (std::size_t k = 0; k < 3; ++k) {
      ASSERT_LT(residual(p, roots[k]), 64) << i << ' ' << roots[k];
      // First-order sensitivity to the rounding of the coefficients.
      const double apart = std::fabs((r[k] - r[(k + 1) % 3]) * (r[k] - r[(k + 2) % 3]));
      const double terms =
          std::pow(std::max({std::fabs(r[0]), std::fabs(r[1]), std::fabs(r[2]), 1e-300}), 2);
      const double allowed =
          1e-14 * std::fabs(r[k]) * (1 + terms / apart) + 1e-13 * std::fabs(r[k]);
      ASSERT_LT(distanceToNearestRoot(roots, count, r[k]),
                std::max(allowed, 1e-6 * std::fabs(r[k])))
          << i << ' ' << r[k];
    }
  }
}

TEST(Cubic, FindsTheOnlyRoot) {
  std::mt19937 generator(2);
  for (std::size_t i = 0; i < solver_test::instances(); ++i) {
    const double r = anySize(generator, 3);
    const double re = anySize(generator, 3);
    const double im = std::fabs(re) * randomUniform(generator, 0.01, 3.0);
    const double a = anySize(generator, 3);
    const std::array<double, 4> p = {
        {a, -a * (r + 2 * re), a * (2 * r * re + re * re + im * im), -a * r * (re * re + im * im)}};
    std::array<double, 3> roots;
    ASSERT_EQ(cubicRoots(p[0], p[1], p[2], p[3], roots), 1U) << i;
    ASSERT_LT(residual(p, roots[0]), 64);
  }
}

TEST(Cubic, KeepsMultipleRoots) {
  std::array<double, 3> roots;
  ASSERT_EQ(cubicRoots(2, -8, 10, -4, roots), 3U);  // 2 (x - 1)^2 (x - 2)
  std::sort(roots.begin(), roots.end());
  EXPECT_NEAR(roots[0], 1, 1e-7);
  EXPECT_NEAR(roots[1], 1, 1e-7);
  EXPECT_NEAR(roots[2], 2, 1e-14);
  ASSERT_EQ(cubicRoots(1, -3, 3, -1, roots), 3U);
  for (const double root : roots) EXPECT_NEAR(root, 1, 1e-4);
  ASSERT_EQ(cubicRoots(1, 0, 0, 0, roots), 3U);
  for (const double root : roots) EXPECT_EQ(root, 0);
}

TEST(Cubic, TakesLowerDegrees) {
  std::array<double, 3> roots;
  ASSERT_EQ(cubicRoots(0, 1, -3, 2, roots), 2U);
  EXPECT_NEAR(std::min(roots[0], roots[1]), 1, 1e-15);
  EXPECT_NEAR(std::max(roots[0], roots[1]), 2, 1e-15);
  ASSERT_EQ(cubicRoots(0, 0, 2, -3, roots), 1U);
  EXPECT_EQ(roots[0], 1.5);
  EXPECT_EQ(cubicRoots(0, 0, 0, 1, roots), 0U);
  EXPECT_EQ(cubicRoots(0, 0, 0, 0, roots), 0U);
  double pair[2];
  EXPECT_EQ(quadraticRoots(1, 0, 0, pair), 2U);
  EXPECT_EQ(quadraticRoots(1, 0, 1, pair), 0U);
}

TEST(Cubic, GivesNoNaN) {
  const double odd[] = {0,
                        1,
                        -1,
                        1e-320,
                        1e-200,
                        1e200,
                        -1e308,
                        std::numeric_limits<double>::quiet_NaN(),
                        std::numeric_limits<double>::infinity(),
                        -std::numeric_limits<double>::infinity()};
  for (const double a : odd) {
    for (const double b : odd) {
      for (const double c : odd) {
        for (const double d : odd) {
          std::array<double, 3> roots;
          const std::size_t count = cubicRoots(a, b, c, d, roots);
          ASSERT_LE(count, 3U);
          for (std::size_t i = 0; i < count; ++i) {
            ASSERT_TRUE(std::isfinite(roots[i])) << a << ' ' << b << ' ' << c << ' ' << d;
          }
        }
      }
    }
  }
}

}  // namespace
