// When enough samples were drawn.
#ifndef GSLAM_ESTIMATOR_ROBUST_STOPPING_H
#define GSLAM_ESTIMATOR_ROBUST_STOPPING_H

#include <gslam/estimator/options.h>

#include <cstddef>
#include <cstdint>
#include <vector>

#include "robust/consensus.h"
#include "robust/problem.h"
#include "robust/sampler.h"

namespace gslam {
inline namespace v1 {
namespace detail {

// Samples needed so that `wanted` without an outlier are among them with this probability, if
// `inliers` of `matches` are none.
double samplesNeeded(std::size_t inliers, std::size_t matches, std::size_t sample_size,
                     double confidence, std::size_t wanted = 1);

// Counts on the best model so far: its inliers say how many samples are needed. A model that is
// not worth it, since chance explains it, ends nothing. With PROSAC those among some of the best
// ranked do, for the number of best ranked that needs the fewest samples, where chance does not
// explain them (Chum, Matas 2005, section 2.2). Unlike there the samples that count are those drawn
// from these alike from then on: qualities that mislead must not end the search early.
class Stopping {
 public:
  Stopping(const Problem& problem, const EstimateOptions& options, Sampler sampler);

  // drawn: samples so far.
  void update(const Consensus& consensus, bool is_worth, const std::uint8_t* inliers,
              std::size_t drawn);

  // Samples after which the search is over.
  std::size_t limit() const { return limit_; }
  // What Sampler::draw() is to be given.
  std::size_t pool() const { return pool_; }
  const Sampler& sampler() const { return sampler_; }

 private:
  double bestPool(const Consensus& consensus, const std::uint8_t* inliers);

  const Problem& problem_;
  Sampler sampler_;
  EstimateScoring scoring_;
  double confidence_;
  std::size_t least_, most_;
  std::size_t limit_;
  std::size_t pool_;
};

}  // namespace detail
}  // namespace v1
}  // namespace gslam

#endif  // GSLAM_ESTIMATOR_ROBUST_STOPPING_H
