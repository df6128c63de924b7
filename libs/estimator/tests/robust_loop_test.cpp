// The robust loop with lines through points of the plane.
#include "robust/robust_loop.h"

#include <gslam/base/simd.h>
#include <gtest/gtest.h>

#include <cmath>
#include <cstddef>
#include <cstdint>
#include <numeric>
#include <random>
#include <string>
#include <vector>

#include "instances.h"
#include "robust_mock.h"

using gslam::EstimateOptions;
using gslam::EstimateSampling;
using gslam::EstimateScoring;
using gslam::EstimateStatus;
using gslam::detail::LoopResult;
using gslam::detail::LoopTuning;
using gslam::detail::ModelNumbers;
using gslam::detail::RandomOrder;
using gslam::detail::randomOrder;
using gslam::detail::runRobustLoop;
using robust_test::LineData;
using robust_test::lineError;
using robust_test::LineProblem;

namespace {

constexpr double kNoise = 0.2;
constexpr double kThreshold = 0.6;
constexpr EstimateScoring kScorings[] = {EstimateScoring::Msac, EstimateScoring::Ransac,
                                         EstimateScoring::Lmeds, EstimateScoring::Magsac};
constexpr EstimateSampling kSamplings[] = {EstimateSampling::Uniform, EstimateSampling::Prosac};

LoopResult search(const LineData& data, const EstimateOptions& options,
                  const LoopTuning& tuning = LoopTuning()) {
  const RandomOrder order = randomOrder(data.points.size(), options.seed);
  const LineProblem problem(data.points, order);
  return runRobustLoop(problem, options, kThreshold, order, tuning);
}

// Better ones are inliers, mostly.
std::vector<float> qualitiesOf(const LineData& data, std::mt19937& generator) {
  std::vector<float> quality;
  for (const std::uint8_t is_inlier : data.is_inlier) {
    quality.push_back(is_inlier + gslam::randomUniform(generator, 0.0f, 1.2f));
  }
  return quality;
}

void expectSame(const LoopResult& a, const LoopResult& b) {
  EXPECT_EQ(a.model, b.model);
  EXPECT_EQ(a.covariance, b.covariance);
  EXPECT_EQ(a.summary.inliers, b.summary.inliers);
  EXPECT_EQ(a.summary.iterations, b.summary.iterations);
  EXPECT_EQ(a.summary.score, b.summary.score);
  EXPECT_EQ(a.summary.message, b.summary.message);
}

// What the summary says is what the model and the points say.
void expectConsistent(const LineData& data, const LoopResult& result) {
  std::size_t count = 0;
  double squares = 0;
  for (std::size_t i = 0; i < data.points.size(); ++i) {
    const double r = std::cos(result.model[0]) * data.points[i][0] +
                     std::sin(result.model[0]) * data.points[i][1] - result.model[1];
    const bool is_inlier = r * r <= result.summary.threshold * result.summary.threshold;
    EXPECT_EQ(is_inlier ? 1 : 0, result.summary.inliers[i]);
    count += is_inlier ? 1 : 0;
    squares += is_inlier ? r * r : 0;
  }
  const double n = static_cast<double>(count);
  EXPECT_EQ(count, result.summary.inlier_count);
  EXPECT_NEAR(std::sqrt(squares / n), result.summary.rms, 1e-12);
  EXPECT_NEAR(n / static_cast<double>(data.points.size()), result.summary.inlier_ratio, 1e-15);
}

}  // namespace

TEST(RobustLoop, FindsTheLineWithEveryScoringAndSampling) {
  std::mt19937 generator(1);
  for (const EstimateScoring scoring : kScorings) {
    for (const EstimateSampling sampling : kSamplings) {
      for (int trial = 0; trial < 20; ++trial) {
        const LineData data(generator, 200, scoring == EstimateScoring::Lmeds ? 0.35 : 0.6, kNoise);
        const std::vector<float> quality = qualitiesOf(data, generator);
        EstimateOptions options;
        options.scoring = scoring;
        options.sampling = sampling;
        options.quality = quality;
        options.seed = static_cast<std::uint64_t>(trial);
        const LoopResult result = search(data, options);
        ASSERT_TRUE(result.summary.ok()) << result.summary.message;
        EXPECT_LT(lineError(result.model, data.angle, data.distance), 0.01);
        EXPECT_LT(result.summary.log10_false_alarms, -3);
        EXPECT_GT(result.covariance[0], 0);
        expectConsistent(data, result);
      }
    }
  }
}

