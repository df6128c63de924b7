// ICL-NUIM, in the form that its authors made compatible with TUM RGB-D (the archives
// ..._frei_png.tar.gz): rgb/<i>.png, depth/<i>.png, associations.txt, <name>.gt.freiburg, where the
// index of the frame stands for its stamp.
//
// A. Handa et al., "A benchmark for RGB-D visual odometry, 3D reconstruction and SLAM", ICRA 2014.
//
// Its camera has fy = -480: y points up in its camera and its world, which are left-handed. Its
// poses go with that. What is written here does the same: the images are as they are, poses are
// mirrored (S R S, S t with S = diag(1, -1, 1)), and fy in calibration.txt is negative. Who reads
// the original rightly, with a negative fy or by mirroring its poses, reads this.
#include <memory>
#include <string>

#include "camera_text.h"
#include "layouts.h"
#include "rgbd.h"
#include "row.h"

namespace gslam {
inline namespace v1 {
namespace exporting {
namespace {

// S T S: turning about y stays, about x and z is the other way round.
SE3d mirrored(const SE3d& pose) {
  const Vec<double, 4>& q = pose.rotation().quaternion();
  const Vec3d& t = pose.translation();
  return SE3d(SO3d::fromQuaternion(-q[0], q[1], -q[2], q[3]), Vec3d{{t[0], -t[1], t[2]}});
}

class Icl : public Layout {
 public:
  explicit Icl(Source& from) : Layout(from) {
    source.keepCameras(1);
    if (source.depth() == nullptr) {
      throw ArgumentError("dataset", "has no depth images, which icl cannot do without");
    }
    checkRegistered(source);
    const Camera& camera = source.camera(0).camera;
    if (camera.isValid() && camera.modelName() != "pinhole") source.failModel(0, "pinhole");
    source.dropImu();
    source.dropGnss();
    source.notes.leftOut("stamps: icl has numbers of frames, which stand for 1/30 s each");
    source.notes.remark("poses are mirrored in y, as icl's are, whose camera has a negative fy");
  }

  void begin(ExportFolder& folder) override {
    folder_ = &folder;
    folder.makeFolder("rgb");
    folder.makeFolder("depth");
    associations_ = &folder.openText("associations.txt");
    if (!source.info().ground_truth.empty()) {
      truth_ = &folder.openText(source.sequence("traj0") + ".gt.freiburg");
    }
    PinholeText model;
    if (!describePinhole(source.camera(0).camera, model)) return;
    model.intrinsics[1] = -model.intrinsics[1];
    folder.write("calibration.txt", joined(model.intrinsics, " ") + "\n");
    source.notes.remark(
        "camera: calibration.txt has fx -fy cx cy; the original has no such file, its camera is "
        "481.2 -480 319.5 239.5");
  }

  void prepare(const Frame& frame) override {
    images_ = rgbdImages(source, frame);
    if (images_.depth.empty()) throw Error("there is no depth image");
    stamp_ = frame.stamp;
  }

  void commit() override {
    const std::string index = std::to_string(index_++);
    const std::string rgb = "rgb/" + index + ".png", depth = "depth/" + index + ".png";
    folder_->write(rgb, images_.colour);
    folder_->write(depth, images_.depth);
    associations_->line(index + " " + depth + " " + index + " " + rgb);
    SE3d pose;
    if (truth_ == nullptr) return;
    if (source.poseAt(stamp_, source.camera(0).T_body_camera, pose)) {
      truth_->line(Row(" ").text(index).poseXyzw(mirrored(pose)).str());
    } else {
      source.notes.count("frames", "they are there, but have no ground truth");
    }
  }

 private:
  ExportFolder* folder_ = nullptr;
  TextFile* associations_ = nullptr;
  TextFile* truth_ = nullptr;
  RgbdImages images_;  // of the frame in work
  std::int64_t stamp_ = 0;
  std::size_t index_ = 0;
};

}  // namespace

std::unique_ptr<Layout> makeIcl(Source& source) {
  return std::make_unique<Icl>(source);
}

}  // namespace exporting
}  // namespace v1
}  // namespace gslam
