// What estimateAbsolutePose() and estimateRigPose() share.
#ifndef GSLAM_ESTIMATOR_ROBUST_POSE_SEARCH_H
#define GSLAM_ESTIMATOR_ROBUST_POSE_SEARCH_H

#include <gslam/base/span.h>
#include <gslam/estimator/estimate.h>
#include <gslam/estimator/options.h>
#include <gslam/geometry/se3.h>

#include <vector>

#include "robust/pose_problem.h"

namespace gslam {
inline namespace v1 {
namespace detail {

// Searches, once all is checked. `estimate.threshold` is set.
void searchPose(std::vector<PoseObservation> observations, Span<const Vec3d> points,
                std::vector<PoseCamera> cameras, const EstimateOptions& options,
                Estimate<SE3d, 6>& estimate);

// The same of pixels: bearings are found here, and those that have none are outliers.
// observations have pixel and camera.
void searchPoseOfPixels(std::vector<PoseObservation> observations, Span<const Vec3d> points,
                        const std::vector<PoseCamera>& cameras, const EstimateOptions& options,
                        Estimate<SE3d, 6>& estimate);

}  // namespace detail
}  // namespace v1
}  // namespace gslam

#endif  // GSLAM_ESTIMATOR_ROBUST_POSE_SEARCH_H
