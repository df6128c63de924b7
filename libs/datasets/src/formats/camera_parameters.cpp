#include "camera_parameters.h"

#include <gslam/base/error.h>
#include <gslam/datasets/calibration_file.h>

#include <string>

#include "../reading/camera_words.h"

namespace gslam {
inline namespace v1 {
namespace reading {

void addCameraParameters(Svar& parameters) {
  parameters.set("camera", "");
  parameters.set("calibration", "");
}

bool overrideCamera(const Svar& parameters, CameraSensor& sensor) {
  const auto words = parameters.get<std::string>("camera", ""),
             file = parameters.get<std::string>("calibration", "");
  if (!words.empty() && !file.empty()) {
    throw ArgumentError("camera", "and calibration are both given, expected one of them");
  }
  if (!words.empty()) sensor.camera = cameraOfWords(words);
  if (!file.empty()) {
    const SensorRig rig = readCalibration(file).rig;
    if (rig.cameras.empty()) throw FileError(file, "has no camera");
    sensor.camera = rig.cameras[0].camera;
  }
  return sensor.camera.isValid();
}

CameraSensor cameraOfFile(const std::string& text, const std::string& name, int index) {
  const SensorRig rig = parseCalibration(text, name).rig;
  if (index >= 0 && std::size_t(index) < rig.cameras.size()) return rig.cameras[std::size_t(index)];
  throw FileError(name, "has " + std::to_string(rig.cameras.size()) +
                            " cameras, expected one with the number " + std::to_string(index));
}

}  // namespace reading
}  // namespace v1
}  // namespace gslam
