// Cameras of the calibration files of other projects, as they are published.
#ifndef GSLAM_TESTS_GEOMETRY_REAL_CALIBRATIONS_H
#define GSLAM_TESTS_GEOMETRY_REAL_CALIBRATIONS_H

#include <gslam/geometry/camera.h>

#include <string>
#include <utility>
#include <vector>

namespace calibrations {

/// Cameras, each with the file it is from.
using Cameras = std::vector<std::pair<std::string, gslam::Camera>>;

/// Kalibr's camchain, as OpenVINS writes it.
Cameras kalibr(const std::string& path);
/// Basalt: double sphere and EUCM.
Cameras basalt(const std::string& path);
/// stella_vslam: perspective, fisheye and equirectangular.
Cameras stella(const std::string& path);
/// OCamCalib's text file.
Cameras ocamcalib(const std::string& path);
/// SVO's ATAN cameras, in units of the image size.
Cameras svoAtan(const std::string& path);
/// ORB-SLAM3 with two KannalaBrandt8 cameras.
Cameras orbSlam3(const std::string& path);
/// DSO's fisheye, in units of the image size.
Cameras dsoFisheye(const std::string& path);
/// EuRoC's sensor.yaml.
Cameras euroc(const std::string& path);
/// KITTI odometry's calib.txt with the size of the images.
Cameras kitti(const std::string& path, int width, int height);
/// 7-Scenes' camera-intrinsics.txt.
Cameras sevenScenes(const std::string& path);

/// All of them.
Cameras all();

}  // namespace calibrations

#endif  // GSLAM_TESTS_GEOMETRY_REAL_CALIBRATIONS_H
