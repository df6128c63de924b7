// What estimateRelativePose() and estimateEssential() share.
#ifndef GSLAM_ESTIMATOR_ROBUST_RELATIVE_POSE_SEARCH_H
#define GSLAM_ESTIMATOR_ROBUST_RELATIVE_POSE_SEARCH_H

#include <gslam/base/span.h>
#include <gslam/estimator/options.h>
#include <gslam/geometry/camera.h>
#include <gslam/geometry/vec.h>

#include "robust/robust_loop.h"

namespace gslam {
inline namespace v1 {
namespace detail {

// Checks, searches; models are EssentialProblem's.
LoopResult searchRelativePose(Span<const Vec3d> first, Span<const Vec3d> second,
                              const EstimateOptions& options);
LoopResult searchRelativePose(Span<const Vec2d> first, Span<const Vec2d> second,
                              const Camera& first_camera, const Camera& second_camera,
                              const EstimateOptions& options);

}  // namespace detail
}  // namespace v1
}  // namespace gslam

#endif  // GSLAM_ESTIMATOR_ROBUST_RELATIVE_POSE_SEARCH_H
