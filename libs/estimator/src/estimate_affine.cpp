#include <gslam/estimator/estimate_affine_2d.h>
#include <gslam/estimator/estimate_affine_3d.h>

#include <utility>

#include "robust/affine_problem.h"
#include "robust/estimate_points.h"

namespace gslam {
inline namespace v1 {
namespace {

template <std::size_t N, class Result>
Result estimateAffine(Span<const Vec<double, N>> first, Span<const Vec<double, N>> second,
                      double default_threshold, const EstimateOptions& options) {
  Result result;
  if (!detail::checkPairs(first, second, N + 1, default_threshold, options, result)) return result;
  const Degeneracy shape = detail::shapeOfAll(first);
  if (shape != Degeneracy::None) return detail::refuseShape("first", shape, result), result;

  const detail::RandomOrder order = detail::randomOrder(first.size(), options.seed);
  const detail::AffineProblem<N> problem(first, second, order);
  detail::LoopResult found = detail::runRobustLoop(problem, options, result.threshold, order);
  static_cast<EstimateSummary&>(result) = std::move(found.summary);
  if (!found.has_model) return result;
  result.model = problem.matrixOf(found.model);
  // The last column is that inside, less the others times the centre.
  constexpr std::size_t kDof = N * (N + 1);
  Mat<double, kDof, kDof> by_delta = Mat<double, kDof, kDof>::identity();
  for (std::size_t r = 0; r < N; ++r) {
    for (std::size_t k = 0; k < N; ++k) {
      by_delta(r * (N + 1) + N, r * (N + 1) + k) = -problem.firstCentre()[k];
    }
  }
  result.covariance = detail::mappedCovariance(by_delta, found.covariance);
  return result;
}

}  // namespace

Affine2DEstimate estimateAffine2D(Span<const Vec2d> first, Span<const Vec2d> second,
                                  const EstimateOptions& options) {
  return estimateAffine<2, Affine2DEstimate>(first, second, kAffine2DThreshold, options);
}

Affine3DEstimate estimateAffine3D(Span<const Vec3d> first, Span<const Vec3d> second,
                                  const EstimateOptions& options) {
  return estimateAffine<3, Affine3DEstimate>(first, second, 0, options);
}

}  // namespace v1
}  // namespace gslam
