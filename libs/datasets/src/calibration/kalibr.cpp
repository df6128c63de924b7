// Kalibr's camchain and imu files, and OpenVINS' variant of them.
//
// The words and the order of numbers: github.com/ethz-asl/kalibr, wiki "yaml formats" and
// aslam_offline_calibration/kalibr/python/kalibr_common/ConfigReader.py; T_imu_cam and T_i_b:
// docs.openvins.com "Sensor Calibration".
#include <algorithm>
#include <cmath>
#include <map>

#include "formats.h"

namespace gslam {
inline namespace v1 {
namespace calibration {
namespace {

const char* const kImuNoise = "accelerometer_noise_density";

// cam0, cam1, ...: their number behind the word; -1 for another name.
int numberBehind(const std::string& word, const std::string& name) {
  if (name.size() <= word.size() || name.size() > word.size() + 4) return -1;
  if (name.compare(0, word.size(), word) != 0) return -1;
  int number = 0;
  for (std::size_t i = word.size(); i < name.size(); ++i) {
    if (name[i] < '0' || name[i] > '9') return -1;
    number = 10 * number + (name[i] - '0');
  }
  return number;
}

// By number; a gap in the numbers is an error, since the chain would be broken.
std::vector<Fields> camerasOf(const Fields& root) {
  std::map<int, std::string> found;
  for (const std::string& name : root.names()) {
    const int number = numberBehind("cam", name);
    if (number >= 0) found[number] = name;
  }
  std::vector<Fields> cameras;
  for (const auto& each : found) {
    if (each.first != static_cast<int>(cameras.size())) {
      root.failMissing("cam" + std::to_string(cameras.size()));
    }
    cameras.push_back(root[each.second]);
  }
  return cameras;
}

// Kalibr has the parameters of the projection first; ours follow fx fy cx cy.
Camera projectionOf(const Fields& camera, const std::string& kind, ImageSize size,
                    const std::vector<double>& coefficients) {
  for (double k : coefficients) {
    if (k != 0 && kind != "omni") {
      camera["distortion_coeffs"].fail("are not 0, but a camera of model " + kind + " has none");
    }
  }
  const Fields list = camera["intrinsics"];
  if (kind == "omni") {
    const std::vector<double> v = list.numbers(5);
    const std::vector<double> mei = {v[1], v[2], v[3], v[4], v[0]};
    if (!coefficients.empty()) camera["distortion_coeffs"].numbers(4);
    const std::vector<double> k = coefficients.empty() ? std::vector<double>(4) : coefficients;
    return makeCamera(list, "mei", size, joined(mei, k));
  }
  const std::vector<double> v = list.numbers(6);
  return makeCamera(list, kind == "ds" ? "double_sphere" : "eucm", size,
                    {v[2], v[3], v[4], v[5], v[0], v[1]});
}

Camera cameraOf(const Fields& camera) {
  const Fields model = camera["camera_model"];
  const std::string kind = model.text();
  const ImageSize size = sizeOf(camera["resolution"]);
  const std::string distortion =
      camera.has("distortion_model") ? camera["distortion_model"].text() : "none";
  const std::vector<double> coefficients = camera.has("distortion_coeffs")
                                               ? camera["distortion_coeffs"].numbers()
                                               : std::vector<double>();
  if (kind == "pinhole") {
    const std::vector<double> intrinsics = camera["intrinsics"].numbers(4);
    return distortedPinhole(camera, distortion, size, intrinsics, coefficients);
  }
  if (kind != "omni" && kind != "ds" && kind != "eucm") {
    model.fail("is '" + kind + "', expected pinhole, omni, ds or eucm");
  }
  if (kind == "omni" && distortion != "radtan" && distortion != "none") {
    camera["distortion_model"].fail("is '" + distortion +
                                    "', expected radtan or none for a camera of model omni");
  }
  return projectionOf(camera, kind, size, coefficients);
}

bool isByImu(const Fields& camera) {
  return camera.hasAnyOf({"T_cam_imu", "T_imu_cam"});
}

SE3d T_imu_cameraOf(const Fields& camera) {  // NOLINT(readability-identifier-naming)
  if (camera.has("T_imu_cam")) return camera["T_imu_cam"].pose();
  return camera["T_cam_imu"].pose().inverse();
}

// The first camera that has a place by the inertial unit; their number: none has.
std::size_t firstByImu(const std::vector<Fields>& cameras) {
  const auto first = std::find_if(cameras.begin(), cameras.end(), isByImu);
  return static_cast<std::size_t>(first - cameras.begin());
}

// The place of cam0: its own, or back along the chain from the first that has one.
SE3d placeOfFirst(const std::vector<Fields>& cameras) {
  std::size_t i = firstByImu(cameras);
  if (i == cameras.size()) return SE3d();
  SE3d place = T_imu_cameraOf(cameras[i]);
  for (; i > 0; --i) place = place * cameras[i]["T_cn_cnm1"].pose();
  return place;
}

// The place of a camera, by the inertial unit or by the camera before it.
SE3d placeOf(const std::vector<Fields>& cameras, std::size_t i, bool is_by_imu,
             Calibration& result) {
  const Fields& camera = cameras[i];
  if (i == 0) return placeOfFirst(cameras);
  const bool is_in_chain = camera.has("T_cn_cnm1");
  if (isByImu(camera)) {
    const SE3d T_imu_camera = T_imu_cameraOf(camera);
    if (is_in_chain) {
      const SE3d by_chain =
          result.rig.cameras[i - 1].T_body_camera * camera["T_cn_cnm1"].pose().inverse();
      const double apart = (by_chain.translation() - T_imu_camera.translation()).norm() +
                           (by_chain.rotation().inverse() * T_imu_camera.rotation()).angle();
      if (apart > 1e-3) {
        result.remarks.push_back(camera.path() +
                                 ": T_cn_cnm1 and T_cam_imu do not agree; T_cam_imu was taken");
      }
    }
    return T_imu_camera;
  }
  if (is_in_chain) {
    return result.rig.cameras[i - 1].T_body_camera * camera["T_cn_cnm1"].pose().inverse();
  }
  camera.failMissing(is_by_imu ? "T_cam_imu or T_cn_cnm1" : "T_cn_cnm1");
}

void readCameras(const Fields& root, Calibration& result) {
  const std::vector<Fields> cameras = camerasOf(root);
  if (cameras.empty()) return;
  const bool is_by_imu = firstByImu(cameras) < cameras.size();
  result.body = is_by_imu ? "the IMU" : "the camera cam0";
  result.rig.has_imu = is_by_imu;
  for (std::size_t i = 0; i < cameras.size(); ++i) {
    const SE3d T_body_camera = placeOf(cameras, i, is_by_imu, result);
    const std::string name = "cam" + std::to_string(i);
    result.rig.cameras.push_back(makeSensor(name, cameraOf(cameras[i]), T_body_camera));
    const bool has_shift = cameras[i].has("timeshift_cam_imu");
    result.time_offsets.push_back(has_shift ? nanosecondsOf(cameras[i]["timeshift_cam_imu"]) : 0);
    if (has_shift && result.time_offsets.back() != 0) {
      result.remarks.push_back(name + ": its stamps are to be shifted by " +
                               std::to_string(result.time_offsets.back()) +
                               " ns to be those of the IMU");
    }
  }
}

bool isIdentity(const std::vector<double>& matrix) {
  for (std::size_t i = 0; i < matrix.size(); ++i) {
    if (matrix[i] != (i % 4 == 0 ? 1 : 0)) return false;  // of 3 x 3
  }
  return true;
}

// What the models of the unit beyond noise have, in Kalibr's words and in OpenVINS'.
void sayUnused(const Fields& imu, Calibration& result) {
  bool is_scaled = imu.hasAnyOf({"gyroscopes", "accelerometers"});
  for (const char* name : {"Tw", "Ta", "R_IMUtoGYRO", "R_IMUtoACC"}) {
    is_scaled = is_scaled || (imu.has(name) && !isIdentity(imu[name].numbers(9)));
  }
  if (is_scaled) {
    result.remarks.push_back("scale and misalignment of the IMU were not taken over");
  }
  if (imu.number("time_offset", 0) != 0) {
    result.remarks.push_back("the time_offset of the IMU was not taken over");
  }
}

void readImu(const Fields& imu, bool has_cameras, Calibration& result) {
  ImuCalibration& calibration = result.rig.imu;
  calibration.accel_noise = noiseOf(imu[kImuNoise], result);
  calibration.accel_bias_walk = noiseOf(imu["accelerometer_random_walk"], result);
  calibration.gyro_noise = noiseOf(imu["gyroscope_noise_density"], result);
  calibration.gyro_bias_walk = noiseOf(imu["gyroscope_random_walk"], result);
  calibration.rate = imu.number("update_rate", 0);
  if (calibration.rate < 0) imu["update_rate"].fail("is negative, expected samples a second");
  // Kalibr's body is its first unit, from which the cameras are measured, too.
  if (imu.has("T_i_b")) calibration.T_body_imu = imu["T_i_b"].pose().inverse();
  if (has_cameras && !result.rig.has_imu) {
    result.remarks.push_back("no camera has T_cam_imu: where the IMU is, is not known");
  }
  sayUnused(imu, result);
  result.rig.has_imu = true;
  if (result.body.empty()) result.body = "the IMU";
}

void readImus(const Fields& root, Calibration& result) {
  const bool has_cameras = !result.rig.cameras.empty();
  if (root.has("imu0")) {
    readImu(root["imu0"], has_cameras, result);
    if (root.has("imu1")) result.remarks.push_back("there are more IMUs: imu0 was taken");
  } else if (root.has(kImuNoise)) {
    readImu(root, has_cameras, result);
  } else if (result.rig.has_imu) {
    result.remarks.push_back("the noise of the IMU is not in this file");
  }
}

}  // namespace

bool isKalibr(const Document& document) {
  const Fields& root = document.root;
  if (root.hasAnyOf({"cam0", "imu0"})) return true;
  return root.has(kImuNoise) && !root.has("sensor_type");
}

Calibration parseKalibr(const Document& document) {
  Calibration result;
  readCameras(document.root, result);
  readImus(document.root, result);
  if (!result.rig.cameras.empty() || result.rig.has_imu) return result;
  document.root.failMissing("cam0 or imu0");
}

}  // namespace calibration
}  // namespace v1
}  // namespace gslam
