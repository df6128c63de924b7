#ifndef GSLAM_OPTIMIZER_SRC_FILES_BUNDLE_TEXT_H
#define GSLAM_OPTIMIZER_SRC_FILES_BUNDLE_TEXT_H

#include <gslam/optimizer/bundle.h>

#include <cstdint>
#include <string>
#include <vector>

#include "files/text_reader.h"

// What the formats of bundles have in common.

namespace gslam {
inline namespace v1 {
namespace detail {

// Indices are below this.
constexpr std::uint64_t kMostThings = 0xffffffff;

// @{
// BAL's and Bundler's cameras look along -z with y up: they differ from ours by half a turn about
// x, which is exact in quaternions.
inline SE3d poseOfBackwardCamera(const SE3d& T_camera_world) {
  const SE3d turn(SO3d::fromQuaternion(1, 0, 0, 0), Vec3d{});
  return (turn * T_camera_world).inverse();
}
inline SE3d backwardCameraOfPose(const SE3d& T_world_body) {
  const SE3d turn(SO3d::fromQuaternion(1, 0, 0, 0), Vec3d{});
  return turn * T_world_body.inverse();
}
// @}

// f, k1 and k2 of BAL and Bundler; the size of the image is not known.
// @throws ArgumentError when f is not positive
Camera radialCamera(double f, double k1, double k2);
// What of it is free.
CameraFreedom radialFreedom();

// f, k1 and k2 of a camera, and the pixel where x and y begin.
struct RadialParameters {
  double f = 0;
  double k1 = 0;
  double k2 = 0;
  Vec2d centre{};
};
// @param format  its name, for errors
// @throws ArgumentError that says what the format cannot hold
RadialParameters radialParametersOf(const Camera& camera, std::size_t index, const char* format);

// All sizes are those of each other; cameras stand in their bodies, each pose has one camera, all
// pixels have the same weight.
// @return the camera of each pose; IdMap::kNone where a pose sees nothing and any might be its own
// @throws ArgumentError that says what the format cannot hold
std::vector<std::uint32_t> cameraOfEachPose(const Bundle& bundle, const char* format);

// Observations in groups: those of group g are order[begins[g]] ... order[begins[g + 1] - 1], as
// they were.
struct ObservationGroups {
  // @param group_of  of each observation, below groups
  ObservationGroups(const std::vector<std::uint32_t>& group_of, std::size_t groups);

  std::vector<std::size_t> begins;
  std::vector<std::size_t> order;
};

// Room for n observations.
void reserveObservations(Bundle& bundle, std::size_t n);
inline void addObservation(Bundle& bundle, std::uint32_t pose, std::uint32_t point,
                           std::uint32_t camera, const Vec2d& pixel) {
  bundle.observation_pose.push_back(pose);
  bundle.observation_point.push_back(point);
  bundle.observation_camera.push_back(camera);
  bundle.pixels.push_back(pixel);
}

// Whether a pose has only finite numbers: sums of large ones may have none.
inline bool isFinitePose(const SE3d& pose) {
  const Vec3d& t = pose.translation();
  return std::isfinite(t[0]) && std::isfinite(t[1]) && std::isfinite(t[2]);
}

// 0 to 255; white where there are no colours.
inline Vec3d colorOf(const Bundle& bundle, std::size_t point) {
  Vec3d color = {255, 255, 255};
  if (point >= bundle.colors.size()) return color;
  for (std::size_t i = 0; i < 3; ++i) {
    const double value = 255 * static_cast<double>(bundle.colors[point][i]);
    color[i] = value >= 0 ? std::round(std::min(value, 255.0)) : 0;
  }
  return color;
}
inline Vec3f readColor(TextReader& in) {
  Vec3f color{};
  for (std::size_t i = 0; i < 3; ++i) {
    color[i] = static_cast<float>(in.below("a part of a colour", 256)) / 255;
  }
  return color;
}

}  // namespace detail
}  // namespace v1
}  // namespace gslam

#endif  // GSLAM_OPTIMIZER_SRC_FILES_BUNDLE_TEXT_H
