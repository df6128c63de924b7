#include "robust/pose_search.h"

#include "robust/bearing_frame.h"
#include "robust/input_check.h"
#include "robust/input_rays.h"
#include "robust/robust_loop.h"

namespace gslam {
inline namespace v1 {
namespace detail {

void searchPose(std::vector<PoseObservation> observations, Span<const Vec3d> points,
                std::vector<PoseCamera> cameras, const EstimateOptions& options,
                Estimate<SE3d, 6>& estimate) {
  const double threshold = estimate.threshold;
  const RandomOrder order = randomOrder(points.size(), options.seed);
  const PoseProblem problem(std::move(observations), points, std::move(cameras), order);
  LoopResult found = runRobustLoop(problem, options, threshold, order);
  takeResult(found, estimate);
  if (found.has_model) estimate.model = problem.worldPoseOf(found.model);
  if (found.has_alternative) estimate.alternative = problem.worldPoseOf(found.alternative);
  if (estimate.status != EstimateStatus::NoConsensus) return;
  const Degeneracy degeneracy = problem.degeneracyOfAllPoints();
  if (degeneracy == Degeneracy::None) return;
  estimate.status = EstimateStatus::Degenerate;
  estimate.degeneracy = degeneracy;
  estimate.message = degeneracy == Degeneracy::Coincident ? "all points are at one place"
                                                          : "all points are on one line";
}

void searchPoseOfPixels(std::vector<PoseObservation> observations, Span<const Vec3d> points,
                        const std::vector<PoseCamera>& cameras, const EstimateOptions& options,
                        Estimate<SE3d, 6>& estimate) {
  std::vector<std::uint8_t> is_in(points.size());
  for (std::size_t i = 0; i < points.size(); ++i) {
    PoseObservation& o = observations[i];
    const PoseCamera& camera = cameras[o.camera];
    Mat<double, 3, 2> by_pixel;
    if (!unprojectPixel(*camera.camera, o.pixel, o.bearing, by_pixel)) continue;
    is_in[i] = 1;
    const Mat3d rotation = camera.T_rig_camera.rotation().matrix();
    o.frame = frameOfPixel(by_pixel) * rotation.transpose();
    o.bearing = rotation * o.bearing;
    o.origin = camera.T_rig_camera.translation();
  }
  const Participants participants(is_in, options);
  if (!checkMatches("pixels", participants.size(), "points", participants.size(), 3, estimate)) {
    estimate.message = "fewer than 3 pixels have bearings";
    participants.restore(estimate);
    return;
  }
  if (participants.size() == points.size()) {
    searchPose(std::move(observations), points, cameras, options, estimate);
    return;
  }
  searchPose(participants.pick(Span<const PoseObservation>(observations)),
             participants.pick(points), cameras, participants.options(), estimate);
  participants.restore(estimate);
}

}  // namespace detail
}  // namespace v1
}  // namespace gslam
