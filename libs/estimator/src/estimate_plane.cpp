#include <gslam/estimator/estimate_plane.h>

#include <utility>

#include "robust/estimate_points.h"
#include "robust/plane_problem.h"

namespace gslam {
inline namespace v1 {

PlaneEstimate estimatePlane(Span<const Vec3d> points, const EstimateOptions& options) {
  PlaneEstimate result;
  if (!detail::checkMatches("points", points.size(), "points", points.size(), 3, result) ||
      !detail::checkFinite("points", points, result) ||
      !detail::checkOptions(options, points.size(), 0, result)) {
    return result;
  }
  const Degeneracy shape = detail::shapeOfAll(points);
  if (shape == Degeneracy::Collinear || shape == Degeneracy::Coincident) {
    return detail::refuseShape("points", shape, result), result;
  }
  const detail::RandomOrder order = detail::randomOrder(points.size(), options.seed);
  const detail::PlaneProblem problem(points, order);
  detail::LoopResult found = detail::runRobustLoop(problem, options, result.threshold, order);
  static_cast<EstimateSummary&>(result) = std::move(found.summary);
  if (!found.has_model) return result;
  Mat<double, 4, 3> by_delta;
  const Vec4d plane = problem.planeOf(found.model, &by_delta);
  result.model = plane[3] < 0 ? -1.0 * plane : plane;
  result.covariance = detail::mappedCovariance(by_delta, found.covariance);
  return result;
}

}  // namespace v1
}  // namespace gslam