TEST(RobustLoop, WorksWithoutRefinements) {
  std::mt19937 generator(2);
  for (const EstimateScoring scoring : kScorings) {
    const LineData data(generator, 200, 0.3, kNoise);
    for (int parts = 0; parts < 4; ++parts) {
      EstimateOptions options;
      options.scoring = scoring;
      options.local_optimisation = (parts & 1) != 0;
      options.final_refinement = (parts & 2) != 0;
      const LoopResult result = search(data, options);
      ASSERT_TRUE(result.summary.ok()) << result.summary.message;
      EXPECT_LT(lineError(result.model, data.angle, data.distance), 0.02);
      expectConsistent(data, result);
    }
  }
}

TEST(RobustLoop, GivesTheSameBitsForAnyNumberOfThreads) {
  std::mt19937 generator(3);
  for (const EstimateScoring scoring : kScorings) {
    for (const EstimateSampling sampling : kSamplings) {
      const LineData data(generator, 300, 0.45, kNoise);
      const std::vector<float> quality = qualitiesOf(data, generator);
      EstimateOptions options;
      options.scoring = scoring;
      options.sampling = sampling;
      options.quality = quality;
      options.min_iterations = 300;
      const LoopResult one = search(data, options);
      for (const unsigned threads : {2u, 3u, 8u, 0u}) {
        options.threads = threads;
        expectSame(one, search(data, options));
      }
    }
  }
}

TEST(RobustLoop, GivesTheSameAnswerWithEverySimd) {
  std::mt19937 generator(4);
  for (const EstimateScoring scoring : kScorings) {
    const LineData data(generator, 301, 0.4, kNoise);
    EstimateOptions options;
    options.scoring = scoring;
    const LoopResult best = search(data, options);
    for (const gslam::Simd variant : gslam::availableSimd()) {
      const gslam::ScopedSimd scoped(variant);
      const LoopResult result = search(data, options);
      EXPECT_EQ(best.summary.inliers, result.summary.inliers);
      EXPECT_LT(lineError(result.model, best.model[0], best.model[1]), 1e-9);
      if (scoring != EstimateScoring::Magsac)
        expectSame(best, result);  // without exp() to the last bit
    }
  }
}

TEST(RobustLoop, DoesNotDependOnTheOrderOfTheMatches) {
  std::mt19937 generator(5);
  for (const EstimateScoring scoring : kScorings) {
    LineData data(generator, 250, 0.4, kNoise);
    EstimateOptions options;
    options.scoring = scoring;
    const LoopResult before = search(data, options);
    const RandomOrder order = randomOrder(data.points.size(), 99);
    LineData shuffled = data;
    for (std::size_t i = 0; i < order.size(); ++i) shuffled.points[i] = data.points[order[i]];
    const LoopResult after = search(shuffled, options);
    EXPECT_LT(lineError(after.model, before.model[0], before.model[1]), 1e-9);
    for (std::size_t i = 0; i < order.size(); ++i) {
      EXPECT_EQ(before.summary.inliers[order[i]], after.summary.inliers[i]);
    }
  }
}

TEST(RobustLoop, LeavesModelsEarlyWithoutHarm) {
  std::mt19937 generator(6);
  for (const EstimateScoring scoring : kScorings) {
    int same = 0;
    const int trials = 30;
    for (int trial = 0; trial < trials; ++trial) {
      const LineData data(generator, 700, 0.45, kNoise);
      EstimateOptions options;
      options.scoring = scoring;
      options.min_iterations = 100;
      LoopTuning nothing, bound, all;
      nothing.exact_bound = nothing.statistical_test = bound.statistical_test = false;
      const LoopResult full = search(data, options, nothing);
      expectSame(full, search(data, options, bound));
      same += search(data, options, all).summary.inliers == full.summary.inliers ? 1 : 0;
    }
    EXPECT_GE(same, trials - 1);
  }
}

