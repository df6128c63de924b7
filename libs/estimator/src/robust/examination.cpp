#include "robust/examination.h"

#include <algorithm>
#include <cmath>

#include "robust/a_contrario.h"
#include "robust/least_squares.h"

namespace gslam {
inline namespace v1 {
namespace detail {
namespace {
constexpr double kLog10FalseAlarms = -3;
}

std::vector<std::uint32_t> indicesOf(const std::uint8_t* inliers, std::size_t size) {
  std::vector<std::uint32_t> indices;
  for (std::size_t i = 0; i < size; ++i) {
    if (inliers[i] != 0) indices.push_back(static_cast<std::uint32_t>(i));
  }
  return indices;
}

double truncatedCost(const Problem& problem, const ModelNumbers& model, double threshold) {
  std::vector<double> squared(problem.size());
  problem.exactSquaredResiduals(model, squared.data());
  const double largest = threshold * threshold;
  double sum = 0;
  for (const double s : squared) sum += s < largest ? s : largest;
  return sum;
}

bool isBeyondChance(std::size_t count, std::size_t agreeing, std::size_t sample,
                    double probability) {
  if (agreeing <= sample) return false;
  // Rounding may let a few more agree than are left over.
  const FalseAlarms alarms = {std::max(count, agreeing), sample, 1};
  return alarms.log10Expected(agreeing, probability) < kLog10FalseAlarms;
}

bool covarianceOf(const Problem& problem, const std::vector<double>& weights,
                  const ModelNumbers& model, std::array<double, kMaxDof * kMaxDof>& covariance) {
  NormalEquations sums;
  problem.accumulate(model, weights.data(), weights.size(), sums);
  std::size_t numbers = 0;
  for (const double w : weights) numbers += w > 0;
  numbers *= problem.residualDimension();
  if (numbers <= problem.dof()) return false;
  if (!invertHessian(sums, problem.dof(), covariance.data())) return false;
  const double variance = sums.cost / static_cast<double>(numbers - problem.dof());
  for (double& c : covariance) c *= variance;
  return true;
}

double cutOffFactor(double ratio) {
  // Below one deviation it is all guesswork.
  double low = 1, high = 10, within = 1, squares = 1;
  for (int i = 0; i < 30; ++i) {
    const double k = 0.5 * (low + high);  // the threshold in standard deviations
    within = std::erf(k / 1.4142135623730951);
    squares = within - k * 0.7978845608028654 * std::exp(-0.5 * k * k);
    (squares / within > ratio * k * k ? low : high) = k;
  }
  return within * within / (squares * squares);
}

double largestVariance(const std::array<double, kMaxDof * kMaxDof>& covariance, std::size_t first,
                       std::size_t size) {
  // Powers: good to a few percent, which is enough for a bound.
  double v[kMaxDof], norm = 0;
  for (std::size_t k = 0; k < size; ++k) v[k] = 1 + 0.1 * static_cast<double>(k);
  for (int round = 0; round < 20; ++round) {
    double next[kMaxDof];
    norm = 0;
    for (std::size_t r = 0; r < size; ++r) {
      next[r] = 0;
      for (std::size_t c = 0; c < size; ++c) {
        next[r] += covariance[(first + r) * kMaxDof + first + c] * v[c];
      }
      norm += next[r] * next[r];
    }
    norm = std::sqrt(norm);
    if (!(norm > 0)) return 0;
    for (std::size_t k = 0; k < size; ++k) v[k] = next[k] / norm;
  }
  return norm;
}

}  // namespace detail
}  // namespace v1
}  // namespace gslam
