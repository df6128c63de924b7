// COLMAP's cameras.txt.
//
// Columns: colmap.github.io/format.html; order of the parameters: src/colmap/sensor/models.h. The
// first pixel goes from 0 to 1 there, so that its centre is at 0.5.
#include "formats.h"
#include "lines.h"

namespace gslam {
inline namespace v1 {
namespace calibration {
namespace {

struct ColmapModel {
  const char* theirs;
  const char* ours;
  bool has_one_focal_length;
  std::size_t coefficients;      // in the file
  std::size_t all_coefficients;  // of ours; those that the file does not have are 0
};

const ColmapModel kColmapModels[] = {{"SIMPLE_PINHOLE", "pinhole", true, 0, 0},
                                     {"PINHOLE", "pinhole", false, 0, 0},
                                     {"SIMPLE_RADIAL", "radtan", true, 1, 4},
                                     {"RADIAL", "radtan", true, 2, 4},
                                     {"OPENCV", "radtan", false, 4, 4},
                                     {"FULL_OPENCV", "radtan", false, 8, 8},
                                     {"OPENCV_FISHEYE", "kannala_brandt", false, 4, 4},
                                     {"SIMPLE_RADIAL_FISHEYE", "kannala_brandt", true, 1, 4},
                                     {"RADIAL_FISHEYE", "kannala_brandt", true, 2, 4},
                                     {"FOV", "fov", false, 1, 1}};

const ColmapModel* colmapModel(const std::string& name) {
  for (const ColmapModel& model : kColmapModels) {
    if (name == model.theirs) return &model;
  }
  return nullptr;
}

const ColmapModel& readModel(FieldReader& reader) {
  const char* const at = reader.place();
  const std::string name = reader.word();
  reader.skipWord();
  const ColmapModel* const model = colmapModel(name);
  if (model != nullptr) return *model;
  std::string expected;
  for (const ColmapModel& known : kColmapModels)
    expected += (expected.empty() ? "" : ", ") + std::string(known.theirs);
  reader.fail(at, "the model is '" + name + "', expected one of " + expected);
}

CameraSensor readCamera(FieldReader& reader, const std::string& source) {
  const std::string id = reader.word();
  (void)wholeNumber(reader, "the id of the camera", 0, 2147483647);
  const ColmapModel& model = readModel(reader);
  const int width = wholeNumber(reader, "the width", 1, kMostPixels);
  const int height = wholeNumber(reader, "the height", 1, kMostPixels);
  std::vector<double> values = {reader.number("the focal length")};
  values.push_back(model.has_one_focal_length ? values[0] : reader.number("fy"));
  values.push_back(reader.number("cx") - 0.5);
  values.push_back(reader.number("cy") - 0.5);
  for (std::size_t i = 0; i < model.coefficients; ++i) {
    values.push_back(reader.number("a coefficient"));
  }
  reader.endLine();
  values.resize(4 + model.all_coefficients);
  const ImageSize size = {width, height};
  const Camera camera = model.ours == std::string("radtan")
                            ? radtanOrPinhole(source, reader.line(), size, values)
                            : makeCamera(source, reader.line(), model.ours, size, values);
  return makeSensor("camera" + id, camera);
}

}  // namespace

bool isColmap(const Document& document) {
  FieldReader reader(document.text, document.source, "a camera");
  if (!reader.nextLine()) return false;
  reader.skipWord();
  if (reader.isLineEnd()) return false;
  const std::string word = reader.word();  // also a model that is not known yet
  return colmapModel(word) != nullptr || word.find("FISHEYE") != std::string::npos;
}

Calibration parseColmap(const Document& document) {
  FieldReader reader(document.text, document.source,
                     "id, model, width, height and the parameters of the model");
  Calibration result;
  while (reader.nextLine()) result.rig.cameras.push_back(readCamera(reader, document.source));
  if (result.rig.cameras.empty()) throw ParseError(document.source, 0, 0, "has no cameras");
  if (result.rig.cameras.size() == 1) {
    result.body = "the camera";
  } else {
    result.remarks.push_back(
        "cameras.txt does not say where cameras are: all are where the body is");
  }
  return result;
}

}  // namespace calibration
}  // namespace v1
}  // namespace gslam
