#include <gslam/estimator/estimate_relative_pose.h>

#include "robust/covariance_map.h"
#include "robust/essential_problem.h"
#include "robust/relative_pose_search.h"

namespace gslam {
inline namespace v1 {
namespace {

using detail::EssentialProblem;

RelativePoseEstimate relativePoseEstimate(detail::LoopResult found) {
  RelativePoseEstimate estimate;
  static_cast<EstimateSummary&>(estimate) = std::move(found.summary);
  if (!found.has_model) return estimate;
  estimate.model = EssentialProblem::poseOf(found.model);
  estimate.covariance =
      detail::mappedCovariance(EssentialProblem::tangentByDelta(found.model), found.covariance);
  if (found.has_alternative) estimate.alternative = EssentialProblem::poseOf(found.alternative);
  return estimate;
}

}  // namespace

RelativePoseEstimate estimateRelativePose(Span<const Vec3d> first, Span<const Vec3d> second,
                                          const EstimateOptions& options) {
  return relativePoseEstimate(detail::searchRelativePose(first, second, options));
}

RelativePoseEstimate estimateRelativePose(Span<const Vec2d> first, Span<const Vec2d> second,
                                          const Camera& first_camera, const Camera& second_camera,
                                          const EstimateOptions& options) {
  return relativePoseEstimate(
      detail::searchRelativePose(first, second, first_camera, second_camera, options));
}

}  // namespace v1
}  // namespace gslam
