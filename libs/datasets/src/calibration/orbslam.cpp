// Settings of ORB-SLAM2 and ORB-SLAM3.
//
// github.com/raulmur/ORB_SLAM2, Examples/*/*.yaml and src/Tracking.cc; github.com/UZ-SLAMLab/
// ORB_SLAM3, src/Settings.cc ("File.version": "1.0") and, for older files, src/Tracking.cc (Tbc,
// Tlr). T_c1_c2 takes coordinates of the second camera to those of the first, T_b_c1 those of the
// first to the inertial unit's.
#include "formats.h"

namespace gslam {
inline namespace v1 {
namespace calibration {
namespace {

ImageSize sizeIn(const Document& document, const std::string& camera) {
  const Fields& root = document.root;
  if (!root.has(camera + ".width")) return sizeOfOptions(document);
  return {root[camera + ".width"].pixels(), root[camera + ".height"].pixels()};
}

enum class Lens { pinhole, fisheye, rectified };

Lens lensOf(const Fields& root) {
  if (!root.has("Camera.type")) return Lens::pinhole;  // ORB-SLAM2
  const std::string type = root["Camera.type"].text();
  if (type == "PinHole") return Lens::pinhole;
  if (type == "KannalaBrandt8") return Lens::fisheye;
  if (type == "Rectified") return Lens::rectified;
  root["Camera.type"].fail("is '" + type + "', expected PinHole, KannalaBrandt8 or Rectified");
}

Camera cameraOf(const Fields& root, const std::string& camera, Lens lens, ImageSize size) {
  const std::vector<double> intrinsics = membersOf(root.section(camera), {"fx", "fy", "cx", "cy"});
  const Fields where = root[camera + ".fx"];
  if (lens == Lens::fisheye) {
    const std::vector<double> k = membersOf(root.section(camera), {"k1", "k2", "k3", "k4"});
    return makeCamera(where, "kannala_brandt", size, joined(intrinsics, k));
  }
  if (lens == Lens::rectified || !root.has(camera + ".k1")) {
    return makeCamera(where, "pinhole", size, intrinsics);
  }
  std::vector<double> k = membersOf(root.section(camera), {"k1", "k2", "p1", "p2"});
  if (root.has(camera + ".k3")) k.push_back(root[camera + ".k3"].number());
  return radtanOrPinhole(where, size, intrinsics, k);
}

// One side of EuRoC's rectification in ORB-SLAM2: LEFT.K and so on.
CameraSensor sideOf(const Fields& root, const std::string& side, const std::string& name) {
  const ImageSize size = {root[side + ".width"].pixels(), root[side + ".height"].pixels()};
  const Fields matrix = root[side + ".K"];
  return makeSensor(
      name, radtanOrPinhole(matrix, size, intrinsicsOfMatrix(matrix), root[side + ".D"].numbers()));
}

void readRectifiedPair(const Fields& root, double rate, Calibration& result) {
  CameraSensor left = sideOf(root, "LEFT", "left"), right = sideOf(root, "RIGHT", "right");
  const double baseline = root["Camera.bf"].number() / root["Camera.fx"].number();
  right.T_body_camera =
      placeOfRight(root["LEFT.R"].rotation(), root["RIGHT.R"].rotation(), baseline);
  left.rate = right.rate = rate;
  result.rig.cameras = {left, right};
  result.remarks.push_back(
      "ORB-SLAM would rectify the images; the cameras are those of the images as they were taken");
}

// How far the second camera is to the right of the first, of rectified ones; 0: there is none.
double baselineOf(const Fields& root, const Camera& first) {
  const double b = root.number("Stereo.b", 0);
  const double baseline = b != 0 ? b : root.number("Camera.bf", 0) / first.parameters()[0];
  if (baseline >= 0) return baseline;
  root.anyOf({"Stereo.b", "Camera.bf"}).fail("is negative, expected 0 or more");
}

void addSecond(const Document& document, Lens lens, double rate, Calibration& result) {
  const Fields& root = document.root;
  const Camera first = result.rig.cameras[0].camera;
  if (root.has("Camera2.fx")) {
    const bool has_place = root.hasAnyOf({"Stereo.T_c1_c2", "Tlr"});
    if (!has_place) {
      result.remarks.push_back(
          "there is no Stereo.T_c1_c2: where the second camera is, is not known, and it was put "
          "where the first one is");
    }
    const SE3d place = has_place ? root.anyOf({"Stereo.T_c1_c2", "Tlr"}).pose() : SE3d();
    const Camera second = cameraOf(root, "Camera2", lens, {first.width(), first.height()});
    result.rig.cameras.push_back(makeSensor("right", second, place, rate));
    return;
  }
  const double baseline = baselineOf(root, first);
  if (baseline == 0) return;
  const SE3d place(SO3d(), {{baseline, 0, 0}});
  result.rig.cameras.push_back(makeSensor("right", first, place, rate));
}

void readCameras(const Document& document, Calibration& result) {
  const Fields& root = document.root;
  const double rate = root.number("Camera.fps", 0);
  if (rate < 0) root["Camera.fps"].fail("is negative, expected images a second");
  if (root.has("LEFT.K")) return readRectifiedPair(root, rate, result);
  const Lens lens = lensOf(root);
  const std::string first = root.has("Camera1.fx") ? "Camera1" : "Camera";
  const Camera camera = cameraOf(root, first, lens, sizeIn(document, "Camera"));
  result.rig.cameras.push_back(makeSensor("left", camera, SE3d(), rate));
  if (root.hasAnyOf({"DepthMapFactor", "RGBD.DepthMapFactor"})) {
    result.rig.cameras[0].name = "rgb";
    result.rig.cameras.push_back(
        depthOf(result.rig.cameras[0], root.anyOf({"DepthMapFactor", "RGBD.DepthMapFactor"})));
    return;  // the baseline of RGB-D is one that ORB-SLAM makes up
  }
  addSecond(document, lens, rate, result);
  if (result.rig.cameras.size() == 1) result.rig.cameras[0].name = "camera";
}

void sayScale(const Fields& root, Calibration& result) {
  const bool is_scaled = root.number("Camera.imageScale", 1) != 1 ||
                         root.hasAnyOf({"Camera.newWidth", "Camera.newHeight"});
  if (!is_scaled) return;
  result.remarks.push_back("ORB-SLAM would scale the images; they are as they were taken");
}

void readOrbslamImu(const Fields& root, Calibration& result) {
  result.rig.has_imu = true;
  ImuCalibration& imu = result.rig.imu;
  imu.gyro_noise = noiseOf(root["IMU.NoiseGyro"], result);
  imu.accel_noise = noiseOf(root["IMU.NoiseAcc"], result);
  imu.gyro_bias_walk = noiseOf(root["IMU.GyroWalk"], result);
  imu.accel_bias_walk = noiseOf(root["IMU.AccWalk"], result);
  imu.rate = root["IMU.Frequency"].number();
  if (imu.rate < 0) root["IMU.Frequency"].fail("is negative, expected samples a second");
  const SE3d T_imu_first = root.anyOf({"IMU.T_b_c1", "Tbc"}).pose();
  for (CameraSensor& camera : result.rig.cameras) {
    camera.T_body_camera = T_imu_first * camera.T_body_camera;
  }
  result.body = "the IMU";
}

}  // namespace

bool isOrbslam(const Document& document) {
  if (isStella(document)) return false;  // OpenVSLAM has Camera.fx, too
  return document.root.hasAnyOf({"Camera.fx", "Camera1.fx", "LEFT.K"});
}

Calibration parseOrbslam(const Document& document) {
  Calibration result;
  readCameras(document, result);
  sayScale(document.root, result);
  result.body = "the camera " + result.rig.cameras[0].name;
  if (document.root.has("IMU.NoiseGyro")) readOrbslamImu(document.root, result);
  return result;
}

}  // namespace calibration
}  // namespace v1
}  // namespace gslam
