// What makes one model better than another.
#ifndef GSLAM_ESTIMATOR_ROBUST_SCORER_H
#define GSLAM_ESTIMATOR_ROBUST_SCORER_H

#include <gslam/estimator/options.h>

#include <cstddef>
#include <limits>
#include <vector>

#include "robust/loop_tuning.h"
#include "robust/problem.h"
#include "robust/score_kernels.h"

namespace gslam {
inline namespace v1 {
namespace detail {

constexpr double kNoLoss = std::numeric_limits<double>::infinity();

// The loss of a model, smaller is better. Msac, Ransac and Magsac: a sum over the matches of 0 (it
// fits) to 1 (it does not). Lmeds: the squared residual number lmedsRank(), from 0.
class Scorer {
 public:
  Scorer(const Problem& problem, EstimateScoring scoring, double threshold,
         const LoopTuning& tuning);

  // The loss, or kNoLoss where it is not below bound, or most likely not. scratch: a buffer that
  // the next call may use again.
  double loss(const ModelNumbers& model, double bound, std::vector<float>& scratch) const;
  // The loss from the exact residuals of all matches.
  double exactLoss(const double* squared) const;

  EstimateScoring scoring() const { return scoring_; }

 private:
  double sumLoss(const ModelNumbers& model, double bound) const;
  double lmedsLoss(const ModelNumbers& model, double bound, std::vector<float>& squared) const;

  const Problem& problem_;
  EstimateScoring scoring_;
  double limit_;  // threshold squared
  LoopTuning tuning_;
  ScoreKernels::Sum kernel_;
  double scale_;  // of the kernel's sums
};

// Half of the matches, and half of a sample more, since those of the sample fit anyway (Rousseeuw,
// "Least median of squares regression", JASA 79, 1984).
std::size_t lmedsRank(std::size_t matches, std::size_t sample_size);

}  // namespace detail
}  // namespace v1
}  // namespace gslam

#endif  // GSLAM_ESTIMATOR_ROBUST_SCORER_H
