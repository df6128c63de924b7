// Cameras of SVO, as vikit_ros' camera_loader.h reads them: cam_model and what belongs to it.
//
// github.com/uzh-rpg/rpg_vikit, vikit_common/src/atan_camera.cpp: ATAN's parameters are relative to
// the size of the image, from the border of the first pixel on.
#include "formats.h"

namespace gslam {
inline namespace v1 {
namespace calibration {

bool isSvo(const Document& document) {
  return document.root.has("cam_model");
}

Calibration parseSvo(const Document& document) {
  const Fields& root = document.root;
  const Fields word = root["cam_model"];
  const std::string model = word.text();
  const ImageSize size = {root["cam_width"].pixels(), root["cam_height"].pixels()};
  std::vector<double> v;
  for (const char* name : {"cam_fx", "cam_fy", "cam_cx", "cam_cy"}) {
    v.push_back(root[name].number());
  }
  Calibration result;
  if (model == "ATAN") {
    v = {v[0] * size.width, v[1] * size.height, v[2] * size.width - 0.5, v[3] * size.height - 0.5,
         root["cam_d0"].number()};
  } else {
    for (const char* name : {"cam_d0", "cam_d1", "cam_d2", "cam_d3"}) {
      v.push_back(root.number(name, 0));
    }
  }
  const bool is_fisheye = model == "Equidistant";
  if (model != "ATAN" && model != "Pinhole" && !is_fisheye) {
    word.fail("is '" + model + "', expected ATAN, Pinhole or Equidistant");
  }
  const Camera camera = makeCamera(word,
                                   model == "ATAN" ? "fov"
                                   : is_fisheye    ? "kannala_brandt"
                                                   : "radtan",
                                   size, v);
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
