#include <gslam/estimator/estimate_rig_pose.h>

#include <string>
#include <vector>

#include "robust/bearing_frame.h"
#include "robust/input_check.h"
#include "robust/input_rays.h"
#include "robust/pose_search.h"

namespace gslam {
inline namespace v1 {
namespace {

bool checkRig(Span<const RigCamera> cameras, Span<const std::uint32_t> camera_of_point,
              EstimateSummary& summary) {
  for (std::size_t c = 0; c < cameras.size(); ++c) {
    const std::string name = "cameras[" + std::to_string(c) + "]";
    if (!detail::checkCamera(name.c_str(), cameras[c].camera, summary)) return false;
  }
  for (std::size_t i = 0; i < camera_of_point.size(); ++i) {
    if (camera_of_point[i] < cameras.size()) continue;
    return detail::refuseInput("camera_of_point[" + std::to_string(i) + "] is " +
                                   std::to_string(camera_of_point[i]) + ", but there are " +
                                   std::to_string(cameras.size()) + " cameras",
                               summary);
  }
  return true;
}

}  // namespace

RigPoseEstimate estimateRigPose(Span<const Vec3d> origins, Span<const Vec3d> bearings,
                                Span<const Vec3d> points, const EstimateOptions& options) {
  using namespace detail;  // NOLINT(google-build-using-namespace)
  RigPoseEstimate estimate;
  std::vector<Vec3d> unit;
  if (!checkMatches("bearings", bearings.size(), "points", points.size(), 3, estimate) ||
      !checkMatches("bearings", bearings.size(), "origins", origins.size(), 3, estimate) ||
      !checkFinite("origins", origins, estimate) || !checkFinite("bearings", bearings, estimate) ||
      !checkFinite("points", points, estimate) ||
      !checkOptions(options, points.size(), kAbsolutePoseRadianThreshold, estimate) ||
      !normalise("bearings", bearings, unit, estimate)) {
    return estimate;
  }
  std::vector<PoseObservation> observations(points.size());
  for (std::size_t i = 0; i < points.size(); ++i) {
    observations[i].origin = origins[i];
    observations[i].bearing = unit[i];
    observations[i].frame = frameOfBearing(unit[i]);
  }
  searchPose(std::move(observations), points, {}, options, estimate);
  return estimate;
}

RigPoseEstimate estimateRigPose(Span<const RigCamera> cameras,
                                Span<const std::uint32_t> camera_of_point, Span<const Vec2d> pixels,
                                Span<const Vec3d> points, const EstimateOptions& options) {
  using namespace detail;  // NOLINT(google-build-using-namespace)
  RigPoseEstimate estimate;
  if (!checkMatches("pixels", pixels.size(), "points", points.size(), 3, estimate) ||
      !checkMatches("pixels", pixels.size(), "camera_of_point", camera_of_point.size(), 3,
                    estimate) ||
      !checkFinite("pixels", pixels, estimate) || !checkFinite("points", points, estimate) ||
      !checkRig(cameras, camera_of_point, estimate) ||
      !checkOptions(options, points.size(), kAbsolutePosePixelThreshold, estimate)) {
    return estimate;
  }
  std::vector<PoseCamera> rig;
  for (const RigCamera& c : cameras) {
    rig.push_back({&c.camera, c.T_rig_camera, c.T_rig_camera.inverse()});
  }
  std::vector<PoseObservation> observations(points.size());
  for (std::size_t i = 0; i < points.size(); ++i) {
    observations[i].pixel = pixels[i];
    observations[i].camera = camera_of_point[i];
  }
  searchPoseOfPixels(std::move(observations), points, rig, options, estimate);
  return estimate;
}

}  // namespace v1
}  // namespace gslam
