// KITTI odometry.
//
// A. Geiger et al., "Are we ready for autonomous driving? The KITTI vision benchmark suite", CVPR
// 2012; the layout is that of its devkit's readme: sequences/NN with image_0, image_1 (grey, left
// and right), image_2, image_3 (colour), calib.txt, times.txt, and poses/NN.txt. All cameras are
// rectified: P_i takes points of camera 0, the left grey one, to pixels of camera i.
#include <gslam/base/error.h>
#include <gslam/core/detail/field_reader.h>
#include <gslam/core/detail/shared_library.h>
#include <gslam/core/trajectory_file.h>
#include <gslam/datasets/formats.h>

#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "../reading/file_tree.h"
#include "../reading/image_list.h"
#include "../reading/looks_like.h"
#include "../reading/sequence.h"
#include "kitti_files.h"
#include "number_file.h"
#include "sequences.h"

namespace gslam {
inline namespace v1 {
namespace reading {
namespace {

constexpr std::int64_t kKittiRate = 10;

class KittiReader {
 public:
  KittiReader(const std::string& path, const Svar& parameters)
      : tree_(FileTree::open(path)), parameters_(parameters) {
    folder_ = chooseSequence(*tree_, "kitti", parameters, "a folder with image_0 or image_2");
    name_ = folder_.empty() ? tree_->baseName() : nameIn(folder_);
  }

  std::unique_ptr<Dataset> open() {
    DatasetInfo& info = sequence_.info;
    info.name = name_;
    info.format = "kitti";
    info.body = "the left grey camera (P0)";
    info.clock = "the time since the first frame";
    listImages();
    std::vector<std::vector<ListedImage>> lists = stampImages();
    calibrate(lists);
    if (isPublished()) info.licence = "CC BY-NC-SA 3.0";
    const std::vector<std::string> names = makeFrames(sequence_, lists, 0);
    loadImageFiles(sequence_, {tree_, names});
    readPoses();
    if (tree_->hasFolder(below("velodyne"))) {
      sequence_.remarks.say("velodyne was not read: there is no place for laser scans");
    }
    return deliver(std::move(sequence_), prefetchOf(parameters_));
  }

 private:
  std::string below(const std::string& name) const { return joined(folder_, name); }
  std::string nameBelow(const std::string& name) const { return tree_->nameOf(below(name)); }
  static std::string imageFolder(std::size_t camera) { return "image_" + std::to_string(camera); }

  // Whether this is one of the 22 sequences by its name, and by its calibrated images: all are
  // about 1241 x 376. Others have made data in the same layout.
  bool isPublished() const {
    const bool is_name = name_.size() == 2 && name_ >= "00" && name_ <= "21";
    const Camera& camera = sequence_.info.sensors.cameras[0].camera;
    return is_name && camera.width() >= 1220 && camera.width() <= 1250 && camera.height() >= 365 &&
           camera.height() <= 380;
  }

  void listImages() {
    std::vector<std::string> folders;
    for (std::size_t i = 0; i < 4; ++i) folders.push_back(below(imageFolder(i)));
    cameras_ = chooseKittiCameras(*tree_, folders, parameters_, sequence_.remarks);
    for (const std::size_t camera : cameras_) {
      images_.push_back(numberedFiles(*tree_, folders[camera], isImageName, sequence_.remarks));
    }
    if (images_[0].empty()) {
      throw FileError(nameBelow(imageFolder(cameras_[0])),
                      "has no images, expected 000000.png ...");
    }
  }

  std::vector<std::int64_t> readTimes() const {
    const std::string text = tree_->text(below("times.txt")), source = nameBelow("times.txt");
    detail::FieldReader in(text, source, "one time in seconds");
    std::vector<std::int64_t> times;
    while (in.nextLine()) {
      times.push_back(in.stamp("seconds", 9));
      in.endLine();
    }
    return times;
  }

  // The first camera's images with their stamps. ListedImage::line is the place in images_[0], from
  // 1 on.
  std::vector<ListedImage> stampFirst() {
    const bool has_times = tree_->has(below("times.txt"));
    const std::vector<std::int64_t> times = has_times ? readTimes() : std::vector<std::int64_t>();
    if (has_times) {
      sayCounts(images_[0], "times.txt", times.size(), "time", sequence_.remarks);
    } else {
      sequence_.remarks.say("there is no times.txt: frames are taken to be 0.1 s apart");
      sequence_.info.clock = "0.1 s a frame, which is a guess";
    }
    std::vector<ListedImage> list;
    for (std::size_t i = 0; i < images_[0].size(); ++i) {
      const NumberedFile& image = images_[0][i];
      const std::size_t line = lineOf(images_[0], i, times.size());
      if (has_times && line >= times.size()) {
        sequence_.remarks.skip("images that times.txt has no time for", image.name);
        continue;
      }
      const std::int64_t stamp = has_times ? times[line] : stampAtRate(image.number, kKittiRate);
      list.push_back({stamp, image.name, i + 1, 0});
    }
    tidy(list, *tree_, below("times.txt"), sequence_.remarks);
    return list;
  }

  std::vector<std::vector<ListedImage>> stampImages() {
    std::vector<std::vector<ListedImage>> lists = {stampFirst()};
    for (std::size_t k = 1; k < images_.size(); ++k) {
      std::vector<ListedImage> list;
      std::size_t used = 0;
      for (const ListedImage& first : lists[0]) {
        const std::size_t number = images_[0][first.line - 1].number;
        const NumberedFile* const found = findNumber(images_[k], number);
        if (found == nullptr) continue;
        list.push_back({first.stamp, found->name, first.line, 0});
        ++used;
      }
      if (used < images_[k].size()) {
        sequence_.remarks.say("in " + imageFolder(cameras_[0]) + " there is no partner for " +
                              countText(images_[k].size() - used, "image") + " of " +
                              imageFolder(cameras_[k]));
      }
      lists.push_back(std::move(list));
    }
    stamped_ = lists[0];
    return lists;
  }

  void calibrate(const std::vector<std::vector<ListedImage>>& lists) {
    const bool has_calibration = tree_->has(below("calib.txt"));
    if (!has_calibration && cameras_.size() > 1) {
      throw FileError(nameBelow("calib.txt"),
                      "is missing, expected P0 to P3; one camera (stereo=false) needs none");
    }
    if (!has_calibration) {
      sequence_.remarks.say("there is no calib.txt: the camera is not calibrated");
      sequence_.info.sensors.cameras.push_back(cameraOf(kittiCameraName(cameras_[0]), Camera()));
      return;
    }
    const NamedNumbers calibration(*tree_, below("calib.txt"));
    for (std::size_t k = 0; k < cameras_.size(); ++k) {
      if (lists[k].empty()) {
        throw FileError(nameBelow(imageFolder(cameras_[k])),
                        "has no image that belongs to one of " + imageFolder(cameras_[0]));
      }
      sequence_.info.sensors.cameras.push_back(
          calibrated(calibration, cameras_[k], lists[k][0].file));
    }
  }

  // The size of images differs from sequence to sequence: 1241 x 376, 1226 x 370, ...
  CameraSensor calibrated(const NamedNumbers& calibration, std::size_t camera,
                          const std::string& image) const {
    const std::string key = "P" + std::to_string(camera);
    Projection p{};
    std::string problem;
    if (!toProjection(calibration.get(key, 12), p, problem)) calibration.fail(key, problem);
    const ImageShape shape = shapeOfFile(*tree_, image);
    CameraSensor sensor = cameraOf(
        kittiCameraName(camera),
        calibration.camera(key, "pinhole", shape.width, shape.height, {p.fx, p.fy, p.cx, p.cy}));
    sensor.T_body_camera = SE3d(SO3d(), Vec3d{} - p.offset);
    return sensor;
  }

  struct Place {
    std::shared_ptr<const FileTree> tree;
    std::string file;
  };

  // Inside of the sequence, or in `poses` beside `sequences`, which is outside of the tree where
  // the user names the folder of the sequence.
  Place findPoses() const {
    const std::string named = name_ + ".txt";
    for (const char* inside : {"poses.txt", named.c_str()}) {
      if (tree_->has(below(inside))) return {tree_, below(inside)};
    }
    const std::string beside = "poses/" + named;
    const std::string parent = folderOf(folder_), around = folderOf(parent);
    const bool is_inside = !parent.empty();  // so that the folder around is in the tree
    if (is_inside) {
      const std::string file = joined(around, beside);
      return tree_->has(file) ? Place{tree_, file} : Place{};
    }
    if (detail::fileKind(tree_->root()) != detail::FileKind::folder) return {};
    const std::string root = tree_->root() + (folder_.empty() ? "/../.." : "/..");
    const std::shared_ptr<const FileTree> outside = FileTree::open(root);
    return outside->has(beside) ? Place{outside, beside} : Place{};
  }

  void readPoses() {
    const Place place = findPoses();
    if (place.tree == nullptr) {
      sequence_.remarks.say("there are no poses/" + name_ + ".txt: no ground truth");
      return;
    }
    TrajectoryFileOptions options;
    options.format = TrajectoryFormat::kitti;
    const std::string name = place.tree->nameOf(place.file);
    const Trajectory poses = parseTrajectory(place.tree->text(place.file), name, options);
    sayCounts(images_[0], nameIn(place.file), poses.size(), "pose", sequence_.remarks);
    for (const ListedImage& image : stamped_) {
      const std::size_t line = lineOf(images_[0], image.line - 1, poses.size());
      if (line < poses.size()) {
        sequence_.info.ground_truth.add(image.stamp, poses[line].pose);
      } else {
        sequence_.remarks.say("some frames have no ground truth: " + nameIn(place.file) +
                              " ends before them");
      }
    }
  }

  std::shared_ptr<const FileTree> tree_;
  const Svar parameters_;
  std::string folder_;
  std::string name_;  // of the sequence, such as "06"
  Sequence sequence_;
  std::vector<std::size_t> cameras_;               // 0 to 3
  std::vector<std::vector<NumberedFile>> images_;  // of each of these
  std::vector<ListedImage> stamped_;               // those of the first one
};

}  // namespace
}  // namespace reading

DatasetFactory kittiFactory() {
  DatasetFactory factory;
  factory.name = "kitti";
  factory.description = "KITTI odometry: rectified grey or colour stereo from a car";
  factory.parameters = reading::commonParameters();
  factory.parameters.set("sequence", Svar());
  factory.parameters.set("cameras", "auto");
  factory.parameters.set("stereo", true);
  factory.recognizes = reading::recognizesAs("kitti");
  factory.open = [](const std::string& path, const Svar& parameters) {
    return reading::KittiReader(path, parameters).open();
  };
  return factory;
}

}  // namespace v1
}  // namespace gslam
