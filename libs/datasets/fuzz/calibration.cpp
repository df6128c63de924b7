// Any bytes are a calibration whose cameras can be used, or are refused with a gslam::Error.
#include <gslam/base/error.h>
#include <gslam/datasets/calibration_file.h>

#include <cmath>
#include <cstddef>
#include <cstdint>
#include <cstdlib>
#include <string>

namespace {

void read(const std::string& text, const gslam::CalibrationOptions& options) {
  try {
    const gslam::Calibration found = gslam::parseCalibration(text, "fuzz", options);
    if (found.time_offsets.size() != found.rig.cameras.size()) std::abort();
    if (found.rig.cameras.empty() && !found.rig.has_imu) std::abort();
    for (const gslam::CameraSensor& sensor : found.rig.cameras) {
      const gslam::Vec3d in_body = sensor.T_body_camera * gslam::Vec3d{{0, 0, 1}};
      gslam::Vec2d pixel;
      if (!sensor.camera.isValid() || std::isnan(in_body[0])) std::abort();
      (void)sensor.camera.project({{0.1, 0.2, 1}}, pixel);
    }
  } catch (const gslam::Error&) {  // NOLINT(bugprone-empty-catch): what most inputs get
  }
}

}  // namespace

// NOLINTNEXTLINE(readability-identifier-naming): libFuzzer looks for this name
extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  const std::string text(reinterpret_cast<const char*>(data), size);
  gslam::CalibrationOptions options;
  options.width = 640;
  options.height = 480;
  read(text, options);
  for (const gslam::CalibrationFormat& format : gslam::calibrationFormats()) {
    options.format = format.name;
    read(text, options);
  }
  return 0;
}
