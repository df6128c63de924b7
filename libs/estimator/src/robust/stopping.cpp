#include "robust/stopping.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "robust/a_contrario.h"
#include "robust/scorer.h"

namespace gslam {
inline namespace v1 {
namespace detail {
namespace {

// Of models with so many inliers among the best ranked by chance: many models were tried, and many
// numbers of best ranked.
constexpr double kLog10OfChance = -3;
constexpr std::size_t kSmallestPool = 20;

// The mean of a Poisson distribution that is below `wanted` with the probability 1 - confidence.
double meanNeeded(std::size_t wanted, double confidence) {
  const double first = -std::log1p(-confidence);
  if (wanted == 1) return first;
  double low = first, high = first + 8 * static_cast<double>(wanted);
  for (int i = 0; i < 40; ++i) {
    const double mean = 0.5 * (low + high);
    double term = 1, sum = 0;
    for (std::size_t k = 0; k < wanted; ++k) {
      sum += term;
      term *= mean / static_cast<double>(k + 1);
    }
    (std::log(sum) - mean > -first ? low : high) = mean;
  }
  return high;
}

}  // namespace

double samplesNeeded(std::size_t inliers, std::size_t matches, std::size_t sample_size,
                     double confidence, std::size_t wanted) {
  if (inliers < sample_size) return std::numeric_limits<double>::infinity();
  double good = 1;  // probability of a sample without an outlier
  for (std::size_t i = 0; i < sample_size; ++i) {
    good *= static_cast<double>(inliers - i) / static_cast<double>(matches - i);
  }
  const auto count = static_cast<double>(wanted);
  if (good >= 1) return count;
  // Samples up to the next good one are an exponential time, rounded up: with one more for each of
  // the others the bound holds for small numbers of samples, too.
  return std::ceil(meanNeeded(wanted, confidence) / -std::log1p(-good) + count - 1);
}

Stopping::Stopping(const Problem& problem, const EstimateOptions& options, Sampler sampler)
    : problem_(problem),
      sampler_(std::move(sampler)),
      scoring_(options.scoring),
      confidence_(options.confidence),
      least_(options.min_iterations),
      most_(options.max_iterations),
      limit_(options.max_iterations),
      pool_(0) {}

void Stopping::update(const Consensus& consensus, bool is_worth, const std::uint8_t* inliers,
                      std::size_t drawn) {
  limit_ = most_;
  pool_ = 0;
  if (!is_worth) return;
  const std::size_t n = problem_.size(), s = problem_.sampleSize();
  // Lmeds' threshold grows with the residuals of a bad model, so that its inliers say nothing.
  const bool is_lmeds = scoring_ == EstimateScoring::Lmeds;
  const std::size_t trusted = is_lmeds ? lmedsRank(n, s) + 1 : consensus.inliers;
  double needed = samplesNeeded(trusted, n, s, confidence_, problem_.goodSamples());
  if (sampler_.isProsac()) {
    pool_ = n;
    if (!is_lmeds) needed = std::min(needed, bestPool(consensus, inliers));
    needed += static_cast<double>(drawn);
  }
  if (needed < static_cast<double>(most_)) {
    limit_ = std::max(least_, static_cast<std::size_t>(needed));
  }
}

// Sets pool_ to the number of best ranked of which the fewest samples are needed; how many.
double Stopping::bestPool(const Consensus& consensus, const std::uint8_t* inliers) {
  const std::size_t s = problem_.sampleSize(), n = problem_.size();
  const std::size_t wanted = problem_.goodSamples();
  const double chance = problem_.chance(consensus.threshold);
  double fewest = samplesNeeded(consensus.inliers, n, s, confidence_, wanted);
  std::size_t found = 0;
  for (std::size_t size = 1; size < n; ++size) {
    found += inliers[sampler_.ranked()[size - 1]];
    if (size < std::max(kSmallestPool, 2 * s) || found <= s) continue;
    const double needed = samplesNeeded(found, size, s, confidence_, wanted);
    if (needed >= fewest) continue;
    const FalseAlarms among_best = {size, s, problem_.maxSolutions()};
    if (among_best.log10Expected(found, chance) > kLog10OfChance) continue;
    fewest = needed;
    pool_ = size;
  }
  return fewest;
}

}  // namespace detail
}  // namespace v1
}  // namespace gslam
