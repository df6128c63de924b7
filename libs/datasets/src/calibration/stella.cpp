// Settings of stella_vslam and of OpenVSLAM before it, which has "Camera.fx" in place of fx in
// Camera, and depthmap_factor at the top.
//
// github.com/stella-cv/stella_vslam, src/stella_vslam/camera/*.cc and util/stereo_rectifier.cc;
// OpenVSLAM 0.2, src/openvslam/config.cc and example/*/*.yaml.
#include "formats.h"

namespace gslam {
inline namespace v1 {
namespace calibration {
namespace {

Camera stellaCamera(const Fields& camera, ImageSize size) {
  const std::string model = camera["model"].text();
  if (model == "equirectangular") return makeCamera(camera, model, size, {});
  if (model != "perspective" && model != "fisheye") {
    camera["model"].fail("is '" + model + "', expected perspective, fisheye or equirectangular");
  }
  const std::vector<double> intrinsics = membersOf(camera, {"fx", "fy", "cx", "cy"});
  if (model == "fisheye") {
    const std::vector<double> k = membersOf(camera, {"k1", "k2", "k3", "k4"});
    return makeCamera(camera, "kannala_brandt", size, joined(intrinsics, k));
  }
  const std::vector<double> k = membersOf(camera, {"k1", "k2", "p1", "p2", "k3"});
  return radtanOrPinhole(camera, size, intrinsics, k);
}

double baselineOf(const Fields& camera) {
  const double baseline = camera["focal_x_baseline"].number() / camera["fx"].number();
  if (baseline > 0 && baseline < 1e6) return baseline;
  camera["focal_x_baseline"].fail("gives no baseline, expected a positive number of pixels");
}

// The camera of a side as its images were taken.
Camera takenBy(const Fields& rectifier, const std::string& side, ImageSize size) {
  const Fields matrix = rectifier["K_" + side];
  const std::vector<double> intrinsics = intrinsicsOfMatrix(matrix);
  const std::vector<double> k = rectifier["D_" + side].numbers();
  const bool is_fisheye = rectifier.has("model") && rectifier["model"].text() == "fisheye";
  if (!is_fisheye) return radtanOrPinhole(matrix, size, intrinsics, k);
  return makeCamera(matrix, "kannala_brandt", size, joined(intrinsics, k));
}

void readPair(const Document& document, const Fields& camera, ImageSize size, Calibration& result) {
  const double baseline = baselineOf(camera);
  result.rig.cameras[0].name = "left";
  CameraSensor right = result.rig.cameras[0];
  right.name = "right";
  right.T_body_camera = SE3d(SO3d(), {{baseline, 0, 0}});
  const Fields rectifier = document.root.section("StereoRectifier");
  if (document.root.has("StereoRectifier") || rectifier.hasAnyOf({"model", "K_left", "R_left"})) {
    result.rig.cameras[0].camera = takenBy(rectifier, "left", size);
    right.camera = takenBy(rectifier, "right", size);
    right.T_body_camera =
        placeOfRight(rectifier["R_left"].rotation(), rectifier["R_right"].rotation(), baseline);
    result.remarks.push_back(
        "stella_vslam would rectify the images; the cameras are those of the images as they were "
        "taken");
  }
  result.rig.cameras.push_back(right);
}

ImageKind kindOf(const Fields& camera) {
  if (!camera.has("color_order")) return ImageKind::grey;
  const std::string order = camera["color_order"].text();
  if (order == "Gray") return ImageKind::grey;
  if (order == "RGB" || order == "RGBA") return ImageKind::rgb;
  if (order == "BGR" || order == "BGRA") return ImageKind::bgr;
  camera["color_order"].fail("is '" + order + "', expected Gray, RGB or BGR");
}

}  // namespace

bool isStella(const Document& document) {
  return document.root.section("Camera").hasAnyOf({"model", "cols"});
}

Calibration parseStella(const Document& document) {
  const Fields& root = document.root;
  const Fields camera = root.section("Camera");
  const ImageSize size = {camera["cols"].pixels(), camera["rows"].pixels()};
  const double rate = camera.number("fps", 0);
  if (rate < 0) camera["fps"].fail("is negative, expected images a second");
  Calibration result;
  result.rig.cameras.push_back(makeSensor("camera", stellaCamera(camera, size), SE3d(), rate));
  result.rig.cameras[0].kind = kindOf(camera);
  const std::string setup = camera.has("setup") ? camera["setup"].text() : "monocular";
  if (setup == "stereo") {
    readPair(document, camera, size, result);
  } else if (setup == "RGBD") {
    result.rig.cameras[0].name = "rgb";
    const Fields with_factor = root.has("Preprocessing") ? root["Preprocessing"] : root;
    result.rig.cameras.push_back(depthOf(result.rig.cameras[0], with_factor["depthmap_factor"]));
  } else if (setup != "monocular") {
    camera["setup"].fail("is '" + setup + "', expected monocular, stereo or RGBD");
  }
  result.body = "the camera " + result.rig.cameras[0].name;
  return result;
}

}  // namespace calibration
}  // namespace v1
}  // namespace gslam
