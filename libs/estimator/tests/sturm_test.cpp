#include "math/sturm.h"

#include <gslam/geometry/random.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <random>
#include <vector>

#include "instances.h"

namespace {

using gslam::randomUniform;
using gslam::detail::RealRoots;
using gslam::detail::SturmChain;
using gslam::detail::valueOf;

// The product of linear and of definite quadratic factors, constant first.
template <std::size_t N>
void polynomial(const std::vector<double>& real, const std::vector<double>& complex,
                double (&c)[N + 1]) {
  std::vector<long double> p = {1};
  const auto times = [&](const std::vector<long double>& q) {
    std::vector<long double> r(p.size() + q.size() - 1, 0);
    for (std::size_t i = 0; i < p.size(); ++i) {
      for (std::size_t j = 0; j < q.size(); ++j) r[i + j] += p[i] * q[j];
    }
    p = r;
  };
  for (const double x : real) times({-static_cast<long double>(x), 1});
  for (std::size_t i = 0; i + 1 < complex.size(); i += 2) {
    const long double re = complex[i], im = complex[i + 1];
    times({re * re + im * im, -2 * re, 1});
  }
  ASSERT_EQ(p.size(), N + 1);
  for (std::size_t i = 0; i <= N; ++i) c[i] = static_cast<double>(p[i]);
}

template <std::size_t N>
void findsRandomRoots(double closest, double allowed) {
  std::mt19937 generator(1);
  for (std::size_t i = 0; i < solver_test::instances(1000); ++i) {
    const std::size_t pairs = static_cast<std::size_t>(randomUniform(generator, 0.0, N / 2 + 0.99));
    std::vector<double> real, complex;
    while (real.size() < N - 2 * pairs) {
      // Evenly in the angle, so many are large.
      const double x = std::tan(randomUniform(generator, -1.5, 1.5));
      bool far = true;
      for (const double y : real) {
        far = far && std::fabs(x - y) > closest * (1 + x * x);
      }
      if (far) real.push_back(x);
    }
    for (std::size_t k = 0; k < pairs; ++k) {
      complex.push_back(randomUniform(generator, -2.0, 2.0));
      complex.push_back(randomUniform(generator, 0.3, 2.0));
    }
    double c[N + 1];
    polynomial<N>(real, complex, c);
    const RealRoots<N> roots(c, 1e-12);
    ASSERT_EQ(roots.size(), real.size()) << i;
    for (const double x : real) {
      double least = 1;
      for (std::size_t k = 0; k < roots.size(); ++k) {
        const double t = roots.t(k), u = roots.u(k);
        ASSERT_EQ(std::max(std::fabs(t), std::fabs(u)), 1);
        least = std::min(least, std::fabs(t - x * u) / std::hypot(1.0, x));
      }
      ASSERT_LT(least, allowed) << i << ' ' << x;
    }
  }
}

TEST(RealRoots, FindsThoseOfDegree6) {
  findsRandomRoots<6>(0.02, 1e-8);
}
TEST(RealRoots, FindsThoseOfDegree10) {
  findsRandomRoots<10>(0.05, 1e-6);
}
TEST(RealRoots, FindsThoseOfOddDegree) {
  findsRandomRoots<7>(0.02, 1e-7);
}

TEST(RealRoots, FindsClosePairs) {
  std::mt19937 generator(2);
  for (int i = 0; i < 1000; ++i) {
    const double x = std::tan(randomUniform(generator, -1.4, 1.4));
    const double gap = std::pow(10.0, randomUniform(generator, -4.0, -1.0)) * (1 + x * x);
    double c[6];
    polynomial<5>({x, x + gap, 10}, {0.2, 0.9}, c);
    const RealRoots<5> roots(c, 1e-12);
    ASSERT_EQ(roots.size(), 3U) << x << ' ' << gap;
  }
}

TEST(RealRoots, CountsARootAtInfinity) {
  const double c[4] = {-6, 11, -6, 1};  // 1 2 3
  double higher[5] = {-6, 11, -6, 1, 0};
  EXPECT_EQ(RealRoots<3>(c, 1e-12).size(), 3U);
  const RealRoots<4> roots(higher, 1e-12);
  std::size_t finite = 0;
  for (std::size_t i = 0; i < roots.size(); ++i) finite += std::fabs(roots.u(i)) > 1e-12 ? 1 : 0;
  EXPECT_EQ(finite, 3U);
}

TEST(RealRoots, EndsWhateverItGets) {
  const double odd[] = {0,
                        1,
                        -1,
                        1e-320,
                        1e200,
                        -1e308,
                        std::numeric_limits<double>::quiet_NaN(),
                        std::numeric_limits<double>::infinity()};
  std::mt19937 generator(3);
  for (int i = 0; i < 5000; ++i) {
    double c[11];
    for (double& value : c) {
      const int which = static_cast<int>(randomUniform(generator, 0.0, 12.0));
      value = which < 8 ? odd[which] : randomUniform(generator, -1.0, 1.0);
    }
    const RealRoots<10> roots(c, 1e-10);
    ASSERT_LE(roots.size(), 10U);
    for (std::size_t k = 0; k < roots.size(); ++k) {
      ASSERT_TRUE(std::isfinite(roots.t(k)) && std::isfinite(roots.u(k)));
    }
  }
}

TEST(SturmChain, CountsDistinctRoots) {
  const auto count = [](const double(&c)[7], double from, double to) {
    const SturmChain<6> chain(c);
    return chain.changes(from) - chain.changes(to);
  };
  double c[7];
  polynomial<6>({-2, -1, 0.5, 0.5, 3, 4}, {}, c);
  EXPECT_EQ(count(c, -10, 10), 5);  // the double one once
  EXPECT_EQ(count(c, -1.5, 0), 1);
  EXPECT_EQ(count(c, 0, 1), 1);
  polynomial<6>({1, 2}, {0, 1, 3, 2}, c);
  EXPECT_EQ(count(c, -10, 10), 2);
  EXPECT_EQ(count(c, 1.5, 10), 1);
  const double gap[7] = {-1, 0, 0, 0, 0, 0, 1};  // a remainder that drops five degrees
  EXPECT_EQ(count(gap, -10, 10), 2);
  const double none[7] = {1, 0, 0, 0, 0, 0, 1};
  EXPECT_EQ(count(none, -10, 10), 0);
}

}  // namespace
