#include "camera_parameters.h"

#include <gslam/base/error.h>
#include <gslam/datasets/calibration_file.h>

#include <string>
#include <vector>

#include "../reading/camera_words.h"

namespace gslam {
inline namespace v1 {
namespace reading {

namespace {

CameraSensor pick(const Calibration& calibration, const std::string& name, int index,
                  Remarks& remarks) {
  const std::vector<CameraSensor>& cameras = calibration.rig.cameras;
  const auto i = static_cast<std::size_t>(index);
  if (index < 0 || i >= cameras.size()) {
    throw FileError(name, "has " + std::to_string(cameras.size()) +
                              " cameras, expected one with the number " + std::to_string(index));
  }
  for (const std::string& remark : calibration.remarks) remarks.say(name + ": " + remark);
  if (i < calibration.time_offsets.size() && calibration.time_offsets[i] != 0) {
    remarks.say(name + ": " + std::to_string(calibration.time_offsets[i]) +
                " ns should be added to the camera's stamps; they are left as they are");
  }
  return cameras[i];
}

CalibrationOptions sizedAs(const ImageShape& shape) {
  CalibrationOptions options;
  options.width = shape.width;
  options.height = shape.height;
  return options;
}

}  // namespace

void addCameraParameters(Svar& parameters) {
  parameters.set("camera", "");
  parameters.set("calibration", "");
}

bool overrideCamera(const Svar& parameters, CameraSensor& sensor, Remarks& remarks,
                    const std::function<ImageShape()>& shape) {
  const auto words = parameters.get<std::string>("camera", ""),
             file = parameters.get<std::string>("calibration", "");
  if (!words.empty() && !file.empty()) {
    throw ArgumentError("camera", "and calibration are both given, expected one of them");
  }
  if (!words.empty()) sensor.camera = cameraOfWords(words);
  if (!file.empty()) {
    sensor.camera = pick(readCalibration(file, sizedAs(shape())), file, 0, remarks).camera;
  }
  return sensor.camera.isValid();
}

CameraSensor cameraOfFile(const std::string& text, const std::string& name, int index,
                          const ImageShape& shape, Remarks& remarks) {
  return pick(parseCalibration(text, name, sizedAs(shape)), name, index, remarks);
}

}  // namespace reading
}  // namespace v1
}  // namespace gslam
