// NPU DroneMap, as the reader in the original GSLAM describes it (DatasetNPUDroneMap.cpp there, and
// Bu et al., "Map2DFusion: Real-time Incremental UAV Image Mosaicing based on Monocular SLAM", IROS
// 2016, which published the data). A sequence is one of
//
//     config.cfg  trajectory.txt  rgb/STAMP.jpg      keyframes, with the poses that SLAM and GPS
//     gave config.cfg  frames.txt  gps.txt                all frames, with the receiver's positions
//
// trajectory.txt has "STAMP tx ty tz qx qy qz qw", east, north and up of GPS.Origin; frames.txt
// "STAMP,FILE"; gps.txt "STAMP,LONGITUDE,LATITUDE,ALTITUDE,...". A file NAME.npudronemap beside
// them stands for the folder; one with "mono" in its name for the images without gps.txt.
#include <gslam/core/detail/field_reader.h>
#include <gslam/core/geodesy.h>
#include <gslam/core/trajectory_file.h>
#include <gslam/datasets/formats.h>

#include <map>
#include <sstream>
#include <utility>

#include "../reading/image_list.h"
#include "../reading/looks_like.h"
#include "camera_parameters.h"
#include "gnss_samples.h"

namespace gslam {
inline namespace v1 {
namespace reading {
namespace {

constexpr const char* kConfig = "config.cfg";

std::string trimmed(const std::string& text) {
  const char* const blanks = " \t\r\"";
  const std::size_t begin = text.find_first_not_of(blanks);
  if (begin == std::string::npos) return "";
  return text.substr(begin, text.find_last_not_of(blanks) - begin + 1);
}

struct Setting {
  std::string value;
  std::size_t line = 0;
};

// Lines "Name = value", where ?= stands for =, too. Commands such as include are passed over.
std::map<std::string, Setting> readConfig(const FileTree& tree) {
  std::istringstream in(tree.text(kConfig));
  std::map<std::string, Setting> settings;
  std::string line;
  for (std::size_t number = 1; std::getline(in, line); ++number) {
    line = trimmed(line.substr(0, std::min(line.find('#'), line.find("//"))));
    const std::size_t equals = line.find('=');
    if (equals == std::string::npos || equals == 0) continue;
    const std::size_t end = line[equals - 1] == '?' ? equals - 1 : equals;
    settings[trimmed(line.substr(0, end))] = {trimmed(line.substr(equals + 1)), number};
  }
  return settings;
}

// Of "[a b c]", "[a,b,c]" or without the brackets.
std::vector<double> configuredNumbers(const FileTree& tree, const std::string& name,
                                      const Setting& setting) {
  std::string text(setting.line - 1, '\n');  // so that errors name the line
  for (const char c : setting.value) text += c == '[' || c == ']' ? ' ' : c;
  const std::string source = tree.nameOf(kConfig);
  detail::FieldReader in(text, source, "numbers");
  std::vector<double> numbers;
  if (!in.nextLine()) return numbers;
  while (!in.isLineEnd()) numbers.push_back(in.number(name.c_str()));
  return numbers;
}

// Width, height, then pinhole, ATAN (relative to the size where below 1) or radtan with k3.
Camera configuredCamera(const FileTree& tree, const std::string& name, const Setting& setting) {
  std::vector<double> p = configuredNumbers(tree, name, setting);
  const auto fail = [&](const std::string& problem) {
    throw ParseError(tree.nameOf(kConfig), setting.line, 0, name + " " + problem);
  };
  if (p.size() != 6 && p.size() != 7 && p.size() != 11) {
    fail("has " + std::to_string(p.size()) +
         " numbers, expected width, height, fx, fy, cx, cy and "
         "no more, one of ATAN, or k1, k2, p1, p2, k3");
  }
  if (!(p[0] >= 1 && p[0] <= 1e6 && p[1] >= 1 && p[1] <= 1e6)) fail("has no size of images");
  if (p.size() == 7 && p[2] < 1 && p[3] < 1) {
    for (std::size_t i = 2; i < 6; ++i) p[i] *= p[i % 2];
  }
  const char* const model = p.size() == 6 ? "pinhole" : p.size() == 7 ? "fov" : "radtan";
  try {
    return Camera::fromParameters(model, int(p[0]), int(p[1]), {p.begin() + 2, p.end()});
  } catch (const ArgumentError& error) {
    fail(std::string("is no camera: ") + error.what());
  }
  return Camera();
}

class DroneMap {
 public:
  DroneMap(std::shared_ptr<const FileTree> tree, bool with_gps, const Svar& parameters)
      : tree_(std::move(tree)), with_gps_(with_gps), parameters_(parameters) {
    if (tree_->has(kConfig)) settings_ = readConfig(*tree_);
    DatasetInfo& info = sequence_.info;
    info.name = tree_->baseName();
    info.format = "dronemap";
    info.licence = "NPU DroneMap dataset: for research; cite Map2DFusion (Bu et al., IROS 2016)";
    info.body = "the camera";
    info.clock = "seconds as in the names of images and in frames.txt, from a start of its own";
    CameraSensor camera;
    camera.name = "camera";
    info.sensors.cameras.push_back(camera);
  }

  std::unique_ptr<Dataset> open() {
    std::vector<ListedImage> images;
    if (tree_->has("trajectory.txt")) {
      images = readKeyframes();
    } else {
      images = readImageList(*tree_, "frames.txt", StampUnit::seconds, "");
      tidy(images, *tree_, "frames.txt", sequence_.remarks);
      readGps();
    }
    setCamera(images);
    std::vector<std::string> names = makeFrames(sequence_, {images}, 0);
    loadImageFiles(sequence_, {tree_, std::move(names)});
    return deliver(std::move(sequence_), prefetchOf(parameters_));
  }

 private:
  std::vector<ListedImage> readKeyframes() {
    const std::string list = "trajectory.txt";
    sequence_.info.ground_truth =
        parseTrajectory(tree_->text(list), tree_->nameOf(list), TrajectoryFileOptions());
    std::vector<ListedImage> images = readImageList(*tree_, list, StampUnit::seconds, "rgb");
    std::istringstream in(tree_->text(list));
    std::string line;
    for (ListedImage& image : images) nameAfterStamp(in, image);
    tidy(images, *tree_, list, sequence_.remarks);
    std::string origin;
    if (settings_.count("GPS.Origin") != 0) {
      origin =
          ", whose origin is at longitude, latitude, altitude " + settings_["GPS.Origin"].value;
    }
    sequence_.remarks.say(
        "ground truth is trajectory.txt, which SLAM and GPS gave its authors: it is in metres "
        "east, "
        "north and up" +
        origin);
    return images;
  }

  // The images have the stamp as a name, as it stands in the list.
  void nameAfterStamp(std::istringstream& in, ListedImage& image) {
    std::string line;
    while (lines_read_ < image.line && std::getline(in, line)) ++lines_read_;
    std::istringstream words(line);
    std::string stamp;
    words >> stamp;
    for (const char* const ending : {".jpg", ".JPG", ".png"}) {
      image.file = "rgb/" + stamp + ending;
      if (tree_->has(image.file)) return;
    }
    image.file = "rgb/" + stamp + ".jpg";
  }

  void readGps() {
    const std::string file = "gps.txt";
    if (!with_gps_) return;
    if (!tree_->has(file)) {
      sequence_.remarks.say("there is no gps.txt: frames have no positions");
      return;
    }
    const std::string text = tree_->text(file), name = tree_->nameOf(file);
    detail::FieldReader in(text, name, "stamp, longitude, latitude, altitude");
    while (in.nextLine()) {
      const char* const at = in.place();
      const std::int64_t stamp = in.stamp("seconds", 9);
      const double longitude = in.number("longitude"), latitude = in.number("latitude"),
                   altitude = in.number("altitude");
      if (!isPlace(latitude, longitude)) in.fail(at, "is no place: expected longitude, latitude");
      sequence_.gnss.push_back(gnssSample(stamp, geodeticOfDegrees(latitude, longitude, altitude)));
    }
    sortByStamp(sequence_.gnss, file, sequence_.remarks);
    sequence_.info.sensors.has_gnss = !sequence_.gnss.empty();
  }

  void setCamera(const std::vector<ListedImage>& images) {
    CameraSensor& sensor = sequence_.info.sensors.cameras[0];
    if (overrideCamera(parameters_, sensor, sequence_.remarks,
                       [&]() { return shapeOfFirst(*tree_, images); })) {
      return;
    }
    const auto named = settings_.find("Video.CameraInName");
    const std::string name =
        (named == settings_.end() ? std::string("Camera") : named->second.value) + ".Paraments";
    const auto setting = settings_.find(name);
    if (setting != settings_.end()) {
      sensor.camera = configuredCamera(*tree_, name, setting->second);
    } else {
      sequence_.remarks.say("config.cfg has no '" + name + "': the camera is not calibrated");
    }
  }

  std::shared_ptr<const FileTree> tree_;
  bool with_gps_;
  Svar parameters_;
  std::map<std::string, Setting> settings_;
  std::size_t lines_read_ = 0;
  Sequence sequence_;
};

std::unique_ptr<Dataset> openDroneMap(const std::string& path, const Svar& parameters) {
  const std::string ending = ".npudronemap";
  const bool is_file = endsWith(path, ending);
  const std::string folder = is_file ? joined(folderOf(path), "") : path;
  std::shared_ptr<const FileTree> tree = FileTree::open(folder.empty() ? "." : folder);
  const Layout& layout = layoutOf("dronemap");
  const Place place = findFolder(*tree, layout.depth, layout.is_enough);
  if (!place.is_found) {
    throw FileError(tree->root(), "has no trajectory.txt and no frames.txt, expected NPU DroneMap");
  }
  const bool is_mono = is_file && nameIn(path).find("mono") != std::string::npos;
  return DroneMap(below(std::move(tree), place.folder), !is_mono, parameters).open();
}

}  // namespace
}  // namespace reading

DatasetFactory droneMapFactory() {
  DatasetFactory factory;
  factory.name = "dronemap";
  factory.description = "NPU DroneMap: photos from a drone, with positions or poses";
  factory.parameters = reading::commonParameters();
  reading::addCameraParameters(factory.parameters);
  factory.recognizes = reading::recognizesAs(factory.name);
  factory.open = reading::openDroneMap;
  return factory;
}

}  // namespace v1
}  // namespace gslam
