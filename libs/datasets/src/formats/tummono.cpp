// TUM monoVO.
//
// J. Engel, V. Usenko, D. Cremers, "A photometrically calibrated benchmark for monocular visual
// odometry", arXiv:1607.02555, and vision.in.tum.de/data/datasets/mono-dataset. A sequence has
//
//     images.zip, or images/   00000.jpg, ...
//     times.txt                id, stamp in s, exposure in ms
//     camera.txt               as DSO reads it
//     groundtruthSync.txt      poses, NaN but at the begin and the end
//     pcalib.txt vignette.png  inverse response and vignette
#include <gslam/base/error.h>
#include <gslam/core/detail/field_reader.h>
#include <gslam/core/trajectory_file.h>
#include <gslam/datasets/calibration_file.h>
#include <gslam/datasets/formats.h>

#include <algorithm>
#include <map>
#include <memory>
#include <utility>

#include "../reading/image_list.h"
#include "../reading/looks_like.h"
#include "asl.h"
#include "camera_parameters.h"
#include "photometric_correction.h"

namespace gslam {
inline namespace v1 {
namespace reading {
namespace {

enum class Photometric { none, u8, f32 };

Photometric photometricOf(const Svar& parameters) {
  const std::string word = parameters.get<std::string>("photometric");
  if (word == "none") return Photometric::none;
  if (word == "u8") return Photometric::u8;
  if (word == "f32") return Photometric::f32;
  throw ArgumentError("photometric", "is '" + word + "', expected none, u8 or f32");
}

// Whether a name is that of one of the 50 sequences: others may write the layout, too.
bool isPublished(const std::string& name) {
  const std::string begin = "sequence_";
  if (name.compare(0, begin.size(), begin) != 0 || name.size() != begin.size() + 2) return false;
  const std::string number = name.substr(begin.size());
  return number.find_first_not_of("0123456789") == number.npos && number >= "01" && number <= "50";
}

// Poses without the lines that have none, which keep their place for what errors say.
std::string withoutNan(const std::string& text, std::size_t& without) {
  std::string result;
  for (std::size_t at = 0; at < text.size();) {
    const std::size_t end = std::min(text.find('\n', at), text.size());
    const std::string line = text.substr(at, end - at);
    const bool is_nan = line.find("NaN") != line.npos || line.find("nan") != line.npos;
    const std::size_t first = line.find_first_not_of(" \t\r");
    const bool is_comment = first != line.npos && line[first] == '#';
    if (is_nan && !is_comment) {
      ++without;
    } else {
      result += line;
    }
    result += '\n';
    at = end + 1;
  }
  return result;
}

class TumMono {
 public:
  TumMono(std::shared_ptr<const FileTree> tree, const Svar& parameters)
      : tree_(std::move(tree)), parameters_(parameters), photometric_(photometricOf(parameters)) {
    DatasetInfo& info = sequence_.info;
    info.name = tree_->baseName();
    info.format = "tummono";
    if (isPublished(info.name)) {
      info.licence = "TUM monoVO, TU Munich: CC BY 4.0; cite Engel et al., arXiv:1607.02555";
    }
    info.body = "the camera";
    info.clock = "POSIX time of the recording computer, in seconds";
    findImages();
  }

  std::unique_ptr<Dataset> open() {
    std::vector<ListedImage> images = readTimes();
    tidy(images, *images_, "times.txt", sequence_.remarks);
    readCamera(images);
    readTruth();
    std::vector<std::string> names = makeFrames(sequence_, {images}, 0);
    loadImageFiles(sequence_, {images_, names});
    correctImages(std::move(names));
    return deliver(std::move(sequence_), prefetchOf(parameters_));
  }

 private:
  // images/ counts before images.zip: whoever unpacked that left it.
  void findImages() {
    if (tree_->hasFolder("images")) {
      images_ = below(tree_, "images");
    } else if (tree_->has("images.zip")) {
      try {
        images_ = FileTree::open(tree_->nameOf("images.zip"));
      } catch (const FileError& error) {
        throw FileError(error.path(),
                        "cannot be opened; in an archive it has to be unpacked first");
      }
      const Place place = findFolder(*images_, 2, [](const FileTree& tree, const std::string& at) {
        for (const std::string& name : tree.files(at)) {
          if (isImageName(name)) return true;
        }
        return false;
      });
      images_ = below(images_, place.folder);
    } else {
      throw FileError(tree_->root(), "has neither images/ nor images.zip");
    }
  }

  void readCamera(const std::vector<ListedImage>& images) {
    CameraSensor sensor;
    sensor.name = "camera";
    CalibrationOptions options;
    options.format = "dso";
    if (overrideCamera(parameters_, sensor, sequence_.remarks,
                       [&]() { return shapeOfFirst(*images_, images); })) {
      // as the user wants it
    } else if (tree_->has("camera.txt")) {
      const Calibration found = calibrationIn(*tree_, "camera.txt", sequence_.remarks, options);
      sensor.camera = found.rig.cameras[0].camera;
    } else {
      sequence_.remarks.say("there is no camera.txt: the camera is not calibrated");
    }
    sequence_.info.sensors.cameras.push_back(sensor);
  }

  // Files by their names without the ending, which are the ids of times.txt.
  std::map<std::string, std::string> imagesById() const {
    std::map<std::string, std::string> files;
    for (const std::string& name : images_->files("")) {
      if (isImageName(name)) files[name.substr(0, name.rfind('.'))] = name;
    }
    if (files.empty()) throw FileError(images_->root(), "has no images");
    return files;
  }

  std::vector<ListedImage> readTimes() {
    std::map<std::string, std::string> files = imagesById();
    const std::string text = tree_->text("times.txt"), name = tree_->nameOf("times.txt");
    detail::FieldReader in(text, name, "id, stamp (s), exposure (ms)");
    std::vector<ListedImage> images;
    while (in.nextLine()) {
      ListedImage image;
      image.line = in.line();
      const std::string id = in.word();
      in.skipWord();
      image.stamp = in.stamp("seconds", 9);
      const char* const at = in.place();
      if (!in.isLineEnd()) image.exposure = in.stamp("milliseconds", 6);
      if (image.exposure < 0) in.fail(at, "the exposure is negative, expected milliseconds");
      in.endLine();
      const auto file = files.find(id);
      image.file = file == files.end() ? id + ".jpg" : file->second;
      if (file != files.end()) files.erase(file);
      images.push_back(std::move(image));
    }
    for (const auto& file : files) {
      sequence_.remarks.skip("images without a line in times.txt", file.second);
    }
    return images;
  }

  void readTruth() {
    const std::string file = "groundtruthSync.txt";
    if (!tree_->has(file)) {
      sequence_.remarks.say("there is no " + file + ": there is no ground truth");
      return;
    }
    TrajectoryFileOptions options;
    options.format = TrajectoryFormat::tum;
    options.may_be_empty = true;
    std::size_t without = 0;
    const std::string text = withoutNan(tree_->text(file), without);
    sequence_.info.ground_truth = parseTrajectory(text, tree_->nameOf(file), options);
    if (without == 0) return;
    sequence_.remarks.say(std::to_string(without) + " of " +
                          std::to_string(without + sequence_.info.ground_truth.size()) +
                          " lines of " + file +
                          " have no pose: there is ground truth at the begin and the end only");
  }

  void correctImages(std::vector<std::string> names) {
    if (photometric_ == Photometric::none) return;
    const auto correction =
        std::make_shared<const PhotometricCorrection>(readPhotometricCorrection(*tree_, ""));
    if (correction->darkPixels() > 0) {
      sequence_.remarks.say("vignette.png is 0 at " + std::to_string(correction->darkPixels()) +
                            " pixels: they are 0 in all images");
    }
    sequence_.remarks.say("images are corrected by pcalib.txt and vignette.png");
    const PixelType type = photometric_ == Photometric::u8 ? PixelType::u8 : PixelType::f32;
    const auto all = std::make_shared<const std::vector<std::string>>(std::move(names));
    const auto load = std::move(sequence_.load);
    const std::shared_ptr<const FileTree> images = images_;
    const auto corrected = [=](std::size_t frame, std::size_t camera) {
      return correction->apply(load(frame, camera), type, images->nameOf((*all)[frame]));
    };
    (void)corrected(0, 0);  // what does not fit is said now
    sequence_.load = corrected;
  }

  std::shared_ptr<const FileTree> tree_, images_;
  Svar parameters_;
  Photometric photometric_;
  Sequence sequence_;
};

std::unique_ptr<Dataset> openTumMono(const std::string& path, const Svar& parameters) {
  std::shared_ptr<const FileTree> tree = FileTree::open(path);
  const std::string folder =
      onlyFolder(*tree, "tummono", "has neither images/ nor images.zip, expected TUM monoVO");
  const Svar all = tumMonoFactory().parameters.merged(parameters);
  return TumMono(below(std::move(tree), folder), all).open();
}

}  // namespace
}  // namespace reading

DatasetFactory tumMonoFactory() {
  DatasetFactory factory;
  factory.name = "tummono";
  factory.description = "TUM monoVO: one camera with exposures and photometric calibration";
  factory.parameters = reading::commonParameters();
  reading::addCameraParameters(factory.parameters);
  factory.parameters.set("photometric", "none");
  factory.recognizes = reading::recognizesAs(factory.name);
  factory.open = reading::openTumMono;
  return factory;
}

}  // namespace v1
}  // namespace gslam
