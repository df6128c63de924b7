#include <gslam/estimator/estimate_essential.h>

#include <algorithm>

#include "robust/covariance_map.h"
#include "robust/essential_problem.h"
#include "robust/relative_pose_search.h"

namespace gslam {
inline namespace v1 {
namespace {

Mat3d matrixOf(const detail::ModelNumbers& model) {
  Mat3d e;
  std::copy(model.begin(), model.begin() + 9, e.values);
  return e;
}

EssentialEstimate essentialEstimate(detail::LoopResult found) {
  EssentialEstimate estimate;
  static_cast<EstimateSummary&>(estimate) = std::move(found.summary);
  if (!found.has_model) return estimate;
  estimate.model = matrixOf(found.model);
  estimate.covariance = detail::mappedCovariance(
      detail::EssentialProblem::matrixByDelta(found.model), found.covariance);
  if (found.has_alternative) estimate.alternative = matrixOf(found.alternative);
  return estimate;
}

}  // namespace

EssentialEstimate estimateEssential(Span<const Vec3d> first, Span<const Vec3d> second,
                                    const EstimateOptions& options) {
  return essentialEstimate(detail::searchRelativePose(first, second, options));
}

EssentialEstimate estimateEssential(Span<const Vec2d> first, Span<const Vec2d> second,
                                    const Camera& first_camera, const Camera& second_camera,
                                    const EstimateOptions& options) {
  return essentialEstimate(
      detail::searchRelativePose(first, second, first_camera, second_camera, options));
}

}  // namespace v1
}  // namespace gslam