TEST(RobustLoop, NeedsFewerSamplesWithQualities) {
  std::mt19937 generator(7);
  std::size_t uniform = 0, prosac = 0;
  for (int trial = 0; trial < 30; ++trial) {
    const LineData data(generator, 400, 0.85, kNoise);
    const std::vector<float> quality = qualitiesOf(data, generator);
    EstimateOptions options;
    options.seed = static_cast<std::uint64_t>(trial);
    options.quality = quality;
    const LoopResult plain = search(data, options);
    options.sampling = EstimateSampling::Prosac;
    const LoopResult ranked = search(data, options);
    EXPECT_TRUE(plain.summary.ok());
    EXPECT_TRUE(ranked.summary.ok());
    EXPECT_LT(lineError(ranked.model, data.angle, data.distance), 0.02);
    uniform += plain.summary.iterations;
    prosac += ranked.summary.iterations;
  }
  EXPECT_LT(4 * prosac, uniform);
}

TEST(RobustLoop, SurvivesQualitiesThatMislead) {
  std::mt19937 generator(8);
  for (int trial = 0; trial < 10; ++trial) {
    const LineData data(generator, 300, 0.6, kNoise);
    std::vector<float> quality = qualitiesOf(data, generator);
    for (float& value : quality) value = -value;
    EstimateOptions options;
    options.sampling = EstimateSampling::Prosac;
    options.quality = quality;
    const LoopResult result = search(data, options);
    EXPECT_TRUE(result.summary.ok()) << result.summary.message;
    EXPECT_LT(lineError(result.model, data.angle, data.distance), 0.02);
  }
}

TEST(RobustLoop, FindsOneInTenAndAdmitsWhenItCannot) {
  std::mt19937 generator(9);
  int too_early = 0;
  for (int trial = 0; trial < 20; ++trial) {
    const LineData data(generator, 600, 0.9, 0.1);
    EstimateOptions options;
    options.seed = static_cast<std::uint64_t>(trial);
    const LoopResult enough = search(data, options);
    EXPECT_TRUE(enough.summary.ok()) << enough.summary.message;
    EXPECT_LT(lineError(enough.model, data.angle, data.distance), 0.02);
    options.max_iterations = 4;
    const LoopResult few = search(data, options);
    EXPECT_EQ(4u, few.summary.iterations);
    if (few.summary.ok()) {
      EXPECT_LT(lineError(few.model, data.angle, data.distance), 0.02);
      continue;
    }
    ++too_early;
    EXPECT_EQ(EstimateStatus::NoConsensus, few.summary.status);
    EXPECT_NE(std::string::npos, few.summary.message.find("more iterations"))
        << few.summary.message;
    for (const double element : few.covariance) EXPECT_EQ(0, element);
  }
  EXPECT_GT(too_early, 10);
}

TEST(RobustLoop, FindsNothingInNoise) {
  std::mt19937 generator(10);
  for (const EstimateScoring scoring : kScorings) {
    const std::size_t trials = solver_test::instances(50);
    std::size_t found = 0;
    for (std::size_t trial = 0; trial < trials; ++trial) {
      const LineData data(generator, 60, 1.0, 0);
      EstimateOptions options;
      options.scoring = scoring;
      options.seed = trial;
      options.max_iterations = 500;
      found += search(data, options).summary.ok() ? 1 : 0;
    }
    EXPECT_LE(found, trials / 500) << gslam::nameOf(EstimateStatus::Ok);
  }
}

TEST(RobustLoop, StopsWhenTimeIsOverAndNotBeforeTheLeastSamples) {
  std::mt19937 generator(11);
  const LineData data(generator, 100, 0.2, kNoise);
  EstimateOptions options;
  options.min_iterations = 5000;
  EXPECT_EQ(5000u, search(data, options).summary.iterations);
  options.max_iterations = 1000;
  EXPECT_EQ(5000u, search(data, options).summary.iterations);
  options.max_seconds = 1e-9;
  const LoopResult result = search(data, options);
  EXPECT_GT(result.summary.iterations, 0u);
  EXPECT_LT(result.summary.iterations, 100u);
}

