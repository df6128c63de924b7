// The angle that fisheye models use, against long double.
#include <gslam/geometry/detail/camera_angle.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <random>

namespace {

using gslam::detail::angleFromAxis;

// Error in units of the result's last digit.
double error(double r, double z) {
  const long double expected = std::atan2(static_cast<long double>(r), static_cast<long double>(z));
  const double difference = double(std::fabs(angleFromAxis(r, z) - expected));
  return expected > 0 ? difference / (double(expected) * std::numeric_limits<double>::epsilon())
                      : difference;
}

TEST(CameraAngle, EverywhereWithinTwoEpsilon) {
  std::mt19937 random(1);
  std::uniform_real_distribution<double> angle(0, 3.14159265358979), exponent(-150, 150);
  double largest = 0;
  for (int i = 0; i < 2000000; ++i) {
    const double a = angle(random), length = std::pow(10, exponent(random));
    largest = std::max(largest, error(length * std::sin(a), length * std::cos(a)));
  }
  EXPECT_LE(largest, 2);
}

TEST(CameraAngle, NextToAxesAndBreaks) {
  for (const double z : {1.0, -1.0, 0.3, -0.3}) {
    for (int i = -69000; i < 69000; ++i)
      ASSERT_LE(error(std::exp(0.01 * i), z), 2) << i << " " << z;
    for (int k = 0; k <= 16; ++k) {
      for (const double sign : {-1e-16, 0.0, 1e-16}) {
        const double r = std::fabs(z) * (k / 16. * (1 + sign));
        ASSERT_LE(error(r, z), 2) << r << " " << z;
        ASSERT_LE(error(std::fabs(z), z * (k / 16. * (1 + sign))), 2) << k;
      }
    }
  }
  EXPECT_EQ(angleFromAxis(0.0, 1.0), 0);
  EXPECT_EQ(angleFromAxis(0.0, -1.0), std::acos(-1.0));
  EXPECT_EQ(angleFromAxis(1.0, 0.0), std::acos(0.0));
}

}  // namespace
