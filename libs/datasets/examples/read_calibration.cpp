#include <gslam/datasets.h>

#include <cmath>
#include <cstdio>

int main(int argc, char** argv) {
  const char* const text = R"(%YAML:1.0
Camera.type: "KannalaBrandt8"
Camera.width: 512
Camera.height: 512
Camera1.fx: 190.978
Camera1.fy: 190.973
Camera1.cx: 254.931
Camera1.cy: 256.897
Camera1.k1: 0.00348
Camera1.k2: 0.00071
Camera1.k3: -0.00205
Camera1.k4: 0.00020
)";
  const gslam::Calibration calibration =
      argc > 1 ? gslam::readCalibration(argv[1]) : gslam::parseCalibration(text, "the example");
  std::printf("%s, body: %s\n", calibration.format.c_str(), calibration.body.c_str());
  for (const gslam::CameraSensor& sensor : calibration.rig.cameras) {
    const gslam::FieldOfView view = sensor.camera.fieldOfView();
    std::printf("%s: %s, %.0f degrees wide\n", sensor.name.c_str(),
                sensor.camera.modelName().c_str(), view.horizontal * 180 / std::acos(-1));
  }
  for (const std::string& remark : calibration.remarks) std::printf("%s\n", remark.c_str());
  return calibration.format.empty() ? 1 : 0;
}
