// KITTI raw.
//
// A. Geiger et al., "Vision meets robotics: the KITTI dataset", IJRR 2013; the layout is that of
// its devkit's readme: a folder of the date has the calibration and the drives, a drive image_00 to
// image_03 (data/<n>.png, timestamps.txt) and oxts (data/<n>.txt, timestamps.txt). Drives that end
// in _sync are rectified and have the same numbers for what belongs together; in those that end in
// _extract each sensor has its own rate, and images are as the cameras took them.
#include <gslam/base/error.h>
#include <gslam/core/detail/shared_library.h>
#include <gslam/datasets/formats.h>

#include <algorithm>
#include <cmath>
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "../reading/file_tree.h"
#include "../reading/image_list.h"
#include "../reading/looks_like.h"
#include "../reading/sequence.h"
#include "kitti_files.h"
#include "kitti_oxts.h"
#include "kitti_raw_calibration.h"
#include "sequences.h"

namespace gslam {
inline namespace v1 {
namespace reading {
namespace {

const char* const kCalibration = "calib_cam_to_cam.txt";

bool isTextName(const std::string& name) {
  return name.size() > 4 && name.compare(name.size() - 4, 4, ".txt") == 0;
}

std::string imageFolder(std::size_t camera) {
  return "image_0" + std::to_string(camera);
}

bool isDrive(const FileTree& tree, const std::string& folder) {
  for (std::size_t i = 0; i < 4; ++i) {
    if (tree.hasFolder(joined(folder, imageFolder(i) + "/data"))) return true;
  }
  return false;
}

class KittiRawReader {
 public:
  KittiRawReader(const std::string& path, const Svar& parameters)
      : tree_(FileTree::open(path)), parameters_(parameters) {
    folder_ = chooseSequence(
        *tree_, 2, [this](const std::string& folder) { return isDrive(*tree_, folder); },
        parameters, "a drive, a folder with image_00/data");
    sequence_.info.name = folder_.empty() ? tree_->baseName() : nameIn(folder_);
  }

  std::unique_ptr<Dataset> open() {
    DatasetInfo& info = sequence_.info;
    info.format = "kittiraw";
    info.licence = "CC BY-NC-SA 3.0";
    info.clock = "date and time of the recording computer, counted as if they were UTC";
    listImages();
    calibrate();
    loadImageFiles(sequence_,
                   {tree_, makeFrames(sequence_, lists_,
                                      is_synced_ ? 0 : toleranceOf(parameters_, 0.02, 10))});
    readOxtsFolder();
    if (tree_->hasFolder(below("velodyne_points"))) {
      sequence_.remarks.say("velodyne_points was not read: there is no place for laser scans");
    }
    return deliver(std::move(sequence_), prefetchOf(parameters_));
  }

 private:
  std::string below(const std::string& name) const { return joined(folder_, name); }
  std::string nameBelow(const std::string& name) const { return tree_->nameOf(below(name)); }

  // Drives whose names say nothing are taken for the usual ones.
  bool isNamedSynced() const {
    const std::string& name = sequence_.info.name;
    return name.find("extract") == std::string::npos && name.find("unsync") == std::string::npos;
  }

  void listImages() {
    std::vector<std::string> folders;
    for (std::size_t i = 0; i < 4; ++i) folders.push_back(below(imageFolder(i) + "/data"));
    cameras_ = chooseKittiCameras(*tree_, folders, parameters_, sequence_.remarks);
    is_synced_ = isNamedSynced();
    for (const std::size_t camera : cameras_) {
      images_.push_back(numberedFiles(*tree_, folders[camera], isImageName, sequence_.remarks));
      if (images_.back().empty()) {
        throw FileError(tree_->nameOf(folders[camera]), "has no images, expected 0000000000.png");
      }
    }
    for (std::size_t k = 0; k < cameras_.size(); ++k) {
      lists_.push_back(is_synced_ && k > 0 ? partnersOfFirst(k) : stamped(k));
    }
    for (std::size_t k = 0; k < cameras_.size(); ++k) checkNotEmpty(k);
  }

  void checkNotEmpty(std::size_t k) const {
    if (!lists_[k].empty()) return;
    throw FileError(nameBelow(imageFolder(cameras_[k]) + "/data"),
                    "has no image with a stamp, and a partner in the first camera");
  }

  // ListedImage::line is the place in images_[k], from 1 on.
  std::vector<ListedImage> stamped(std::size_t k) {
    const std::string file = below(imageFolder(cameras_[k]) + "/timestamps.txt");
    const std::vector<std::int64_t> stamps = readDateTimes(*tree_, file);
    sayCounts(images_[k], file, stamps.size(), "stamp", sequence_.remarks);
    std::vector<ListedImage> list;
    for (std::size_t i = 0; i < images_[k].size(); ++i) {
      const std::size_t line = lineOf(images_[k], i, stamps.size());
      if (line < stamps.size()) {
        list.push_back({stamps[line], images_[k][i].name, i + 1, 0});
      } else {
        sequence_.remarks.skip("images that " + file + " has no stamp for", images_[k][i].name);
      }
    }
    tidy(list, *tree_, file, sequence_.remarks);
    return list;
  }

  // Images of synced drives belong together by their numbers, whatever their stamps.
  std::vector<ListedImage> partnersOfFirst(std::size_t k) const {
    std::vector<ListedImage> list;
    for (const ListedImage& first : lists_[0]) {
      const NumberedFile* const found = findNumber(images_[k], images_[0][first.line - 1].number);
      if (found != nullptr) list.push_back({first.stamp, found->name, first.line, 0});
    }
    return list;
  }

  struct Place {
    std::shared_ptr<const FileTree> tree;
    std::string folder;
  };

  // In the folder of the date, which is around the drive and perhaps outside of the tree; or in
  // the drive itself.
  Place findCalibration() const {
    const std::string around = folderOf(folder_);
    for (const std::string& folder : {folder_, around}) {
      if (tree_->has(joined(folder, kCalibration))) return {tree_, folder};
    }
    const bool is_inside = !folder_.empty();
    const bool is_folder = detail::fileKind(tree_->root()) == detail::FileKind::folder;
    if (is_inside || !is_folder) return {};
    const std::shared_ptr<const FileTree> outside = FileTree::open(tree_->root() + "/..");
    return outside->has(kCalibration) ? Place{outside, ""} : Place{};
  }

  void calibrate() {
    const Place place = findCalibration();
    std::vector<CameraSensor>& sensors = sequence_.info.sensors.cameras;
    sequence_.info.body = "the left grey camera (camera 0)";
    if (place.tree == nullptr && cameras_.size() > 1) {
      throw FileError(nameBelow(kCalibration),
                      "is missing, and in the folder around the drive, too; one camera "
                      "(stereo=false) needs none");
    }
    if (place.tree == nullptr) {
      sequence_.remarks.say(std::string("there is no ") + kCalibration +
                            ": the camera is not calibrated");
      sequence_.info.body = "";
      sensors.push_back(cameraOf(kittiCameraName(cameras_[0]), Camera()));
      return;
    }
    const KittiRawCalibration calibration(*place.tree, place.folder);
    for (std::size_t k = 0; k < cameras_.size(); ++k) {
      const ImageShape shape = shapeOfFile(*tree_, lists_[k][0].file);
      const bool is_rectified = calibration.isRectified(cameras_[k], shape, is_synced_);
      sensors.push_back(calibration.camera(cameras_[k], is_rectified, shape));
    }
    has_body_ = calibration.hasImu();
    if (has_body_) sequence_.info.body = "the inertial unit (OXTS): x forward, y left, z up";
  }

  void readOxtsFolder() {
    if (!tree_->hasFolder(below("oxts/data"))) {
      sequence_.remarks.say("there is no oxts/data: no ground truth and no inertial samples");
      return;
    }
    if (!has_body_) {
      sequence_.remarks.say(
          "oxts was not read: calib_velo_to_cam.txt or calib_imu_to_velo.txt is missing, which "
          "say where the inertial unit is");
      return;
    }
    const std::vector<OxtsSample> samples = readSamples();
    if (samples.empty()) {
      sequence_.remarks.say("oxts/data has no samples");
      return;
    }
    deliverSamples(samples);
  }

  // Of samples with equal stamps the first counts.
  std::vector<OxtsSample> readSamples() {
    const std::string stamp_file = below("oxts/timestamps.txt");
    const std::vector<NumberedFile> files =
        numberedFiles(*tree_, below("oxts/data"), isTextName, sequence_.remarks);
    const std::vector<std::int64_t> stamps = readDateTimes(*tree_, stamp_file);
    sayCounts(files, stamp_file, stamps.size(), "stamp", sequence_.remarks);
    std::vector<ListedImage> list;
    for (std::size_t i = 0; i < files.size(); ++i) {
      const std::size_t line = lineOf(files, i, stamps.size());
      if (line < stamps.size()) {
        list.push_back({stamps[line], files[i].name, line + 1, 0});
      } else {
        sequence_.remarks.skip("samples that " + stamp_file + " has no stamp for", files[i].name);
      }
    }
    orderSamples(list);
    std::vector<OxtsSample> samples;
    samples.reserve(list.size());
    for (const ListedImage& one : list) samples.push_back(readOxts(*tree_, one.file, one.stamp));
    return samples;
  }

  void orderSamples(std::vector<ListedImage>& list) {
    const auto isBefore = [](const ListedImage& a, const ListedImage& b) {
      return a.stamp < b.stamp;
    };
    if (!std::is_sorted(list.begin(), list.end(), isBefore)) {
      sequence_.remarks.say("oxts/timestamps.txt is not in the order of time: it was sorted");
      std::stable_sort(list.begin(), list.end(), isBefore);
    }
    const auto isTwin = [this](const ListedImage& a, const ListedImage& b) {
      if (a.stamp != b.stamp) return false;
      sequence_.remarks.skip("samples of oxts with the stamp of another", b.file);
      return true;
    };
    list.erase(std::unique(list.begin(), list.end(), isTwin), list.end());
  }

  void deliverSamples(const std::vector<OxtsSample>& samples) {
    SensorRig& rig = sequence_.info.sensors;
    rig.has_imu = true;
    rig.has_gnss = true;
    for (const OxtsSample& sample : samples) {
      sequence_.imu.push_back(sample.imu);
      sequence_.gnss.push_back(sample.gnss);
    }
    sequence_.info.ground_truth = oxtsTrajectory(samples);
    sequence_.remarks.say(
        "ground truth is the OXTS unit's own fusion of satellites and inertia: a Mercator "
        "projection, x east, y north, z up, from its first position on");
    sequence_.remarks.say(
        "satellite positions are those of the same fusion, at the unit; altitudes are taken to be "
        "twice as inaccurate as the rest, of which alone the files speak");
    if (is_synced_) {
      sequence_.remarks.say(
          "inertial samples are as rare as images: only _extract drives have all of them");
    }
  }

  std::shared_ptr<const FileTree> tree_;
  const Svar parameters_;
  std::string folder_;
  Sequence sequence_;
  bool is_synced_ = true;
  bool has_body_ = false;
  std::vector<std::size_t> cameras_;               // 0 to 3
  std::vector<std::vector<NumberedFile>> images_;  // of each of these
  std::vector<std::vector<ListedImage>> lists_;    // with stamps
};

}  // namespace
}  // namespace reading

DatasetFactory kittiRawFactory() {
  DatasetFactory factory;
  factory.name = "kittiraw";
  factory.description = "KITTI raw: drives with cameras, an inertial unit and satellite positions";
  factory.parameters = reading::commonParameters();
  factory.parameters.set("sequence", Svar());
  factory.parameters.set("cameras", "auto");
  factory.parameters.set("stereo", true);
  factory.parameters.set("tolerance", 0.02);
  factory.recognizes = reading::recognizesAs("kittiraw");
  factory.open = [](const std::string& path, const Svar& parameters) {
    return reading::KittiRawReader(path, parameters).open();
  };
  return factory;
}

}  // namespace v1
}  // namespace gslam
