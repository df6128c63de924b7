// The parts of the robust loop one by one.
#include <gslam/base/simd.h>
#include <gslam/geometry/random.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <map>
#include <random>
#include <set>
#include <vector>

#include "instances.h"
#include "robust/a_contrario.h"
#include "robust/least_squares.h"
#include "robust/point_kernels.h"
#include "robust/point_set.h"
#include "robust/random_order.h"
#include "robust/sampler.h"
#include "robust/score_kernels.h"
#include "robust/scorer.h"
#include "robust/stopping.h"

using namespace gslam::detail;  // NOLINT(google-build-using-namespace): these are its tests

namespace {

std::set<std::uint32_t> asSet(const Sample& sample, std::size_t size) {
  return std::set<std::uint32_t>(sample.begin(),
                                 sample.begin() + static_cast<std::ptrdiff_t>(size));
}

// Tail of the binomial distribution, term by term.
long double bruteTail(unsigned n, unsigned k, long double p) {
  long double sum = 0;
  for (unsigned i = k; i <= n; ++i) {
    long double term = 1;
    for (unsigned j = 0; j < i; ++j) {
      term *= static_cast<long double>(n - j) / static_cast<long double>(i - j);
    }
    sum += term * std::pow(p, static_cast<long double>(i)) *
           std::pow(1 - p, static_cast<long double>(n - i));
  }
  return sum;
}

std::vector<float> someResiduals(std::mt19937& generator, std::size_t count, bool with_strange) {
  std::vector<float> squared;
  for (std::size_t i = 0; i < count; ++i) {
    squared.push_back(gslam::randomUniform(generator, 0.0f, 8.0f));
    if (with_strange && i % 7 == 3) squared.back() = std::numeric_limits<float>::infinity();
    if (with_strange && i % 7 == 5) squared.back() = std::numeric_limits<float>::quiet_NaN();
  }
  return squared;
}

}  // namespace

TEST(RobustOrder, IsAPermutationThatTheSeedDecides) {
  for (const std::size_t size : {0u, 1u, 2u, 1000u}) {
    const RandomOrder order = randomOrder(size, 5);
    EXPECT_EQ(size, std::set<std::uint32_t>(order.begin(), order.end()).size());
    EXPECT_EQ(order, randomOrder(size, 5));
  }
  EXPECT_NE(randomOrder(1000, 5), randomOrder(1000, 6));
}

TEST(RobustSampler, DrawsDifferentMatchesThatSeedAndNumberDecide) {
  for (const std::size_t matches : {5u, 6u, 50u, 100000u}) {
    const Sampler sampler(matches, 5, 3), same(matches, 5, 3), other(matches, 5, 4);
    int differing = 0;
    for (std::uint64_t number = 0; number < 2000; ++number) {
      const Sample sample = sampler.draw(number, 0);
      EXPECT_EQ(5u, asSet(sample, 5).size());
      EXPECT_LT(*asSet(sample, 5).rbegin(), matches);
      EXPECT_EQ(sample, same.draw(number, 0));
      differing += asSet(sample, 5) != asSet(other.draw(number, 0), 5) ? 1 : 0;
    }
    EXPECT_GE(differing, matches > 5 ? 1000 : 0);
  }
}

TEST(RobustSampler, DrawsAllSetsAlike) {
  const Sampler sampler(6, 3, 11);
  std::map<std::set<std::uint32_t>, int> counts;
  const int draws = 40000;
  for (int number = 0; number < draws; ++number) {
    ++counts[asSet(sampler.draw(static_cast<std::uint64_t>(number), 0), 3)];
  }
  ASSERT_EQ(20u, counts.size());
  double chi_squared = 0;
  for (const auto& entry : counts) {
    const double expected = draws / 20.0;
    chi_squared += (entry.second - expected) * (entry.second - expected) / expected;
  }
  EXPECT_LT(chi_squared, 43.8);  // 19 degrees of freedom, one in a thousand
}

