// The stereo factors that GTSAM's examples have as text.
#ifndef GSLAM_OPTIMIZER_TESTS_BACKEND_CONTRACT_STEREO_FACTORS_H
#define GSLAM_OPTIMIZER_TESTS_BACKEND_CONTRACT_STEREO_FACTORS_H

#include <cstddef>
#include <cstdint>
#include <fstream>
#include <map>
#include <string>
#include <vector>

#include "scenes.h"

namespace backend_contract {

/// fx fy skew cx cy baseline
inline bool readStereoCalibration(const std::string& path, BundleScene& scene) {
  std::ifstream file(path);
  double fx = 0, fy = 0, skew = 0, cx = 0, cy = 0, baseline = 0;
  if (!(file >> fx >> fy >> skew >> cx >> cy >> baseline) || skew != 0) return false;
  scene.cameras = {Camera::fromParameters("pinhole", 1242, 376, {fx, fy, cx, cy})};
  scene.baseline = {baseline};
  return true;
}

/// Lines of a number and T_world_camera, 4 x 4, row by row. The index of each number.
inline std::map<std::size_t, std::uint32_t> readStereoPoses(const std::string& path,
                                                            BundleScene& scene) {
  std::map<std::size_t, std::uint32_t> index;
  std::ifstream file(path);
  for (std::size_t number = 0; file >> number;) {
    double m[16];
    for (double& value : m) file >> value;
    const double tolerance = 1e-4;  // they are written with six digits
    const gslam::Mat3d rotation = {m[0], m[1], m[2], m[4], m[5], m[6], m[8], m[9], m[10]};
    index[number] = static_cast<std::uint32_t>(scene.poses.size());
    scene.poses.push_back(SE3d(SO3d::fromMatrix(rotation, tolerance), Vec3d{m[3], m[7], m[11]}));
  }
  return index;
}

/// Lines of a pose's and a point's number, u in the left image, u in the right one, v, and the
/// point in the camera. A point begins where its first line has it.
inline bool readStereoFactors(const std::string& path,
                              const std::map<std::size_t, std::uint32_t>& index_of_pose,
                              BundleScene& scene) {
  std::map<std::size_t, std::uint32_t> index_of_point;
  std::ifstream file(path);
  std::size_t pose = 0, point = 0;
  double left = 0, right = 0, v = 0;
  Vec3d in_camera{};
  while (file >> pose >> point >> left >> right >> v >> in_camera[0] >> in_camera[1] >>
         in_camera[2]) {
    const auto found = index_of_pose.find(pose);
    if (found == index_of_pose.end()) return false;
    const auto place =
        index_of_point.emplace(point, static_cast<std::uint32_t>(scene.points.size()));
    if (place.second) scene.points.push_back(scene.poses[found->second] * in_camera);
    scene.of_pose.push_back(found->second);
    scene.of_point.push_back(place.first->second);
    scene.pixels.push_back({left, v});
    scene.right_u.push_back(right);
  }
  return file.eof();
}

/// The set of a calibration, camera poses and factors, whose first pose is fixed; empty where a
/// file is not what it should be.
inline BundleScene readStereoScene(const std::string& calibration, const std::string& poses,
                                   const std::string& factors) {
  BundleScene scene;
  if (!readStereoCalibration(calibration, scene)) return {};
  const std::map<std::size_t, std::uint32_t> index = readStereoPoses(poses, scene);
  if (index.empty() || !readStereoFactors(factors, index, scene)) return {};
  scene.pose_fixed.assign(scene.poses.size(), 0);
  scene.pose_fixed[0] = 1;
  return scene;
}

}  // namespace backend_contract

#endif  // GSLAM_OPTIMIZER_TESTS_BACKEND_CONTRACT_STEREO_FACTORS_H
