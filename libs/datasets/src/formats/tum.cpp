// TUM RGB-D.
//
// J. Sturm et al., "A benchmark for the evaluation of RGB-D SLAM systems", IROS 2012. The layout
// and the calibrations are those of its pages "File Formats" and "Intrinsic Camera Calibration of
// the Kinect". ETH3D's SLAM dataset has the same layout, with a calibration.txt.
#include <gslam/base/error.h>
#include <gslam/core/detail/field_reader.h>
#include <gslam/core/trajectory_file.h>
#include <gslam/datasets/formats.h>

#include <cmath>
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "../reading/file_tree.h"
#include "../reading/image_list.h"
#include "../reading/looks_like.h"
#include "../reading/second.h"
#include "../reading/sequence.h"
#include "camera_parameters.h"
#include "rgbd_camera.h"
#include "sequences.h"

namespace gslam {
inline namespace v1 {
namespace reading {
namespace {

// Of the colour cameras. The depth images of all have been corrected already, so that 5000 is right
// for them, and are registered to the colour images.
struct Published {
  const char* name;
  std::vector<double> values;
};
const std::vector<Published>& publishedCameras() {
  static const std::vector<Published> kCameras = {
      {"1", {517.3, 516.5, 318.6, 255.3, 0.2624, -0.9531, -0.0054, 0.0026, 1.1633}},
      {"2", {520.9, 521.0, 325.1, 249.7, 0.2312, -0.7849, -0.0033, -0.0001, 0.9172}},
      {"3", {535.4, 539.2, 320.1, 247.6}}};
  return kCameras;
}

constexpr int kPublishedWidth = 640, kPublishedHeight = 480;

Camera cameraOfValues(const std::vector<double>& values, const ImageShape& shape) {
  const Camera camera = Camera::fromParameters(values.size() > 4 ? "radtan" : "pinhole",
                                               kPublishedWidth, kPublishedHeight, values);
  const bool is_published = shape.width == kPublishedWidth && shape.height == kPublishedHeight;
  return is_published ? camera : camera.resized(shape.width, shape.height);
}

// Whether a text has words that end in a number, and no digit behind that.
bool hasNumbered(const std::string& text, const std::string& words) {
  for (std::size_t at = text.find(words); at != std::string::npos; at = text.find(words, at + 1)) {
    const std::size_t end = at + words.size();
    if (end == text.size() || text[end] < '0' || text[end] > '9') return true;
  }
  return false;
}

// Which of the three cameras a name speaks of: freiburg1, fr1.
const Published* publishedFor(const std::string& name) {
  const std::string padded = "_" + name + "_";
  for (const Published& camera : publishedCameras()) {
    const std::string number = camera.name;
    if (hasNumbered(padded, "_fr" + number) || hasNumbered(padded, "freiburg" + number)) {
      return &camera;
    }
  }
  return nullptr;
}

// What stands behind `# file: ` in the head of rgb.txt: the name of the recording, whatever the
// folder is called.
std::string recordingOf(const std::string& text) {
  const std::string head = text.substr(0, 500), key = "# file: '";
  const std::size_t begin = head.find(key);
  if (begin == std::string::npos) return "";
  const std::size_t end = head.find('\'', begin + key.size());
  return end == std::string::npos ? "" : head.substr(begin + key.size(), end - begin - key.size());
}

class TumReader {
 public:
  TumReader(const std::string& path, const Svar& parameters)
      : tree_(FileTree::open(path)), parameters_(parameters) {
    folder_ = onlyFolder(*tree_, "tum", "has no rgb.txt, which lists the images");
  }

  std::unique_ptr<Dataset> open() {
    DatasetInfo& info = sequence_.info;
    info.name = folder_.empty() ? tree_->baseName() : nameIn(folder_);
    info.format = "tum";
    info.body = "the colour camera";
    info.clock = "POSIX time of the recording computer";
    std::vector<std::vector<ListedImage>> lists = {listOf("rgb.txt")};
    sayIfIcl(lists[0]);
    addColour(lists[0][0].file);
    if (parameters_.get<bool>("depth", true)) addDepth(lists);
    const std::vector<std::string> names =
        makeFrames(sequence_, lists, toleranceOf(parameters_, 0.02, 10));
    loadImageFiles(sequence_, {tree_, names});
    readTruth();
    countAccelerations();
    sayUnread();
    return deliver(std::move(sequence_), prefetchOf(parameters_));
  }

 private:
  std::string below(const std::string& name) const { return joined(folder_, name); }
  std::string nameBelow(const std::string& name) const { return tree_->nameOf(below(name)); }

  std::vector<ListedImage> listOf(const std::string& list) {
    std::vector<ListedImage> images =
        readImageList(*tree_, below(list), StampUnit::seconds, folder_);
    if (images.empty()) throw FileError(nameBelow(list), "lists no image");
    tidy(images, *tree_, below(list), sequence_.remarks);
    if (images.empty()) throw FileError(nameBelow(list), "lists no image that exists");
    return images;
  }

  // ICL-NUIM's stamps are numbers of frames.
  void sayIfIcl(const std::vector<ListedImage>& images) {
    for (const ListedImage& image : images) {
      const bool is_frame = image.stamp >= 0 && image.stamp % kSecond == 0;
      if (!is_frame || image.stamp / kSecond >= 1000000) return;
    }
    sequence_.remarks.say(
        "all stamps are whole seconds: if they are numbers of frames of ICL-NUIM, whose poses are "
        "mirrored, icl:" +
        tree_->root() + " reads it so");
  }

  void addColour(const std::string& image) {
    const ImageShape shape = shapeOfFile(*tree_, image);
    CameraSensor colour = cameraOf("rgb", calibrationFor(shape));
    sequence_.info.sensors.cameras.push_back(std::move(colour));
  }

  Camera calibrationFor(const ImageShape& shape) {
    const Camera given = wantedCamera(parameters_, shape, sequence_.remarks);
    const std::string recording = recordingOf(tree_->text(below("rgb.txt")));
    const Published* published = publishedFor(recording);
    if (published == nullptr) published = publishedFor(sequence_.info.name);
    if (published != nullptr) sequence_.info.licence = "CC BY 4.0";
    if (given.isValid()) return given;
    if (tree_->has(below("calibration.txt"))) {
      return cameraOfText(tree_->text(below("calibration.txt")), nameBelow("calibration.txt"),
                          shape.width, shape.height);
    }
    if (published != nullptr) {
      sequence_.remarks.say(std::string("the calibration is the published one of freiburg") +
                            published->name);
      return cameraOfValues(published->values, shape);
    }
    sequence_.remarks.say(
        "neither the name nor rgb.txt says freiburg1, 2 or 3: the calibration is ROS's default, "
        "525 525 319.5 239.5, which is a guess; parameters camera and calibration set it");
    return cameraOfValues({525, 525, 319.5, 239.5}, shape);
  }

  void addDepth(std::vector<std::vector<ListedImage>>& lists) {
    if (!tree_->has(below("depth.txt"))) {
      sequence_.remarks.say("there is no depth.txt, and so no depth");
      return;
    }
    lists.push_back(listOf("depth.txt"));
    std::vector<CameraSensor>& cameras = sequence_.info.sensors.cameras;
    cameras.push_back(
        depthOf(cameras[0], *tree_, lists[1][0].file, depthFactorOf(parameters_, kTumDepthUnits)));
  }

  // Motion capture; stamps that were rounded stand there twice.
  void readTruth() {
    if (!tree_->has(below("groundtruth.txt"))) {
      sequence_.remarks.say("there is no groundtruth.txt");
      return;
    }
    const std::string text = tree_->text(below("groundtruth.txt"));
    const std::string source = nameBelow("groundtruth.txt");
    TrajectoryFileOptions options;
    options.format = TrajectoryFormat::tum;
    options.duplicates = DuplicateStamps::keep_first;
    options.may_be_empty = true;
    Trajectory& truth = sequence_.info.ground_truth;
    truth = parseTrajectory(text, source, options);
    std::size_t lines = 0;
    for (detail::FieldReader in(text, source, ""); in.nextLine();) ++lines;
    if (truth.empty()) sequence_.remarks.say("groundtruth.txt has no pose");
    if (lines > truth.size()) {
      sequence_.remarks.say("groundtruth.txt has the stamp of another before it in " +
                            countText(lines - truth.size(), "line") + ", skipped");
    }
  }

  // A sample of an inertial unit has an angular velocity, too, which nobody measured.
  std::size_t accelerations() const {
    const std::string text = tree_->text(below("accelerometer.txt"));
    const std::string source = nameBelow("accelerometer.txt");
    detail::FieldReader in(text, source, "timestamp ax ay az");
    std::size_t count = 0;
    for (; in.nextLine(); ++count) {
      (void)in.stamp("seconds", 9);
      for (const char* name : {"ax", "ay", "az"}) (void)in.number(name);
      in.endLine();
    }
    return count;
  }

  // A fault in what is not delivered is no reason to deliver nothing.
  void countAccelerations() {
    if (!tree_->has(below("accelerometer.txt"))) return;
    try {
      sequence_.remarks.say(
          countText(accelerations(), "acceleration") +
          " of accelerometer.txt are not delivered: the sensor measured no angular velocity, which "
          "inertial samples have");
    } catch (const Error& error) {
      sequence_.remarks.say("accelerometer.txt is not delivered, and has a fault: " +
                            std::string(error.what()));
    }
  }

  // ETH3D's SLAM dataset has an inertial unit and a second colour camera.
  void sayUnread() {
    const auto hasAny = [this](const char* name) {
      return tree_->has(below(name)) || tree_->hasFolder(below(name));
    };
    if (hasAny("imu.txt")) {
      sequence_.remarks.say("imu.txt was not read: frames have no inertial samples");
    }
    if (hasAny("rgb2.txt") || hasAny("rgb2")) {
      sequence_.remarks.say("rgb2, the second colour camera, was not read");
    }
  }

  std::shared_ptr<const FileTree> tree_;
  const Svar parameters_;
  std::string folder_;
  Sequence sequence_;
};

}  // namespace
}  // namespace reading

DatasetFactory tumFactory() {
  DatasetFactory factory;
  factory.name = "tum";
  factory.description = "TUM RGB-D: colour and depth of a Kinect, poses of motion capture";
  factory.parameters = reading::commonParameters();
  factory.parameters.set("depth", true);
  factory.parameters.set("tolerance", 0.02);
  factory.parameters.set("depth_factor", reading::kTumDepthUnits);
  reading::addCameraParameters(factory.parameters);
  factory.recognizes = reading::recognizesAs("tum");
  factory.open = [](const std::string& path, const Svar& parameters) {
    return reading::TumReader(path, parameters).open();
  };
  return factory;
}

}  // namespace v1
}  // namespace gslam
