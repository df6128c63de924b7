#include "asl.h"

#include <gslam/base/error.h>
#include <gslam/core/detail/field_reader.h>

#include <algorithm>
#include <filesystem>
#include <utility>

#include "../reading/decode.h"
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

std::vector<std::size_t> cameraNumbersOf(const std::string& text) {
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
  std::vector<std::size_t> wanted = cameraNumbersOf(text);
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

// Where the user names mav0, the tree of the folder around it, which may have more than mav0; else,
// or where that folder cannot be looked at, none.
std::shared_ptr<const FileTree> treeAround(const FileTree& tree) {
  std::error_code problem;
  if (tree.baseName() != "mav0" || !std::filesystem::is_directory(tree.root(), problem)) return {};
  std::filesystem::path path = std::filesystem::path(tree.root()).lexically_normal();
  if (path.filename().empty()) path = path.parent_path();  // of "mav0/."
  if (path.filename() != "mav0") {                         // "." inside of it
    path = std::filesystem::absolute(tree.root(), problem).lexically_normal();
    if (path.filename().empty()) path = path.parent_path();
  }
  const std::string around = path.parent_path().string();
  try {
    std::shared_ptr<const FileTree> found = FileTree::open(around.empty() ? "." : around);
    if (isMav(*found, "mav0")) return found;
  } catch (const FileError&) {
    // mav0 alone is a sequence as well
  }
  return {};
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

// One camera by its sensor.yaml.
CameraSensor readCamera(const Asl& asl, std::size_t i, Remarks& remarks) {
  CameraSensor sensor;
  const std::string file = asl.cameraFolder(i) + "sensor.yaml";
  if (!asl.tree->has(file)) return sensor;
  CalibrationOptions options;
  options.format = "euroc";
  const Calibration found = calibrationIn(*asl.tree, file, remarks, options);
  if (found.rig.cameras.empty()) {
    throw ParseError(asl.tree->nameOf(file), 0, 0, "is of no camera, expected one");
  }
  return found.rig.cameras[0];
}

// What is left of a sensor.yaml that has no camera: where that is.
CameraSensor readPlace(const Asl& asl, std::size_t i, const ParseError& error, Remarks& remarks) {
  CameraSensor sensor;
  std::string place = "its T_BS was taken";
  try {
    sensor.T_body_camera = placeOfSensor(asl, "cam" + std::to_string(asl.cameras[i]));
  } catch (const ParseError&) {
    place = "its T_BS was taken to be the identity";
  }
  remarks.say(std::string("of a file that another calibration replaces ") + place + ", since " +
              error.what());
  return sensor;
}

// The first camera that both the dataset and a calibration have; the number of cameras: none.
std::size_t firstOfBoth(const Asl& asl, const std::vector<CameraSensor>& from) {
  const auto first = std::find_if(asl.cameras.begin(), asl.cameras.end(),
                                  [&](std::size_t number) { return number < from.size(); });
  return static_cast<std::size_t>(first - asl.cameras.begin());
}

// Whether a camera is not where the first one is: files that do not say its place have it there.
bool isApart(const std::vector<CameraSensor>& cameras, std::size_t i) {
  return !cameras[i].T_body_camera.isApprox(cameras[0].T_body_camera, 1e-12);
}

// Whether a calibration says where a camera is: by the inertial unit, or by another camera.
bool hasPlace(const Calibration& calibration, std::size_t number) {
  const std::vector<CameraSensor>& cameras = calibration.rig.cameras;
  if (number > 0) return isApart(cameras, number);
  if (calibration.body == "the IMU") return true;
  for (std::size_t i = 1; i < cameras.size(); ++i) {
    if (isApart(cameras, i)) return true;
  }
  return false;
}

// Sets exposures of images by stamps that are at most so many nanoseconds apart.
// @return which images have one now
std::vector<bool> setExposures(std::vector<ListedImage>& images,
                               const std::map<std::int64_t, std::int64_t>& by_stamp,
                               std::int64_t apart) {
  std::vector<bool> is_set(images.size());
  for (std::size_t i = 0; i < images.size(); ++i) {
    const auto found = by_stamp.lower_bound(images[i].stamp - apart);
    if (found == by_stamp.end() || found->first > images[i].stamp + apart) continue;
    images[i].exposure = found->second;
    is_set[i] = true;
  }
  return is_set;
}

void addExposures(std::vector<ListedImage>& images, const AslExposures& exposures,
                  Remarks& remarks) {
  if (exposures.file.empty()) return;
  const auto hasAny = [](const std::vector<bool>& is_set) {
    return std::find(is_set.begin(), is_set.end(), true) != is_set.end();
  };
  std::vector<bool> is_set = setExposures(images, exposures.exact, 0);
  if (!hasAny(is_set)) {
    // As floating-point numbers, seconds since 1970 are exact to less than a microsecond.
    is_set = setExposures(images, exposures.rounded, 1000);
    if (hasAny(is_set)) {
      remarks.say("the nanoseconds of " + exposures.file +
                  " are not those of the images: exposures are by its seconds");
    }
  }
  for (std::size_t i = 0; i < images.size(); ++i) {
    if (!is_set[i]) {
      remarks.skip("exposures that " + exposures.file + " does not have", images[i].file);
    }
  }
}

// What the first image of the first camera is like; of size 0 where there is none.
ImageShape shapeOfImages(const Asl& asl) {
  const std::string folder = joined(asl.cameraFolder(0), "data");
  for (const std::string& name : asl.tree->files(folder)) {
    if (isImageName(name)) return shapeOf(readImage(*asl.tree, joined(folder, name)));
  }
  return ImageShape();
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
  const std::string folder =
      onlyFolder(*tree, "euroc",
                 "has no cam0/data.csv, expected mav0 with cam0, or a folder or archive around it");
  asl.tree = below(tree, folder);
  if (const auto around = folder.empty() ? treeAround(*tree) : nullptr) asl.tree = around;
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

bool isCalibrationOfUser(const Asl& asl) {
  return !asl.parameters.get<std::string>("calibration").empty();
}

void readAslSensors(Asl& asl, bool is_replaced) {
  SensorRig& rig = asl.sequence.info.sensors;
  Remarks& remarks = asl.sequence.remarks;
  for (std::size_t i = 0; i < asl.cameras.size(); ++i) {
    CameraSensor sensor;
    try {
      sensor = readCamera(asl, i, remarks);
    } catch (const ParseError& error) {
      if (!is_replaced) throw;
      sensor = readPlace(asl, i, error, remarks);
    }
    sensor.name = "cam" + std::to_string(asl.cameras[i]);
    rig.cameras.push_back(sensor);
  }
  readImuSamples(asl);
  const std::string file = asl.file("imu0/sensor.yaml");
  if (!rig.has_imu || !asl.tree->has(file)) return;
  CalibrationOptions options;
  options.format = "euroc";
  const Calibration found = calibrationIn(*asl.tree, file, remarks, options);
  if (!found.rig.has_imu) {
    throw ParseError(asl.tree->nameOf(file), 0, 0, "is of no IMU, expected one");
  }
  rig.imu = found.rig.imu;
}

void takeCalibration(Asl& asl, const Calibration& calibration, const std::string& file) {
  SensorRig& rig = asl.sequence.info.sensors;
  Remarks& remarks = asl.sequence.remarks;
  if (calibration.rig.imu.gyro_noise > 0) takeNoise(calibration.rig.imu, rig.imu);
  const std::vector<CameraSensor>& from = calibration.rig.cameras;
  if (from.empty()) return;
  const bool is_by_imu = calibration.body == "the IMU";
  const std::size_t reference = firstOfBoth(asl, from);
  // Takes the calibration's body to the dataset's.
  SE3d anchor = rig.imu.T_body_imu;
  if (!is_by_imu && reference < asl.cameras.size()) {
    anchor =
        rig.cameras[reference].T_body_camera * from[asl.cameras[reference]].T_body_camera.inverse();
  }
  for (std::size_t i = 0; i < asl.cameras.size(); ++i) {
    const std::size_t number = asl.cameras[i];
    if (number >= from.size()) {
      remarks.say(file + " has no camera " + std::to_string(number));
      continue;
    }
    rig.cameras[i].camera = from[number].camera;
    if (hasPlace(calibration, number)) {
      rig.cameras[i].T_body_camera = anchor * from[number].T_body_camera;
    }
  }
  if (is_by_imu || reference == asl.cameras.size()) return;
  const bool has_pair = hasPlace(calibration, 0);
  remarks.say(file + " does not say where cameras are by the IMU: " +
              (has_pair ? rig.cameras[reference].name + " stays where the dataset has it"
                        : "they stay where the dataset has them"));
}

void takeCalibrationOfUser(Asl& asl, const std::string& bare_model) {
  if (!isCalibrationOfUser(asl)) return;
  const std::string path = asl.parameters.get<std::string>("calibration");
  const ImageShape shape = shapeOfImages(asl);
  CalibrationOptions options;
  options.width = shape.width;
  options.height = shape.height;
  options.bare_model = bare_model;
  const Calibration calibration = readCalibration(path, options);
  for (const std::string& remark : calibration.remarks) {
    asl.sequence.remarks.say(path + ": " + remark);
  }
  takeCalibration(asl, calibration, path);
}

std::unique_ptr<Dataset> deliverAsl(Asl asl, const std::vector<AslExposures>& exposures) {
  const std::int64_t tolerance = toleranceOf(asl.parameters, 0, 3600);
  Sequence& sequence = asl.sequence;
  const std::string list = asl.parameters.get<std::string>("list");
  std::vector<std::vector<ListedImage>> images;
  for (std::size_t i = 0; i < asl.cameras.size(); ++i) {
    const std::string folder = asl.cameraFolder(i);
    images.push_back(
        readImageList(*asl.tree, folder + list, StampUnit::nanoseconds, folder + "data"));
    tidy(images.back(), *asl.tree, folder + list, sequence.remarks);
    if (!exposures.empty()) addExposures(images.back(), exposures[i], sequence.remarks);
  }
  for (const CameraSensor& camera : sequence.info.sensors.cameras) {
    if (!camera.camera.isValid()) {
      sequence.remarks.say("camera " + camera.name + " is not calibrated: nothing says its model");
    }
  }
  std::vector<std::string> names = makeFrames(sequence, images, tolerance);
  loadImageFiles(sequence, {asl.tree, std::move(names)});
  return deliver(std::move(sequence), prefetchOf(asl.parameters));
}

}  // namespace reading
}  // namespace v1
}  // namespace gslam
