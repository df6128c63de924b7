// Where polynomials first change their sign.
#include <gslam/geometry/detail/camera_polynomial.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>

#include "not_finite.h"

namespace {

using gslam::detail::CameraPolynomial;
using gslam::detail::firstPositiveRoot;

TEST(CameraPolynomial, KnownRoots) {
  EXPECT_EQ(firstPositiveRoot({{{1}}}), kInfinity);
  EXPECT_EQ(firstPositiveRoot({{{1, 1}}}), kInfinity);
  EXPECT_EQ(firstPositiveRoot({{{1, 0, 1}}}), kInfinity);
  EXPECT_NEAR(firstPositiveRoot({{{1, -0.25}}}), 4, 1e-14);
  EXPECT_NEAR(firstPositiveRoot({{{2, -3, 1}}}), 1, 1e-14);       // (1 - x) (2 - x)
  EXPECT_NEAR(firstPositiveRoot({{{-6, 11, -6, 1}}}), 1, 1e-13);  // 1, 2, 3
  EXPECT_NEAR(firstPositiveRoot({{{1, 0, 0, 0, -1e-9}}}), std::pow(1e9, 0.25), 1e-9);
  // a double root is no change of sign: (1 - x)^2 (3 - x)
  EXPECT_NEAR(firstPositiveRoot({{{3, -7, 5, -1}}}), 3, 1e-6);
}

// Products of factors with known roots, up to the highest degree there is.
TEST(CameraPolynomial, ProductsOfFactors) {
  std::mt19937 random(1);
  std::uniform_real_distribution<double> root(0.2, 3);
  for (int i = 0; i < 300; ++i) {
    CameraPolynomial product = {{{1}}};
    double first = kInfinity;
    for (int degree = 0; degree < 15; degree += 3) {
      const double a = root(random), b = root(random);
      const CameraPolynomial linear = {{{1, -1 / a}}};
      const CameraPolynomial square = {{{1 + b, -b, 1}}};  // has no root: b^2 < 4 (1 + b)
      product = product * linear * square;
      first = std::min(first, a);
    }
    ASSERT_EQ(product.degree(), 15U);
    ASSERT_NEAR(firstPositiveRoot(product), first, 1e-7 * first);
  }
}

}  // namespace
