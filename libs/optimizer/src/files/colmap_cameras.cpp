#include "files/colmap_cameras.h"

namespace gslam {
inline namespace v1 {
namespace detail {
namespace {

// Whether COLMAP's model has all of a camera that is free or not 0. FULL_OPENCV has all of radtan
// with 5 coefficients too.
bool holdsCamera(const ColmapModel& model, const std::string& name,
                 const std::vector<double>& values, const CameraFreedom& freedom) {
  const bool is_radtan5 = name == "radtan" && values.size() == 9;
  const std::size_t our_count = is_radtan5 ? 12 : values.size();
  if (model.ours != name || model.our_count != our_count) return false;
  if (model.has_one_focal && (values[0] != values[1] || !freedom.keeps_aspect)) return false;
  const std::size_t known = model.parameters + (model.has_one_focal ? 1 : 0);
  for (std::size_t i = known; i < values.size(); ++i) {
    if (values[i] != 0 || (freedom.parameters >> i & 1U) != 0) return false;
  }
  return true;
}

}  // namespace

const std::vector<ColmapModel>& colmapModels() {
  static const std::vector<ColmapModel> models = {
      {"SIMPLE_PINHOLE", "pinhole", 4, 3, true},
      {"PINHOLE", "pinhole", 4, 4, false},
      {"SIMPLE_RADIAL", "radtan", 8, 4, true},
      {"RADIAL", "radtan", 8, 5, true},
      {"OPENCV", "radtan", 8, 8, false},
      {"FULL_OPENCV", "radtan", 12, 12, false},
      {"SIMPLE_RADIAL_FISHEYE", "kannala_brandt", 8, 4, true},
      {"RADIAL_FISHEYE", "kannala_brandt", 8, 5, true},
      {"OPENCV_FISHEYE", "kannala_brandt", 8, 8, false},
      {"FOV", "fov", 5, 5, false},
  };
  return models;
}

const ColmapModel* colmapModelNamed(std::string_view name) {
  for (const ColmapModel& model : colmapModels()) {
    if (model.name == name) return &model;
  }
  return nullptr;
}

std::string colmapModelNames() {
  std::string names;
  for (const ColmapModel& model : colmapModels()) {
    names += (names.empty() ? "" : ", ") + std::string(model.name);
  }
  return names;
}

Camera cameraOfColmap(const ColmapModel& model, int width, int height,
                      const std::vector<double>& values) {
  std::vector<double> ours(model.our_count, 0.0);
  const std::size_t shift = model.has_one_focal ? 1 : 0;
  for (std::size_t i = 0; i < values.size(); ++i) ours[i + shift] = values[i];
  ours[0] = values[0];
  ours[2] -= 0.5;  // the corner of the first pixel is COLMAP's origin
  ours[3] -= 0.5;
  return Camera::fromParameters(model.ours, width, height, ours);
}

CameraFreedom freedomOfColmap(const ColmapModel& model) {
  CameraFreedom freedom;
  freedom.keeps_aspect = model.has_one_focal;
  const std::size_t known = model.parameters + (model.has_one_focal ? 1 : 0);
  freedom.parameters = (1U << known) - 1;
  freedom.parameters &= ~(1U << 2 | 1U << 3);  // cx cy
  if (model.has_one_focal) freedom.parameters &= ~(1U << 1);
  return freedom;
}

ColmapCamera colmapCameraOf(const Camera& camera, const CameraFreedom& freedom, std::size_t index) {
  std::vector<double> values = camera.parameters();
  for (const ColmapModel& model : colmapModels()) {
    if (!holdsCamera(model, camera.modelName(), values, freedom)) continue;
    values.resize(model.our_count, 0.0);
    ColmapCamera result = {model.name, {}};
    for (std::size_t i = model.has_one_focal ? 1 : 0; result.values.size() < model.parameters;
         ++i) {
      result.values.push_back(i == 2 || i == 3 ? values[i] + 0.5 : values[i]);
    }
    return result;
  }
  const std::string name = camera.isValid() ? camera.modelName() : "no camera";
  throw ArgumentError("cameras[" + std::to_string(index) + "]",
                      "is " + name + " with " + std::to_string(values.size()) +
                          " parameters, and COLMAP has no such model, but " + colmapModelNames());
}

}  // namespace detail
}  // namespace v1
}  // namespace gslam
