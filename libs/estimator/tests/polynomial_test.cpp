// Roots of quartics, and of octics in Bernstein's basis, of polynomials made from their roots.
#include <gslam/geometry/random.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <random>
#include <vector>

#include "../src/math/bernstein.h"
#include "../src/math/quartic.h"
#include "instances.h"

namespace {

using gslam::randomUniform;
using gslam::detail::Bernstein;
using gslam::detail::octicRoots;
using gslam::detail::quarticRoots;
using Generator = std::mt19937;

// Coefficients, lowest first, times (x - root).
std::vector<long double> timesRoot(const std::vector<long double>& c, long double root) {
  std::vector<long double> product(c.size() + 1, 0);
  for (std::size_t i = 0; i < c.size(); ++i) {
    product[i + 1] += c[i];
    product[i] -= root * c[i];
  }
  return product;
}

void expectRoots(const std::vector<double>& roots, std::vector<long double> c, double tolerance,
                 const char* what) {
  c.resize(5, 0);
  double coefficients[5], found[4];
  for (std::size_t i = 0; i < 5; ++i) coefficients[i] = static_cast<double>(c[i]);
  const std::size_t count = quarticRoots(coefficients, found);
  EXPECT_EQ(count, roots.size()) << what;
  for (double root : roots) {
    double nearest = std::numeric_limits<double>::infinity();
    for (std::size_t i = 0; i < count; ++i) {
      nearest = std::min(nearest, std::fabs(found[i] - root) / std::fabs(root));
    }
    EXPECT_LT(nearest, tolerance) << what << " root " << root;
  }
}

TEST(Quartic, FindsRealRoots) {
  Generator generator(1);
  for (std::size_t i = 0; i < solver_test::instances(2000); ++i) {
    std::vector<double> roots;
    while (roots.size() < 4) {  // apart from each other and from 0, else they are ill-conditioned
      const double root = randomUniform(generator, -2.0, 2.0);
      bool is_apart = std::fabs(root) > 0.01;
      for (double other : roots) is_apart = is_apart && std::fabs(other - root) > 0.01;
      if (is_apart) roots.push_back(root);
    }
    for (double& root : roots) root *= i % 3 == 0 ? 1e3 : (i % 3 == 1 ? 1e-3 : 1);
    std::vector<long double> c = {1};
    for (double root : roots) c = timesRoot(c, root);
    expectRoots(roots, c, 1e-8, "four");
    // Two of them, and two complex ones.
    roots.resize(2);
    c = timesRoot(timesRoot({1}, roots[0]), roots[1]);
    const long double middle = roots[0] + roots[1],
                      square = middle * middle / 4 + roots[0] * roots[0];
    std::vector<long double> with(5, 0);
    for (std::size_t k = 0; k < 3; ++k) {
      with[k] += square * c[k];
      with[k + 1] += middle * c[k];
      with[k + 2] += c[k];
    }
    expectRoots(roots, with, 1e-8, "two");
  }
}

TEST(Quartic, FindsRootsAtInfinity) {
  expectRoots({1, 2, 3}, {-6, 11, -6, 1, 0}, 1e-14, "cubic");
  expectRoots({1, -2}, {-2, 1, 1, 0, 0}, 1e-14, "quadratic");
  expectRoots({0.5}, {-1, 2, 0, 0, 0}, 1e-14, "linear");
  expectRoots({}, {1, 0, 0, 0, 0}, 0, "constant");
  Generator generator(2);
  for (std::size_t i = 0; i < solver_test::instances(500); ++i) {
    std::vector<double> roots = {
        randomUniform(generator, 1.0, 2.0), randomUniform(generator, -2.0, -1.0),
        randomUniform(generator, 0.2, 0.8), randomUniform(generator, 1e5, 1e7)};
    std::vector<long double> c = {1e-7L};
    for (double root : roots) c = timesRoot(c, root);
    expectRoots(roots, c, 1e-9, "one far");
    roots[2] *= 1e-7;
    c = {1e-7L};
    for (double root : roots) c = timesRoot(c, root);
    expectRoots(roots, c, 1e-9, "one far, one near 0");
  }
}

TEST(Quartic, KeepsDoubleRoots) {
  Generator generator(3);
  for (std::size_t i = 0; i < solver_test::instances(1000); ++i) {
    const double a = randomUniform(generator, 0.5, 2.0), b = randomUniform(generator, -2.0, -0.5);
    const double c = randomUniform(generator, 3.0, 4.0);
    double coefficients[5], found[4];
    const auto p = timesRoot(timesRoot(timesRoot(timesRoot({1}, a), a), b), c);
    for (std::size_t k = 0; k < 5; ++k) coefficients[k] = static_cast<double>(p[k]);
    EXPECT_EQ(quarticRoots(coefficients, found), 4u);
    EXPECT_EQ(std::count_if(found, found + 4, [&](double x) { return std::fabs(x - a) < 1e-6; }),
              2);
  }
}

TEST(Quartic, GivesNothingForNothing) {
  const double infinite = std::numeric_limits<double>::infinity();
  double found[4];
  EXPECT_EQ(quarticRoots({0, 0, 0, 0, 0}, found), 0u);
  for (double odd : {infinite, -infinite, std::nan("")}) {
    for (std::size_t i = 0; i < 5; ++i) {
      double c[5] = {1, 2, 3, 4, 5};
      c[i] = odd;
      EXPECT_EQ(quarticRoots(c, found), 0u);
    }
  }
  for (double size : {1e-300, 1e-160, 1e160, 1e300}) {
    double c[5] = {size, -3 * size, 1, 2, size};
    const std::size_t count = quarticRoots(c, found);
    for (std::size_t i = 0; i < count; ++i) EXPECT_TRUE(std::isfinite(found[i]));
  }
}

// With `count` roots between 0 and 1, and other factors that have none there.
Bernstein<8> octicOf(const std::vector<double>& roots, Generator& generator) {
  Bernstein<8> product{};
  product.c[0] = 1;
  std::size_t degree = 0;
  const auto multiply = [&](double at0, double at1) {
    ++degree;
    for (std::size_t k = degree + 1; k-- > 0;) {
      product.c[k] = (k < degree ? product.c[k] * at0 : 0) + (k > 0 ? product.c[k - 1] * at1 : 0);
    }
  };
  for (double root : roots) multiply(-root, 1 - root);
  while (degree < 8) {
    const double outside = randomUniform(generator, 1.1, 3.0);
    multiply(-outside, 1 - outside);
  }
  return product;
}

TEST(Octic, FindsRootsBetween0And1) {
  Generator generator(4);
  double found[8];
  for (std::size_t i = 0; i < solver_test::instances(2000); ++i) {
    std::vector<double> roots;
    while (roots.size() < i % 9) {
      const double root = randomUniform(generator, 0.0, 1.0);
      bool is_apart = true;
      for (double other : roots) is_apart = is_apart && std::fabs(other - root) > 0.03;
      if (is_apart) roots.push_back(root);
    }
    std::sort(roots.begin(), roots.end());
    const std::size_t count = octicRoots(octicOf(roots, generator), found);
    ASSERT_EQ(count, roots.size());
    for (std::size_t k = 0; k < count; ++k) EXPECT_NEAR(found[k], roots[k], 1e-6);
  }
}

TEST(Octic, FindsRootsWhereItHalves) {
  Generator generator(5);
  double found[8];
  ASSERT_EQ(octicRoots(octicOf({0.25, 0.5, 0.75}, generator), found), 3u);
  for (std::size_t k = 0; k < 3; ++k)
    EXPECT_NEAR(found[k], 0.25 * static_cast<double>(k + 1), 1e-9);
}

TEST(Octic, GivesDoubleRootsAndEnds) {
  Generator generator(6);
  double found[8];
  std::size_t missed = 0;  // where rounding lifts the polynomial off the axis
  const std::size_t instances = solver_test::instances(200);
  for (std::size_t i = 0; i < instances; ++i) {
    const double root = randomUniform(generator, 0.1, 0.9);
    const std::size_t count = octicRoots(octicOf({root, root}, generator), found);
    if (count == 0) ++missed;
    for (std::size_t k = 0; k < count; ++k) EXPECT_NEAR(found[k], root, 1e-5);
  }
  EXPECT_LE(missed, instances / 50);  // 0.75 % of 2000
  EXPECT_EQ(octicRoots(Bernstein<8>{}, found), 0u);
  Bernstein<8> odd{};
  for (double& c : odd.c) c = std::nan("");
  EXPECT_EQ(octicRoots(odd, found), 0u);
  odd.c[3] = std::numeric_limits<double>::infinity();
  EXPECT_LE(octicRoots(odd, found), 8u);
  for (std::size_t k = 0; k < 9; ++k) odd.c[k] = k % 2 == 0 ? 1e-17 : -1e-17;  // noise
  EXPECT_LE(octicRoots(odd, found), 8u);
}

}  // namespace
