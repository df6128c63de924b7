#include "camera.h"

#include <gslam/base/error.h>

#include <algorithm>
#include <cmath>
#include <vector>

namespace gslam {
inline namespace v1 {
namespace ros {
namespace {

// The coefficients without the zeros at their end, which D often has; `counts` are those that the
// model may have.
std::vector<double> coefficients(const std::vector<double>& d, std::initializer_list<int> counts,
                                 const CameraInfo& info, const std::string& name) {
  std::size_t used = d.size();
  while (used > 0 && d[used - 1] == 0) --used;
  for (const int count : counts) {
    if (std::size_t(count) < used) continue;
    std::vector<double> values(d.begin(), d.begin() + std::ptrdiff_t(used));
    values.resize(std::size_t(count));
    return values;
  }
  throw ParseError(name, 0, 0,
                   "the distortion model '" + info.distortion_model + "' has " +
                       std::to_string(d.size()) + " coefficients, which are too many");
}

Camera makeCamera(const char* model, const CameraInfo& info, const std::vector<double>& focal,
                  const std::vector<double>& distortion, const std::string& name) {
  std::vector<double> values = focal;
  values.insert(values.end(), distortion.begin(), distortion.end());
  constexpr std::uint32_t kMost = 1U << 20;
  if (info.width == 0 || info.height == 0 || info.width > kMost || info.height > kMost) {
    throw ParseError(name, 0, 0,
                     "the calibration is of " + std::to_string(info.width) + " x " +
                         std::to_string(info.height) + " pixels");
  }
  try {
    return Camera::fromParameters(model, int(info.width), int(info.height), values);
  } catch (const ArgumentError& error) {
    throw ParseError(name, 0, 0, std::string("the calibration makes no camera: ") + error.what());
  }
}

Camera fullCamera(const CameraInfo& info, const std::string& name) {
  const std::vector<double> focal = {info.k[0], info.k[4], info.k[2], info.k[5]};
  const std::string& model = info.distortion_model;
  const bool is_straight =
      std::all_of(info.d.begin(), info.d.end(), [](double value) { return value == 0; });
  if (model == "equidistant" || model == "fisheye" || model == "kannala_brandt") {
    return makeCamera("kannala_brandt", info, focal, coefficients(info.d, {4}, info, name), name);
  }
  if (is_straight) return makeCamera("pinhole", info, focal, {}, name);
  if (model == "plumb_bob" || model == "radtan" || model == "radial-tangential") {
    return makeCamera("radtan", info, focal, coefficients(info.d, {4, 5}, info, name), name);
  }
  if (model == "rational_polynomial") {
    const auto values = coefficients(info.d, {4, 5, 8, 12, 14}, info, name);
    return makeCamera("radtan", info, focal, values, name);
  }
  throw ParseError(name, 0, 0,
                   "the distortion model is '" + model.substr(0, 60) +
                       "', expected plumb_bob, rational_polynomial or equidistant");
}

// What is recorded of the full image: a part of it, with pixels put together.
Camera recordedCamera(Camera camera, const CameraInfo& info) {
  const bool has_region = info.roi_width > 0 || info.roi_height > 0;
  if (has_region) {
    camera =
        camera.cropped(int(info.roi_x), int(info.roi_y), int(info.roi_width), int(info.roi_height));
  }
  const int x = std::max(1, int(info.binning_x)), y = std::max(1, int(info.binning_y));
  if (x > 1 || y > 1) {
    // Pixels at the right and the bottom that fill no binned one are left out.
    const int width = std::max(1, camera.width() / x), height = std::max(1, camera.height() / y);
    camera = camera.cropped(0, 0, std::min(camera.width(), x * width),
                            std::min(camera.height(), y * height));
    camera = camera.resized(width, height);
  }
  return camera;
}

}  // namespace

Camera cameraOf(const CameraInfo& info, bool is_rectified, const std::string& name) {
  const auto is_zero = [](double value) { return value == 0; };
  if (std::all_of(info.k.begin(), info.k.end(), is_zero)) return Camera();
  constexpr std::uint32_t kMost = 1U << 20;
  for (const std::uint32_t value :
       {info.roi_x, info.roi_y, info.roi_width, info.roi_height, info.binning_x, info.binning_y}) {
    if (value > kMost) {
      throw ParseError(name, 0, 0,
                       "binning or region of the calibration is " + std::to_string(value) +
                           ", larger than any image");
    }
  }
  if ((info.roi_width == 0) != (info.roi_height == 0)) {
    throw ParseError(name, 0, 0,
                     "the region of the calibration has " + std::to_string(info.roi_width) + " x " +
                         std::to_string(info.roi_height) + " pixels");
  }
  const bool has_p = is_rectified && info.p[0] != 0;
  const Camera full =
      has_p ? makeCamera("pinhole", info, {info.p[0], info.p[5], info.p[2], info.p[6]}, {}, name)
            : fullCamera(info, name);
  return recordedCamera(full, info);
}

Vec3d offsetOf(const CameraInfo& info) noexcept {
  const double x = info.p[0] != 0 ? -info.p[3] / info.p[0] : 0;
  const double y = info.p[5] != 0 ? -info.p[7] / info.p[5] : 0;
  if (!std::isfinite(x) || !std::isfinite(y)) return {0, 0, 0};
  return {x, y, 0};
}

}  // namespace ros
}  // namespace v1
}  // namespace gslam
