// TUM VI, the archives of EuRoC and DSO layout.
//
// D. Schubert et al., "The TUM VI benchmark for evaluating visual-inertial odometry", IROS 2018,
// and vision.in.tum.de/data/datasets/visual-inertial-dataset: mav0/ in the ASL layout with 8 or 16
// bit images and mocap0, whose poses are those of the IMU; dso/ with Kalibr's camchain.yaml and
// imu_config.yaml, and for each camera times.txt: stamp in ns, in s, exposure in ms. The stamp is
// the middle of the exposure.
#include <gslam/base/error.h>
#include <gslam/core/detail/field_reader.h>
#include <gslam/datasets/formats.h>

#include <utility>

#include "../reading/looks_like.h"
#include "asl.h"

namespace gslam {
inline namespace v1 {
namespace reading {
namespace {

AslExposures readExposures(const Asl& asl, const std::string& file) {
  const std::string text = asl.tree->text(file), name = asl.tree->nameOf(file);
  detail::FieldReader in(text, name, "stamp (ns), stamp (s), exposure (ms)");
  AslExposures exposures;
  exposures.file = file;
  while (in.nextLine()) {
    const std::int64_t stamp = in.stamp("nanoseconds", 0);
    const std::int64_t rounded = in.stamp("seconds", 9);
    const char* const at = in.place();
    const std::int64_t exposure = in.stamp("milliseconds", 6);
    if (exposure < 0) in.fail(at, "the exposure is negative, expected milliseconds");
    in.endLine();
    exposures.exact[stamp] = exposure;
    exposures.rounded[rounded] = exposure;
  }
  return exposures;
}

std::vector<AslExposures> readAllExposures(Asl& asl) {
  std::vector<AslExposures> all;
  for (std::size_t number : asl.cameras) {
    const std::string file = "dso/cam" + std::to_string(number) + "/times.txt";
    const bool is_there = asl.tree->has(file);
    if (!is_there) asl.sequence.remarks.say("there is no " + file + ": exposures are not known");
    all.push_back(is_there ? readExposures(asl, file) : AslExposures());
  }
  return all;
}

const char* const kCameras = "dso/camchain.yaml";

// Kalibr's files in dso/; without them what sensor.yaml had, if there was one.
void takeKalibrsFiles(Asl& asl, bool is_replaced) {
  Remarks& remarks = asl.sequence.remarks;
  CalibrationOptions options;
  options.format = "kalibr";
  for (const std::string file : {kCameras, "dso/imu_config.yaml"}) {
    if (!asl.tree->has(file)) {
      remarks.say("there is no " + file);
      continue;
    }
    try {
      takeCalibration(asl, calibrationIn(*asl.tree, file, remarks, options), file);
    } catch (const ParseError& error) {
      if (!is_replaced || file != kCameras) throw;
      remarks.say(std::string("a file that the parameter calibration replaces was not used: ") +
                  error.what());
    }
  }
}

std::unique_ptr<Dataset> openTumVi(const std::string& path, const Svar& parameters) {
  Asl asl = openAsl(path, parameters);
  DatasetInfo& info = asl.sequence.info;
  info.format = "tumvi";
  if (info.name.compare(0, 8, "dataset-") == 0) {  // as all archives are called
    info.licence = "TUM VI, TU Munich: CC BY 4.0; cite Schubert et al., IROS 2018";
  }
  info.body = "the IMU";
  info.clock = "POSIX time of the recording computer, in nanoseconds";
  const bool is_replaced = isCalibrationOfUser(asl);
  readAslSensors(asl, is_replaced || asl.tree->has(kCameras));
  takeKalibrsFiles(asl, is_replaced);
  takeCalibrationOfUser(asl, "EquiDistant");
  readAslTruth(asl);
  const std::vector<AslExposures> exposures = readAllExposures(asl);
  return deliverAsl(std::move(asl), exposures);
}

}  // namespace
}  // namespace reading

DatasetFactory tumViFactory() {
  DatasetFactory factory;
  factory.name = "tumvi";
  factory.description = "TUM VI: a fisheye pair with exposures, IMU, motion capture";
  factory.parameters = reading::aslParameters();
  factory.recognizes = reading::recognizesAs(factory.name);
  factory.open = reading::openTumVi;
  return factory;
}

}  // namespace v1
}  // namespace gslam
