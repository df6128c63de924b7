// TUM-VI, the archives of EuRoC and DSO layout: mav0/ as in EuRoC, with 16-bit images and mocap0;
// dso/ with exposures, photometric calibration and Kalibr's camchain.yaml. Body is the IMU.
//
// D. Schubert et al., "The TUM VI benchmark for evaluating visual-inertial odometry", IROS 2018.
#include <gslam/base/error.h>

#include <memory>
#include <string>
#include <vector>

#include "camera_text.h"
#include "euroc_files.h"
#include "layouts.h"
#include "photometric.h"
#include "pixels.h"
#include "row.h"

namespace gslam {
inline namespace v1 {
namespace exporting {
namespace {

std::string matrixYaml(const SE3d& pose) {
  const SE3d::Matrix m = pose.matrix();
  std::string text;
  for (std::size_t i = 0; i < 4; ++i) {
    text += "  - [" + joined({m(i, 0), m(i, 1), m(i, 2), m(i, 3)}, ", ") + "]\n";
  }
  return text;
}

// dso/imu.txt has a sample at the stamp of each image, interpolated where the unit made none.
class ImuAtImages {
 public:
  explicit ImuAtImages(TextFile& file) : file_(file) {
    file_.line("# timestamp[ns] w.x w.y w.z a.x a.y a.z");
  }
  void addImage(std::int64_t stamp) {
    if (has_last_ && stamp > last_.stamp) waiting_.push_back(stamp);
  }
  void add(const ImuSample& sample) {
    for (std::int64_t stamp : waiting_) {
      if (stamp < sample.stamp) write(between(sample, stamp));
    }
    waiting_.clear();
    write(sample);
    last_ = sample;
    has_last_ = true;
  }

 private:
  ImuSample between(const ImuSample& next, std::int64_t stamp) const {
    const double part = double(nanosecondsBetween(last_.stamp, stamp)) /
                        double(nanosecondsBetween(last_.stamp, next.stamp));
    return {stamp, last_.gyro + part * (next.gyro - last_.gyro),
            last_.accel + part * (next.accel - last_.accel)};
  }
  void write(const ImuSample& sample) {
    file_.line(Row(" ").nanoseconds(sample.stamp).vector(sample.gyro).vector(sample.accel).str());
  }

  TextFile& file_;
  ImuSample last_{};
  bool has_last_ = false;
  std::vector<std::int64_t> waiting_;  // images later than the last sample
};

class Tumvi : public Layout {
 public:
  explicit Tumvi(Source& from) : Layout(from) {
    for (std::size_t i = 0; i < source.cameras().size(); ++i) {
      source.needModel(i);
      if (source.camera(i).camera.modelName() != "kannala_brandt") {
        source.failModel(i, "kannala_brandt");
      }
    }
    source.dropDepth();
    source.dropGnss();
    notePhotometric(source);
    if (!source.rig().has_imu) return;
    noteImu(source);
    T_body_imu_ = source.rig().imu.T_body_imu;
  }

  void begin(ExportFolder& folder) override {
    folder_ = &folder;
    const SE3d T_imu_body = T_body_imu_.inverse();
    for (std::size_t i = 0; i < source.cameras().size(); ++i) beginCamera(i, T_imu_body);
    folder.write("dso/camchain.yaml", camchain());
    if (source.rig().has_imu) {
      imu_ = std::make_unique<AslImu>(folder, "mav0/imu0", source.rig().imu, T_imu_body);
      dso_imu_ = std::make_unique<ImuAtImages>(folder.openText("dso/imu.txt"));
      folder.write("dso/imu_config.yaml", imuConfig());
    }
    writeTruth();
  }

  void writeSamples(const Frame& frame) override {
    if (imu_ == nullptr) return;
    for (const ImuSample& sample : frame.imu) {
      if (!filter_.accept(sample, source.notes)) continue;
      imu_->write(sample);
      dso_imu_->add(sample);
    }
  }

  void prepare(const Frame& frame) override {
    images_.assign(cameras_.size(), Bytes());
    exposures_.assign(cameras_.size(), "0");
    bool has_image = false;
    for (std::size_t i = 0; i < cameras_.size(); ++i) {
      const CameraImage* const image = source.image(frame, i);
      if (image == nullptr) continue;
      images_[i] = grey16Png(*image, source.camera(i), source.notes);
      exposures_[i] = exposureText(image->exposure, source.notes);
      has_image = true;
    }
    if (!has_image) throw Error("there is no image");
    stamp_ = frame.stamp;
  }

  void commit() override {
    const std::string stamp = std::to_string(stamp_);
    for (std::size_t i = 0; i < cameras_.size(); ++i) {
      if (images_[i].empty()) continue;
      cameras_[i]->write(stamp_, images_[i]);
      if (!is_linked_) folder_->write(dsoFolder(i) + "images/" + stamp + ".png", images_[i]);
      times_[i]->line(Row(" ").text(stamp).seconds(stamp_).text(exposures_[i]).str());
    }
    if (dso_imu_ != nullptr) dso_imu_->addImage(stamp_);
  }

  void finish() override {
    for (const auto& camera : cameras_) camera->finish();
    if (imu_ != nullptr) imu_->finish();
  }

 private:
  static std::string cameraName(std::size_t i) { return "cam" + std::to_string(i); }
  static std::string dsoFolder(std::size_t i) { return "dso/" + cameraName(i) + "/"; }

  void beginCamera(std::size_t i, const SE3d& T_imu_body) {
    const CameraSensor& sensor = source.camera(i);
    cameras_.push_back(
        std::make_unique<AslCamera>(*folder_, "mav0/" + cameraName(i), sensor, T_imu_body));
    folder_->write(dsoFolder(i) + "camera.txt", dsoCameraText(sensor.camera));
    writePhotometric(*folder_, dsoFolder(i), sensor.camera);
    times_.push_back(&folder_->openText(dsoFolder(i) + "times.txt"));
    times_.back()->line("# timestamp[ns] timestamp[s] exposure[ms]");
    // The same images a second time: a link where there are links.
    const std::string target = "../../mav0/" + cameraName(i) + "/data";
    is_linked_ = is_linked_ && folder_->link(target, dsoFolder(i) + "images");
  }

  std::string camchain() const {
    std::string text;
    for (std::size_t i = 0; i < source.cameras().size(); ++i) {
      const CameraSensor& sensor = source.camera(i);
      PinholeText model;
      describePinhole(sensor.camera, model);
      text += cameraName(i) + ":\n  T_cam_imu:\n" +
              matrixYaml(sensor.T_body_camera.inverse() * T_body_imu_);
      if (i > 0) {
        text += "  T_cn_cnm1:\n" +
                matrixYaml(sensor.T_body_camera.inverse() * source.camera(i - 1).T_body_camera);
      }
      text += "  camera_model: pinhole\n  distortion_coeffs: [" + joined(model.coefficients, ", ") +
              "]\n  distortion_model: equidistant\n  intrinsics: [" +
              joined(model.intrinsics, ", ") + "]\n  resolution: [" +
              std::to_string(sensor.camera.width()) + ", " +
              std::to_string(sensor.camera.height()) + "]\n  rostopic: /" + cameraName(i) +
              "/image_raw\n";
    }
    return text;
  }

  std::string imuConfig() const {
    const ImuCalibration& imu = source.rig().imu;
    return "accelerometer_noise_density: " + numberText(imu.accel_noise) +
           "\naccelerometer_random_walk: " + numberText(imu.accel_bias_walk) +
           "\ngyroscope_noise_density: " + numberText(imu.gyro_noise) +
           "\ngyroscope_random_walk: " + numberText(imu.gyro_bias_walk) +
           "\nrostopic: /imu0\nupdate_rate: " + numberText(imu.rate) + "\n";
  }

  void writeTruth() {
    const std::vector<StampedPose> poses = source.groundTruth(T_body_imu_);
    if (poses.empty()) return;
    TextFile& mocap = folder_->openText("mav0/mocap0/data.csv");
    mocap.line(
        "#timestamp [ns], p_RS_R_x [m], p_RS_R_y [m], p_RS_R_z [m], q_RS_w [], q_RS_x [], "
        "q_RS_y [], q_RS_z []");
    TextFile& dso = folder_->openText("dso/gt_imu.csv");
    dso.line("# timestamp[ns],tx,ty,tz,qw,qx,qy,qz");
    for (const StampedPose& pose : poses) {
      const std::string line = Row(",").nanoseconds(pose.stamp).poseWxyz(pose.pose).str();
      mocap.line(line);
      dso.line(line);
    }
  }

  SE3d T_body_imu_;  // the identity where there is no IMU
  ExportFolder* folder_ = nullptr;
  std::vector<std::unique_ptr<AslCamera>> cameras_;
  std::vector<TextFile*> times_;
  bool is_linked_ = true;
  std::unique_ptr<AslImu> imu_;
  std::unique_ptr<ImuAtImages> dso_imu_;
  ImuFilter filter_;
  std::vector<Bytes> images_;  // of the frame in work
  std::vector<std::string> exposures_;
  std::int64_t stamp_ = 0;
};

}  // namespace

std::unique_ptr<Layout> makeTumvi(Source& source) {
  return std::make_unique<Tumvi>(source);
}

}  // namespace exporting
}  // namespace v1
}  // namespace gslam
