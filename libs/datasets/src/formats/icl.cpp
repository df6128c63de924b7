// ICL-NUIM, in both of its forms: that which is compatible with TUM RGB-D (rgb/<i>.png,
// depth/<i>.png, associations.txt, <name>.gt.freiburg; the index of the frame stands for its
// stamp), and the original one of POV-Ray (icl_original.cpp).
//
// A. Handa et al., "A benchmark for RGB-D visual odometry, 3D reconstruction and SLAM", ICRA 2014.
#include <gslam/base/error.h>
#include <gslam/core/detail/field_reader.h>
#include <gslam/core/trajectory_file.h>
#include <gslam/datasets/formats.h>

#include <cmath>
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "../calibration/formats.h"
#include "../reading/file_tree.h"
#include "../reading/image_list.h"
#include "../reading/looks_like.h"
#include "../reading/second.h"
#include "../reading/sequence.h"
#include "camera_parameters.h"
#include "icl_mirror.h"
#include "icl_original.h"
#include "number_file.h"
#include "rgbd_camera.h"
#include "sequences.h"

namespace gslam {
inline namespace v1 {
namespace reading {
namespace {

constexpr std::int64_t kListTolerance = kSecond / 50;  // as TUM RGB-D's lists are associated

bool beginsWith(const std::string& name, const std::string& begin) {
  return name.compare(0, begin.size(), begin) == 0;
}

// Whole numbers are those of frames, 30 of which make a second. They were read as seconds: 42 is
// 42e9.
std::int64_t stampOfFrame(std::int64_t seconds) {
  return stampAtRate(static_cast<std::size_t>(seconds / kSecond), kIclRate);
}

bool isFrame(std::int64_t seconds) {
  return seconds >= 0 && seconds % kSecond == 0;
}

class IclReader {
 public:
  IclReader(const std::string& path, const Svar& parameters)
      : tree_(FileTree::open(path)), parameters_(parameters) {
    folder_ = onlyFolder(*tree_, "icl",
                         "has neither associations.txt nor rgb.txt nor scene_00_0000.depth, one of "
                         "which icl has");
  }

  std::unique_ptr<Dataset> open() {
    DatasetInfo& info = sequence_.info;
    info.name = folder_.empty() ? tree_->baseName() : nameIn(folder_);
    info.format = "icl";
    if (isPublished()) info.licence = "CC BY 3.0";
    info.body = "the camera";
    const bool wants_depth = parameters_.get<bool>("depth", true);
    if (isIclOriginal(*tree_, folder_)) {
      sayFrames();
      openIclOriginal(sequence_, tree_, folder_, wants_depth, unitOf());
    } else {
      openTumStyle(wants_depth);
    }
    return deliver(std::move(sequence_), prefetchOf(parameters_));
  }

 private:
  std::string below(const std::string& name) const { return joined(folder_, name); }
  std::string nameBelow(const std::string& name) const { return tree_->nameOf(below(name)); }

  // By the names of its scenes, and of files of poses that no calibration.txt is beside. Others
  // have made data in the same layout.
  bool isPublished() const {
    std::string name;
    for (const char c : sequence_.info.name) {
      if (c != '_') name += static_cast<char>(c >= 'A' && c <= 'Z' ? c - 'A' + 'a' : c);
    }
    if (name.find("livingroom") != name.npos || name.find("officeroom") != name.npos) return true;
    if (tree_->has(below("calibration.txt"))) return false;
    const std::vector<std::string> truth = truthFiles();
    return !truth.empty() && (beginsWith(truth[0], "livingRoom") || beginsWith(truth[0], "traj"));
  }

  double unitOf() const {
    const double unit = parameters_.get<double>("unit", 0.0);
    if (unit >= 0 && unit <= 1e6) return unit;
    throw ArgumentError("unit", "is " + std::to_string(unit) + ", expected metres, or 0");
  }

  void sayFrames() {
    sequence_.info.clock = "1/30 s a frame: there are no stamps";
    sequence_.remarks.say("numbers of frames are taken to be 1/30 s apart");
  }

  void openTumStyle(bool wants_depth) {
    const bool is_associated = tree_->has(below("associations.txt"));
    const std::string list = is_associated ? "associations.txt" : "rgb.txt";
    if (is_associated) {
      readAssociations();
    } else {
      wants_depth = wants_depth && hasDepthList();
      readLists(wants_depth);
    }
    countFrames(list);
    std::vector<std::vector<ListedImage>> lists = {rgb_};
    tidy(lists[0], *tree_, below(list), sequence_.remarks);
    if (lists[0].empty()) throw FileError(nameBelow(list), "lists no image that exists");
    const ImageShape shape = shapeOfFile(*tree_, lists[0][0].file);
    const bool is_mirrored = addColour(shape);
    if (wants_depth) {
      tidy(depth_, *tree_, below(is_associated ? list : "depth.txt"), sequence_.remarks);
      if (depth_.empty()) throw FileError(nameBelow("depth"), "has no image that is listed");
      std::vector<CameraSensor>& cameras = sequence_.info.sensors.cameras;
      cameras.push_back(
          depthOf(cameras[0], *tree_, depth_[0].file, depthFactorOf(parameters_, kTumDepthUnits)));
      lists.push_back(depth_);
    }
    const std::int64_t tolerance = is_associated || counts_frames_ ? 0 : kListTolerance;
    const std::vector<std::string> names = makeFrames(sequence_, lists, tolerance);
    loadImageFiles(sequence_, {tree_, names});
    readTruth(is_mirrored);
  }

  // A line is `0 depth/0.png 0 rgb/0.png`, or the other way round. Both images get the stamp of the
  // colour image.
  void readAssociations() {
    const std::string text = tree_->text(below("associations.txt"));
    const std::string source = nameBelow("associations.txt");
    detail::FieldReader in(text, source, "0 depth/0.png 0 rgb/0.png");
    while (in.nextLine()) {
      std::int64_t stamps[2] = {};
      std::string files[2];
      for (int k = 0; k < 2; ++k) {
        stamps[k] = in.stamp("frames or seconds", 9);
        files[k] = in.isLineEnd() ? "" : in.word();
        in.skipWord();
      }
      in.endLine();
      const int rgb = beginsWith(files[0], "depth") ? 1 : 0;
      rgb_.push_back({stamps[rgb], below(files[rgb]), in.line(), 0});
      depth_.push_back({stamps[rgb], below(files[1 - rgb]), in.line(), 0});
    }
  }

  bool hasDepthList() {
    if (tree_->has(below("depth.txt"))) return true;
    sequence_.remarks.say("there is no depth.txt, and so no depth");
    return false;
  }

  // Lists as TUM RGB-D has them, which people made for its readers.
  void readLists(bool wants_depth) {
    rgb_ = readImageList(*tree_, below("rgb.txt"), StampUnit::seconds, folder_);
    if (wants_depth) {
      depth_ = readImageList(*tree_, below("depth.txt"), StampUnit::seconds, folder_);
    }
  }

  void countFrames(const std::string& list) {
    if (rgb_.empty()) throw FileError(nameBelow(list), "lists no image");
    for (const std::vector<ListedImage>* images : {&rgb_, &depth_}) {
      for (const ListedImage& image : *images) {
        counts_frames_ = counts_frames_ && isFrame(image.stamp);
      }
    }
    if (!counts_frames_) {
      sequence_.info.clock = "the seconds of " + list;
      return;
    }
    sayFrames();
    for (ListedImage& image : rgb_) image.stamp = stampOfFrame(image.stamp);
    for (ListedImage& image : depth_) image.stamp = stampOfFrame(image.stamp);
  }

  // The camera, and whether its fy is negative in the files, so that poses are to be mirrored.
  struct Calibration {
    Camera camera;
    bool is_mirrored = true;
  };

  Calibration readCalibration(const ImageShape& shape) {
    if (!tree_->has(below("calibration.txt"))) {
      sequence_.remarks.say("the calibration is the published one, 481.2 -480 319.5 239.5");
      Camera camera = Camera::fromParameters("pinhole", 640, 480, {481.2, 480, 319.5, 239.5});
      const bool is_published = shape.width == 640 && shape.height == 480;
      return {is_published ? camera : camera.resized(shape.width, shape.height), true};
    }
    const std::vector<double> k =
        readNumbers(*tree_, below("calibration.txt"), 4, "fx fy cx cy, fy is negative");
    if (!(k[0] > 0) || k[1] == 0) {
      throw ParseError(nameBelow("calibration.txt"), 1, 0, "expected fx above 0 and an fy");
    }
    const Camera camera =
        calibration::makeCamera(nameBelow("calibration.txt"), 1, "pinhole",
                                {shape.width, shape.height}, {k[0], std::fabs(k[1]), k[2], k[3]});
    return {camera, k[1] < 0};
  }

  // @return whether poses are to be mirrored
  bool addColour(const ImageShape& shape) {
    Calibration calibration = readCalibration(shape);
    const Camera given = wantedCamera(parameters_, shape, sequence_.remarks);
    if (given.isValid()) calibration.camera = given;
    sequence_.info.sensors.cameras.push_back(cameraOf("rgb", calibration.camera));
    return calibration.is_mirrored && parameters_.get<bool>("mirror", true);
  }

  std::vector<std::string> truthFiles() const {
    std::vector<std::string> found;
    for (const std::string& name : tree_->files(folder_)) {
      if (endsWith(name, ".gt.freiburg")) found.push_back(name);
    }
    return found;
  }

  std::string truthFile() {
    const std::vector<std::string> found = truthFiles();
    if (found.empty() && tree_->has(below("groundtruth.txt"))) return "groundtruth.txt";
    if (found.size() > 1) {
      sequence_.remarks.say("of " + countText(found.size(), "file") + " *.gt.freiburg " + found[0] +
                            " was read");
    }
    return found.empty() ? "" : found[0];
  }

  static void checkFrames(const std::string& text, const std::string& source) {
    for (detail::FieldReader in(text, source, "a number of a frame"); in.nextLine();) {
      const char* const at = in.place();
      const std::string word = in.word();
      if (isFrame(in.stamp("frames", 9))) continue;
      in.fail(at, detail::quotedText(word) +
                      " is no number of a frame, expected one, as images have them for stamps");
    }
  }

  void readTruth(bool is_mirrored) {
    const std::string file = truthFile();
    if (file.empty()) {
      sequence_.remarks.say("there is no *.gt.freiburg: no ground truth");
      return;
    }
    TrajectoryFileOptions options;
    options.format = TrajectoryFormat::tum;
    options.may_be_empty = true;
    const std::string text = tree_->text(below(file));
    const Trajectory read = parseTrajectory(text, nameBelow(file), options);
    if (counts_frames_) checkFrames(text, nameBelow(file));
    for (const StampedPose& pose : read) {
      const std::int64_t stamp = counts_frames_ ? stampOfFrame(pose.stamp) : pose.stamp;
      sequence_.info.ground_truth.add(stamp, is_mirrored ? mirroredInY(pose.pose) : pose.pose);
    }
    if (!is_mirrored) return;
    sequence_.remarks.say(
        "y points up in the files, whose fy is negative: fy became positive, and the poses of " +
        file + " were mirrored (y points down in the world, too)");
  }

  std::shared_ptr<const FileTree> tree_;
  const Svar parameters_;
  std::string folder_;
  Sequence sequence_;
  std::vector<ListedImage> rgb_;
  std::vector<ListedImage> depth_;
  bool counts_frames_ = true;
};

}  // namespace
}  // namespace reading

DatasetFactory iclFactory() {
  DatasetFactory factory;
  factory.name = "icl";
  factory.description = "ICL-NUIM: rendered colour and depth with exact poses";
  factory.parameters = reading::commonParameters();
  factory.parameters.set("depth", true);
  factory.parameters.set("depth_factor", reading::kTumDepthUnits);
  reading::addCameraParameters(factory.parameters);
  factory.parameters.set("mirror", true);
  factory.parameters.set("unit", 0.0);
  factory.recognizes = reading::recognizesAs("icl");
  factory.open = [](const std::string& path, const Svar& parameters) {
    return reading::IclReader(path, parameters).open();
  };
  return factory;
}

}  // namespace v1
}  // namespace gslam
