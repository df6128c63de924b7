#include "robust/scorer.h"

#include <algorithm>
#include <cmath>
#include <vector>

namespace gslam {
inline namespace v1 {
namespace detail {
namespace {

// The first look at a model: most are bad, and 64 matches show it.
constexpr std::size_t kFirstBlocks = 64;
constexpr std::size_t kFirstBlocksEnd = 256;

std::size_t blockAt(std::size_t done, std::size_t matches) {
  return std::min(done < kFirstBlocksEnd ? kFirstBlocks : kScoreBlock, matches - done);
}

// Of all matches of a model no worse than the best so far, each gains 1 - loss, from 0 to 1, with
// the mean g at least. Matches are in random order, so that the gains of the first m have this
// mean and a variance of at most g (1 - g) each. A sum three deviations below it is seen in one of
// a thousand such models. (In the spirit of Matas, Chum, "Randomized RANSAC with sequential
// probability ratio test", ICCV 2005; unlike theirs it needs no guess of how bad models look.)
bool isHopeless(double loss_of_first, double m, double bound_per_match) {
  constexpr double kDeviations = 3;
  const double g = std::max(0.0, 1 - bound_per_match);
  return m - loss_of_first < m * g - kDeviations * std::sqrt(m * g * (1 - g));
}

}  // namespace

std::size_t lmedsRank(std::size_t matches, std::size_t sample_size) {
  return std::min(matches, matches / 2 + (sample_size + 1) / 2) - 1;
}

Scorer::Scorer(const Problem& problem, EstimateScoring scoring, double threshold,
               const LoopTuning& tuning)
    : problem_(problem),
      scoring_(scoring),
      limit_(threshold * threshold),
      tuning_(tuning),
      kernel_(nullptr),
      scale_(1) {
  switch (scoring) {
    case EstimateScoring::Msac:
      kernel_ = ScoreKernels::truncated().active();
      scale_ = 1 / limit_;
      break;
    case EstimateScoring::Magsac:
      kernel_ = ScoreKernels::magsac().active();
      break;
    case EstimateScoring::Ransac:
    case EstimateScoring::Lmeds:
      kernel_ = ScoreKernels::above().active();
      break;
  }
}

double Scorer::loss(const ModelNumbers& model, double bound, std::vector<float>& scratch) const {
  return scoring_ == EstimateScoring::Lmeds ? lmedsLoss(model, bound, scratch)
                                            : sumLoss(model, bound);
}

double Scorer::sumLoss(const ModelNumbers& model, double bound) const {
  const std::size_t n = problem_.size();
  const double per_match = bound / static_cast<double>(n);
  const bool is_bounded = std::isfinite(bound);
  const float limit = static_cast<float>(limit_);
  float squared[kScoreBlock];
  double sum = 0;
  for (std::size_t done = 0; done < n;) {
    const std::size_t count = blockAt(done, n);
    problem_.squaredResiduals(model, done, count, squared);
    sum += scale_ * kernel_(squared, count, limit);
    done += count;
    if (tuning_.exact_bound && sum >= bound) return kNoLoss;
    if (tuning_.statistical_test && is_bounded && done < n &&
        isHopeless(sum, static_cast<double>(done), per_match)) {
      return kNoLoss;
    }
  }
  return sum < bound ? sum : kNoLoss;  // NOLINT(bugprone-narrowing-conversions): both are double
}

// The rank is better than the bound if and only if enough residuals are: that is seen early.
double Scorer::lmedsLoss(const ModelNumbers& model, double bound,
                         std::vector<float>& squared) const {
  const std::size_t n = problem_.size();
  const std::size_t rank = lmedsRank(n, problem_.sampleSize());
  const double most_above = static_cast<double>(n - rank - 1);
  const bool is_bounded = std::isfinite(bound);
  squared.resize(n);
  double above = 0;
  for (std::size_t done = 0; done < n;) {
    const std::size_t count = blockAt(done, n);
    problem_.squaredResiduals(model, done, count, &squared[done]);
    if (is_bounded) above += kernel_(&squared[done], count, static_cast<float>(bound));
    done += count;
    if (tuning_.exact_bound && above > most_above) return kNoLoss;
    if (tuning_.statistical_test && is_bounded && done < n &&
        isHopeless(above, static_cast<double>(done), most_above / static_cast<double>(n))) {
      return kNoLoss;
    }
  }
  for (float& value : squared) {  // which an order needs
    if (std::isnan(value)) value = std::numeric_limits<float>::infinity();
  }
  const auto at = squared.begin() + static_cast<std::ptrdiff_t>(rank);
  std::nth_element(squared.begin(), at, squared.end());
  return static_cast<double>(*at) < bound ? static_cast<double>(*at) : kNoLoss;
}

double Scorer::exactLoss(const double* squared) const {
  const std::size_t n = problem_.size();
  if (scoring_ == EstimateScoring::Lmeds) {
    std::vector<double> sorted(squared, squared + n);
    for (double& value : sorted) {
      if (std::isnan(value)) value = kNoLoss;
    }
    const auto at =
        sorted.begin() + static_cast<std::ptrdiff_t>(lmedsRank(n, problem_.sampleSize()));
    std::nth_element(sorted.begin(), at, sorted.end());
    return *at;
  }
  double sum = 0;
  for (std::size_t i = 0; i < n; ++i) {
    const bool is_inlier = squared[i] <= limit_;
    switch (scoring_) {
      case EstimateScoring::Msac:
        sum += is_inlier ? squared[i] / limit_ : 1;
        break;
      case EstimateScoring::Magsac:
        sum += magsacLoss(squared[i], limit_);
        break;
      default:
        sum += is_inlier ? 0 : 1;
    }
  }
  return sum;
}

}  // namespace detail
}  // namespace v1
}  // namespace gslam
