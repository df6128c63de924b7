#include "robust/consensus.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <vector>

#include "robust/evidence.h"
#include "robust/scorer.h"

namespace gslam {
inline namespace v1 {
namespace detail {
namespace {

// Magsac's thresholds: each is 2^(1/4) of the next, down to a thousandth.
constexpr std::size_t kThresholds = 40;

// Of the length of a normal vector of 1, 2, 3, 4 dimensions with unit deviations.
constexpr double kMedian[] = {0.6744898, 1.1774100, 1.5381723, 1.8323153};
constexpr double kLargest[] = {2.5, 2.9629, 3.2941, 3.5714};  // quantile 0.9876

std::size_t dimensionIndex(const Problem& problem) {
  return std::min<std::size_t>(std::max<std::size_t>(problem.residualDimension(), 1), 4) - 1;
}

double thresholdsTried(EstimateScoring scoring, std::size_t matches) {
  if (scoring == EstimateScoring::Magsac) return static_cast<double>(kThresholds);
  return scoring == EstimateScoring::Lmeds ? static_cast<double>(matches) : 1;  // any residual
}

}  // namespace

Judge::Judge(const Problem& problem, const EstimateOptions& options, double threshold)
    : problem_(problem),
      scoring_(options.scoring),
      threshold_(threshold),
      log10_limit_(std::log10(options.max_false_alarms)),
      false_alarms_{problem.size(), problem.sampleSize(), problem.maxSolutions(),
                    thresholdsTried(options.scoring, problem.size())} {}

Consensus Judge::judge(const float* squared) const {
  return judgeAll(squared);
}
Consensus Judge::judge(const double* squared) const {
  return judgeAll(squared);
}
Consensus Judge::judge(const double* squared, double threshold) const {
  return judgeAt(squared, threshold);
}

bool Judge::couldBeSignificant(const Consensus& consensus) const {
  return false_alarms_.log10Expected(problem_.size(), consensus.chance) < log10_limit_;
}

void Judge::examine(const ModelNumbers& model, const std::uint8_t* inliers,
                    Consensus& consensus) const {
  const DistinctCount distinct = countDistinct(problem_, model, consensus.threshold, inliers);
  consensus.distinct = distinct.matches;
  consensus.distinct_inliers = distinct.inliers;
  const FalseAlarms alarms = alarmsOf(consensus);
  const auto isSignificantWith = [&](double chance) {
    return alarms.log10Expected(distinct.inliers, chance) < log10_limit_;
  };
  // What is chance already stays so.
  if (isSignificantWith(consensus.chance)) {
    ShuffledPairs pairs(problem_, model, consensus.threshold);
    consensus.chance = std::max(consensus.chance, pairs.chance(isSignificantWith));
  }
  consensus.log10_false_alarms = alarms.log10Expected(distinct.inliers, consensus.chance);
}

FalseAlarms Judge::alarmsOf(const Consensus& consensus) const {
  FalseAlarms alarms = false_alarms_;
  if (consensus.distinct > 0) {
    alarms.matches = std::max(consensus.distinct, problem_.sampleSize());
  }
  return alarms;
}

std::size_t Judge::fewestMatches(const Consensus& consensus) const {
  constexpr std::size_t kMost = 1000;
  FalseAlarms alarms = false_alarms_;
  for (alarms.matches = problem_.sampleSize() + 1; alarms.matches <= kMost; ++alarms.matches) {
    if (alarms.log10Expected(alarms.matches, consensus.chance) < log10_limit_) {
      return alarms.matches;
    }
  }
  return 0;
}

std::size_t Judge::fewestInliers(const Consensus& consensus) const {
  return alarmsOf(consensus).fewestInliers(consensus.chance, log10_limit_);
}

template <class T>
Consensus Judge::judgeAll(const T* squared) const {
  if (scoring_ == EstimateScoring::Magsac) return judgeMagsac(squared);
  return judgeAt(squared,
                 scoring_ == EstimateScoring::Lmeds ? lmedsThreshold(squared) : threshold_);
}

template <class T>
Consensus Judge::judgeAt(const T* squared, double threshold) const {
  const T limit = static_cast<T>(threshold * threshold);
  Consensus result;
  result.threshold = threshold;
  for (std::size_t i = 0; i < problem_.size(); ++i) result.inliers += squared[i] <= limit ? 1u : 0u;
  result.chance = problem_.chance(threshold);
  result.log10_false_alarms = false_alarms_.log10Expected(result.inliers, result.chance);
  return result;
}

template <class T>
Consensus Judge::judgeMagsac(const T* squared) const {
  Consensus best = judgeAt(squared, threshold_);
  for (std::size_t i = 1; i < kThresholds; ++i) {
    const double smaller = threshold_ * std::exp2(-0.25 * static_cast<double>(i));
    const Consensus next = judgeAt(squared, smaller);
    if (next.inliers <= problem_.sampleSize()) break;
    if (next.log10_false_alarms < best.log10_false_alarms) best = next;
  }
  return best;
}

template <class T>
double Judge::lmedsThreshold(const T* squared) const {
  const std::size_t n = problem_.size(), s = problem_.sampleSize();
  std::vector<T> sorted(squared, squared + n);
  for (T& value : sorted) {
    if (std::isnan(value)) value = std::numeric_limits<T>::infinity();
  }
  const auto at = sorted.begin() + static_cast<std::ptrdiff_t>(lmedsRank(n, s));
  std::nth_element(sorted.begin(), at, sorted.end());
  const double median = std::sqrt(static_cast<double>(*at));
  const double few = 1 + 5 / static_cast<double>(std::max<std::size_t>(n - s, 1));
  const std::size_t dimension = dimensionIndex(problem_);
  const double deviation = few * median / kMedian[dimension];
  // Matches without any noise have residuals made of rounding, which are not normal: half the
  // digits of what is no rounding.
  const auto upper = sorted.begin() + static_cast<std::ptrdiff_t>(n - 1 - (n - 1) / 4);
  if (upper > at) std::nth_element(at, upper, sorted.end());
  const double far = std::isfinite(*upper) ? std::sqrt(static_cast<double>(*upper)) : 0;
  const double rounding = std::sqrt(static_cast<double>(std::numeric_limits<T>::epsilon())) * far;
  return std::max(kLargest[dimension] * deviation, rounding);
}

}  // namespace detail
}  // namespace v1
}  // namespace gslam