TEST(RobustSampler, ProsacBeginsWithTheBestAndEndsWithAll) {
  std::mt19937 generator(1);
  const std::size_t matches = 100;
  std::vector<float> quality;
  for (std::size_t i = 0; i < matches; ++i) {
    quality.push_back(gslam::randomUniform(generator, 0.0f, 1.0f));
  }
  const RandomOrder order = randomOrder(matches, 1);
  const Sampler sampler(order, 4, 1, quality);
  ASSERT_TRUE(sampler.isProsac());
  for (std::size_t i = 1; i < matches; ++i) {
    EXPECT_GE(quality[order[sampler.ranked()[i - 1]]], quality[order[sampler.ranked()[i]]]);
  }
  std::vector<std::size_t> rank(matches);
  for (std::size_t i = 0; i < matches; ++i) rank[sampler.ranked()[i]] = i;
  std::size_t before = 0;
  for (std::uint64_t number = 0; number < 3000; ++number) {
    const std::size_t reach = sampler.reach(number);
    EXPECT_GE(reach, before);
    EXPECT_LE(reach, before == 0 ? 4u : before + 1);
    before = reach;
    const Sample sample = sampler.draw(number, 0);
    EXPECT_EQ(4u, asSet(sample, 4).size());
    std::size_t worst = 0;
    for (std::size_t i = 0; i < 4; ++i) worst = std::max(worst, rank[sample[i]]);
    EXPECT_EQ(reach - 1, worst);  // the newest is always in it
    const Sample pooled = sampler.draw(number, 10);
    for (std::size_t i = 0; i < 4; ++i) EXPECT_LT(rank[pooled[i]], 10u);
  }
  EXPECT_EQ(matches, sampler.reach(200000));
  EXPECT_LT(sampler.reach(20), 20u);
}

TEST(RobustKernels, AgreeWithSumsInDouble) {
  std::mt19937 generator(2);
  for (const bool with_strange : {false, true}) {
    for (std::size_t count = 0; count <= kScoreBlock; count = count < 40 ? count + 1 : count + 27) {
      const std::vector<float> squared = someResiduals(generator, count, with_strange);
      const float limit = 3;
      double truncated = 0, above = 0, magsac = 0;
      for (const float value : squared) {
        truncated += value < limit ? static_cast<double>(value) : 3.0;
        above += value <= limit ? 0 : 1;
        magsac += magsacLoss(static_cast<double>(value), 3);
      }
      for (const gslam::Simd variant : ScoreKernels::truncated().variants()) {
        const auto call = [&](const ScoreKernels::Kernel& kernel) {
          return kernel.exact(variant)(squared.data(), count, limit);
        };
        EXPECT_NEAR(truncated, call(ScoreKernels::truncated()), 1e-6 * truncated);
        EXPECT_EQ(above, call(ScoreKernels::above()));
        EXPECT_NEAR(magsac, call(ScoreKernels::magsac()), 5e-6 * static_cast<double>(count));
        // The first two have the same bits everywhere.
        EXPECT_EQ(
            ScoreKernels::truncated().exact(gslam::Simd::scalar)(squared.data(), count, limit),
            call(ScoreKernels::truncated()));
      }
    }
  }
}

TEST(RobustKernels, MagsacsLossGrowsFromZeroToOneAndItsWeightIsTheDerivative) {
  EXPECT_EQ(0, magsacLoss(0, 2));
  EXPECT_NEAR(1, magsacLoss(2, 2), 1e-12);
  EXPECT_EQ(1, magsacLoss(5, 2));
  EXPECT_EQ(1, magsacLoss(std::numeric_limits<double>::quiet_NaN(), 2));
  EXPECT_EQ(0, magsacWeight(2.5, 2));
  const double step = 1e-6;
  double ratio = 0;
  for (double squared = 0.1; squared < 1.9; squared += 0.1) {
    const double slope =
        (magsacLoss(squared + step, 2) - magsacLoss(squared - step, 2)) / (2 * step);
    EXPECT_GT(slope, 0);
    if (ratio == 0) ratio = slope / magsacWeight(squared, 2);
    EXPECT_NEAR(ratio, slope / magsacWeight(squared, 2), 1e-4 * ratio);
  }
}

TEST(RobustKernels, ResidualsOfMapsAreTheSameInEveryVariant) {
  std::mt19937 generator(3);
  const std::size_t n = 101;
  std::vector<std::vector<float>> numbers(12, std::vector<float>(n));
  const float* columns[12];
  for (std::size_t k = 0; k < 12; ++k) {
    for (float& value : numbers[k]) value = gslam::randomUniform(generator, -1.0f, 1.0f);
    columns[k] = numbers[k].data();
  }
  float map[12];
  for (float& value : map) value = gslam::randomUniform(generator, -1.0f, 1.0f);
  for (const PointKernels::Kernel* kernel :
       {&PointKernels::homography(), &PointKernels::bearingHomography(), &PointKernels::affine2D(),
        &PointKernels::affine3D(), &PointKernels::plane()}) {
    std::vector<float> plain(n), other(n);
    kernel->exact(gslam::Simd::scalar)(map, 2, columns, 3, n - 3, plain.data());
    for (const gslam::Simd variant : kernel->variants()) {
      kernel->exact(variant)(map, 2, columns, 3, n - 3, other.data());
      for (std::size_t i = 0; i < n - 3; ++i) {
        if (std::isfinite(plain[i])) {
          EXPECT_NEAR(plain[i], other[i], 1e-3f * (plain[i] + 1e-3f));
        } else {
          EXPECT_FALSE(std::isfinite(other[i]));
        }
      }
    }
  }
}

