#include <gslam/base/error.h>

#include <algorithm>
#include <cmath>

#include "formats.h"

namespace gslam {
inline namespace v1 {
namespace calibration {

namespace {

bool hasOther(const std::vector<double>& values, double than) {
  return std::any_of(values.begin(), values.end(), [&](double v) { return v != than; });
}

}  // namespace

ImageSize sizeOfOptions(const Document& document) {
  const CalibrationOptions& options = document.options;
  if (options.width > 0 && options.height > 0) return {options.width, options.height};
  throw ParseError(document.source, 0, 0,
                   "does not say how large the images are, expected that in "
                   "CalibrationOptions::width and height");
}

ImageSize sizeOf(const Fields& pair) {
  if (pair.size() != 2) {
    pair.fail("has " + std::to_string(pair.size()) + " elements, expected width and height");
  }
  return {pair.at(0).pixels(), pair.at(1).pixels()};
}

Camera makeCamera(const Fields& where, const std::string& model, ImageSize size,
                  const std::vector<double>& parameters) {
  try {
    return Camera::fromParameters(model, size.width, size.height, parameters);
  } catch (const ArgumentError& error) {
    where.fail(std::string("is no camera: ") + error.what());
  }
}

Camera makeCamera(const std::string& source, std::size_t line, const std::string& model,
                  ImageSize size, const std::vector<double>& parameters) {
  try {
    return Camera::fromParameters(model, size.width, size.height, parameters);
  } catch (const ArgumentError& error) {
    throw ParseError(source, line, 0, std::string("is no camera: ") + error.what());
  }
}

CameraSensor makeSensor(const std::string& name, const Camera& camera, const SE3d& T_body_camera,
                        double rate) {
  CameraSensor sensor;
  sensor.name = name;
  sensor.camera = camera;
  sensor.T_body_camera = T_body_camera;
  sensor.rate = rate;
  return sensor;
}

Camera distortedPinhole(const Fields& where, const std::string& distortion, ImageSize size,
                        const std::vector<double>& intrinsics,
                        const std::vector<double>& coefficients) {
  const auto check = [&](std::size_t count) {
    if (coefficients.size() == count) return;
    where.fail("has " + std::to_string(coefficients.size()) + " coefficients, expected " +
               std::to_string(count) + " for the distortion " + distortion);
  };
  const std::vector<double> all = joined(intrinsics, coefficients);
  if (distortion == "radtan" || distortion == "radial-tangential" || distortion == "plumb_bob") {
    if (coefficients.size() != 5) check(4);
    return radtanOrPinhole(where, size, intrinsics, coefficients);
  }
  if (distortion == "equidistant" || distortion == "fisheye") {
    check(4);
    return makeCamera(where, "kannala_brandt", size, all);
  }
  if (distortion == "fov") {
    check(1);
    return makeCamera(where, "fov", size, all);
  }
  if (distortion == "none" || distortion.empty()) {
    if (hasOther(coefficients, 0)) {
      where.fail("has distortion coefficients, but the distortion is none");
    }
    return makeCamera(where, "pinhole", size, intrinsics);
  }
  where.fail("has the distortion '" + distortion +
             "', expected radtan, radial-tangential, plumb_bob, equidistant, fisheye, fov or none");
}

Camera radtanOrPinhole(const Fields& where, ImageSize size, const std::vector<double>& intrinsics,
                       const std::vector<double>& coefficients) {
  if (!hasOther(coefficients, 0)) return makeCamera(where, "pinhole", size, intrinsics);
  return makeCamera(where, "radtan", size, joined(intrinsics, coefficients));
}

Camera radtanOrPinhole(const std::string& source, std::size_t line, ImageSize size,
                       const std::vector<double>& parameters) {
  const std::vector<double> intrinsics(parameters.begin(), parameters.begin() + 4);
  const std::vector<double> coefficients(parameters.begin() + 4, parameters.end());
  if (!hasOther(coefficients, 0)) return makeCamera(source, line, "pinhole", size, intrinsics);
  return makeCamera(source, line, "radtan", size, parameters);
}

SE3d placeOfRight(const SO3d& R_rectified_left, const SO3d& R_rectified_right, double baseline) {
  const SO3d R_left_rectified = R_rectified_left.inverse();
  return SE3d(R_left_rectified * R_rectified_right, R_left_rectified * Vec3d{{baseline, 0, 0}});
}

std::vector<double> intrinsicsOfMatrix(const Fields& matrix) {
  const std::vector<double> k = matrix.numbers(9);
  if (k[3] != 0 || k[6] != 0 || k[7] != 0 || k[8] != 1) {
    matrix.fail("is no camera matrix, expected fx 0 cx  0 fy cy  0 0 1");
  }
  if (k[1] != 0) matrix.fail("has skew, expected 0 in the first row's second column");
  return {k[0], k[4], k[2], k[5]};
}

std::vector<double> membersOf(const Fields& object, const std::vector<std::string>& names) {
  std::vector<double> values;
  for (const std::string& name : names) values.push_back(object[name].number());
  return values;
}

double noiseOf(const Fields& density, Calibration& result) {
  const std::vector<double> values = density.numbers();
  if (values.size() != 1 && values.size() != 3) density.numbers(3);
  const auto ends = std::minmax_element(values.begin(), values.end());
  if (*ends.first < 0) density.fail("is negative, expected 0 or more");
  if (*ends.first != *ends.second) {
    result.remarks.push_back(density.path() + " differs between axes: the largest was taken");
  }
  return *ends.second;
}

CameraSensor depthOf(const CameraSensor& colour, const Fields& factor) {
  const double per_metre = factor.number();
  if (!(per_metre > 0)) factor.fail("is not positive, expected numbers a metre");
  CameraSensor depth = colour;
  depth.name = "depth";
  depth.kind = ImageKind::depth;
  depth.depth_scale = 1 / per_metre;
  return depth;
}

std::vector<double> joined(std::vector<double> a, const std::vector<double>& b) {
  a.insert(a.end(), b.begin(), b.end());
  return a;
}

std::int64_t nanosecondsOf(const Fields& seconds) {
  const double value = seconds.number();
  if (!(std::fabs(value) < 9e9)) seconds.fail("is more than 64 bits of nanoseconds hold");
  return static_cast<std::int64_t>(std::llround(value * 1e9));
}

}  // namespace calibration
}  // namespace v1
}  // namespace gslam
