// The cameras of a synthetic world.
#include <algorithm>
#include <cmath>
#include <string>

#include "options.h"
#include "pi.h"

namespace gslam {
inline namespace v1 {
namespace detail {
namespace synthetic {
namespace {

// Usual parameters of a model: those of well known calibrations, scaled to the image.
std::vector<double> usualLens(const std::string& model, int width, int height) {
  const double u = (width - 1) / 2.0, v = (height - 1) / 2.0, w = width;
  if (model == "radtan") return {0.61 * w, 0.61 * w, u, v, -0.283, 0.074, 2e-4, 2e-5};
  if (model == "kannala_brandt" || model == "equidistant" || model == "fisheye") {
    return {0.373 * w, 0.373 * w, u, v, 0.0035, 0.0007, -0.002, 0.0002};
  }
  if (model == "fov" || model == "atan") return {0.5 * w, 0.5 * w, u, v, 0.93};
  if (model == "double_sphere") return {0.309 * w, 0.309 * w, u, v, -0.172, 0.593};
  if (model == "eucm") return {0.613 * w, 0.613 * w, u, v, 0.59, 1.127};
  if (model == "ucm") return {0.44 * w, 0.44 * w, u, v, 0.68};
  if (model == "mei") return {1.117 * w, 1.117 * w, u, v, 1.31, -0.12, 0.31, 4e-4, -0.0011};
  if (model == "orthographic") return {0.64 * w, 0.64 * w, u, v};
  if (model == "equirectangular") return {};
  if (model == "ocam") {
    const double s = w / 640;
    return {u,
            v,
            1.002,
            0.0014,
            0.0001,
            -325.9 * s,
            0,
            8.61e-4 / s,
            -3.55e-8 / (s * s),
            6.74e-9 / (s * s * s)};
  }
  return {0.625 * w, 0.625 * w, u, v};
}

Camera cameraOf(const SyntheticOptions& o) {
  return Camera::fromParameters(o.model, o.width, o.height,
                                o.lens.empty() ? usualLens(o.model, o.width, o.height) : o.lens);
}

// Camera axes (right, down, forward) in the body, turned to the left and then down.
SO3d looking(double left, double down) {
  const SO3d straight = SO3d::fromMatrix({{0, 0, 1, -1, 0, 0, 0, -1, 0}});
  return SO3d::exp({{0, 0, left}}) * straight * SO3d::exp({{-down, 0, 0}});
}

}  // namespace

std::vector<CameraSensor> camerasOf(const SyntheticOptions& o, const WorldFacts& world) {
  std::vector<CameraSensor> cameras = o.cameras;
  const ImageKind kind = o.colour ? ImageKind::rgb : ImageKind::grey;
  const auto add = [&](const std::string& name, ImageKind of, double left, const Vec3d& place) {
    CameraSensor sensor;
    sensor.name = name;
    sensor.kind = of;
    sensor.camera = cameraOf(o);
    sensor.T_body_camera = SE3d(looking(left, world.camera_pitch), place);
    cameras.push_back(sensor);
  };
  if (cameras.empty() && o.sensors == "stereo") {
    add("left", kind, 0, {{0, 0, 0}});
    add("right", kind, 0, {{0, -(o.baseline > 0 ? o.baseline : world.baseline), 0}});
  } else if (cameras.empty() && o.sensors == "multi") {
    add("front", kind, 0, {{0.05, 0, 0}});
    add("left", kind, kPi / 2, {{0, 0.05, 0}});
    add("back", kind, kPi, {{-0.05, 0, 0}});
    add("right", kind, -kPi / 2, {{0, -0.05, 0}});
  } else if (cameras.empty()) {
    add("camera", kind, 0, {{0, 0, 0}});
    if (o.sensors == "rgbd") add("depth", ImageKind::depth, 0, {{0, 0, 0}});
  }
  for (CameraSensor& sensor : cameras) {
    sensor.rate = o.rate;
    sensor.depth_scale = sensor.kind != ImageKind::depth ? 0 : o.depth_float ? 1 : world.depth_unit;
  }
  return cameras;
}

float textureDetail(const std::vector<CameraSensor>& cameras) {
  double finest = 1;
  for (const CameraSensor& sensor : cameras) {
    const Vec2d middle = {{(sensor.camera.width() - 1) / 2.0, (sensor.camera.height() - 1) / 2.0}};
    Vec3d bearing{};
    Mat<double, 3, 2> slope{};
    if (!sensor.camera.unproject(middle, bearing, &slope)) continue;
    finest = std::min(finest, std::max(slope.col(0).norm(), slope.col(1).norm()));
  }
  return static_cast<float>(std::min(std::max(400 * finest, 0.6), 16.0));
}

}  // namespace synthetic
}  // namespace detail
}  // namespace v1
}  // namespace gslam
