// From names and values to camera models, with words for what is wrong.
#ifndef GSLAM_GEOMETRY_DETAIL_CAMERA_BUILD_H
#define GSLAM_GEOMETRY_DETAIL_CAMERA_BUILD_H

#include <gslam/base/error.h>
#include <gslam/geometry/detail/camera_math.h>
#include <gslam/geometry/detail/camera_models.h>

#include <cmath>
#include <cstddef>
#include <limits>
#include <map>
#include <string>
#include <vector>

namespace gslam {
inline namespace v1 {
namespace detail {

inline std::vector<std::string> cameraModelNames() {
  std::vector<std::string> names;
  for (std::size_t i = 0; i < CameraModels::size(); ++i) {
    const std::string name = cameraModelFacts()[i].name;
    if (names.empty() || names.back() != name) names.push_back(name);  // radtan has several
  }
  return names;
}

inline std::string joined(const std::vector<std::string>& words, const char* between) {
  std::string text;
  for (const std::string& word : words) text += (text.empty() ? "" : between) + word;
  return text;
}

// All models of a name, plainest first.
inline std::vector<const CameraModelFacts*> cameraModelsNamed(const std::string& name) {
  std::string canonical = name;
  if (name == "equidistant" || name == "fisheye") canonical = "kannala_brandt";
  if (name == "atan") canonical = "fov";
  std::vector<const CameraModelFacts*> found;
  for (std::size_t i = 0; i < CameraModels::size(); ++i) {
    if (cameraModelFacts()[i].name == canonical) found.push_back(&cameraModelFacts()[i]);
  }
  if (!found.empty()) return found;
  throw ArgumentError("model",
                      "is \"" + name + "\", expected one of " + joined(cameraModelNames(), ", "));
}

inline std::string parameterNamesOf(const CameraModelFacts& facts) {
  std::vector<std::string> names;
  for (std::size_t i = 0; i < facts.parameter_count; ++i) names.push_back(facts.parameter_name(i));
  return joined(names, " ");
}

// The model of this name with this number of parameters.
inline const CameraModelFacts& cameraModelOf(const std::string& name, std::size_t count) {
  const std::vector<const CameraModelFacts*> models = cameraModelsNamed(name);
  std::vector<std::string> counts;
  for (const CameraModelFacts* model : models) {
    if (model->parameter_count == count) return *model;
    counts.push_back(std::to_string(model->parameter_count));
  }
  throw ArgumentError("values", "are " + std::to_string(count) + " numbers, expected " +
                                    joined(counts, " or ") + " for " + name + ": " +
                                    parameterNamesOf(*models.back()));
}

// The values in the order of the model that has as many parameters, each under its name.
inline std::vector<double> orderedCameraValues(const std::string& model,
                                               const std::map<std::string, double>& values) {
  std::vector<double> ordered;
  if (model == "equirectangular" && values.empty()) return ordered;
  const CameraModelFacts& facts = cameraModelOf(model, values.size());
  for (std::size_t i = 0; i < facts.parameter_count; ++i) {
    const auto found = values.find(facts.parameter_name(i));
    if (found == values.end()) {
      throw ArgumentError(facts.parameter_name(i),
                          "is missing, expected " + model + ": " + parameterNamesOf(facts));
    }
    ordered.push_back(found->second);
  }
  return ordered;
}

inline std::size_t cameraParameterIndex(const std::vector<std::string>& names,
                                        const std::string& model, const std::string& name) {
  for (std::size_t i = 0; i < names.size(); ++i) {
    if (names[i] == name) return i;
  }
  throw ArgumentError("name", "is \"" + name + "\", expected a parameter of " +
                                  (model.empty() ? "a camera, but this is none" : model) + ": " +
                                  joined(names, " "));
}

inline void checkCameraBatch(const char* name, std::size_t size, std::size_t expected) {
  if (size == expected) return;
  throw ArgumentError(name, "has " + std::to_string(size) + " elements, expected " +
                                std::to_string(expected) + ", one for each that is given");
}

inline int scaledCameraSize(int size, double factor) {
  checkParameter(factor > 0 && factor <= 1e9, "factor", factor, "a positive number");
  const double scaled = std::round(size * factor);
  checkParameter(scaled >= 1 && scaled <= std::numeric_limits<int>::max(), "factor", factor,
                 "one that leaves an image");
  return static_cast<int>(scaled);
}

}  // namespace detail
}  // namespace v1
}  // namespace gslam

#endif  // GSLAM_GEOMETRY_DETAIL_CAMERA_BUILD_H
