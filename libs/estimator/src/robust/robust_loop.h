// The search for the model with the best consensus.
#ifndef GSLAM_ESTIMATOR_ROBUST_ROBUST_LOOP_H
#define GSLAM_ESTIMATOR_ROBUST_ROBUST_LOOP_H

#include <gslam/estimator/estimate.h>
#include <gslam/estimator/options.h>

#include <array>
#include <cstddef>
#include <utility>

#include "robust/loop_tuning.h"
#include "robust/problem.h"
#include "robust/random_order.h"

namespace gslam {
inline namespace v1 {
namespace detail {

// What the loop found.
struct LoopResult {
  EstimateSummary summary;  // inliers are in the caller's order
  bool has_model = false;   // whether model says anything; see summary.status for its worth
  ModelNumbers model{};
  bool has_alternative = false;
  ModelNumbers alternative{};
  // Of retract()'s delta at model, row by row in kMaxDof columns; zeros where status is not Ok.
  std::array<double, kMaxDof * kMaxDof> covariance{};
};

// Searches. `options` were checked and threshold is positive (input_check.h; for Lmeds it is not
// read); `order` is that of the problem's matches: options.quality and the mask are the caller's.
LoopResult runRobustLoop(const Problem& problem, const EstimateOptions& options, double threshold,
                         const RandomOrder& order, const LoopTuning& tuning = LoopTuning());

// Copies what all estimates share, and the covariance. The model is the caller's to convert.
template <class Model, std::size_t Dof>
void takeResult(LoopResult& from, Estimate<Model, Dof>& to) {
  static_cast<EstimateSummary&>(to) = std::move(from.summary);
  for (std::size_t r = 0; r < Dof; ++r) {
    for (std::size_t c = 0; c < Dof; ++c) to.covariance(r, c) = from.covariance[r * kMaxDof + c];
  }
}

}  // namespace detail
}  // namespace v1
}  // namespace gslam

#endif  // GSLAM_ESTIMATOR_ROBUST_ROBUST_LOOP_H
