#include "euroc_files.h"

#include <gslam/base/error.h>

#include "camera_text.h"
#include "row.h"

namespace gslam {
inline namespace v1 {
namespace exporting {
namespace {

const char* const kYaml = "%YAML:1.0\n";

std::string oneLine(std::string text) {
  for (char& c : text) {
    if (static_cast<unsigned char>(c) < 0x20 || c == ':' || c == '#') c = ' ';
  }
  return text.empty() ? "camera" : text;
}

std::string cameraYaml(const CameraSensor& sensor, const SE3d& T_base_camera, double rate) {
  PinholeText model;
  describePinhole(sensor.camera, model);
  if (model.distortion == "none") model.coefficients.assign(4, 0);
  const bool is_fisheye = model.distortion == "equidistant";
  return std::string(kYaml) +
         "# General sensor definitions.\nsensor_type: camera\ncomment: " + oneLine(sensor.name) +
         "\n\n# Sensor extrinsics wrt. the body-frame.\n" + poseYaml(T_base_camera) +
         "\n# Camera specific definitions.\nrate_hz: " + numberText(rate) + "\nresolution: [" +
         std::to_string(sensor.camera.width()) + ", " + std::to_string(sensor.camera.height()) +
         "]\ncamera_model: pinhole\nintrinsics: [" + joined(model.intrinsics, ", ") +
         "] #fu, fv, cu, cv\ndistortion_model: " +
         (is_fisheye ? "equidistant" : "radial-tangential") + "\ndistortion_coefficients: [" +
         joined(model.coefficients, ", ") + "]\n";
}

std::string imuYaml(const ImuCalibration& imu, const SE3d& T_base_imu, double rate) {
  return std::string(kYaml) +
         "sensor_type: imu\ncomment: inertial unit\n\n# Sensor extrinsics wrt. the body-frame.\n" +
         poseYaml(T_base_imu) + "rate_hz: " + numberText(rate) +
         "\n\n# inertial sensor noise model parameters (static)\ngyroscope_noise_density: " +
         numberText(imu.gyro_noise) +
         "  # [ rad / s / sqrt(Hz) ]\ngyroscope_random_walk: " + numberText(imu.gyro_bias_walk) +
         "  # [ rad / s^2 / sqrt(Hz) ]\naccelerometer_noise_density: " +
         numberText(imu.accel_noise) + "  # [ m / s^2 / sqrt(Hz) ]\naccelerometer_random_walk: " +
         numberText(imu.accel_bias_walk) + "  # [ m / s^3 / sqrt(Hz) ]\n";
}

}  // namespace

AslCamera::AslCamera(ExportFolder& folder, const std::string& name, const CameraSensor& sensor,
                     const SE3d& T_base_body)
    : folder_(folder),
      name_(name),
      sensor_(sensor),
      T_base_camera_(T_base_body * sensor.T_body_camera),
      csv_(folder.openText(name + "/data.csv")) {
  csv_.line("#timestamp [ns],filename");
  folder.makeFolder(name + "/data");
  writeSensor(sensor.rate);
}

void AslCamera::write(std::int64_t stamp, const Bytes& png) {
  const std::string file = std::to_string(stamp) + ".png";
  folder_.write(name_ + "/data/" + file, png);
  csv_.line(std::to_string(stamp) + "," + file);
  meter_.add(stamp);
}

void AslCamera::finish() {
  if (!(sensor_.rate > 0)) writeSensor(meter_.rate());
}

void AslCamera::writeSensor(double rate) {
  folder_.write(name_ + "/sensor.yaml", cameraYaml(sensor_, T_base_camera_, rate));
}

AslImu::AslImu(ExportFolder& folder, const std::string& name, const ImuCalibration& calibration,
               const SE3d& T_base_body)
    : folder_(folder),
      name_(name),
      calibration_(calibration),
      T_base_imu_(T_base_body * calibration.T_body_imu),
      csv_(folder.openText(name + "/data.csv")) {
  csv_.line(
      "#timestamp [ns],w_RS_S_x [rad s^-1],w_RS_S_y [rad s^-1],w_RS_S_z [rad s^-1],"
      "a_RS_S_x [m s^-2],a_RS_S_y [m s^-2],a_RS_S_z [m s^-2]");
  writeSensor(calibration.rate);
}

void AslImu::write(const ImuSample& sample) {
  csv_.line(Row(",").nanoseconds(sample.stamp).vector(sample.gyro).vector(sample.accel).str());
  meter_.add(sample.stamp);
}

void AslImu::finish() {
  if (!(calibration_.rate > 0)) writeSensor(meter_.rate());
}

void AslImu::writeSensor(double rate) {
  folder_.write(name_ + "/sensor.yaml", imuYaml(calibration_, T_base_imu_, rate));
}

bool ImuFilter::accept(const ImuSample& sample, Notes& notes) {
  if (!isFinite(sample.gyro) || !isFinite(sample.accel)) {
    notes.count("inertial samples", "they are not finite");
    return false;
  }
  if (has_last_ && sample.stamp <= last_) {
    notes.count("inertial samples", "they are not later than the one before");
    return false;
  }
  has_last_ = true;
  last_ = sample.stamp;
  return true;
}

std::string poseYaml(const SE3d& T_base_sensor) {
  const SE3d::Matrix m = T_base_sensor.matrix();
  std::string text = "T_BS:\n  cols: 4\n  rows: 4\n  data: [";
  for (std::size_t i = 0; i < 4; ++i) {
    text += i == 0 ? "" : ",\n         ";
    text += joined({m(i, 0), m(i, 1), m(i, 2), m(i, 3)}, ", ");
  }
  return text + "]\n";
}

void checkAslModel(const Source& source, std::size_t i) {
  source.needModel(i);
  PinholeText model;
  if (describePinhole(source.camera(i).camera, model) && model.coefficients.size() <= 4) return;
  source.failModel(i, "pinhole, radtan with k1 k2 p1 p2, or kannala_brandt");
}

void noteImu(Source& source) {
  const ImuCalibration& imu = source.rig().imu;
  if (!(imu.gyro_noise > 0) || !(imu.accel_noise > 0) || !(imu.gyro_bias_walk > 0) ||
      !(imu.accel_bias_walk > 0)) {
    source.notes.remark("IMU: noise that is not known is written as 0, which not all readers take");
  }
}

}  // namespace exporting
}  // namespace v1
}  // namespace gslam
