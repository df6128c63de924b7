// Finds the format of a calibration.
#include <gslam/base/error.h>
#include <gslam/datasets/calibration_file.h>
#include <gslam/svar/detail/json_file.h>
#include <gslam/svar/json.h>
#include <gslam/svar_formats/xml.h>
#include <gslam/svar_formats/yaml.h>

#include <algorithm>
#include <cstddef>
#include <string>
#include <vector>

#include "formats.h"

namespace gslam {
inline namespace v1 {
namespace calibration {
namespace {

struct Format {
  const char* name;
  const char* summary;
  bool is_lines;
  bool (*is_it)(const Document&);
  Calibration (*parse)(const Document&);
};

const Format kFormats[] = {
    {"kalibr",
     "Kalibr's camchain.yaml and imu.yaml, as OpenVINS has them, too: pinhole, omni, ds, "
     "eucm with radtan, equidistant, fov or none",
     false, isKalibr, parseKalibr},
    {"opencv",
     "OpenCV's samples and ROS' camera_info, YAML or XML: pinhole, radtan, fisheye, "
     "omnidir",
     false, isOpenCv, parseOpenCv},
    {"ocamcalib", "calib_results.txt of Scaramuzza's toolbox: ocam", true, isOcamcalib,
     parseOcamcalib},
    {"basalt", "Basalt's JSON: ds, eucm, ucm, kb4, fov, pinhole, pinhole-radtan8", false, isBasalt,
     parseBasalt},
    {"orbslam", "settings of ORB-SLAM2 and ORB-SLAM3: PinHole, KannalaBrandt8, Rectified", false,
     isOrbslam, parseOrbslam},
    {"colmap", "COLMAP's cameras.txt: all of its models that Camera has", true, isColmap,
     parseColmap},
    {"euroc", "sensor.yaml of the ASL layout, of a camera or an IMU", false, isEuroc, parseEuroc},
    {"dso", "camera.txt of DSO and TUM monoVO: Pinhole, FOV, RadTan, EquiDistant, KannalaBrandt",
     true, isDso, parseDso},
    {"stella", "settings of stella_vslam and OpenVSLAM: perspective, fisheye, equirectangular",
     false, isStella, parseStella},
    {"svo", "cameras of SVO: ATAN, Pinhole, Equidistant", false, isSvo, parseSvo}};

std::string namesOfAll() {
  std::string names;
  for (const Format& format : kFormats)
    names += (names.empty() ? "" : ", ") + std::string(format.name);
  return names;
}

const Format& formatNamed(const std::string& name) {
  for (const Format& format : kFormats) {
    if (name == format.name) return format;
  }
  throw ArgumentError("CalibrationOptions::format",
                      "is '" + name + "', expected one of " + namesOfAll());
}

void checkOptions(const CalibrationOptions& options) {
  if (!options.format.empty()) formatNamed(options.format);
  if (options.width < 0 || options.height < 0 || (options.width == 0) != (options.height == 0)) {
    throw ArgumentError("CalibrationOptions::width", "and height are " +
                                                         std::to_string(options.width) + " and " +
                                                         std::to_string(options.height) +
                                                         ", expected both 1 or more, or both 0");
  }
  const std::string& bare = options.bare_model;
  if (bare.empty() || bare == "RadTan" || bare == "EquiDistant") return;
  throw ArgumentError("CalibrationOptions::bare_model",
                      "is '" + bare + "', expected RadTan or EquiDistant");
}

// The first line that is neither empty nor a comment, without blanks before it.
std::string firstLine(const std::string& text) {
  std::size_t at = text.compare(0, 3, "\xEF\xBB\xBF") == 0 ? 3 : 0;
  while (at < text.size()) {
    const std::size_t end = std::min(text.find('\n', at), text.size());
    const std::size_t begin = text.find_first_not_of(" \t\r", at);
    if (begin < end && text[begin] != '#') return text.substr(begin, end - begin);
    at = end + 1;
  }
  return "";
}

Document takeApart(const std::string& text, const std::string& source,
                   const CalibrationOptions& options) {
  const std::string head = firstLine(text);
  if (head.empty()) throw ParseError(source, 0, 0, "is empty, expected a calibration");
  const bool is_lines = options.format.empty() ? head.find_first_of(":%<{[") == std::string::npos &&
                                                     head.compare(0, 3, "---") != 0
                                               : formatNamed(options.format).is_lines;
  Svar root;
  if (!is_lines) {
    root = head[0] == '<'   ? parseXml(text, source)
           : head[0] == '{' ? parseJson(text, source)
                            : parseYaml(text, source);
  }
  return {text, source, is_lines, Fields(root, source), options};
}

// What a file has at its top, for whoever wonders why it is none of the formats.
std::string whatItHas(const Document& document) {
  if (document.is_lines) return "begins with \"" + firstLine(document.text).substr(0, 60) + "\"";
  std::string names;
  for (const std::string& name : document.root.names()) {
    if (names.size() > 60) return "has " + names + ", ...";
    names += (names.empty() ? "" : ", ") + name;
  }
  return names.empty() ? "has no names" : "has " + names;
}

const Format& formatOf(const Document& document) {
  if (!document.options.format.empty()) return formatNamed(document.options.format);
  for (const Format& format : kFormats) {
    if (format.is_lines == document.is_lines && format.is_it(document)) return format;
  }
  throw ParseError(document.source, 0, 0,
                   "is no calibration of a known format, expected one of " + namesOfAll() +
                       "; it " + whatItHas(document));
}

}  // namespace
}  // namespace calibration

std::vector<CalibrationFormat> calibrationFormats() {
  std::vector<CalibrationFormat> formats;
  for (const calibration::Format& format : calibration::kFormats) {
    formats.push_back({format.name, format.summary});
  }
  return formats;
}

Calibration parseCalibration(const std::string& text, const std::string& source,
                             const CalibrationOptions& options) {
  calibration::checkOptions(options);
  const calibration::Document document = calibration::takeApart(text, source, options);
  const calibration::Format& format = calibration::formatOf(document);
  Calibration result = format.parse(document);
  result.format = format.name;
  result.time_offsets.resize(result.rig.cameras.size());
  return result;
}

Calibration readCalibration(const std::string& path, const CalibrationOptions& options) {
  return parseCalibration(detail::readFile(path), path, options);
}

}  // namespace v1
}  // namespace gslam
