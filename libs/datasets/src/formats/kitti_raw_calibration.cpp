// With the names of the devkit's readme: a point x of the laser scanner is seen by the rectified
// camera i at P_rect_0i * R_rect_00 * (R | T)_velo_to_cam * x; the camera that is not rectified has
// K_0i, D_0i, and (R_0i | T_0i) takes points of camera 0 to it.
#include "kitti_raw_calibration.h"

#include <gslam/base/error.h>

#include <vector>

#include "kitti_files.h"
#include "sequences.h"

namespace gslam {
inline namespace v1 {
namespace reading {
namespace {

std::string indexed(const std::string& name, std::size_t camera) {
  return name + "_0" + std::to_string(camera);
}

SE3d readTransform(const FileTree& tree, const std::string& file) {
  const NamedNumbers numbers(tree, file);
  return SE3d(numbers.rotation("R"), numbers.vector("T"));
}

bool isSize(const std::vector<double>& size, const ImageShape& shape) {
  return size[0] == shape.width && size[1] == shape.height;
}

std::string sizeText(double width, double height) {
  return std::to_string(static_cast<long>(width)) + " x " +
         std::to_string(static_cast<long>(height));
}

}  // namespace

KittiRawCalibration::KittiRawCalibration(const FileTree& tree, const std::string& folder)
    : cameras_(tree, joined(folder, "calib_cam_to_cam.txt")) {
  const std::string velo_to_cam = joined(folder, "calib_velo_to_cam.txt");
  const std::string imu_to_velo = joined(folder, "calib_imu_to_velo.txt");
  has_imu_ = tree.has(velo_to_cam) && tree.has(imu_to_velo);
  if (has_imu_) T_left_imu_ = readTransform(tree, velo_to_cam) * readTransform(tree, imu_to_velo);
}

bool KittiRawCalibration::isRectified(std::size_t camera, const ImageShape& shape,
                                      bool is_likely) const {
  const std::string raw_name = indexed("S", camera), rectified_name = indexed("S_rect", camera);
  const std::vector<double>& raw = cameras_.get(raw_name, 2);
  const std::vector<double>& rectified = cameras_.get(rectified_name, 2);
  const bool may_be_raw = isSize(raw, shape), may_be_rectified = isSize(rectified, shape);
  if (may_be_raw && may_be_rectified) return is_likely;
  if (may_be_raw || may_be_rectified) return may_be_rectified;
  cameras_.fail(rectified_name, "is " + sizeText(rectified[0], rectified[1]) + " and " + raw_name +
                                    " " + sizeText(raw[0], raw[1]) + ", but images are " +
                                    sizeText(shape.width, shape.height));
}

// Takes points of camera 0 to those of another, both not rectified.
SE3d KittiRawCalibration::fromLeft(std::size_t camera) const {
  if (camera == 0) return SE3d();
  return SE3d(cameras_.rotation(indexed("R", camera)), cameras_.vector(indexed("T", camera)));
}

CameraSensor KittiRawCalibration::camera(std::size_t camera, bool is_rectified,
                                         const ImageShape& shape) const {
  SE3d T_camera_left;  // from camera 0: the rectified one where nothing is known of the body
  Camera model;
  if (is_rectified) {
    const std::string name = indexed("P_rect", camera);
    Projection p{};
    std::string problem;
    if (!toProjection(cameras_.get(name, 12), p, problem)) cameras_.fail(name, problem);
    model = cameras_.camera(name, "pinhole", shape.width, shape.height, {p.fx, p.fy, p.cx, p.cy});
    T_camera_left = SE3d(SO3d(), p.offset);
    if (has_imu_) T_camera_left *= SE3d(cameras_.rotation("R_rect_00"), Vec3d{});
  } else {
    const std::string name = indexed("K", camera);
    const Mat3d k = cameras_.matrix(name);
    const std::vector<double>& d = cameras_.get(indexed("D", camera), 5);
    model = cameras_.camera(name, "radtan", shape.width, shape.height,
                            {k(0, 0), k(1, 1), k(0, 2), k(1, 2), d[0], d[1], d[2], d[3], d[4]});
    T_camera_left = fromLeft(camera);
  }
  CameraSensor sensor = cameraOf(kittiCameraName(camera), model);
  sensor.T_body_camera = (has_imu_ ? T_camera_left * T_left_imu_ : T_camera_left).inverse();
  return sensor;
}

}  // namespace reading
}  // namespace v1
}  // namespace gslam