TEST(RobustLoop, PredictsItsErrors) {
  std::mt19937 generator(12);
  double normalised = 0;
  const std::size_t trials = solver_test::instances(300);
  for (std::size_t trial = 0; trial < trials; ++trial) {
    const LineData data(generator, 100, 0.3, kNoise);
    EstimateOptions options;
    const RandomOrder order = randomOrder(data.points.size(), 1);
    const LoopResult result = runRobustLoop(LineProblem(data.points, order), options, 0.8, order);
    ASSERT_TRUE(result.summary.ok());
    const double same = std::cos(result.model[0] - data.angle) < 0 ? -1 : 1;
    const double e0 = std::asin(std::sin(result.model[0] - data.angle) * same);
    const double e1 = result.model[1] - same * data.distance;
    const double a = result.covariance[0], b = result.covariance[1];
    const double d = result.covariance[gslam::detail::kMaxDof + 1];
    normalised += (d * e0 * e0 - 2 * b * e0 * e1 + a * e1 * e1) / (a * d - b * b);
  }
  // Two degrees of freedom; some outliers beside the line are taken for inliers.
  EXPECT_NEAR(2, normalised / static_cast<double>(trials), 0.5);
}

namespace {

// A problem whose samples lead nowhere, but whose proposal is the truth.
class ProposingProblem : public LineProblem {
 public:
  ProposingProblem(const LineData& data, const RandomOrder& order)
      : LineProblem(data.points, order), truth_{{data.angle, data.distance}} {}

  std::size_t solve(const std::uint32_t* sample, ModelNumbers* models) const override {
    models[0] = ModelNumbers{{0.0, 10.0 + sample[0] * 1e-3}};
    return 1;
  }
  std::size_t propose(const ModelNumbers& model, const std::uint32_t* sample,
                      const std::uint8_t* inliers, double threshold,
                      ModelNumbers* models) const override {
    EXPECT_NEAR(10.0 + sample[0] * 1e-3, model[1], 1e-12);
    EXPECT_EQ(kThreshold, threshold);
    for (std::size_t i = 0; i < size(); ++i) {
      EXPECT_EQ(std::fabs(points_[i][0] - model[1]) <= threshold ? 1 : 0, inliers[i]);
    }
    models[0] = truth_;
    return 1;
  }

 private:
  ModelNumbers truth_;
};

class ExaminedProblem : public LineProblem {
 public:
  ExaminedProblem(const LineData& data, const RandomOrder& order, gslam::detail::Examination answer)
      : LineProblem(data.points, order), answer_(answer) {}
  gslam::detail::Examination examine(const ModelNumbers&, const std::uint8_t*,
                                     double) const override {
    return answer_;
  }

 private:
  gslam::detail::Examination answer_;
};

// Nothing but samples without a model.
class EmptyProblem : public LineProblem {
 public:
  using LineProblem::LineProblem;
  std::size_t solve(const std::uint32_t*, ModelNumbers*) const override { return 0; }
};

// A model that the inliers leave free: the second unknown does nothing.
class FreeProblem : public LineProblem {
 public:
  using LineProblem::LineProblem;
  void accumulate(const ModelNumbers& model, const double* weights, std::size_t count,
                  gslam::detail::NormalEquations& sums) const override {
    LineProblem::accumulate(model, weights, count, sums);
    sums.hessian[0] = sums.hessian[1] * sums.hessian[1] / sums.hessian[gslam::detail::kMaxDof + 1];
  }
};

}  // namespace

TEST(RobustLoop, TriesWhatTheProblemProposes) {
  std::mt19937 generator(13);
  const LineData data(generator, 200, 0.5, kNoise);
  const RandomOrder order = randomOrder(200, 1);
  const ProposingProblem problem(data, order);
  EstimateOptions options;
  options.max_iterations = 50;
  const LoopResult result = runRobustLoop(problem, options, kThreshold, order);
  EXPECT_TRUE(result.summary.ok()) << result.summary.message;
  EXPECT_LT(lineError(result.model, data.angle, data.distance), 0.01);
}

