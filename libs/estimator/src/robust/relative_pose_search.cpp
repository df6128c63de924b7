#include "robust/relative_pose_search.h"

#include <gslam/estimator/estimate_relative_pose.h>

#include <vector>

#include "robust/essential_problem.h"
#include "robust/input_check.h"
#include "robust/input_rays.h"

namespace gslam {
inline namespace v1 {
namespace detail {
namespace {

LoopResult search(const EpipolarMatches& matches, const RandomOrder& order,
                  const EstimateOptions& options, double threshold) {
  return runRobustLoop(EssentialProblem(matches, threshold), options, threshold, order);
}

// The matches that have bearings in both views.
struct Rays {
  std::vector<std::uint8_t> is_in;
  std::vector<Vec3d> first, second;
  std::vector<Mat<double, 3, 2>> first_by_pixel, second_by_pixel;
};

Rays unprojectMatches(Span<const Vec2d> first, Span<const Vec2d> second, const Camera& first_camera,
                      const Camera& second_camera) {
  Rays rays;
  rays.is_in.assign(first.size(), 0);
  for (std::size_t i = 0; i < first.size(); ++i) {
    Vec3d a, b;
    Mat<double, 3, 2> a_by_pixel, b_by_pixel;
    if (!unprojectPixel(first_camera, first[i], a, a_by_pixel) ||
        !unprojectPixel(second_camera, second[i], b, b_by_pixel)) {
      continue;
    }
    rays.is_in[i] = 1;
    rays.first.push_back(a);
    rays.second.push_back(b);
    rays.first_by_pixel.push_back(a_by_pixel);
    rays.second_by_pixel.push_back(b_by_pixel);
  }
  return rays;
}

}  // namespace

LoopResult searchRelativePose(Span<const Vec3d> first, Span<const Vec3d> second,
                              const EstimateOptions& options) {
  LoopResult result;
  std::vector<Vec3d> a, b;
  if (!checkMatches("first", first.size(), "second", second.size(), 5, result.summary) ||
      !checkFinite("first", first, result.summary) ||
      !checkFinite("second", second, result.summary) ||
      !checkOptions(options, first.size(), kRelativePoseRadianThreshold, result.summary) ||
      !normalise("first", first, a, result.summary) ||
      !normalise("second", second, b, result.summary)) {
    return result;
  }
  const RandomOrder order = randomOrder(first.size(), options.seed);
  return search(EpipolarMatches::fromBearings(a, b, order), order, options,
                result.summary.threshold);
}

LoopResult searchRelativePose(Span<const Vec2d> first, Span<const Vec2d> second,
                              const Camera& first_camera, const Camera& second_camera,
                              const EstimateOptions& options) {
  LoopResult result;
  if (!checkMatches("first", first.size(), "second", second.size(), 5, result.summary) ||
      !checkFinite("first", first, result.summary) ||
      !checkFinite("second", second, result.summary) ||
      !checkCamera("first_camera", first_camera, result.summary) ||
      !checkCamera("second_camera", second_camera, result.summary) ||
      !checkOptions(options, first.size(), kRelativePosePixelThreshold, result.summary)) {
    return result;
  }
  const double threshold = result.summary.threshold;
  if (first_camera.modelName() == "pinhole" && second_camera.modelName() == "pinhole") {
    const RandomOrder order = randomOrder(first.size(), options.seed);
    return search(EpipolarMatches::fromPinholes(first, second, first_camera, second_camera, order),
                  order, options, threshold);
  }
  const Rays rays = unprojectMatches(first, second, first_camera, second_camera);
  const Participants participants(rays.is_in, options);
  if (!checkMatches("first", participants.size(), "second", participants.size(), 5,
                    result.summary)) {
    result.summary.message = "fewer than 5 matches have bearings in both views";
    participants.restore(result.summary);
    return result;
  }
  const RandomOrder order = randomOrder(participants.size(), options.seed);
  result = search(EpipolarMatches::fromFrames(rays.first, rays.second, rays.first_by_pixel,
                                              rays.second_by_pixel, order),
                  order, participants.options(), threshold);
  participants.restore(result.summary);
  return result;
}

}  // namespace detail
}  // namespace v1
}  // namespace gslam
