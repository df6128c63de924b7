// camera.txt of DSO and TUM monoVO.
//
// github.com/JakobEngel/dso, README 3.1.1 and src/util/Undistort.cpp: four lines, the model, the
// size of the images, how to crop, the size after that. A principal point below 1 means parameters
// relative to the size, from the border of the first pixel on; others are pixels.
#include <cctype>

#include "formats.h"
#include "lines.h"

namespace gslam {
inline namespace v1 {
namespace calibration {
namespace {

struct DsoModel {
  const char* word;
  const char* ours;
  std::size_t numbers;
};

const DsoModel kDsoModels[] = {{"Pinhole", "pinhole", 5},
                               {"FOV", "fov", 5},
                               {"RadTan", "radtan", 8},
                               {"EquiDistant", "kannala_brandt", 8},
                               {"KannalaBrandt", "kannala_brandt", 8}};

const DsoModel* dsoModel(const std::string& word) {
  for (const DsoModel& model : kDsoModels) {
    if (word == model.word) return &model;
  }
  return nullptr;
}

struct FirstLine {
  const DsoModel* model = nullptr;
  std::vector<double> values;
  std::size_t line = 0;
};

// Five numbers are a field-of-view camera, or a pinhole where the last is 0; eight: see
// CalibrationOptions::bare_model.
const DsoModel* modelOfBare(const FirstLine& first, const CalibrationOptions& options,
                            std::vector<std::string>& remarks) {
  if (first.values.size() == 5) return dsoModel(first.values[4] == 0 ? "Pinhole" : "FOV");
  if (first.values.size() != 8) return nullptr;
  if (!options.bare_model.empty()) return dsoModel(options.bare_model);
  remarks.push_back(
      "eight numbers without a word before them were taken for RadTan, as DSO does; in TUM-VI's "
      "files they are EquiDistant (CalibrationOptions::bare_model)");
  return dsoModel("RadTan");
}

FirstLine readFirst(FieldReader& reader, const Document& document,
                    std::vector<std::string>& remarks) {
  FirstLine first;
  needLine(reader, "a camera model and its parameters");
  first.line = reader.line();
  first.model = dsoModel(reader.word());
  const bool is_bare = first.model == nullptr;
  const char* const at = reader.place();
  if (!is_bare) reader.skipWord();
  if (is_bare && std::isalpha(static_cast<unsigned char>(*at)) != 0) {
    reader.fail(at, "the model is '" + reader.word() +
                        "', expected Pinhole, FOV, RadTan, EquiDistant or KannalaBrandt");
  }
  first.values = restOfLine(reader, "a parameter");
  if (is_bare) first.model = modelOfBare(first, document.options, remarks);
  std::string expected = "5 or 8";
  if (first.model != nullptr) {
    if (first.values.size() == first.model->numbers) return first;
    expected = std::to_string(first.model->numbers);
  }
  reader.fail(at, "there are " + std::to_string(first.values.size()) + " parameters, expected " +
                      expected + ": fx fy cx cy and those of the distortion");
}

std::vector<double> inPixels(std::vector<double> values, ImageSize size) {
  if (!(values[2] < 1 && values[3] < 1)) return values;
  values[0] *= size.width;
  values[1] *= size.height;
  values[2] = values[2] * size.width - 0.5;
  values[3] = values[3] * size.height - 0.5;
  return values;
}

Camera cameraOf(const FirstLine& first, const std::string& source, ImageSize size) {
  std::vector<double> values = inPixels(first.values, size);
  const std::string model = first.model->ours;
  if (model == "pinhole") values.resize(4);  // DSO has a fifth, 0
  if (model == "radtan") return radtanOrPinhole(source, first.line, size, values);
  return makeCamera(source, first.line, model, size, values);
}

ImageSize readSize(FieldReader& reader, const char* what) {
  needLine(reader, what);
  ImageSize size;
  size.width = wholeNumber(reader, "the width", 1, kMostPixels);
  size.height = wholeNumber(reader, "the height", 1, kMostPixels);
  reader.endLine();
  return size;
}

// How DSO rectifies, and to what size; said, since the images are as they were taken.
void readOutput(FieldReader& reader, std::vector<std::string>& remarks) {
  needLine(reader, "crop, full, none, or five numbers of a rectified camera");
  const char* const at = reader.place();
  const std::string word = reader.word();
  std::string how = word;
  if (word == "crop" || word == "full" || word == "none") {
    reader.skipWord();
    reader.endLine();
  } else {
    if (std::isalpha(static_cast<unsigned char>(*at)) != 0) {
      reader.fail(at, "is '" + word + "', expected crop, full, none, or five numbers");
    }
    if (restOfLine(reader, "a parameter").size() != 5) {
      reader.fail(at, "has not five numbers, expected those, or crop, full, none");
    }
    how = "a camera of its own";
  }
  const ImageSize size = readSize(reader, "width and height of what is rectified");
  remarks.push_back("DSO would rectify the images (" + how + ") to " + std::to_string(size.width) +
                    " x " + std::to_string(size.height) + "; they are as they were taken");
}

}  // namespace

bool isDso(const Document& document) {
  FieldReader reader(document.text, document.source, "a camera");
  if (!reader.nextLine()) return false;
  if (dsoModel(reader.word()) != nullptr) return true;
  try {
    const std::size_t count = restOfLine(reader, "a parameter").size();
    return count == 5 || count == 8;
  } catch (const ParseError&) {
    return false;
  }
}

Calibration parseDso(const Document& document) {
  FieldReader reader(document.text, document.source,
                     "the four lines of DSO: model, size, crop, size after that");
  Calibration result;
  const FirstLine first = readFirst(reader, document, result.remarks);
  const ImageSize size = readSize(reader, "width and height of the images");
  readOutput(reader, result.remarks);
  if (reader.nextLine()) {
    result.remarks.push_back("DSO does not read line " + std::to_string(reader.line()) +
                             " and what is behind it: nor was it read here");
  }
  result.rig.cameras.push_back(makeSensor("camera", cameraOf(first, document.source, size)));
  result.body = "the camera";
  return result;
}

}  // namespace calibration
}  // namespace v1
}  // namespace gslam
