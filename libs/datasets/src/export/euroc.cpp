// EuRoC MAV, the ASL layout.
//
// M. Burri et al., "The EuRoC micro aerial vehicle datasets", IJRR 35(10), 2016; the headers are
// those of its files.
#include <gslam/base/error.h>

#include <memory>
#include <string>
#include <vector>

#include "euroc_files.h"
#include "layouts.h"
#include "pixels.h"
#include "row.h"

namespace gslam {
inline namespace v1 {
namespace exporting {
namespace {

const char* const kTruthHead =
    "#timestamp, p_RS_R_x [m], p_RS_R_y [m], p_RS_R_z [m], q_RS_w [], q_RS_x [], q_RS_y [], "
    "q_RS_z [], v_RS_R_x [m s^-1], v_RS_R_y [m s^-1], v_RS_R_z [m s^-1], b_w_RS_S_x [rad s^-1], "
    "b_w_RS_S_y [rad s^-1], b_w_RS_S_z [rad s^-1], b_a_RS_S_x [m s^-2], b_a_RS_S_y [m s^-2], "
    "b_a_RS_S_z [m s^-2]";

// b is not before a.
double secondsBetween(const StampedPose& a, const StampedPose& b) {
  return double(nanosecondsBetween(a.stamp, b.stamp)) * 1e-9;
}

// Velocity at pose i, of the parabola through three poses; at an end the outer one of them.
Vec3d velocityAt(const std::vector<StampedPose>& poses, std::size_t i) {
  if (poses.size() < 2) return Vec3d{};
  const auto slope = [&](std::size_t k) {  // from k to k + 1
    const Vec3d way = poses[k + 1].pose.translation() - poses[k].pose.translation();
    return (1 / secondsBetween(poses[k], poses[k + 1])) * way;
  };
  if (poses.size() == 2) return slope(0);
  const std::size_t middle = i == 0 ? 1 : i + 1 == poses.size() ? i - 1 : i;
  const Vec3d before = slope(middle - 1), after = slope(middle);
  const double h0 = secondsBetween(poses[middle - 1], poses[middle]);
  const double h1 = secondsBetween(poses[middle], poses[middle + 1]);
  const Vec3d bend = (1 / (h0 + h1)) * (after - before);
  if (i < middle) return before - h0 * bend;
  return i == middle ? before + h0 * bend : after + h1 * bend;
}

class Euroc : public Layout {
 public:
  explicit Euroc(Source& from) : Layout(from) {
    for (std::size_t i = 0; i < source.cameras().size(); ++i) checkAslModel(source, i);
    source.dropDepth();
    source.dropGnss();
    if (source.rig().has_imu) noteImu(source);
    const SE3d& T_body_imu = source.rig().imu.T_body_imu;
    if (source.rig().has_imu && !T_body_imu.isApprox(SE3d(), 1e-9)) {
      source.notes.remark(
          "IMU: it is not where the body is; imu0/sensor.yaml says so, but many readers take the "
          "IMU of EuRoC for the body");
    }
  }

  void begin(ExportFolder& folder) override {
    folder.write("mav0/body.yaml", "%YAML:1.0\ncomment: " + source.title() + "\n");
    for (std::size_t i = 0; i < source.cameras().size(); ++i) {
      cameras_.push_back(std::make_unique<AslCamera>(folder, "mav0/cam" + std::to_string(i),
                                                     source.camera(i), SE3d()));
    }
    if (source.rig().has_imu) {
      imu_ = std::make_unique<AslImu>(folder, "mav0/imu0", source.rig().imu, SE3d());
    }
    writeTruth(folder);
  }

  void writeSamples(const Frame& frame) override {
    if (imu_ == nullptr) return;
    for (const ImuSample& sample : frame.imu) {
      if (filter_.accept(sample, source.notes)) imu_->write(sample);
    }
  }

  void prepare(const Frame& frame) override {
    images_.assign(cameras_.size(), Bytes());
    bool has_image = false;
    for (std::size_t i = 0; i < cameras_.size(); ++i) {
      const CameraImage* const image = source.image(frame, i);
      if (image == nullptr) continue;
      images_[i] = greyPng(*image, source.camera(i), source.notes);
      has_image = true;
    }
    if (!has_image) throw Error("there is no image");
    stamp_ = frame.stamp;
  }

  void commit() override {
    for (std::size_t i = 0; i < cameras_.size(); ++i) {
      if (!images_[i].empty()) cameras_[i]->write(stamp_, images_[i]);
    }
  }

  void finish() override {
    for (const auto& camera : cameras_) camera->finish();
    if (imu_ != nullptr) imu_->finish();
  }

 private:
  void writeTruth(ExportFolder& folder) {
    const std::vector<StampedPose> poses = source.groundTruth(SE3d());
    if (poses.empty()) return;
    const std::string name = "mav0/state_groundtruth_estimate0";
    folder.write(name + "/sensor.yaml",
                 "%YAML:1.0\n# General sensor definitions.\nsensor_type: visual-inertial\n"
                 "comment: ground truth\n\n# Sensor extrinsics wrt. the body-frame.\n" +
                     poseYaml(SE3d()));
    TextFile& csv = folder.openText(name + "/data.csv");
    csv.line(kTruthHead);
    for (std::size_t i = 0; i < poses.size(); ++i) {
      Row row(",");
      row.nanoseconds(poses[i].stamp).poseWxyz(poses[i].pose).vector(velocityAt(poses, i));
      csv.line(row.vector(Vec3d{}).vector(Vec3d{}).str());
    }
    source.notes.remark(
        "ground truth: velocities are differences of the positions, the biases of the IMU are not "
        "known and written as 0");
  }

  std::vector<std::unique_ptr<AslCamera>> cameras_;
  std::unique_ptr<AslImu> imu_;
  ImuFilter filter_;
  std::vector<Bytes> images_;  // of the frame in work
  std::int64_t stamp_ = 0;
};

}  // namespace

std::unique_ptr<Layout> makeEuroc(Source& source) {
  return std::make_unique<Euroc>(source);
}

}  // namespace exporting
}  // namespace v1
}  // namespace gslam
