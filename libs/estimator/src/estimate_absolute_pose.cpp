#include <gslam/estimator/estimate_absolute_pose.h>

#include <vector>

#include "robust/bearing_frame.h"
#include "robust/input_check.h"
#include "robust/input_rays.h"
#include "robust/pose_search.h"

namespace gslam {
inline namespace v1 {

AbsolutePoseEstimate estimateAbsolutePose(Span<const Vec3d> bearings, Span<const Vec3d> points,
                                          const EstimateOptions& options) {
  using namespace detail;  // NOLINT(google-build-using-namespace)
  AbsolutePoseEstimate estimate;
  std::vector<Vec3d> unit;
  if (!checkMatches("bearings", bearings.size(), "points", points.size(), 3, estimate) ||
      !checkFinite("bearings", bearings, estimate) || !checkFinite("points", points, estimate) ||
      !checkOptions(options, points.size(), kAbsolutePoseRadianThreshold, estimate) ||
      !normalise("bearings", bearings, unit, estimate)) {
    return estimate;
  }
  std::vector<PoseObservation> observations(points.size());
  for (std::size_t i = 0; i < points.size(); ++i) {
    observations[i].bearing = unit[i];
    observations[i].frame = frameOfBearing(unit[i]);
  }
  searchPose(std::move(observations), points, {}, options, estimate);
  return estimate;
}

AbsolutePoseEstimate estimateAbsolutePose(Span<const Vec2d> pixels, const Camera& camera,
                                          Span<const Vec3d> points,
                                          const EstimateOptions& options) {
  using namespace detail;  // NOLINT(google-build-using-namespace)
  AbsolutePoseEstimate estimate;
  if (!checkMatches("pixels", pixels.size(), "points", points.size(), 3, estimate) ||
      !checkFinite("pixels", pixels, estimate) || !checkFinite("points", points, estimate) ||
      !checkCamera("camera", camera, estimate) ||
      !checkOptions(options, points.size(), kAbsolutePosePixelThreshold, estimate)) {
    return estimate;
  }
  std::vector<PoseObservation> observations(points.size());
  for (std::size_t i = 0; i < points.size(); ++i) observations[i].pixel = pixels[i];
  searchPoseOfPixels(std::move(observations), points, {{&camera, SE3d(), SE3d()}}, options,
                     estimate);
  return estimate;
}

}  // namespace v1
}  // namespace gslam
