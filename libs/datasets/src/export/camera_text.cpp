#include "camera_text.h"

#include "row.h"

namespace gslam {
inline namespace v1 {
namespace exporting {
namespace {

// fx fy cx cy as parts of the image, from its border on.
std::vector<double> relativeIntrinsics(const Camera& camera, const std::vector<double>& p) {
  const double width = camera.width(), height = camera.height();
  return {p[0] / width, p[1] / height, (p[2] + 0.5) / width, (p[3] + 0.5) / height};
}

}  // namespace

bool describePinhole(const Camera& camera, PinholeText& text) {
  const std::string model = camera.modelName();
  const std::vector<double> values = camera.parameters();
  if (model != "pinhole" && model != "radtan" && model != "kannala_brandt") return false;
  text.intrinsics.assign(values.begin(), values.begin() + 4);
  text.coefficients.assign(values.begin() + 4, values.end());
  text.distortion = model == "pinhole" ? "none" : model == "radtan" ? "radtan" : "equidistant";
  while (text.coefficients.size() > 4 && text.coefficients.back() == 0)
    text.coefficients.pop_back();
  return true;
}

std::string joined(const std::vector<double>& values, const char* separator) {
  Row row(separator);
  for (double value : values) row.number(value);
  return row.str();
}

std::string dsoCameraText(const Camera& camera) {
  std::vector<double> values;
  std::string word, mode = "crop";
  PinholeText pinhole;
  if (camera.modelName() == "fov") {
    const std::vector<double> p = camera.parameters();
    values = relativeIntrinsics(camera, p);
    values.push_back(p[4]);  // without a word before it, as in the original
  } else if (describePinhole(camera, pinhole) && pinhole.coefficients.size() <= 4) {
    values = relativeIntrinsics(camera, pinhole.intrinsics);
    values.insert(values.end(), pinhole.coefficients.begin(), pinhole.coefficients.end());
    if (pinhole.distortion == "none") {
      values.push_back(0);  // a field-of-view camera that bends nothing
      mode = "none";
    } else {
      word = pinhole.distortion == "radtan" ? "RadTan " : "EquiDistant ";
    }
  } else {
    return "";
  }
  const std::string size =
      std::to_string(camera.width()) + " " + std::to_string(camera.height()) + "\n";
  return word + joined(values, " ") + "\n" + size + mode + "\n" + size;
}

const char* dsoCameraModels() {
  return "pinhole, fov, radtan with k1 k2 p1 p2, or kannala_brandt";
}

}  // namespace exporting
}  // namespace v1
}  // namespace gslam
