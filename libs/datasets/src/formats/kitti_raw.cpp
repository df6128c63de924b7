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

#include <cmath>
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "../reading/file_tree.h"
#include "../reading/image_list.h"
#include "../reading/looks_like.h"
#include "../reading/sequence.h"
#include "../reading/sort_unique.h"
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
  return endsWith(name, ".txt");
}

std::string imageFolder(std::size_t camera) {
  return "image_0" + std::to_string(camera);
}

bool contains(const std::string& text, const char* words) {
  return text.find(words) != std::string::npos;
}

// "2011_09_26_drive_0001...", as all that were published are named.
bool isPublishedName(const std::string& name) {
  const std::string like = "2011_dd_dd_drive_dddd";
  for (std::size_t i = 0; i < like.size(); ++i) {
    const char c = i < name.size() ? name[i] : '\0';
    const bool is_digit = c >= '0' && c <= '9';
    const bool wants_digit = like[i] == 'd' && (i < 11 || i > 15);
    if (wants_digit ? !is_digit : c != like[i]) return false;
  }
  return true;
}

class KittiRawReader {
 public:
  KittiRawReader(const std::string& path, const Svar& parameters)
      : tree_(FileTree::open(path)), parameters_(parameters) {
    folder_ = chooseSequence(*tree_, "kittiraw", parameters, "a drive, a folder with image_00/data",
                             "drive_");
    sequence_.info.name = folder_.empty() ? tree_->baseName() : nameIn(folder_);
  }

  std::unique_ptr<Dataset> open() {
    DatasetInfo& info = sequence_.info;
    info.format = "kittiraw";
    if (isPublishedName(info.name)) info.licence = "CC BY-NC-SA 3.0";
    info.clock = "date and time of the recording computer, counted as if they were UTC";
    listImages();
    findCalibration();
    decideSynced();
    stampImages();
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

  // Drives are synced and rectified, or neither. Their names say which, where nobody renamed them,
  // and so does the size of images, where rectification changed that.
  void decideSynced() {
    const std::string& name = sequence_.info.name;
    const bool is_named_raw = contains(name, "extract") || contains(name, "unsync");
    const bool is_named = is_named_raw || contains(name, "sync");
    is_synced_ = is_rectified_ = !is_named_raw;
    const bool is_known = lookAtSize();
    if (!is_named) is_synced_ = is_rectified_;
    if (!is_named && !is_known) {
      sequence_.remarks.say(
          "neither the name nor the size of images says whether the drive is synced: it is taken "
          "to be; extracts have 'extract' in their names");
    }
    if (is_named && is_rectified_ != is_synced_) {
      sequence_.remarks.say(std::string("the name says that images are ") +
                            (is_synced_ ? "" : "not ") + "synced and rectified, their size that " +
                            "they are " + (is_rectified_ ? "" : "not ") +
                            "rectified: they go by their size, and are paired by their stamps");
      is_synced_ = false;
    }
  }

  // @return whether the size of the first camera's images tells whether they are rectified
  bool lookAtSize() {
    if (calibration_ == nullptr) return false;
    const ImageShape shape = shapeOfFile(*tree_, images_[0][0].name);
    const bool if_likely = calibration_->isRectified(cameras_[0], shape, true);
    if (if_likely != calibration_->isRectified(cameras_[0], shape, false)) return false;
    is_rectified_ = if_likely;
    return true;
  }

  void listImages() {
    std::vector<std::string> folders;
    for (std::size_t i = 0; i < 4; ++i) folders.push_back(below(imageFolder(i) + "/data"));
    cameras_ = chooseKittiCameras(*tree_, folders, parameters_, sequence_.remarks);
    for (const std::size_t camera : cameras_) {
      images_.push_back(numberedFiles(*tree_, folders[camera], isImageName, sequence_.remarks));
      if (images_.back().empty()) {
        throw FileError(tree_->nameOf(folders[camera]), "has no images, expected 0000000000.png");
      }
    }
  }

  void stampImages() {
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

  // In the folder of the date, which is around the drive and perhaps outside of the tree; or in
  // the drive itself.
  void findCalibration() {
    const std::string around = folderOf(folder_);
    for (const std::string& folder : {folder_, around}) {
      if (!tree_->has(joined(folder, kCalibration))) continue;
      calibration_ = std::make_unique<KittiRawCalibration>(*tree_, folder);
      return;
    }
    const bool is_inside = !folder_.empty();
    const bool is_folder = detail::fileKind(tree_->root()) == detail::FileKind::folder;
    if (is_inside || !is_folder) return;
    const std::shared_ptr<const FileTree> outside = FileTree::open(tree_->root() + "/..");
    if (outside->has(kCalibration)) {
      calibration_ = std::make_unique<KittiRawCalibration>(*outside, "");
    }
  }

  void calibrate() {
    std::vector<CameraSensor>& sensors = sequence_.info.sensors.cameras;
    sequence_.info.body = "the left grey camera (camera 0)";
    if (calibration_ == nullptr && cameras_.size() > 1) {
      throw FileError(nameBelow(kCalibration),
                      "is missing, and in the folder around the drive, too; one camera "
                      "(stereo=false) needs none");
    }
    if (calibration_ == nullptr) {
      sequence_.remarks.say(std::string("there is no ") + kCalibration +
                            ": the camera is not calibrated");
      sequence_.info.body = "";
      sensors.push_back(cameraOf(kittiCameraName(cameras_[0]), Camera()));
      return;
    }
    for (std::size_t k = 0; k < cameras_.size(); ++k) {
      const ImageShape shape = shapeOfFile(*tree_, lists_[k][0].file);
      const bool is_rectified = calibration_->isRectified(cameras_[k], shape, is_rectified_);
      sensors.push_back(calibration_->camera(cameras_[k], is_rectified, shape));
    }
    has_body_ = calibration_->hasImu();
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
    const bool was_sorted = sortUnique(
        list, [](const ListedImage& one) { return one.stamp; },
        [this](const ListedImage& twin) {
          sequence_.remarks.skip("samples of oxts with the stamp of another", twin.file);
        });
    if (!was_sorted) {
      sequence_.remarks.say("oxts/timestamps.txt is not in the order of time: it was sorted");
    }
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
  std::unique_ptr<const KittiRawCalibration> calibration_;  // null: there is none
  bool is_synced_ = true;
  bool is_rectified_ = true;
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
