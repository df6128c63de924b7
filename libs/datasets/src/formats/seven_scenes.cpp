// Microsoft 7-Scenes.
//
// J. Shotton et al., "Scene coordinate regression forests for camera relocalization in RGB-D
// images", CVPR 2013; the layout is that of the readme on its page: frame-N.color.png,
// frame-N.depth.png (millimetres, 65535 where there is none), frame-N.pose.txt (camera to world,
// 4 x 4, by KinectFusion). camera-intrinsics.txt is an addition of Princeton's copies.
#include <gslam/base/error.h>
#include <gslam/core/trajectory_file.h>
#include <gslam/datasets/formats.h>
#include <gslam/geometry/nearest_rotation.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "../calibration/formats.h"
#include "../reading/file_tree.h"
#include "../reading/looks_like.h"
#include "../reading/sequence.h"
#include "../reading/sort_unique.h"
#include "camera_parameters.h"
#include "number_file.h"
#include "rgbd_camera.h"
#include "sequences.h"

namespace gslam {
inline namespace v1 {
namespace reading {
namespace {

constexpr std::int64_t kSevenScenesRate = 30;
constexpr double kSevenScenesDepthUnits = 1000;
constexpr std::uint16_t kNoDepth = 65535;
constexpr double kPoseTolerance = 0.01;  // KinectFusion let its matrices drift a little
const char* const kIntrinsics = "camera-intrinsics.txt";

void clearUnknownDepth(Image& image) {
  for (int y = 0; y < image.height(); ++y) {
    std::uint16_t* const row = image.row<std::uint16_t>(y);
    std::replace(row, row + image.width(), kNoDepth, std::uint16_t(0));
  }
}

// Whether the words of a file have a number that is none: KinectFusion that lost its way wrote such
// poses. FieldReader takes no number that is not finite.
bool hasNoNumber(const std::string& text) {
  return text.find("nan") != std::string::npos || text.find("NaN") != std::string::npos ||
         text.find("IND") != std::string::npos || text.find("INF") != std::string::npos ||
         text.find("inf") != std::string::npos || text.find("QNAN") != std::string::npos;
}

class SevenScenesReader {
 public:
  SevenScenesReader(const std::string& path, const Svar& parameters)
      : tree_(FileTree::open(path)), parameters_(parameters) {
    folder_ =
        chooseSequence(*tree_, "7scenes", parameters, "frame-000000.color.png ..." + packedOnes());
  }

  std::unique_ptr<Dataset> open() {
    DatasetInfo& info = sequence_.info;
    info.name = folder_.empty() ? tree_->baseName() : tree_->baseName() + "/" + folder_;
    info.format = "7scenes";
    info.licence = "Microsoft Research licence: non-commercial use only";
    info.body = "the depth camera, which KinectFusion tracked";
    info.clock = "1/30 s a frame: there are no stamps";
    sequence_.remarks.say("there are no stamps: frames are taken to be 1/30 s apart");
    listFrames();
    addCameras();
    makeStamps();
    loadImages();
    readPoses();
    return deliver(std::move(sequence_), prefetchOf(parameters_));
  }

 private:
  struct SceneFrame {
    std::size_t number = 0;
    std::string base;  // "frame-000012"
    std::string colour;
  };

  // Scenes are downloaded with an archive of each sequence in them.
  std::string packedOnes() const {
    std::string names;
    for (const std::string& name : packedSevenScenes(*tree_, "")) {
      names += (names.empty() ? "" : ", ") + name;
    }
    return names.empty() ? "" : "; name one of these archives, or unpack them: " + names;
  }

  std::string below(const std::string& name) const { return joined(folder_, name); }

  void listFrames() {
    for (const std::string& name : tree_->files(folder_)) {
      SceneFrame frame;
      if (!isSevenScenesColour(name)) continue;
      if (!numberIn(name, frame.number)) {
        sequence_.remarks.skip("images without a number in their names", name);
        continue;
      }
      frame.base = name.substr(0, name.find('.'));
      frame.colour = name;
      const bool has_depth = tree_->has(below(frame.base + ".depth.png"));
      has_depth_ = has_depth_ || has_depth;
      frames_.push_back(std::move(frame));
    }
    const bool wants_depth = parameters_.get<bool>("depth", true);
    if (wants_depth && !has_depth_) sequence_.remarks.say("there are no depth images");
    has_depth_ = has_depth_ && wants_depth;
    if (has_depth_) skipWithoutDepth();
    sortUnique(
        frames_, [](const SceneFrame& frame) { return frame.number; },
        [this](const SceneFrame& twin) {
          sequence_.remarks.skip("images whose number another one has", twin.colour);
        });
  }

  void skipWithoutDepth() {
    std::vector<SceneFrame> whole;
    for (SceneFrame& frame : frames_) {
      if (tree_->has(below(frame.base + ".depth.png"))) {
        whole.push_back(std::move(frame));
      } else {
        sequence_.remarks.skip("frames without depth", frame.base);
      }
    }
    frames_ = std::move(whole);
  }

  // In the folder of the sequence or the one around it.
  std::string intrinsicsFile() const {
    for (const std::string& folder : {folder_, folderOf(folder_)}) {
      if (tree_->has(joined(folder, kIntrinsics))) return joined(folder, kIntrinsics);
    }
    return "";
  }

  Camera cameraFor(const ImageShape& shape) {
    const Camera given = wantedCamera(parameters_, shape, sequence_.remarks);
    if (given.isValid()) return given;
    const std::string file = intrinsicsFile();
    if (file.empty()) {
      sequence_.remarks.say(
          "the calibration is the published one of the depth camera, 585 585 320 "
          "240");
      const Camera published = Camera::fromParameters("pinhole", 640, 480, {585, 585, 320, 240});
      const bool is_published = shape.width == 640 && shape.height == 480;
      return is_published ? published : published.resized(shape.width, shape.height);
    }
    const std::vector<double> k = readNumbers(*tree_, file, 9, "the rows of a 3 x 3 matrix");
    const std::string name = tree_->nameOf(file);
    return calibration::makeCamera(name, 1, "pinhole", {shape.width, shape.height},
                                   intrinsicsOfRows(k, name));
  }

  void addCameras() {
    if (frames_.empty()) throw FileError(tree_->nameOf(folder_), "has no frame with depth");
    const ImageShape shape = shapeOfFile(*tree_, below(frames_[0].colour));
    std::vector<CameraSensor>& cameras = sequence_.info.sensors.cameras;
    cameras.push_back(cameraOf("rgb", cameraFor(shape)));
    if (!has_depth_) return;
    cameras.push_back(depthOf(cameras[0], *tree_, below(frames_[0].base + ".depth.png"),
                              depthFactorOf(parameters_, kSevenScenesDepthUnits)));
    sequence_.remarks.say(
        "depth and colour are those of two cameras and not registered to each other: both have the "
        "depth camera's calibration and pose, which is wrong for colour by a few pixels");
  }

  void makeStamps() {
    for (const SceneFrame& frame : frames_) {
      sequence_.stamps.push_back(stampAtRate(frame.number, kSevenScenesRate));
    }
  }

  void loadImages() {
    std::vector<std::string> names;
    for (const SceneFrame& frame : frames_) {
      names.push_back(below(frame.colour));
      if (has_depth_) names.push_back(below(frame.base + ".depth.png"));
    }
    loadImageFiles(sequence_, {tree_, std::move(names)});
    if (!has_depth_) return;
    sequence_.load = [load = sequence_.load](std::size_t frame, std::size_t camera) {
      Image image = load(frame, camera);
      if (camera == 1) clearUnknownDepth(image);
      return image;
    };
  }

  void readPoses() {
    std::size_t missing = 0;
    for (std::size_t i = 0; i < frames_.size(); ++i) {
      const std::string file = below(frames_[i].base + ".pose.txt");
      if (tree_->has(file)) {
        readPose(file, sequence_.stamps[i]);
      } else {
        ++missing;
      }
    }
    if (missing != 0) {
      sequence_.remarks.say("there is no ground truth, no pose.txt, of " +
                            countText(missing, "frame"));
    }
  }

  void readPose(const std::string& file, std::int64_t stamp) {
    const std::string text = tree_->text(file);
    if (hasNoNumber(text)) {
      sequence_.remarks.skip("poses that are not finite", file);
      return;
    }
    const std::vector<double> m =
        numbersOf(text, tree_->nameOf(file), 16, "the rows of a 4 x 4 matrix");
    Mat3d rotation{};
    for (std::size_t i = 0; i < 9; ++i) rotation.values[i] = m[i / 3 * 4 + i % 3];
    const NearestRotation<double> nearest = nearestRotation(rotation);
    const bool is_pose =
        nearest.distance <= kPoseTolerance && m[12] == 0 && m[13] == 0 && m[14] == 0 && m[15] == 1;
    if (!is_pose) {
      sequence_.remarks.skip("poses that are no rotation and translation", file);
      return;
    }
    sequence_.info.ground_truth.add(stamp, SE3d(nearest.rotation, {{m[3], m[7], m[11]}}));
  }

  std::shared_ptr<const FileTree> tree_;
  const Svar parameters_;
  std::string folder_;
  Sequence sequence_;
  std::vector<SceneFrame> frames_;
  bool has_depth_ = false;
};

}  // namespace
}  // namespace reading

DatasetFactory sevenScenesFactory() {
  DatasetFactory factory;
  factory.name = "7scenes";
  factory.description = "Microsoft 7-Scenes: colour and depth of a Kinect, poses of KinectFusion";
  factory.parameters = reading::commonParameters();
  factory.parameters.set("sequence", Svar());
  factory.parameters.set("depth", true);
  factory.parameters.set("depth_factor", reading::kSevenScenesDepthUnits);
  reading::addCameraParameters(factory.parameters);
  factory.recognizes = reading::recognizesAs("7scenes");
  factory.open = [](const std::string& path, const Svar& parameters) {
    return reading::SevenScenesReader(path, parameters).open();
  };
  return factory;
}

}  // namespace v1
}  // namespace gslam
