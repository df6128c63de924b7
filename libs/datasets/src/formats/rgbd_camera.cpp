#include "rgbd_camera.h"

#include <gslam/base/error.h>
#include <gslam/core/detail/field_reader.h>

#include <cmath>
#include <string>
#include <vector>

#include "camera_parameters.h"
#include "sequences.h"

namespace gslam {
inline namespace v1 {
namespace reading {
namespace {

bool isNumberBegin(char c) {
  return (c >= '0' && c <= '9') || c == '-' || c == '+' || c == '.';
}

}  // namespace

Camera cameraOfText(const std::string& text, const std::string& source, int width, int height) {
  detail::FieldReader in(text, source, "fx fy cx cy, and perhaps k1 k2 p1 p2 k3");
  if (!in.nextLine()) throw ParseError(source, 0, 0, "has no camera, expected fx fy cx cy");
  const char* const at = in.place();
  std::string model;
  if (!isNumberBegin(*at)) {
    model = in.word();
    in.skipWord();
  }
  std::vector<double> values;
  while (!in.isLineEnd()) values.push_back(in.number("a parameter of the camera"));
  if (model.empty()) model = values.size() > 4 ? "radtan" : "pinhole";
  try {
    return Camera::fromParameters(model, width, height, values);
  } catch (const ArgumentError& error) {
    in.fail(at, error.what());
  }
}

Camera wantedCamera(const Svar& parameters, const ImageShape& shape, Remarks& remarks) {
  CameraSensor sensor;
  const bool is_wanted = overrideCamera(parameters, sensor, remarks, [&]() { return shape; });
  return is_wanted ? sensor.camera : Camera();
}

CameraSensor depthOf(const CameraSensor& colour, const FileTree& tree, const std::string& file,
                     double units) {
  const ImageShape shape = shapeOfFile(tree, file);
  if (shape.type != PixelType::u16 || shape.channels != 1) {
    throw FileError(tree.nameOf(file), "is no depth image, expected one channel of 16 bits");
  }
  CameraSensor depth = colour;
  depth.name = "depth";
  depth.kind = ImageKind::depth;
  depth.depth_scale = 1 / units;
  const Camera& camera = colour.camera;
  const bool is_same_size =
      !camera.isValid() || (camera.width() == shape.width && camera.height() == shape.height);
  if (!is_same_size) depth.camera = camera.resized(shape.width, shape.height);
  return depth;
}

double depthFactorOf(const Svar& parameters, double usual) {
  const double factor = parameters.get<double>("depth_factor", usual);
  if (factor > 0 && std::isfinite(factor)) return factor;
  throw ArgumentError("depth_factor", "is " + std::to_string(factor) +
                                          ", expected how many units of a pixel make a metre");
}

}  // namespace reading
}  // namespace v1
}  // namespace gslam
