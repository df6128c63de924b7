#include "robust/refiner.h"

#include <algorithm>
#include <cmath>

#include "robust/least_squares.h"
#include "robust/score_kernels.h"

namespace gslam {
inline namespace v1 {
namespace detail {
namespace {

constexpr std::size_t kLocalInliers = 200;
constexpr int kLocalSteps = 6;
constexpr int kRounds = 40;
constexpr int kFitSteps = 15;

// exp() of Magsac's weights needs no more digits while searching.
double quickMagsacWeight(float squared, float limit) {
  if (!(squared < limit)) return 0;
  const float u = squared * (kMagsacEnd / limit);
  return static_cast<double>(std::exp(-u) - kMagsacFloor);
}

}  // namespace

// Fills squared_ with the residuals of the first `count` matches; their truncated or soft cost.
static double costOfFirst(const Problem& problem, const ModelNumbers& model, bool soft,
                          std::size_t count, float limit, float* squared) {
  const ScoreKernels::Sum kernel =
      (soft ? ScoreKernels::magsac() : ScoreKernels::truncated()).active();
  double sum = 0;
  for (std::size_t done = 0; done < count;) {
    const std::size_t block = std::min(kScoreBlock, count - done);
    problem.squaredResiduals(model, done, block, squared + done);
    sum += kernel(squared + done, block, limit);
    done += block;
  }
  return sum;
}

ModelNumbers Refiner::improve(const ModelNumbers& model, double threshold, std::size_t inliers) {
  const std::size_t n = problem_.size(), dof = problem_.dof();
  const float limit = static_cast<float>(threshold * threshold);
  std::size_t count = n;
  if (inliers > kLocalInliers) count = std::max<std::size_t>(1, n * kLocalInliers / inliers);
  squared_.resize(2 * n);
  weights_.resize(n);
  float* squared = squared_.data();
  float* next_squared = squared_.data() + n;

  ModelNumbers best = model;
  double cost = costOfFirst(problem_, model, soft_, count, limit, squared);
  double damping = 1e-4;
  for (int step = 0; step < kLocalSteps; ++step) {
    for (std::size_t i = 0; i < count; ++i) {
      weights_[i] =
          soft_ ? quickMagsacWeight(squared[i], limit) : (squared[i] <= limit ? 1.0 : 0.0);
    }
    NormalEquations sums;
    problem_.accumulate(best, weights_.data(), count, sums);
    double delta[kMaxDof];
    if (!solveStep(sums, dof, damping, delta)) return best;
    const ModelNumbers candidate = problem_.retract(best, delta);
    const double next = costOfFirst(problem_, candidate, soft_, count, limit, next_squared);
    if (!(next < cost)) {
      damping *= 100;
      if (damping > 1) return best;
      continue;
    }
    const bool is_enough = next > cost * (1 - 1e-3);
    best = candidate;
    cost = next;
    std::swap(squared, next_squared);
    damping *= 0.1;
    if (is_enough) break;
  }
  return best;
}

ModelNumbers Refiner::converge(const ModelNumbers& model, double threshold) {
  exact_.resize(problem_.size());
  weights_.resize(problem_.size());
  const double limit = threshold * threshold;
  return soft_ ? convergeSoft(model, limit) : convergeHard(model, limit);
}

// Sets the weights from exact_; the cost.
double Refiner::weigh(double limit, std::size_t count) {
  double cost = 0;
  for (std::size_t i = 0; i < count; ++i) {
    const bool is_inlier = exact_[i] <= limit;
    weights_[i] = soft_ ? magsacWeight(exact_[i], limit) : (is_inlier ? 1 : 0);
    cost += soft_ ? magsacLoss(exact_[i], limit) : (is_inlier ? exact_[i] : limit);
  }
  return cost;
}

// Reweighted least squares: the loss is concave in the squared residual, so that no step raises it.
ModelNumbers Refiner::convergeSoft(const ModelNumbers& model, double limit) {
  const std::size_t n = problem_.size();
  ModelNumbers best = model;
  problem_.exactSquaredResiduals(best, exact_.data());
  double cost = weigh(limit, n);
  for (int round = 0; round < kRounds; ++round) {
    ModelNumbers candidate = best;
    fit(problem_, weights_.data(), n, 2, candidate);
    problem_.exactSquaredResiduals(candidate, exact_.data());
    const double next = weigh(limit, n);
    if (!(next < cost)) break;
    const bool is_enough = next > cost * (1 - 1e-13);
    best = candidate;
    cost = next;
    if (is_enough) break;
  }
  return best;
}

ModelNumbers Refiner::convergeHard(const ModelNumbers& model, double limit) {
  const std::size_t n = problem_.size();
  ModelNumbers best = model;
  problem_.exactSquaredResiduals(best, exact_.data());
  double cost = weigh(limit, n);
  bool is_fitted = false;  // best to these very inliers
  for (int round = 0; round < kRounds && !is_fitted; ++round) {
    const std::vector<double> old_weights = weights_;
    ModelNumbers candidate = best;
    // While the inliers change, a step or two are enough.
    const bool converged = fit(problem_, weights_.data(), n, round == 0 ? 2 : kFitSteps, candidate);
    problem_.exactSquaredResiduals(candidate, exact_.data());
    const double next = weigh(limit, n);
    if (!(next <= cost * (1 + 1e-12))) break;
    best = candidate;
    cost = next;
    is_fitted = weights_ == old_weights && (converged || round > 0);
  }
  return best;
}

}  // namespace detail
}  // namespace v1
}  // namespace gslam
