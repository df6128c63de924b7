// The cameras of KITTI raw, from the three files of its date folders.
#ifndef GSLAM_DATASETS_SRC_FORMATS_KITTI_RAW_CALIBRATION_H
#define GSLAM_DATASETS_SRC_FORMATS_KITTI_RAW_CALIBRATION_H

#include <gslam/core/frame.h>

#include <cstddef>
#include <memory>
#include <string>

#include "../reading/decode.h"
#include "../reading/file_tree.h"
#include "number_file.h"

namespace gslam {
inline namespace v1 {
namespace reading {

class KittiRawCalibration {
 public:
  /// @param folder  that has calib_cam_to_cam.txt, and perhaps calib_velo_to_cam.txt and
  ///   calib_imu_to_velo.txt
  /// @throws FileError, ParseError
  KittiRawCalibration(const FileTree& tree, const std::string& folder);

  /// Whether it is known where the inertial unit is, which is the body then; else the left camera
  /// is.
  bool hasImu() const noexcept { return has_imu_; }

  /// Whether images of a size are rectified ones of a camera, by S_xx and S_rect_xx.
  /// @param is_likely  what is taken where both sizes are the same
  /// @throws ParseError when it is neither size
  bool isRectified(std::size_t camera, const ImageShape& shape, bool is_likely) const;

  /// A camera with its place on the body.
  CameraSensor camera(std::size_t camera, bool is_rectified, const ImageShape& shape) const;

 private:
  SE3d fromLeft(std::size_t camera) const;

  NamedNumbers cameras_;
  bool has_imu_ = false;
  SE3d T_left_imu_;  // left: camera 0, not rectified
};

}  // namespace reading
}  // namespace v1
}  // namespace gslam

#endif  // GSLAM_DATASETS_SRC_FORMATS_KITTI_RAW_CALIBRATION_H
