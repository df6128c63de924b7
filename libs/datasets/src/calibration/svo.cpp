// Cameras of SVO, as vikit_ros' camera_loader.h reads them: cam_model and what belongs to it.
//
// github.com/uzh-rpg/rpg_vikit, vikit_common/src/atan_camera.cpp: ATAN's parameters are relative to
// the size of the image, from the border of the first pixel on. pinhole_camera.cpp: cam_d0 to
// cam_d4 are k1 k2 p1 p2 k3.
#include "formats.h"

namespace gslam {
inline namespace v1 {
namespace calibration {

namespace {

Camera svoCamera(const Fields& root, ImageSize size) {
  const Fields word = root["cam_model"];
  const std::string model = word.text();
  const std::vector<double> v = membersOf(root, {"cam_fx", "cam_fy", "cam_cx", "cam_cy"});
  if (model == "ATAN") {
    return makeCamera(word, "fov", size,
                      {v[0] * size.width, v[1] * size.height, v[2] * size.width - 0.5,
                       v[3] * size.height - 0.5, root["cam_d0"].number()});
  }
  std::vector<double> k;
  for (const char* name : {"cam_d0", "cam_d1", "cam_d2", "cam_d3"}) {
    k.push_back(root.number(name, 0));
  }
  if (model == "Equidistant") return makeCamera(word, "kannala_brandt", size, joined(v, k));
  if (model != "Pinhole") {
    word.fail("is '" + model + "', expected ATAN, Pinhole or Equidistant");
  }
  if (root.has("cam_d4")) k.push_back(root["cam_d4"].number());  // k3
  return radtanOrPinhole(word, size, v, k);
}

}  // namespace

bool isSvo(const Document& document) {
  return document.root.has("cam_model");
}

Calibration parseSvo(const Document& document) {
  const Fields& root = document.root;
  const ImageSize size = {root["cam_width"].pixels(), root["cam_height"].pixels()};
  Calibration result;
  const Camera camera = svoCamera(root, size);
  result.rig.cameras.push_back(makeSensor("camera", camera));
  result.body = "the camera";
  if (root.number("scale", 1) != 1 || root.number("cam_scale", 1) != 1) {
    result.remarks.push_back("SVO would scale the images; they are as they were taken");
  }
  return result;
}

}  // namespace calibration
}  // namespace v1
}  // namespace gslam