TEST(RobustLoop, PassesOnWhatTheExaminationFinds) {
  std::mt19937 generator(14);
  const LineData data(generator, 200, 0.5, kNoise);
  const RandomOrder order = randomOrder(200, 1);
  gslam::detail::Examination answer;
  answer.degeneracy = gslam::Degeneracy::Planar;
  answer.has_alternative = true;
  answer.alternative = ModelNumbers{{1.0, 2.0}};
  answer.has_replacement = true;
  answer.replacement = ModelNumbers{{data.angle, data.distance}};
  answer.reason = "because";
  LoopResult result =
      runRobustLoop(ExaminedProblem(data, order, answer), EstimateOptions(), kThreshold, order);
  EXPECT_EQ(EstimateStatus::Ok, result.summary.status);
  EXPECT_EQ(gslam::Degeneracy::Planar, result.summary.degeneracy);
  EXPECT_TRUE(result.has_alternative);
  EXPECT_EQ(answer.alternative, result.alternative);
  EXPECT_EQ(answer.replacement, result.model);
  EXPECT_NE(std::string::npos, result.summary.message.find("because"));
  expectConsistent(data, result);

  answer.is_determined = false;
  result =
      runRobustLoop(ExaminedProblem(data, order, answer), EstimateOptions(), kThreshold, order);
  EXPECT_EQ(EstimateStatus::Degenerate, result.summary.status);
  EXPECT_EQ(0, result.covariance[0]);
}

TEST(RobustLoop, SaysWhenThereIsNoModel) {
  std::mt19937 generator(15);
  const LineData data(generator, 50, 0.5, kNoise);
  const RandomOrder order = randomOrder(50, 1);
  for (const EstimateScoring scoring : kScorings) {
    EstimateOptions options;
    options.scoring = scoring;
    options.max_iterations = 100;
    const LoopResult result =
        runRobustLoop(EmptyProblem(data.points, order), options, kThreshold, order);
    EXPECT_EQ(EstimateStatus::NoConsensus, result.summary.status);
    EXPECT_FALSE(result.has_model);
    EXPECT_EQ(50u, result.summary.inliers.size());
    EXPECT_EQ(100u, result.summary.iterations);
  }
}

TEST(RobustLoop, SaysWhenInliersLeaveTheModelFree) {
  std::mt19937 generator(16);
  const LineData data(generator, 50, 0.2, kNoise);
  const RandomOrder order = randomOrder(50, 1);
  const LoopResult result =
      runRobustLoop(FreeProblem(data.points, order), EstimateOptions(), kThreshold, order);
  EXPECT_EQ(EstimateStatus::Degenerate, result.summary.status) << result.summary.message;
  EXPECT_EQ(0, result.covariance[0]);
}

TEST(RobustLoop, TrustsNoModelThatNothingConfirms) {
  const std::vector<gslam::Vec2d> points = {{1, 2}, {3, 5}};
  const RandomOrder order = randomOrder(2, 1);
  for (const EstimateScoring scoring : kScorings) {
    EstimateOptions options;
    options.scoring = scoring;
    const LoopResult result = runRobustLoop(LineProblem(points, order), options, kThreshold, order);
    EXPECT_EQ(EstimateStatus::NoConsensus, result.summary.status);
    EXPECT_LT(result.summary.iterations, 10u);
    EXPECT_EQ(2u, result.summary.inlier_count);
  }
}

TEST(RobustLoop, ScoresMatchesWithoutNoise) {
  std::mt19937 generator(17);
  for (const EstimateScoring scoring : kScorings) {
    const LineData data(generator, 100, 0.3, 0);
    EstimateOptions options;
    options.scoring = scoring;
    const LoopResult result = search(data, options);
    ASSERT_TRUE(result.summary.ok()) << result.summary.message;
    EXPECT_LT(lineError(result.model, data.angle, data.distance), 1e-7);
    EXPECT_GE(result.summary.inlier_count, 60u);
  }
}
