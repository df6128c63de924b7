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

/// Those of a file that gslam::readCalibration() reads, without depth.
Cameras read(const std::string& path);
/// KITTI odometry's calib.txt with the size of the images.
Cameras kitti(const std::string& path, int width, int height);
/// 7-Scenes' camera-intrinsics.txt.
Cameras sevenScenes(const std::string& path);

/// All of them.
Cameras all();

}  // namespace calibrations

#endif  // GSLAM_TESTS_GEOMETRY_REAL_CALIBRATIONS_H
