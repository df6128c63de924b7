#include <gslam/estimator/estimate_fundamental.h>

#include "robust/covariance_map.h"
#include "robust/fundamental_problem.h"
#include "robust/input_check.h"
#include "robust/robust_loop.h"

namespace gslam {
inline namespace v1 {

FundamentalEstimate estimateFundamental(Span<const Vec2d> first, Span<const Vec2d> second,
                                        const EstimateOptions& options) {
  using namespace detail;  // NOLINT(google-build-using-namespace)
  FundamentalEstimate estimate;
  if (!checkMatches("first", first.size(), "second", second.size(), 7, estimate) ||
      !checkFinite("first", first, estimate) || !checkFinite("second", second, estimate) ||
      !checkOptions(options, first.size(), kFundamentalThreshold, estimate)) {
    return estimate;
  }
  const RandomOrder order = randomOrder(first.size(), options.seed);
  const EpipolarMatches matches = EpipolarMatches::fromPoints(first, second, order);
  const FundamentalProblem problem(matches);
  LoopResult found = runRobustLoop(problem, options, estimate.threshold, order);
  static_cast<EstimateSummary&>(estimate) = std::move(found.summary);
  if (!found.has_model) return estimate;
  Mat<double, 9, 7> by_delta;
  estimate.model = problem.pixelMatrix(found.model, &by_delta);
  estimate.covariance = mappedCovariance(by_delta, found.covariance);
  return estimate;
}

}  // namespace v1
}  // namespace gslam
