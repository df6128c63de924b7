// What the tests of the contract have in common.
#ifndef GSLAM_OPTIMIZER_TESTS_BACKEND_CONTRACT_FIXTURE_H
#define GSLAM_OPTIMIZER_TESTS_BACKEND_CONTRACT_FIXTURE_H

#include <gmock/gmock.h>
#include <gslam/optimizer.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <functional>
#include <string>
#include <utility>
#include <vector>

#include "scenes.h"

using BackendOfContract = const gslam::OptimizerBackend& (*)();

class BackendContract : public testing::TestWithParam<BackendOfContract> {
 protected:
  const gslam::OptimizerBackend& backend() const { return GetParam()(); }
  /// Of the back end, with tolerances that leave nothing to be found.
  gslam::OptimizerOptions options() const {
    gslam::registerOptimizerBackend(backend());
    gslam::OptimizerOptions result;
    result.backend = backend().name;
    result.max_iterations = 100;
    result.function_tolerance = 1e-14;
    result.parameter_tolerance = 1e-14;
    result.linear_tolerance = 1e-6;
    return result;
  }
};

/// Skips the test where the back end has no such function.
#define NEEDS_FUNCTION(function) \
  if (!backend().function) GTEST_SKIP() << backend().name << " has no " #function

namespace backend_contract {

/// Whether two arrays are the same, bit for bit.
template <class T>
bool areSameBits(const std::vector<T>& a, const std::vector<T>& b) {
  return a.size() == b.size() &&
         (a.empty() || std::memcmp(a.data(), b.data(), a.size() * sizeof(T)) == 0);
}
template <class T>
bool areSameBits(const T& a, const T& b) {
  return std::memcmp(&a, &b, sizeof(T)) == 0;
}

inline const std::vector<gslam::RobustLoss>& allLosses() {
  using gslam::LossKind;
  static const std::vector<gslam::RobustLoss> losses = {{LossKind::Squared, 1},
                                                        {LossKind::Huber, 1},
                                                        {LossKind::Cauchy, 1},
                                                        {LossKind::Tukey, 4},
                                                        {LossKind::GemanMcClure, 2}};
  return losses;
}

/// What every summary must say of itself; `cost` is that of the returned variables.
inline void expectConsistent(const gslam::OptimizerSummary& summary, double initial, double cost) {
  const std::string page = fullReport(summary);
  EXPECT_NEAR(summary.initial_cost, initial, 1e-9 * initial + 1e-18) << page;
  EXPECT_NEAR(summary.final_cost, cost, 1e-9 * cost + 1e-18) << page;
  EXPECT_FALSE(summary.message.empty());
  EXPECT_FALSE(summary.backend.empty());
  EXPECT_FALSE(summary.linear_solver.empty());
  EXPECT_LE(summary.inliers, summary.observations);
  if (summary.is_usable) {
    EXPECT_LE(summary.final_cost, summary.initial_cost) << page;
  } else {
    EXPECT_EQ(cost, initial) << page;
  }
  const gslam::OptimizerTimes& times = summary.times;
  EXPECT_GE(std::min({times.setup, times.linearize, times.solve, times.evaluate}), 0) << page;
  EXPECT_LE(times.setup + times.linearize + times.solve + times.evaluate,
            times.total * 1.001 + 1e-4)
      << page;
  ASSERT_FALSE(summary.iterations.empty());
  EXPECT_NEAR(summary.iterations.front().cost, initial, 1e-9 * initial + 1e-18) << page;
  double kept = summary.iterations.front().cost, seconds = 0;
  for (std::size_t i = 0; i < summary.iterations.size(); ++i) {
    const gslam::OptimizerIteration& one = summary.iterations[i];
    EXPECT_EQ(one.number, i);
    EXPECT_GE(one.seconds, seconds);
    seconds = one.seconds;
    if (i == 0) continue;
    if (one.is_successful) {
      EXPECT_LE(one.cost, kept * (1 + 1e-12)) << page;
      kept = one.cost;
    }
  }
  EXPECT_NEAR(kept, summary.final_cost, 1e-9 * kept + 1e-18) << page;
}

/// Solves, and looks at what is said of it.
inline gslam::OptimizerSummary solveChecked(BundleScene& scene,
                                            const gslam::OptimizerOptions& options) {
  const double initial = bundleCost(scene.problem(), options.loss);
  const gslam::OptimizerSummary summary = optimizeBundle(scene.problem(), options);
  expectConsistent(summary, initial, bundleCost(scene.problem(), options.loss));
  return summary;
}

template <class Group>
gslam::OptimizerSummary solveChecked(const gslam::PoseGraphProblem<Group>& problem,
                                     const gslam::OptimizerOptions& options) {
  const double initial = poseGraphCost(problem, options.loss);
  const gslam::OptimizerSummary summary = optimizePoseGraph(problem, options);
  expectConsistent(summary, initial, poseGraphCost(problem, options.loss));
  return summary;
}

/// How far the worst of them is from the truth.
template <class Group>
double worstPose(const std::vector<Group>& poses, const std::vector<Group>& truth) {
  double worst = 0;
  for (std::size_t i = 0; i < poses.size(); ++i) {
    worst = std::max(worst, (truth[i].inverse() * poses[i]).log().norm());
  }
  return worst;
}
inline double worstPoint(const std::vector<Vec3d>& points, const std::vector<Vec3d>& truth) {
  double worst = 0;
  for (std::size_t i = 0; i < points.size(); ++i) {
    worst = std::max(worst, (points[i] - truth[i]).norm());
  }
  return worst;
}

/// The inverse of an n x n matrix with positive eigenvalues, by Gauss and Jordan.
inline std::vector<double> inverseOf(std::vector<double> a, std::size_t n) {
  std::vector<double> inverse(n * n, 0);
  for (std::size_t i = 0; i < n; ++i) inverse[i * n + i] = 1;
  for (std::size_t k = 0; k < n; ++k) {
    const double pivot = a[k * n + k];
    for (std::size_t j = 0; j < n; ++j) {
      a[k * n + j] /= pivot;
      inverse[k * n + j] /= pivot;
    }
    for (std::size_t i = 0; i < n; ++i) {
      const double factor = a[i * n + k];
      for (std::size_t j = 0; i != k && j < n; ++j) {
        a[i * n + j] -= factor * a[k * n + j];
        inverse[i * n + j] -= factor * inverse[k * n + j];
      }
    }
  }
  return inverse;
}

/// Second derivatives of a function of n numbers at 0. At an optimum without residuals those of a
/// cost are its normal equations.
inline std::vector<double> hessianOf(const std::function<double(const std::vector<double>&)>& cost,
                                     std::size_t n, double step) {
  std::vector<double> hessian(n * n), x(n, 0);
  const auto at = [&](std::size_t i, double di, std::size_t j, double dj) {
    x[i] += di;
    x[j] += dj;
    const double value = cost(x);
    x[i] = x[j] = 0;
    return value;
  };
  for (std::size_t i = 0; i < n; ++i) {
    for (std::size_t j = 0; j <= i; ++j) {
      hessian[i * n + j] = hessian[j * n + i] = (at(i, step, j, step) - at(i, step, j, -step) -
                                                 at(i, -step, j, step) + at(i, -step, j, -step)) /
                                                (4 * step * step);
    }
  }
  return hessian;
}

}  // namespace backend_contract

#endif  // GSLAM_OPTIMIZER_TESTS_BACKEND_CONTRACT_FIXTURE_H