TEST(RobustAContrario, TailsAreThoseOfBruteForce) {
  for (const unsigned n : {1u, 2u, 7u, 30u, 100u}) {
    for (const double p : {1e-9, 1e-4, 0.01, 0.3, 0.5, 0.9, 0.999}) {
      for (unsigned k = 0; k <= n; ++k) {
        const long double brute = bruteTail(n, k, p);
        const double got = log10BinomialTail(n, k, p);
        EXPECT_NEAR(static_cast<double>(std::log10(brute)), got, 1e-10 + 1e-12 * std::fabs(got))
            << n << " " << k << " " << p;
      }
    }
  }
  EXPECT_EQ(0, log10BinomialTail(10, 5, 1));
  EXPECT_EQ(0, log10BinomialTail(10, 0, 0));
  EXPECT_LT(log10BinomialTail(10, 1, 0), -200);
  EXPECT_LT(log10BinomialTail(10, 11, 0.5), -1e300);
  EXPECT_NEAR(0, log10BinomialTail(1000000, 400000, 0.5), 1e-12);
  EXPECT_LT(log10BinomialTail(1000000, 600000, 0.5), -8000);
}

TEST(RobustAContrario, CountsSubsets) {
  EXPECT_NEAR(std::log10(10.0), log10Binomial(5, 2), 1e-13);
  EXPECT_NEAR(std::log10(75287520.0), log10Binomial(100, 5), 1e-12);
  EXPECT_EQ(0, log10Binomial(7, 7));
}

TEST(RobustAContrario, FewestInliersIsWhereTheExpectationCrosses) {
  const FalseAlarms alarms = {200, 4, 1};
  for (const double chance : {1e-4, 0.01, 0.1, 0.5}) {
    const std::size_t fewest = alarms.fewestInliers(chance, -3);
    ASSERT_LE(fewest, 200u);
    EXPECT_LT(alarms.log10Expected(fewest, chance), -3);
    EXPECT_GE(alarms.log10Expected(fewest - 1, chance), -3);
  }
  EXPECT_EQ(201u, alarms.fewestInliers(1, -3));
}

// The expected number itself: lines through pairs of random points.
TEST(RobustAContrario, BoundsWhatChanceDoes) {
  std::mt19937 generator(4);
  const unsigned n = 30;
  const double p = 0.1;
  const FalseAlarms alarms = {n, 2, 1};
  const std::size_t trials = solver_test::instances(2000);
  std::size_t models = 0;
  const unsigned least = 9;
  for (std::size_t trial = 0; trial < trials; ++trial) {
    for (unsigned pair = 0; pair < n * (n - 1) / 2; ++pair) {
      unsigned inliers = 2;
      for (unsigned i = 2; i < n; ++i)
        inliers += static_cast<double>(generator()) < p * 4294967296.0 ? 1 : 0;
      models += inliers >= least ? 1 : 0;
    }
  }
  const double expected = std::pow(10.0, alarms.log10Expected(least, p));
  EXPECT_NEAR(1, static_cast<double>(models) / (expected * static_cast<double>(trials)), 0.05);
}

TEST(RobustStopping, NeedsAsManySamplesAsTheFormulaSays) {
  // ln(1 - 0.99) / ln(1 - good), good = (50 49 48 47) / (100 99 98 97)
  EXPECT_EQ(std::ceil(std::log(0.01) / std::log(1 - 5527200.0 / 94109400.0)),
            samplesNeeded(50, 100, 4, 0.99));
  EXPECT_EQ(1, samplesNeeded(100, 100, 4, 0.99));
  EXPECT_TRUE(std::isinf(samplesNeeded(3, 100, 4, 0.99)));
  EXPECT_GT(samplesNeeded(8, 1000000, 8, 0.99), 1e30);
}

