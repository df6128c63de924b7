// TUM RGB-D.
//
// J. Sturm et al., "A benchmark for the evaluation of RGB-D SLAM systems", IROS 2012; the heads are
// those of its files. calibration.txt is not in it, but in ETH3D's SLAM dataset, which has this
// layout too.
#include <memory>
#include <string>

#include "camera_text.h"
#include "euroc_files.h"
#include "layouts.h"
#include "rgbd.h"
#include "row.h"

namespace gslam {
inline namespace v1 {
namespace exporting {
namespace {

const char* const kModels = "pinhole, or radtan with k1 k2 p1 p2 k3";

class Tum : public Layout {
 public:
  explicit Tum(Source& from) : Layout(from) {
    source.keepCameras(1);
    checkRegistered(source);
    checkModel();
    source.dropGnss();
    if (source.depth() == nullptr) {
      source.notes.remark("there is no depth, and so neither depth/ nor depth.txt");
    }
    if (source.rig().has_imu) {
      source.notes.leftOut(
          "angular velocities and the place of the IMU: tum has acceleration only");
    }
  }

  void begin(ExportFolder& folder) override {
    folder_ = &folder;
    rgb_ = open("rgb.txt", "color images", "timestamp filename");
    folder.makeFolder("rgb");
    if (source.depth() != nullptr) {
      depth_ = open("depth.txt", "depth maps", "timestamp filename");
      folder.makeFolder("depth");
    }
    if (source.rig().has_imu) {
      accelerometer_ = open("accelerometer.txt", "accelerometer data", "timestamp ax ay az");
    }
    writeCalibration();
    writeTruth();
  }

  void writeSamples(const Frame& frame) override {
    if (accelerometer_ == nullptr) return;
    for (const ImuSample& sample : frame.imu) {
      if (!filter_.accept(sample, source.notes)) continue;
      accelerometer_->line(Row(" ").seconds(sample.stamp).vector(sample.accel).str());
    }
  }

  void prepare(const Frame& frame) override {
    images_ = rgbdImages(source, frame);
    stamp_ = secondsText(frame.stamp);
  }

  void commit() override {
    write("rgb/", images_.colour, *rgb_);
    if (!images_.depth.empty()) write("depth/", images_.depth, *depth_);
  }

 private:
  void checkModel() const {
    const Camera& camera = source.camera(0).camera;
    if (!camera.isValid()) return;
    PinholeText model;
    const bool is_pinhole = describePinhole(camera, model) && model.distortion != "equidistant";
    if (!is_pinhole || model.coefficients.size() > 5) source.failModel(0, kModels);
  }

  TextFile* open(const std::string& name, const char* what, const char* columns) {
    TextFile& file = folder_->openText(name);
    file.line(std::string("# ") + what);
    file.line("# file: '" + source.title() + "'");
    file.line(std::string("# ") + columns);
    return &file;
  }

  void write(const std::string& below, const Bytes& png, TextFile& list) {
    const std::string name = below + stamp_ + ".png";
    folder_->write(name, png);
    list.line(stamp_ + " " + name);
  }

  void writeCalibration() {
    PinholeText model;
    if (!describePinhole(source.camera(0).camera, model)) {
      source.notes.remark("camera: its model is not known, so that there is no calibration.txt");
      return;
    }
    std::string text = joined(model.intrinsics, " ");
    if (!model.coefficients.empty()) text += " " + joined(model.coefficients, " ");
    folder_->write("calibration.txt", text + "\n");
    source.notes.remark(
        "camera: calibration.txt has fx fy cx cy and the distortion k1 k2 p1 p2 k3, if any; the "
        "original has no such file");
  }

  void writeTruth() {
    const std::vector<StampedPose> poses = source.groundTruth(source.camera(0).T_body_camera);
    if (poses.empty()) return;
    TextFile* const file =
        open("groundtruth.txt", "ground truth trajectory", "timestamp tx ty tz qx qy qz qw");
    for (const StampedPose& pose : poses) {
      file->line(Row(" ").seconds(pose.stamp).poseXyzw(pose.pose).str());
    }
  }

  ExportFolder* folder_ = nullptr;
  TextFile* rgb_ = nullptr;
  TextFile* depth_ = nullptr;
  TextFile* accelerometer_ = nullptr;
  ImuFilter filter_;
  RgbdImages images_;  // of the frame in work
  std::string stamp_;
};

}  // namespace

std::unique_ptr<Layout> makeTum(Source& source) {
  return std::make_unique<Tum>(source);
}

}  // namespace exporting
}  // namespace v1
}  // namespace gslam
