// KITTI odometry.
//
// A. Geiger et al., "Are we ready for autonomous driving? The KITTI vision benchmark suite", CVPR
// 2012. Cameras are rectified; poses are those of the left one, seen from where it was first.
#include <gslam/base/error.h>

#include <cmath>
#include <memory>
#include <string>
#include <vector>

#include "layouts.h"
#include "pixels.h"
#include "row.h"

namespace gslam {
inline namespace v1 {
namespace exporting {
namespace {

std::string matrixRow(const Mat<double, 3, 4>& m) {
  Row row(" ");
  for (std::size_t i = 0; i < 3; ++i) {
    for (std::size_t j = 0; j < 4; ++j) row.text(scientificText(m(i, j), 12));
  }
  return row.str();
}

// Takes points of the left camera to pixels of a camera that is `baseline` metres right of it.
std::string projectionRow(const Camera& camera, double baseline) {
  const std::vector<double> p = camera.parameters();
  Mat<double, 3, 4> m{};
  m(0, 0) = p[0];
  m(1, 1) = p[1];
  m(0, 2) = p[2];
  m(1, 2) = p[3];
  m(2, 2) = 1;
  m(0, 3) = baseline == 0 ? 0 : -p[0] * baseline;
  return matrixRow(m);
}

class Kitti : public Layout {
 public:
  explicit Kitti(Source& from) : Layout(from), sequence_(source.sequence("00")) {
    source.keepCameras(2);
    for (std::size_t i = 0; i < source.cameras().size(); ++i) {
      source.needModel(i);
      if (source.camera(i).camera.modelName() != "pinhole") source.failModel(i, "pinhole");
    }
    if (source.cameras().size() == 2) baseline_ = rectifiedBaseline();
    if (source.cameras().size() == 1) {
      source.notes.remark("there is one camera: P0 to P3 of calib.txt are the same");
    } else {
      source.notes.remark("there are no colour cameras: P2 and P3 of calib.txt are P0 and P1");
    }
    source.dropDepth();
    source.dropImu();
    source.dropGnss();
  }

  void begin(ExportFolder& folder) override {
    folder_ = &folder;
    const Camera& camera = source.camera(0).camera;
    const std::string left = projectionRow(camera, 0), right = projectionRow(camera, baseline_);
    folder.write(below("calib.txt"),
                 "P0: " + left + "\nP1: " + right + "\nP2: " + left + "\nP3: " + right + "\n");
    for (std::size_t i = 0; i < source.cameras().size(); ++i) folder.makeFolder(imageFolder(i));
    times_ = &folder.openText(below("times.txt"));
  }

  void prepare(const Frame& frame) override {
    images_.clear();
    for (std::size_t i = 0; i < source.cameras().size(); ++i) {
      const CameraImage* const image = source.image(frame, i);
      if (image == nullptr) {
        throw Error("there is no image of camera '" + source.camera(i).name + "'");
      }
      images_.push_back(greyPng(*image, source.camera(i), source.notes));
    }
    stamp_ = frame.stamp;
  }

  void commit() override {
    if (index_ == 0) first_stamp_ = stamp_;
    const std::string name = "/" + paddedText(index_, 6) + ".png";
    for (std::size_t i = 0; i < images_.size(); ++i) {
      folder_->write(imageFolder(i) + name, images_[i]);
    }
    times_->line(secondsText(static_cast<std::int64_t>(nanosecondsBetween(first_stamp_, stamp_))));
    addPose();
    ++index_;
  }

  void finish() override {
    if (first_stamp_ != 0) {
      source.notes.remark("stamps begin at 0 in times.txt; the first one was " +
                          secondsText(first_stamp_) + " s");
    }
  }

 private:
  std::string below(const std::string& name) const { return "sequences/" + sequence_ + "/" + name; }
  std::string imageFolder(std::size_t camera) const {
    return below("image_" + std::to_string(camera));
  }
  std::string posesName() const { return "poses/" + sequence_ + ".txt"; }

  // Metres from the left to the right camera.
  double rectifiedBaseline() const {
    const CameraSensor &left = source.camera(0), &right = source.camera(1);
    const SE3d T_left_right = left.T_body_camera.inverse() * right.T_body_camera;
    const Vec3d& t = T_left_right.translation();
    const double aside = std::hypot(t[1], t[2]);
    const double angle = T_left_right.rotation().log().norm();
    if (left.camera == right.camera && t[0] > 0 && aside <= 1e-4 * t[0] && angle <= 1e-5) {
      return t[0];
    }
    throw ArgumentError("camera '" + right.name + "'",
                        "is not the rectified right one of camera '" + left.name +
                            "', which kitti wants: the same model, right of it along its x axis, "
                            "not turned; rectify both, or write euroc");
  }

  // The file has a line for each frame, so that none can be left out.
  void addPose() {
    if (source.info().ground_truth.empty() || has_gap_) return;
    SE3d T_world_camera;
    if (!source.poseAt(stamp_, source.camera(0).T_body_camera, T_world_camera)) {
      has_gap_ = true;
      if (poses_ != nullptr) folder_->remove(posesName());
      source.notes.leftOut("ground truth: it has none of frame " + std::to_string(index_) + " at " +
                           secondsText(stamp_) + " s, and kitti must have one of each");
      return;
    }
    if (poses_ == nullptr) {
      poses_ = &folder_->openText(posesName());
      T_first_world_ = T_world_camera.inverse();
    }
    poses_->line(matrixRow((T_first_world_ * T_world_camera).matrix3x4()));
  }

  std::string sequence_;
  double baseline_ = 0;
  ExportFolder* folder_ = nullptr;
  TextFile* times_ = nullptr;
  TextFile* poses_ = nullptr;
  bool has_gap_ = false;
  SE3d T_first_world_;
  std::vector<Bytes> images_;  // of the frame in work
  std::int64_t stamp_ = 0, first_stamp_ = 0;
  std::size_t index_ = 0;
};

}  // namespace

std::unique_ptr<Layout> makeKitti(Source& source) {
  return std::make_unique<Kitti>(source);
}

}  // namespace exporting
}  // namespace v1
}  // namespace gslam
