#include <gslam/estimator/estimate_homography.h>

#include <algorithm>
#include <utility>
#include <vector>

#include "robust/estimate_points.h"
#include "robust/homography_problem.h"

namespace gslam {
inline namespace v1 {
namespace {

// One match, zeros where a camera sees nothing: it has no depth then, and is no inlier.
detail::BearingHomographyProblem::Match matchOf(const Vec2d& first, const Vec2d& second,
                                                const Camera& first_camera,
                                                const Camera& second_camera) {
  detail::BearingHomographyProblem::Match match{};
  Vec2d pixel;
  if (!first_camera.unproject(first, match.first) ||
      !second_camera.unproject(second, match.second) ||
      !second_camera.project(match.second, pixel, &match.by_point)) {
    return {};
  }
  return match;
}

bool requireCamera(const char* name, const Camera& camera, EstimateSummary& summary) {
  return camera.isValid() || detail::refuseInput(std::string(name) + " is none", summary);
}

}  // namespace

HomographyEstimate estimateHomography(Span<const Vec2d> first, Span<const Vec2d> second,
                                      const EstimateOptions& options) {
  HomographyEstimate result;
  if (!detail::checkPairs(first, second, 4, kHomographyThreshold, options, result)) return result;
  const Degeneracy shape1 = detail::shapeOfAll(first), shape2 = detail::shapeOfAll(second);
  if (shape1 != Degeneracy::None) return detail::refuseShape("first", shape1, result), result;
  if (shape2 != Degeneracy::None) return detail::refuseShape("second", shape2, result), result;

  const detail::RandomOrder order = detail::randomOrder(first.size(), options.seed);
  const detail::PlaneHomographyProblem problem(first, second, order);
  detail::LoopResult found = detail::runRobustLoop(problem, options, result.threshold, order);
  static_cast<EstimateSummary&>(result) = std::move(found.summary);
  if (!found.has_model) return result;
  Mat<double, 9, 8> by_delta;
  result.model = problem.matrixOf(found.model, &by_delta);
  result.covariance = detail::mappedCovariance(by_delta, found.covariance);
  return result;
}

HomographyEstimate estimateHomography(Span<const Vec2d> first, Span<const Vec2d> second,
                                      const Camera& first_camera, const Camera& second_camera,
                                      const EstimateOptions& options) {
  HomographyEstimate result;
  if (!detail::checkPairs(first, second, 4, kHomographyThreshold, options, result) ||
      !requireCamera("first_camera", first_camera, result) ||
      !requireCamera("second_camera", second_camera, result)) {
    return result;
  }
  const Degeneracy shape1 = detail::shapeOfAll(first), shape2 = detail::shapeOfAll(second);
  if (shape1 == Degeneracy::Coincident) return detail::refuseShape("first", shape1, result), result;
  if (shape2 == Degeneracy::Coincident) {
    return detail::refuseShape("second", shape2, result), result;
  }

  const detail::RandomOrder order = detail::randomOrder(first.size(), options.seed);
  std::vector<detail::BearingHomographyProblem::Match> matches;
  matches.reserve(order.size());
  for (const std::uint32_t i : order) {
    matches.push_back(matchOf(first[i], second[i], first_camera, second_camera));
  }
  const Vec2d image = {{double(second_camera.width()), double(second_camera.height())}};
  const detail::BearingHomographyProblem problem(std::move(matches), image);
  detail::LoopResult found = detail::runRobustLoop(problem, options, result.threshold, order);
  static_cast<EstimateSummary&>(result) = std::move(found.summary);
  if (!found.has_model) return result;
  std::copy(found.model.begin(), found.model.begin() + 9, result.model.values);
  result.covariance =
      detail::mappedCovariance(detail::sphereTangents(found.model.data()), found.covariance);
  return result;
}

}  // namespace v1
}  // namespace gslam