TEST(RobustLeastSquares, SolvesAndInverts) {
  std::mt19937 generator(5);
  for (std::size_t dof = 1; dof <= kMaxDof; ++dof) {
    NormalEquations sums;
    double full[kMaxDof][kMaxDof] = {};
    for (int row = 0; row < 40; ++row) {
      double j[kMaxDof];
      for (std::size_t i = 0; i < dof; ++i) {
        // Units that differ by many orders.
        j[i] = gslam::randomUniform(generator, -1.0, 1.0) *
               std::pow(10.0, 3 * static_cast<int>(i % 4) - 5);
      }
      const double r = gslam::randomUniform(generator, -1.0, 1.0);
      for (std::size_t i = 0; i < dof; ++i) {
        sums.gradient[i] += j[i] * r;
        for (std::size_t k = 0; k < dof; ++k) {
          full[i][k] += j[i] * j[k];
          if (k >= i) sums.hessian[i * kMaxDof + k] += j[i] * j[k];
        }
      }
    }
    double delta[kMaxDof], inverse[kMaxDof * kMaxDof];
    ASSERT_TRUE(solveStep(sums, dof, 0, delta));
    ASSERT_TRUE(invertHessian(sums, dof, inverse));
    double promised = 0;
    for (std::size_t i = 0; i < dof; ++i) {
      double sum = sums.gradient[i], scale = std::fabs(sums.gradient[i]);
      promised -= sums.gradient[i] * delta[i];
      for (std::size_t k = 0; k < dof; ++k) {
        sum += full[i][k] * delta[k];
        scale += std::fabs(full[i][k] * delta[k]);
        double product = 0, size = 0;
        for (std::size_t l = 0; l < dof; ++l) {
          product += full[i][l] * inverse[l * kMaxDof + k];
          size += std::fabs(full[i][l] * inverse[l * kMaxDof + k]);
        }
        EXPECT_NEAR(i == k ? 1 : 0, product, 1e-11 * (1 + size));
      }
      EXPECT_NEAR(0, sum, 1e-11 * scale);
    }
    EXPECT_NEAR(promised, promisedDecrease(sums, dof, 0, delta), 1e-12 * promised);
  }
}

TEST(RobustLeastSquares, SeesWhatIsSingularOrNotFinite) {
  NormalEquations sums;
  double delta[kMaxDof], inverse[kMaxDof * kMaxDof];
  EXPECT_FALSE(solveStep(sums, 2, 0, delta));
  sums.hessian[0] = 4e6, sums.hessian[1] = 2e-3, sums.hessian[kMaxDof + 1] = 1e-12;
  EXPECT_FALSE(invertHessian(sums, 2, inverse));  // 4e6 1e-12 = (2e-3)^2
  sums.hessian[1] = 0;
  EXPECT_TRUE(invertHessian(sums, 2, inverse));
  sums.gradient[0] = std::numeric_limits<double>::quiet_NaN();
  EXPECT_FALSE(solveStep(sums, 2, 0, delta));
  sums.hessian[0] = std::numeric_limits<double>::infinity();
  EXPECT_FALSE(invertHessian(sums, 2, inverse));
}

TEST(RobustScorer, RankOfLmedsStaysInside) {
  for (std::size_t s = 1; s < 8; ++s) {
    for (std::size_t n = s; n < 40; ++n) {
      EXPECT_LT(lmedsRank(n, s), n);
      EXPECT_GE(2 * (lmedsRank(n, s) + 1), n);
    }
  }
}

TEST(PointSet, HasItsMiddleWhereMostPointsAre) {
  std::mt19937 generator(21);
  for (const std::size_t count : {2u, 5u, 11u, 30u, 100u, 255u, 1000u}) {
    std::vector<gslam::Vec2d> points;
    for (std::size_t i = 0; i < count; ++i) {
      points.push_back({gslam::randomUniform(generator, 100.0, 200.0),
                        gslam::randomUniform(generator, -10.0, 10.0)});
    }
    // Where few are left out the box is that of all.
    gslam::Vec2d low = points[0], high = points[0];
    for (const gslam::Vec2d& p : points) {
      for (std::size_t k = 0; k < 2; ++k) {
        low[k] = std::min(low[k], p[k]);
        high[k] = std::max(high[k], p[k]);
      }
    }
    const gslam::detail::RandomOrder order = gslam::detail::randomOrder(count, 1);
    const auto middle = gslam::detail::middleOf(points, order);
    for (std::size_t k = 0; k < 2; ++k) {
      const double size = high[k] - low[k];
      EXPECT_NEAR(size, middle.box[k], count < 12 ? 1e-12 : 0.2 * size) << count;
    }
    if (count < 100) continue;
    EXPECT_NEAR(150, middle.centre[0], 20);
    EXPECT_NEAR(0, middle.centre[1], 4);
    EXPECT_NEAR(25, middle.size, 8);
    points[3] = {1e300, -1e300};
    const auto same = gslam::detail::middleOf(points, order);
    EXPECT_LT((same.centre - middle.centre).norm(), 5);
    EXPECT_NEAR(middle.size, same.size, 5);
    for (std::size_t k = 0; k < 2; ++k) EXPECT_LT(same.box[k], 1.2 * middle.box[k] + 1);
  }
}
