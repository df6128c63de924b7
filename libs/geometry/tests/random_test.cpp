// Random elements: the same bits everywhere, and evenly distributed.
#include <gslam/geometry/random.h>

#include <random>

#include "reference.h"

namespace {

using gslam::randomOf;
using gslam::SE2d;
using gslam::SE3d;
using gslam::SIM3d;
using gslam::SO2d;
using gslam::SO3d;

// Numbers that another program may rely on; mt19937 itself is fixed by the C++ standard.
TEST(Random, SameBitsEverywhere) {
  std::mt19937 generator(7);
  const SO3d r = randomOf<SO3d>(generator);
  EXPECT_EQ(r.x(), -0.12318154984236551);
  EXPECT_EQ(r.y(), 0.44693035979549622);
  EXPECT_EQ(r.z(), 0.8831875100767238);
  EXPECT_EQ(r.w(), 0.071129328100144107);
  const SE3d t = randomOf<SE3d>(generator, 10.0);
  EXPECT_EQ(t.translation()[2], -2.3811773378730643);
}

TEST(Random, GeneratorsOfAnyRange) {
  std::mt19937_64 wide(1);
  std::minstd_rand odd(1);     // 1 to 2^31 - 2
  std::ranlux24_base less(1);  // 24 bits
  double sums[3] = {0, 0, 0};
  const int count = 20000;
  for (int i = 0; i < count; ++i) {
    sums[0] += gslam::randomUniform(wide, 0.0, 1.0);
    sums[1] += gslam::randomUniform(odd, 0.0, 1.0);
    sums[2] += gslam::randomUniform(less, 0.0, 1.0);
  }
  // The mean has the deviation sqrt(1 / 12 / count); five of them.
  for (const double sum : sums) EXPECT_NEAR(sum / count, 0.5, 5 * std::sqrt(1.0 / 12 / count));
}

// A generator of one bit, to see how bits are put together.
struct OneBit {
  static constexpr unsigned min() { return 3; }
  static constexpr unsigned max() { return 4; }
  unsigned operator()() { return ++calls % 2 == 1 ? 4 : 3; }
  int calls = 0;
};
TEST(Random, TakesAsManyBitsAsThereAre) {
  OneBit generator;
  EXPECT_EQ(gslam::detail::random53Bits(generator), 0x15555555555555u);
  EXPECT_EQ(generator.calls, 53);
}

// The angle t of an evenly distributed rotation has the distribution (t - sin t) / pi.
TEST(Random, RotationsAreEvenlyDistributed) {
  std::mt19937 generator(1);
  constexpr int count = 40000, bins = 20;
  const SO3d start = SO3d::exp({1, -0.4, 0.7});  // even as seen from anywhere
  int angles[bins] = {}, directions[bins] = {};
  for (int i = 0; i < count; ++i) {
    const SO3d r = start.inverse() * randomOf<SO3d>(generator);
    const double t = r.angle();
    const double even = (t - std::sin(t)) / std::acos(-1.0);
    ++angles[static_cast<int>(even * bins * 0.999999)];
    const double z = (r * gslam::Vec3d{0.6, 0, 0.8})[2];
    ++directions[static_cast<int>((z + 1) / 2 * bins * 0.999999)];
  }
  // Chi squared with 19 degrees of freedom is above 43.8 once in a thousand seeds.
  const double expected = double(count) / bins;
  double chi_angles = 0, chi_directions = 0;
  for (int i = 0; i < bins; ++i) {
    chi_angles += (angles[i] - expected) * (angles[i] - expected) / expected;
    chi_directions += (directions[i] - expected) * (directions[i] - expected) / expected;
  }
  EXPECT_LT(chi_angles, 43.8);
  EXPECT_LT(chi_directions, 43.8);
}

TEST(Random, PlanarRotationsAndDirectionsAreEvenlyDistributed) {
  std::mt19937 generator(1);
  constexpr int count = 40000, bins = 20;
  int angles[bins] = {}, heights[bins] = {};
  for (int i = 0; i < count; ++i) {
    const double turn = randomOf<SO2d>(generator).angle() / (2 * std::acos(-1.0)) + 0.5;
    ++angles[static_cast<int>(turn * bins * 0.999999)];
    const gslam::Vec3d d = gslam::randomDirection<double>(generator);
    ASSERT_NEAR(d.norm(), 1, 1e-15);
    ++heights[static_cast<int>((d[static_cast<std::size_t>(i) % 3] + 1) / 2 * bins * 0.999999)];
  }
  const double expected = double(count) / bins;
  double chi_angles = 0, chi_heights = 0;
  for (int i = 0; i < bins; ++i) {
    chi_angles += (angles[i] - expected) * (angles[i] - expected) / expected;
    chi_heights += (heights[i] - expected) * (heights[i] - expected) / expected;
  }
  EXPECT_LT(chi_angles, 43.8);
  EXPECT_LT(chi_heights, 43.8);
}

// Mean 0, variance 1, fourth moment 3, no correlation; each within five deviations.
TEST(Random, NormalNumbers) {
  std::mt19937 generator(1);
  const int count = 100000;
  double mean = 0, square = 0, fourth = 0, product = 0;
  for (int i = 0; i < count; ++i) {
    const gslam::Vec3d v = gslam::randomNormal<double, 3>(generator);
    for (const double x : v.values) mean += x, square += x * x, fourth += x * x * x * x;
    product += v[0] * v[1];
  }
  const double n = 3 * count;
  EXPECT_NEAR(mean / n, 0, 5 / std::sqrt(n));
  EXPECT_NEAR(square / n, 1, 5 * std::sqrt(2 / n));
  EXPECT_NEAR(fourth / n, 3, 5 * std::sqrt(96 / n));
  EXPECT_NEAR(product / count, 0, 5 / std::sqrt(double(count)));
}

TEST(Random, StaysWithinItsReach) {
  std::mt19937 generator(1);
  double farthest = 0, largest = 0;
  for (int i = 0; i < 2000; ++i) {
    const SIM3d s = randomOf<SIM3d>(generator, 10.0, 4.0);
    const SE2d t = randomOf<SE2d>(generator);
    for (const double x : s.translation().values) farthest = std::fmax(farthest, std::fabs(x));
    for (const double x : t.translation().values) ASSERT_LE(std::fabs(x), 1);
    largest = std::fmax(largest, std::fabs(std::log(s.scale())));
  }
  EXPECT_LE(farthest, 10);
  EXPECT_GT(farthest, 9.9);
  EXPECT_LE(largest, std::log(4.0));
  EXPECT_GT(largest, 0.99 * std::log(4.0));
  EXPECT_LE(std::fabs(randomOf<gslam::SE3f>(generator, 2.0f).translation()[0]), 2);
}

TEST(Random, ARangeWithoutEndIsRefused) {
  std::mt19937 generator;
  const double infinity = std::numeric_limits<double>::infinity();
  EXPECT_THROW(gslam::randomUniform(generator, -infinity, infinity), gslam::ArgumentError);
  EXPECT_THROW(gslam::randomOf<gslam::SE3d>(generator, infinity), gslam::ArgumentError);
}

}  // namespace
