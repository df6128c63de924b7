#include "robust/robust_loop.h"

#include <gslam/base/parallel.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <cstdint>
#include <string>
#include <utility>
#include <vector>

#include "robust/consensus.h"
#include "robust/evidence.h"
#include "robust/least_squares.h"
#include "robust/messages.h"
#include "robust/refiner.h"
#include "robust/sampler.h"
#include "robust/scorer.h"
#include "robust/stopping.h"

namespace gslam {
inline namespace v1 {
namespace detail {
namespace {

// Samples are drawn in batches, and each batch in chunks, whatever the number of threads: what is
// known at the start of a batch, and before in the same chunk, decides when a model is left early.
constexpr std::size_t kFirstBatch = 8;
constexpr std::size_t kLargestBatch = 64;
constexpr std::size_t kChunk = 8;

// A model of a sample.
struct Candidate {
  double loss = kNoLoss;
  ModelNumbers model{};
  Sample sample{};
};

class Search {
 public:
  Search(const Problem& problem, const EstimateOptions& options, double threshold,
         const RandomOrder& order, const LoopTuning& tuning);

  LoopResult run();

 private:
  void draw(std::size_t count);
  Candidate bestOfChunk(std::size_t first, std::size_t last) const;
  void adopt(Candidate candidate);
  void considerProposals(Candidate& candidate);
  void look(const ModelNumbers& model);
  bool isOver() const;

  void refineToTheEnd();
  void conclude(LoopResult& result);
  void examine(LoopResult& result);
  void setConsensus(EstimateSummary& summary);
  ConsensusLimits consensusLimits() const;
  bool setCovariance(LoopResult& result);

  const Problem& problem_;
  const EstimateOptions options_;
  const RandomOrder& order_;
  const std::size_t n_;
  double threshold_;
  Scorer scorer_;
  Judge judge_;
  Refiner refiner_;
  Stopping stopping_;
  const std::chrono::steady_clock::time_point start_ = std::chrono::steady_clock::now();

  std::size_t drawn_ = 0;
  std::size_t batch_ = kFirstBatch;
  double sample_loss_ = kNoLoss;  // of the best model of a sample, before it was improved
  Candidate best_;
  Consensus consensus_;  // of the best
  std::vector<float> squared_;
  std::vector<double> exact_;
  std::vector<std::uint8_t> inliers_;  // in the problem's order
};

Sampler samplerFor(const Problem& problem, const EstimateOptions& options,
                   const RandomOrder& order) {
  if (options.sampling == EstimateSampling::Prosac && !options.quality.empty()) {
    return Sampler(order, problem.sampleSize(), options.seed, options.quality,
                   options.max_iterations / 2);
  }
  return Sampler(problem.size(), problem.sampleSize(), options.seed);
}

// What is given as the least counts as the most, where it is more.
EstimateOptions consistent(EstimateOptions options) {
  options.max_iterations = std::max(options.max_iterations, options.min_iterations);
  return options;
}

Search::Search(const Problem& problem, const EstimateOptions& options, double threshold,
               const RandomOrder& order, const LoopTuning& tuning)
    : problem_(problem),
      options_(consistent(options)),
      order_(order),
      n_(problem.size()),
      threshold_(threshold),
      scorer_(problem, options.scoring, threshold, tuning),
      judge_(problem, options, threshold),
      refiner_(problem, options.scoring == EstimateScoring::Magsac),
      stopping_(problem, options_, samplerFor(problem, options_, order)),
      squared_(n_),
      exact_(n_),
      inliers_(n_) {}

LoopResult Search::run() {
  while (!isOver()) {
    draw(std::min(batch_, stopping_.limit() - drawn_));
    batch_ = std::min(2 * batch_, kLargestBatch);
  }
  LoopResult result;
  result.summary.iterations = drawn_;
  result.has_model = best_.loss < kNoLoss;
  if (result.has_model) {
    if (options_.final_refinement) refineToTheEnd();
    conclude(result);
  } else {
    result.summary.inliers.assign(n_, 0);
    result.summary.threshold = threshold_;
    result.summary.score = kNoLoss;
    result.summary.message = noModelMessage(drawn_);
  }
  return result;
}

bool Search::isOver() const {
  if (drawn_ >= stopping_.limit()) return true;
  if (options_.max_seconds <= 0 || drawn_ == 0) return false;
  const std::chrono::duration<double> passed = std::chrono::steady_clock::now() - start_;
  return passed.count() >= options_.max_seconds;
}

void Search::draw(std::size_t count) {
  Candidate candidates[kLargestBatch / kChunk];
  ParallelOptions parallel;
  parallel.grain = kChunk;
  parallel.threads = options_.threads;
  parallelChunks(
      0, count,
      [&](std::size_t first, std::size_t last) {
        candidates[first / kChunk] = bestOfChunk(drawn_ + first, drawn_ + last);
      },
      parallel);
  drawn_ += count;
  const Candidate* best = candidates;
  for (const Candidate& candidate : candidates) {
    if (candidate.loss < best->loss) best = &candidate;  // of equal ones the first
  }
  if (best->loss < sample_loss_) adopt(*best);
}

Candidate Search::bestOfChunk(std::size_t first, std::size_t last) const {
  Candidate best;
  best.loss = sample_loss_;
  bool is_found = false;
  std::vector<float> scratch;
  ModelNumbers models[kMaxModels];
  for (std::size_t number = first; number < last; ++number) {
    const Sample sample = stopping_.sampler().draw(number, stopping_.pool());
    const std::size_t count = problem_.solve(sample.data(), models);
    for (std::size_t i = 0; i < count; ++i) {
      const double loss = scorer_.loss(models[i], best.loss, scratch);
      if (!(loss < best.loss)) continue;
      best.loss = loss;
      best.model = models[i];
      best.sample = sample;
      is_found = true;
    }
  }
  if (!is_found) best.loss = kNoLoss;
  return best;
}

// Fills squared_ and inliers_, and judges.
void Search::look(const ModelNumbers& model) {
  problem_.squaredResiduals(model, 0, n_, squared_.data());
  consensus_ = judge_.judge(squared_.data());
  const float limit = static_cast<float>(consensus_.threshold * consensus_.threshold);
  for (std::size_t i = 0; i < n_; ++i) inliers_[i] = squared_[i] <= limit ? 1 : 0;
}

// The best model of a sample so far. Improved it may be worse than another improved before.
void Search::adopt(Candidate candidate) {
  sample_loss_ = candidate.loss;
  look(candidate.model);
  considerProposals(candidate);
  if (options_.local_optimisation) {
    const double threshold =
        options_.scoring == EstimateScoring::Lmeds ? consensus_.threshold : threshold_;
    const ModelNumbers improved = refiner_.improve(candidate.model, threshold, consensus_.inliers);
    const double loss = scorer_.loss(improved, candidate.loss, squared_);
    if (loss < candidate.loss) {
      candidate.loss = loss;
      candidate.model = improved;
    }
  }
  if (!(candidate.loss < best_.loss)) return;
  best_ = candidate;
  look(best_.model);
  // Where nothing can be significant, the search need not go on for it.
  const bool is_worth = judge_.isSignificant(consensus_) || !judge_.couldBeSignificant(consensus_);
  stopping_.update(consensus_, is_worth, inliers_.data(), drawn_);
}

void Search::considerProposals(Candidate& candidate) {
  ModelNumbers models[kMaxModels];
  const std::size_t count = problem_.propose(candidate.model, candidate.sample.data(),
                                             inliers_.data(), consensus_.threshold, models);
  bool is_other = false;
  for (std::size_t i = 0; i < count; ++i) {
    const double loss = scorer_.loss(models[i], candidate.loss, squared_);
    if (!(loss < candidate.loss)) continue;
    candidate.loss = loss;
    candidate.model = models[i];
    is_other = true;
  }
  if (is_other) look(candidate.model);
}

// Least squares at the inliers in the end, whatever made the model the best.
void Search::refineToTheEnd() {
  ModelNumbers model = best_.model;
  if (options_.scoring == EstimateScoring::Magsac) model = refiner_.converge(model, threshold_);
  double threshold = threshold_;
  if (options_.scoring == EstimateScoring::Magsac || options_.scoring == EstimateScoring::Lmeds) {
    problem_.exactSquaredResiduals(model, exact_.data());
    threshold = judge_.judge(exact_.data()).threshold;
  }
  Refiner hard(problem_, false);
  best_.model = hard.converge(model, threshold);
}

void Search::conclude(LoopResult& result) {
  EstimateSummary& summary = result.summary;
  setConsensus(summary);
  result.model = best_.model;
  if (!judge_.isSignificant(consensus_)) {
    summary.status = EstimateStatus::NoConsensus;
    summary.message = noConsensusMessage(summary, consensusLimits());
    return;
  }
  summary.status = EstimateStatus::Ok;
  summary.message = okMessage(summary);
  examine(result);
}

ConsensusLimits Search::consensusLimits() const {
  ConsensusLimits limits;
  limits.sample_size = problem_.sampleSize();
  limits.distinct = consensus_.distinct;
  limits.distinct_inliers = consensus_.distinct_inliers;
  limits.fewest_inliers = judge_.fewestInliers(consensus_);
  limits.fewest_matches = judge_.fewestMatches(consensus_);
  limits.is_at_limit = drawn_ >= options_.max_iterations;
  limits.has_threshold = options_.scoring != EstimateScoring::Lmeds;
  return limits;
}

void Search::examine(LoopResult& result) {
  EstimateSummary& summary = result.summary;
  const Examination found = problem_.examine(best_.model, inliers_.data(), consensus_.threshold);
  if (found.has_replacement) {
    best_.model = result.model = found.replacement;
    setConsensus(summary);
    summary.message = okMessage(summary);
  }
  summary.degeneracy = found.degeneracy;
  result.has_alternative = found.has_alternative;
  result.alternative = found.alternative;
  if (found.has_covariance) result.covariance = found.covariance;
  const bool is_determined = found.is_determined && (found.has_covariance || setCovariance(result));
  if (!is_determined) summary.status = EstimateStatus::Degenerate;
  if (found.reason != nullptr) {
    summary.message += std::string(": ") + found.reason;
  } else if (!is_determined) {
    summary.message += ", but they do not determine the model";
  }
}

// From the exact residuals of the model that is returned.
void Search::setConsensus(EstimateSummary& summary) {
  problem_.exactSquaredResiduals(best_.model, exact_.data());
  consensus_ = judge_.judge(exact_.data());
  const double limit = consensus_.threshold * consensus_.threshold;
  summary.inliers.assign(n_, 0);
  double sum = 0;
  for (std::size_t i = 0; i < n_; ++i) {
    inliers_[i] = exact_[i] <= limit ? 1 : 0;
    summary.inliers[order_[i]] = inliers_[i];
    if (inliers_[i] != 0) sum += exact_[i];
  }
  judge_.examine(best_.model, inliers_.data(), consensus_);
  const double count = static_cast<double>(consensus_.inliers);
  summary.inlier_count = consensus_.inliers;
  summary.inlier_ratio = count / static_cast<double>(n_);
  summary.threshold = consensus_.threshold;
  summary.score = scorer_.exactLoss(exact_.data());
  summary.rms = consensus_.inliers > 0 ? std::sqrt(sum / count) : 0;
  summary.log10_false_alarms = consensus_.log10_false_alarms;
}

// The variance of one number of a residual times (J^T J)^-1, over the inliers. That the tails
// beyond the threshold are missing is not made up for: with a threshold of 2.5 standard deviations
// it makes 10 percent, with 3 it makes 3. Matches that were given several times count once.
bool Search::setCovariance(LoopResult& result) {
  const std::size_t dof = problem_.dof();
  std::vector<double> weights;
  const std::size_t distinct = weighDistinct(problem_, best_.model, inliers_.data(), weights);
  NormalEquations sums;
  problem_.accumulate(best_.model, weights.data(), n_, sums);
  std::array<double, kMaxDof * kMaxDof> inverse{};
  if (!invertHessian(sums, dof, inverse.data())) return false;
  const double numbers = static_cast<double>(distinct * problem_.residualDimension());
  double squares = 0;
  for (std::size_t i = 0; i < n_; ++i) {
    if (weights[i] > 0) squares += weights[i] * exact_[i];
  }
  // Without redundancy the residuals say nothing of the noise; the threshold does.
  const double third = consensus_.threshold / 3;
  const double variance = numbers > static_cast<double>(dof)
                              ? squares / (numbers - static_cast<double>(dof))
                              : third * third;
  for (double& element : inverse) element *= variance;
  result.covariance = inverse;
  return true;
}

}  // namespace

LoopResult runRobustLoop(const Problem& problem, const EstimateOptions& options, double threshold,
                         const RandomOrder& order, const LoopTuning& tuning) {
  return Search(problem, options, threshold, order, tuning).run();
}

}  // namespace detail
}  // namespace v1
}  // namespace gslam
