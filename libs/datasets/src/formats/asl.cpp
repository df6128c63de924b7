#include "asl.h"

#include <gslam/base/error.h>
#include <gslam/core/detail/field_reader.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <utility>

#include "../reading/looks_like.h"

namespace gslam {
inline namespace v1 {
namespace reading {
namespace {

// The number of "cam12"; -1 for another name.
int cameraNumber(const std::string& name) {
  if (name.compare(0, 3, "cam") != 0 || name.size() < 4 || name.size() > 6) return -1;
  int number = 0;
  for (std::size_t i = 3; i < name.size(); ++i) {
    if (name[i] < '0' || name[i] > '9') return -1;
    number = 10 * number + (name[i] - '0');
  }
  return number;
}

std::vector<std::size_t> camerasIn(const FileTree& tree, const std::string& mav) {
  std::vector<std::size_t> numbers;
  for (const std::string& name : tree.folders(mav)) {
    const int number = cameraNumber(name);
    if (number >= 0) numbers.push_back(static_cast<std::size_t>(number));
  }
  std::sort(numbers.begin(), numbers.end());
  return numbers;
}

bool isMav(const FileTree& tree, const std::string& folder) {
  const std::vector<std::size_t> cameras = camerasIn(tree, folder);
  return std::any_of(cameras.begin(), cameras.end(), [&](std::size_t number) {
    const std::string camera = joined(folder, "cam" + std::to_string(number));
    return tree.hasFolder(joined(camera, "data")) || tree.has(joined(camera, "data.csv"));
  });
}

// "0,1" or, from a command line, 0.
std::string textOf(const Svar& parameters, const std::string& name) {
  const Svar value = parameters[name];
  return value.type() == SvarType::integer ? std::to_string(value.as<std::int64_t>())
                                           : value.as<std::string>();
}

std::vector<std::size_t> numbersOf(const std::string& text) {
  std::vector<std::size_t> numbers;
  std::size_t begin = 0;
  while (begin <= text.size()) {
    const std::size_t end = std::min(text.find(',', begin), text.size());
    const std::string word = text.substr(begin, end - begin);
    const bool is_number =
        !word.empty() && word.size() < 4 && word.find_first_not_of("0123456789") == word.npos;
    if (!is_number) {
      throw ArgumentError("cameras", "is '" + text + "', expected numbers such as 0 or 0,1");
    }
    numbers.push_back(std::stoul(word));
    begin = end + 1;
  }
  return numbers;
}

std::vector<std::size_t> wantedCameras(const Asl& asl) {
  std::vector<std::size_t> all = camerasIn(*asl.tree, asl.mav);
  const std::string text = textOf(asl.parameters, "cameras");
  if (text.empty()) return all;
  std::vector<std::size_t> wanted = numbersOf(text);
  for (auto number = wanted.begin(); number != wanted.end(); ++number) {
    const bool is_there = std::find(all.begin(), all.end(), *number) != all.end();
    if (is_there && std::find(wanted.begin(), number, *number) == number) continue;
    std::string names;
    for (std::size_t each : all) {
      names += names.empty() ? "" : ",";
      names += std::to_string(each);
    }
    throw ArgumentError("cameras", "is '" + text + "', expected some of " + names +
                                       ", each once, in " + asl.tree->root());
  }
  return wanted;
}

// Of a sequence whose folder is named "mav0" the name of the folder around it.
std::string sequenceName(const FileTree& tree) {
  if (tree.baseName() != "mav0") return tree.baseName();
  std::error_code error;
  std::filesystem::path path = std::filesystem::absolute(tree.root(), error).lexically_normal();
  if (path.filename().empty()) path = path.parent_path();  // of "mav0/."
  return path.parent_path().filename().string();
}

void readImuSamples(Asl& asl) {
  const std::string file = asl.file("imu0/data.csv");
  SensorRig& rig = asl.sequence.info.sensors;
  if (!asl.tree->has(file)) {
    asl.sequence.remarks.say("there is no " + file + ": frames have no inertial samples");
    return;
  }
  rig.has_imu = true;
  const std::string text = asl.tree->text(file), name = asl.tree->nameOf(file);
  detail::FieldReader in(text, name,
                         "stamp (ns), angular velocity x y z (rad/s), acceleration x y z (m/s^2)");
  asl.sequence.imu.reserve(text.size() / 80);
  while (in.nextLine()) {
    ImuSample sample;
    sample.stamp = in.stamp("nanoseconds", 0);
    for (std::size_t i = 0; i < 3; ++i) sample.gyro[i] = in.number("the angular velocity");
    for (std::size_t i = 0; i < 3; ++i) sample.accel[i] = in.number("the acceleration");
    in.endLine();
    asl.sequence.imu.push_back(sample);
  }
  sortByStamp(asl.sequence.imu, file, asl.sequence.remarks);
  if (asl.sequence.imu.empty()) asl.sequence.remarks.say(file + " has no samples");
}

void takeNoise(const ImuCalibration& from, ImuCalibration& imu) {
  imu.gyro_noise = from.gyro_noise;
  imu.accel_noise = from.accel_noise;
  imu.gyro_bias_walk = from.gyro_bias_walk;
  imu.accel_bias_walk = from.accel_bias_walk;
  if (from.rate > 0) imu.rate = from.rate;
}

}  // namespace

std::string Asl::cameraFolder(std::size_t i) const {
  return file("cam" + std::to_string(cameras[i])) + "/";
}

Svar aslParameters() {
  Svar parameters = commonParameters();
  parameters.set("cameras", "");
  parameters.set("list", "data.csv");
  parameters.set("tolerance", 0.0);
  parameters.set("calibration", "");
  parameters.set("truth", "");
  return parameters;
}

Asl openAsl(const std::string& path, const Svar& parameters) {
  Asl asl;
  asl.parameters = aslParameters().merged(parameters);
  const std::shared_ptr<const FileTree> tree = FileTree::open(path);
  // The folder around mav0 is met before mav0.
  asl.tree = below(tree, onlyFolder(*tree, "euroc",
                                    "has no cam0/data.csv, expected mav0 with cam0, or a folder or "
                                    "archive around it"));
  asl.mav = isMav(*asl.tree, "mav0") ? "mav0" : "";
  asl.sequence.info.name = sequenceName(*asl.tree);
  asl.cameras = wantedCameras(asl);
  return asl;
}

Calibration calibrationIn(const FileTree& tree, const std::string& file, Remarks& remarks,
                          const CalibrationOptions& options) {
  Calibration calibration = parseCalibration(tree.text(file), tree.nameOf(file), options);
  for (const std::string& remark : calibration.remarks) remarks.say(file + ": " + remark);
  return calibration;
}

void readAslSensors(Asl& asl) {
  CalibrationOptions options;
  options.format = "euroc";
  SensorRig& rig = asl.sequence.info.sensors;
  Remarks& remarks = asl.sequence.remarks;
  for (std::size_t i = 0; i < asl.cameras.size(); ++i) {
    CameraSensor sensor;
    const std::string file = asl.cameraFolder(i) + "sensor.yaml";
    if (asl.tree->has(file)) {
      const Calibration found = calibrationIn(*asl.tree, file, remarks, options);
      if (found.rig.cameras.empty()) {
        throw ParseError(asl.tree->nameOf(file), 0, 0, "is of no camera, expected one");
      }
      sensor = found.rig.cameras[0];
    }
    sensor.name = "cam" + std::to_string(asl.cameras[i]);
    rig.cameras.push_back(sensor);
  }
  readImuSamples(asl);
  const std::string file = asl.file("imu0/sensor.yaml");
  if (!rig.has_imu || !asl.tree->has(file)) return;
  const Calibration found = calibrationIn(*asl.tree, file, remarks, options);
  if (!found.rig.has_imu) {
    throw ParseError(asl.tree->nameOf(file), 0, 0, "is of no IMU, expected one");
  }
  rig.imu = found.rig.imu;
}

void takeCalibration(Asl& asl, const Calibration& calibration, const std::string& file) {
  SensorRig& rig = asl.sequence.info.sensors;
  Remarks& remarks = asl.sequence.remarks;
  const std::vector<CameraSensor>& from = calibration.rig.cameras;
  for (std::size_t i = 0; i < asl.cameras.size() && !from.empty(); ++i) {
    const std::size_t number = asl.cameras[i];
    if (number >= from.size()) {
      remarks.say(file + " has no camera " + std::to_string(number));
      continue;
    }
    rig.cameras[i].camera = from[number].camera;
    rig.cameras[i].T_body_camera = rig.imu.T_body_imu * from[number].T_body_camera;
  }
  if (!from.empty() && calibration.body != "the IMU") {
    remarks.say(file + " does not say where cameras are by the IMU: they are placed as if " +
                (calibration.body.empty() ? std::string("all") : calibration.body) +
                " were where it is");
  }
  if (calibration.rig.imu.gyro_noise > 0) takeNoise(calibration.rig.imu, rig.imu);
}

bool takeCalibrationOfUser(Asl& asl) {
  const std::string path = asl.parameters.get<std::string>("calibration");
  if (path.empty()) return false;
  const Calibration calibration = readCalibration(path);
  for (const std::string& remark : calibration.remarks) {
    asl.sequence.remarks.say(path + ": " + remark);
  }
  takeCalibration(asl, calibration, path);
  return true;
}

std::unique_ptr<Dataset> deliverAsl(
    Asl asl, const std::vector<std::map<std::int64_t, std::int64_t>>& exposures) {
  const double tolerance = asl.parameters.get<double>("tolerance");
  if (!(tolerance >= 0 && tolerance < 3600)) {
    throw ArgumentError("tolerance",
                        "is " + std::to_string(tolerance) + ", expected 0 to 3600 seconds");
  }
  Sequence& sequence = asl.sequence;
  const std::string list = asl.parameters.get<std::string>("list");
  std::vector<std::vector<ListedImage>> images;
  for (std::size_t i = 0; i < asl.cameras.size(); ++i) {
    const std::string folder = asl.cameraFolder(i);
    images.push_back(
        readImageList(*asl.tree, folder + list, StampUnit::nanoseconds, folder + "data"));
    tidy(images.back(), *asl.tree, folder + list, sequence.remarks);
    if (exposures.empty()) continue;
    for (ListedImage& image : images.back()) {
      const auto found = exposures[i].find(image.stamp);
      if (found != exposures[i].end()) image.exposure = found->second;
    }
  }
  for (const CameraSensor& camera : sequence.info.sensors.cameras) {
    if (!camera.camera.isValid()) {
      sequence.remarks.say("camera " + camera.name + " is not calibrated: nothing says its model");
    }
  }
  std::vector<std::string> names = makeFrames(sequence, images, std::llround(tolerance * 1e9));
  loadImageFiles(sequence, {asl.tree, std::move(names)});
  return deliver(std::move(sequence), prefetchOf(asl.parameters));
}

}  // namespace reading
}  // namespace v1
}  // namespace gslam
