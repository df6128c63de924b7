#include "calibrations.h"

#include <gslam/base/error.h>
#include <gslam/datasets/calibration_file.h>

#include <cstdlib>
#include <fstream>
#include <sstream>

#include "test_data.h"

namespace calibrations {

namespace {

using gslam::Camera;

// All numbers of a text file without its comments and other words.
std::vector<double> numbersOfText(const std::string& path) {
  std::ifstream in(path);
  if (!in) throw gslam::FileError(path, "cannot be opened");
  std::vector<double> result;
  std::string line, word;
  while (std::getline(in, line)) {
    std::istringstream words(line.substr(0, line.find('#')));
    while (words >> word) {
      char* end = nullptr;
      const double value = std::strtod(word.c_str(), &end);
      if (*end == '\0') result.push_back(value);
    }
  }
  return result;
}

}  // namespace

Cameras read(const std::string& path) {
  gslam::CalibrationOptions options;
  options.bare_model = "EquiDistant";  // TUM-VI's files
  Cameras cameras;
  for (const gslam::CameraSensor& camera : gslam::readCalibration(path, options).rig.cameras) {
    if (camera.kind != gslam::ImageKind::depth) cameras.emplace_back(path, camera.camera);
  }
  return cameras;
}

Cameras kitti(const std::string& path, int width, int height) {
  Cameras cameras;
  const std::vector<double> n = numbersOfText(path);
  for (std::size_t i = 0; i + 12 <= n.size() && i < 48; i += 12) {
    cameras.emplace_back(path, Camera::fromParameters("pinhole", width, height,
                                                      {n[i], n[i + 5], n[i + 2], n[i + 6]}));
  }
  return cameras;
}

Cameras sevenScenes(const std::string& path) {
  const std::vector<double> n = numbersOfText(path);
  return {{path, Camera::fromParameters("pinhole", 640, 480, {n[0], n[4], n[2], n[5]})}};
}

Cameras all() {
  Cameras cameras;
  const auto add = [&](const Cameras& more) {
    cameras.insert(cameras.end(), more.begin(), more.end());
  };
  const std::string calibrations = test_data::folder() + "calibrations/",
                    sequences = test_data::folder() + "sequences/";
  for (const char* name : {"euroc_mav", "rs_d455", "tum_vi"}) {
    add(read(calibrations + "kalibr/" + name + "/kalibr_imucam_chain.yaml"));
  }
  for (const char* name : {"euroc_ds", "euroc_eucm", "tumvi_512_ds", "tumvi_512_eucm"}) {
    add(read(calibrations + "basalt/" + name + "_calib.json"));
  }
  for (const char* name :
       {"aist/equirectangular", "aist/fisheye", "euroc/EuRoC_mono", "euroc/EuRoC_stereo",
        "kitti/KITTI_mono_00-02", "kitti/KITTI_mono_03", "kitti/KITTI_mono_04-12",
        "kitti/KITTI_stereo_00-02", "kitti/KITTI_stereo_03", "kitti/KITTI_stereo_04-12",
        "tum_rgbd/TUM_RGBD_mono_1", "tum_rgbd/TUM_RGBD_mono_2", "tum_rgbd/TUM_RGBD_mono_3",
        "tum_rgbd/TUM_RGBD_rgbd_1", "tum_rgbd/TUM_RGBD_rgbd_2", "tum_rgbd/TUM_RGBD_rgbd_3",
        "tum_vi/TUM_VI_mono", "tum_vi/TUM_VI_stereo"}) {
    add(read(calibrations + "stella_vslam/" + name + ".yaml"));
  }
  for (const char* name :
       {"calib_results_640x480.txt", "rpg_svo_camera_atan.yaml",
        "equidistant/ORB_SLAM3_TUM-VI_KB8.yaml", "equidistant/dso_camera_tumvi_cam0.txt"}) {
    add(read(calibrations + name));
  }
  add(read(sequences + "euroc_V1_01_easy/mav0/cam0/sensor.yaml"));
  add(read(sequences + "euroc_V1_01_easy/mav0/cam1/sensor.yaml"));
  add(kitti(sequences + "kitti_06/sequences/06/calib.txt", 1226, 370));
  add(sevenScenes(sequences + "7scenes_redkitchen/camera-intrinsics.txt"));
  return cameras;
}

}  // namespace calibrations
