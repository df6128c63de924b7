#include "files/bundle_text.h"

#include <cstddef>
#include <numeric>

namespace gslam {
inline namespace v1 {
namespace detail {
namespace {

void expectSize(const char* field, std::size_t size, std::size_t expected, bool may_be_empty) {
  if (size == expected || (may_be_empty && size == 0)) return;
  throw ArgumentError(
      field, "has " + std::to_string(size) + " elements, expected " + std::to_string(expected));
}

void expectIndex(const char* field, std::size_t i, std::uint32_t index, std::size_t size) {
  if (index < size) return;
  throw ArgumentError(field + ("[" + std::to_string(i) + "]"),
                      "is " + std::to_string(index) + ", expected below " + std::to_string(size));
}

void checkBundleArrays(const Bundle& bundle) {
  const std::size_t n = bundle.pixels.size();
  expectSize("observation_pose", bundle.observation_pose.size(), n, false);
  expectSize("observation_point", bundle.observation_point.size(), n, false);
  expectSize("observation_camera", bundle.observation_camera.size(), n, true);
  expectSize("information", bundle.information.size(), n, true);
  expectSize("observation_key", bundle.observation_key.size(), n, true);
  expectSize("T_body_camera", bundle.T_body_camera.size(), bundle.cameras.size(), true);
  expectSize("camera_freedom", bundle.camera_freedom.size(), bundle.cameras.size(), true);
  expectSize("colors", bundle.colors.size(), bundle.points.size(), true);
  expectSize("image_names", bundle.image_names.size(), bundle.T_world_body.size(), true);
  expectSize("pose_fixed", bundle.pose_fixed.size(), bundle.T_world_body.size(), true);
  expectSize("pose_ids", bundle.pose_ids.size(), bundle.T_world_body.size(), true);
  expectSize("point_ids", bundle.point_ids.size(), bundle.points.size(), true);
  expectSize("camera_ids", bundle.camera_ids.size(), bundle.cameras.size(), true);
}

[[noreturn]] void refuseBundle(const std::string& what, const std::string& problem) {
  throw ArgumentError(what, problem);
}

void checkIsPlain(const Bundle& bundle, const char* format) {
  for (std::size_t i = 0; i < bundle.T_body_camera.size(); ++i) {
    if (bundle.T_body_camera[i].isApprox(SE3d(), 0)) continue;
    refuseBundle("T_body_camera[" + std::to_string(i) + "]",
                 std::string("is not the identity: ") + format + " cannot hold a rig");
  }
  for (std::size_t i = 0; i < bundle.information.size(); ++i) {
    const Vec3d& w = bundle.information[i];
    if (w[0] == 1 && w[1] == 0 && w[2] == 1) continue;
    refuseBundle("information[" + std::to_string(i) + "]",
                 std::string("is not 1 0 1: ") + format + " cannot hold weights");
  }
}

}  // namespace

Camera radialCamera(double f, double k1, double k2) {
  return Camera(1, 1, RadtanCamera<double, 4>({f, f, 0, 0, k1, k2, 0, 0}));
}

CameraFreedom radialFreedom() {
  CameraFreedom freedom;
  freedom.parameters = 1U << 0 | 1U << 4 | 1U << 5;  // fx k1 k2
  freedom.keeps_aspect = true;
  return freedom;
}

RadialParameters radialParametersOf(const Camera& camera, std::size_t index, const char* format) {
  const std::string what = "cameras[" + std::to_string(index) + "]";
  const std::string can_hold = std::string(": ") + format + " cameras have f, k1 and k2 alone";
  const std::vector<double> values = camera.parameters();
  const bool is_pinhole = camera.modelName() == "pinhole";
  if (!is_pinhole && (camera.modelName() != "radtan" || values.size() != 8)) {
    const std::string name = camera.isValid() ? camera.modelName() : "no camera";
    refuseBundle(
        what, "is " + name + " with " + std::to_string(values.size()) + " parameters" + can_hold);
  }
  if (values[0] != values[1]) refuseBundle(what, "has two focal lengths, fx and fy" + can_hold);
  RadialParameters result;
  result.f = values[0];
  result.centre = {values[2], values[3]};
  if (is_pinhole) return result;
  if (values[6] != 0 || values[7] != 0) refuseBundle(what, "has p1 and p2 besides" + can_hold);
  result.k1 = values[4];
  result.k2 = values[5];
  return result;
}

std::vector<std::uint32_t> cameraOfEachPose(const Bundle& bundle, const char* format) {
  checkBundleArrays(bundle);
  checkIsPlain(bundle, format);
  const std::size_t poses = bundle.T_world_body.size(), cameras = bundle.cameras.size();
  std::vector<std::uint32_t> camera_of(poses, IdMap::kNone);
  for (std::size_t i = 0; i < bundle.pixels.size(); ++i) {
    const std::uint32_t pose = bundle.observation_pose[i];
    const std::uint32_t camera =
        bundle.observation_camera.empty() ? 0 : bundle.observation_camera[i];
    expectIndex("observation_pose", i, pose, poses);
    expectIndex("observation_point", i, bundle.observation_point[i], bundle.points.size());
    expectIndex("observation_camera", i, camera, cameras);
    if (camera_of[pose] == IdMap::kNone) camera_of[pose] = camera;
    if (camera_of[pose] == camera) continue;
    refuseBundle("observation_camera[" + std::to_string(i) + "]",
                 "is the second camera of pose " + std::to_string(pose) + ": " + format +
                     " cannot hold a rig");
  }
  for (std::size_t i = 0; i < poses; ++i) {
    if (camera_of[i] != IdMap::kNone) continue;
    if (cameras == poses) camera_of[i] = static_cast<std::uint32_t>(i);
    if (cameras == 1) camera_of[i] = 0;
  }
  return camera_of;
}

ObservationGroups::ObservationGroups(const std::vector<std::uint32_t>& group_of, std::size_t groups)
    : begins(groups + 1, 0), order(group_of.size()) {
  for (const std::uint32_t group : group_of) ++begins[group + 1];
  std::partial_sum(begins.begin(), begins.end(), begins.begin());
  std::vector<std::size_t> next = begins;
  for (std::size_t i = 0; i < order.size(); ++i) order[next[group_of[i]]++] = i;
}

void reserveObservations(Bundle& bundle, std::size_t n) {
  bundle.observation_pose.reserve(n);
  bundle.observation_point.reserve(n);
  bundle.observation_camera.reserve(n);
  bundle.pixels.reserve(n);
}

}  // namespace detail
}  // namespace v1
}  // namespace gslam
