#include "calibrations.h"

#include <gslam/svar.h>
#include <gslam/svar_formats.h>

#include <cstdlib>
#include <fstream>
#include <sstream>

#include "test_data.h"

namespace calibrations {

namespace {

using gslam::Camera;
using gslam::Svar;
using Values = std::vector<double>;

double number(const Svar& value) {
  return value.as<double>();
}

Values numbers(const Svar& list) {
  Values result;
  for (std::size_t i = 0; i < list.size(); ++i) result.push_back(number(list[i]));
  return result;
}

Values membersOf(const Svar& object, const std::vector<std::string>& names) {
  Values result;
  for (const std::string& name : names) result.push_back(number(object[name]));
  return result;
}

Values joined(Values a, const Values& b) {
  a.insert(a.end(), b.begin(), b.end());
  return a;
}

// All numbers of a text file without its comments and other words.
Values numbersOfText(const std::string& path) {
  std::ifstream in(path);
  if (!in) throw gslam::FileError(path, "cannot be opened");
  Values result;
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

std::string modelOfKalibr(const std::string& distortion) {
  if (distortion == "equidistant") return "kannala_brandt";
  return distortion;
}

}  // namespace

Cameras kalibr(const std::string& path) {
  Cameras cameras;
  const Svar chain = gslam::loadYaml(path);
  for (const char* name : {"cam0", "cam1"}) {
    if (!chain.contains(name)) continue;
    const Svar cam = chain[name];
    const Values size = numbers(cam["resolution"]);
    cameras.emplace_back(
        path, Camera::fromParameters(
                  modelOfKalibr(cam.get<std::string>("distortion_model")),
                  static_cast<int>(size[0]), static_cast<int>(size[1]),
                  joined(numbers(cam["intrinsics"]), numbers(cam["distortion_coeffs"]))));
  }
  return cameras;
}

Cameras basalt(const std::string& path) {
  Cameras cameras;
  const Svar calibration = gslam::loadJson(path)["value0"];
  const Svar list = calibration["intrinsics"];
  for (std::size_t i = 0; i < list.size(); ++i) {
    const bool is_ds = list[i].get<std::string>("camera_type") == "ds";
    const Svar values = list[i]["intrinsics"];
    const Values size = numbers(calibration["resolution"][i]);
    cameras.emplace_back(
        path,
        Camera::fromParameters(
            is_ds ? "double_sphere" : "eucm", static_cast<int>(size[0]), static_cast<int>(size[1]),
            membersOf(values,
                      is_ds ? std::vector<std::string>{"fx", "fy", "cx", "cy", "xi", "alpha"}
                            : std::vector<std::string>{"fx", "fy", "cx", "cy", "alpha", "beta"})));
  }
  return cameras;
}

Cameras stella(const std::string& path) {
  const Svar camera = gslam::loadYaml(path)["Camera"];
  const int width = camera["cols"].as<int>(), height = camera["rows"].as<int>();
  const std::string model = camera.get<std::string>("model");
  if (model == "equirectangular") {
    return {{path, Camera::fromParameters(model, width, height, Values())}};
  }
  const bool is_fisheye = model == "fisheye";
  const Values values = membersOf(
      camera, is_fisheye
                  ? std::vector<std::string>{"fx", "fy", "cx", "cy", "k1", "k2", "k3", "k4"}
                  : std::vector<std::string>{"fx", "fy", "cx", "cy", "k1", "k2", "p1", "p2", "k3"});
  return {{path, Camera::fromParameters(is_fisheye ? model : "radtan", width, height, values)}};
}

Cameras ocamcalib(const std::string& path) {
  const Values n = numbersOfText(path);
  const std::size_t degree = static_cast<std::size_t>(n[0]);
  const std::size_t centre = 2 + degree + static_cast<std::size_t>(n[1 + degree]);
  Values values = {n[centre + 1], n[centre], n[centre + 2], n[centre + 3], n[centre + 4]};
  values.insert(values.end(), n.begin() + 1, n.begin() + 1 + static_cast<std::ptrdiff_t>(degree));
  values.resize(10);
  return {{path, Camera::fromParameters("ocam", static_cast<int>(n[centre + 6]),
                                        static_cast<int>(n[centre + 5]), values)}};
}

Cameras svoAtan(const std::string& path) {
  const Svar file = gslam::loadYaml(path);
  const Values size = membersOf(file, {"cam_width", "cam_height"});
  const Values v = membersOf(file, {"cam_fx", "cam_fy", "cam_cx", "cam_cy", "cam_d0"});
  return {
      {path, Camera::fromParameters("atan", static_cast<int>(size[0]), static_cast<int>(size[1]),
                                    {v[0] * size[0], v[1] * size[1], v[2] * size[0] - 0.5,
                                     v[3] * size[1] - 0.5, v[4]})}};
}

Cameras orbSlam3(const std::string& path) {
  const Svar file = gslam::loadYaml(path);
  Cameras cameras;
  for (const std::string camera : {"Camera1", "Camera2"}) {
    Values values;
    for (const char* name : {"fx", "fy", "cx", "cy", "k1", "k2", "k3", "k4"}) {
      values.push_back(number(file["/" + camera + "." + name]));
    }
    cameras.emplace_back(path, Camera::fromParameters("kannala_brandt", 512, 512, values));
  }
  return cameras;
}

Cameras dsoFisheye(const std::string& path) {
  const Values n = numbersOfText(path);
  return {
      {path, Camera::fromParameters("equidistant", static_cast<int>(n[8]), static_cast<int>(n[9]),
                                    {n[0] * n[8], n[1] * n[9], n[2] * n[8] - 0.5, n[3] * n[9] - 0.5,
                                     n[4], n[5], n[6], n[7]})}};
}

Cameras euroc(const std::string& path) {
  const Svar file = gslam::loadYaml(path);
  const Values size = numbers(file["resolution"]);
  return {
      {path, Camera::fromParameters(
                 "radtan", static_cast<int>(size[0]), static_cast<int>(size[1]),
                 joined(numbers(file["intrinsics"]), numbers(file["distortion_coefficients"])))}};
}

Cameras kitti(const std::string& path, int width, int height) {
  Cameras cameras;
  const Values n = numbersOfText(path);
  for (std::size_t i = 0; i + 12 <= n.size() && i < 48; i += 12) {
    cameras.emplace_back(path, Camera::fromParameters("pinhole", width, height,
                                                      {n[i], n[i + 5], n[i + 2], n[i + 6]}));
  }
  return cameras;
}

Cameras sevenScenes(const std::string& path) {
  const Values n = numbersOfText(path);
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
    add(kalibr(calibrations + "kalibr/" + name + "/kalibr_imucam_chain.yaml"));
  }
  for (const char* name : {"euroc_ds", "euroc_eucm", "tumvi_512_ds", "tumvi_512_eucm"}) {
    add(basalt(calibrations + "basalt/" + name + "_calib.json"));
  }
  for (const char* name :
       {"aist/equirectangular", "aist/fisheye", "euroc/EuRoC_mono", "euroc/EuRoC_stereo",
        "kitti/KITTI_mono_00-02", "kitti/KITTI_mono_03", "kitti/KITTI_mono_04-12",
        "kitti/KITTI_stereo_00-02", "kitti/KITTI_stereo_03", "kitti/KITTI_stereo_04-12",
        "tum_rgbd/TUM_RGBD_mono_1", "tum_rgbd/TUM_RGBD_mono_2", "tum_rgbd/TUM_RGBD_mono_3",
        "tum_rgbd/TUM_RGBD_rgbd_1", "tum_rgbd/TUM_RGBD_rgbd_2", "tum_rgbd/TUM_RGBD_rgbd_3",
        "tum_vi/TUM_VI_mono", "tum_vi/TUM_VI_stereo"}) {
    add(stella(calibrations + "stella_vslam/" + name + ".yaml"));
  }
  add(ocamcalib(calibrations + "calib_results_640x480.txt"));
  add(svoAtan(calibrations + "rpg_svo_camera_atan.yaml"));
  add(orbSlam3(calibrations + "equidistant/ORB_SLAM3_TUM-VI_KB8.yaml"));
  add(dsoFisheye(calibrations + "equidistant/dso_camera_tumvi_cam0.txt"));
  add(euroc(sequences + "euroc_V1_01_easy/mav0/cam0/sensor.yaml"));
  add(euroc(sequences + "euroc_V1_01_easy/mav0/cam1/sensor.yaml"));
  add(kitti(sequences + "kitti_06/sequences/06/calib.txt", 1226, 370));
  add(sevenScenes(sequences + "7scenes_redkitchen/camera-intrinsics.txt"));
  return cameras;
}

}  // namespace calibrations
