// sensor.yaml of the ASL layout, of cameras and inertial units.
//
// M. Burri et al., "The EuRoC micro aerial vehicle datasets", IJRR 35(10), 2016; the files
// themselves. T_BS takes coordinates of the sensor to those of the body.
#include "formats.h"

namespace gslam {
inline namespace v1 {
namespace calibration {
namespace {

void readEurocCamera(const Fields& root, Calibration& result) {
  const std::string model = root.has("camera_model") ? root["camera_model"].text() : "pinhole";
  if (model != "pinhole") root["camera_model"].fail("is '" + model + "', expected pinhole");
  const ImageSize size = sizeOf(root["resolution"]);
  const std::string distortion =
      root.has("distortion_model") ? root["distortion_model"].text() : "none";
  const std::vector<double> coefficients = root.has("distortion_coefficients")
                                               ? root["distortion_coefficients"].numbers()
                                               : std::vector<double>();
  const Camera camera =
      distortedPinhole(root, distortion, size, root["intrinsics"].numbers(4), coefficients);
  const double rate = root.number("rate_hz", 0);
  result.rig.cameras.push_back(makeSensor("camera", camera, root["T_BS"].pose(), rate));
}

void readEurocImu(const Fields& root, Calibration& result) {
  result.rig.has_imu = true;
  ImuCalibration& imu = result.rig.imu;
  imu.T_body_imu = root["T_BS"].pose();
  imu.rate = root.number("rate_hz", 0);
  const auto noise = [&](const char* name) {
    if (root.has(name)) return noiseOf(root[name], result);
    result.remarks.push_back(std::string(name) + " is not in this file");
    return 0.0;
  };
  imu.gyro_noise = noise("gyroscope_noise_density");
  imu.gyro_bias_walk = noise("gyroscope_random_walk");
  imu.accel_noise = noise("accelerometer_noise_density");
  imu.accel_bias_walk = noise("accelerometer_random_walk");
}

}  // namespace

bool isEuroc(const Document& document) {
  return document.root.hasAnyOf({"sensor_type", "T_BS"});
}

Calibration parseEuroc(const Document& document) {
  const Fields& root = document.root;
  Calibration result;
  result.body = "the body of T_BS";
  const std::string type = root["sensor_type"].text();
  if (root.number("rate_hz", 0) < 0) root["rate_hz"].fail("is negative, expected 0 or more");
  if (type == "camera") {
    readEurocCamera(root, result);
  } else if (type == "imu") {
    readEurocImu(root, result);
  } else {
    root["sensor_type"].fail("is '" + type + "', expected camera or imu");
  }
  return result;
}

}  // namespace calibration
}  // namespace v1
}  // namespace gslam
