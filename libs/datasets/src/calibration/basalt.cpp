// Basalt's calibration JSON.
//
// Names and order: gitlab.com/VladyslavUsenko/basalt-headers, include/basalt/serialization/
// headers_serialization.h and calibration/calibration.hpp, whose noises are continuous and whose
// cam_time_offset_ns is added to stamps of images.
#include <algorithm>
#include <cmath>

#include "formats.h"

namespace gslam {
inline namespace v1 {
namespace calibration {
namespace {

struct BasaltModel {
  const char* theirs;
  const char* ours;
  std::vector<std::string> names;  // of the values, in our order
};

const std::vector<BasaltModel>& models() {
  static const std::vector<BasaltModel> all = {
      {"ds", "double_sphere", {"fx", "fy", "cx", "cy", "xi", "alpha"}},
      {"eucm", "eucm", {"fx", "fy", "cx", "cy", "alpha", "beta"}},
      {"ucm", "ucm", {"fx", "fy", "cx", "cy", "alpha"}},
      {"kb4", "kannala_brandt", {"fx", "fy", "cx", "cy", "k1", "k2", "k3", "k4"}},
      {"fov", "fov", {"fx", "fy", "cx", "cy", "w"}},
      {"pinhole", "pinhole", {"fx", "fy", "cx", "cy"}},
      {"pinhole-radtan8",
       "radtan",
       {"fx", "fy", "cx", "cy", "k1", "k2", "p1", "p2", "k3", "k4", "k5", "k6"}}};
  return all;
}

const BasaltModel& modelOf(const Fields& type) {
  std::string expected;
  for (const BasaltModel& model : models()) {
    if (type.text() == model.theirs) return model;
    expected += (expected.empty() ? "" : ", ") + std::string(model.theirs);
  }
  type.fail("is '" + type.text() + "', expected one of " + expected);
}

Camera basaltCamera(const Fields& camera, ImageSize size) {
  const BasaltModel& model = modelOf(camera["camera_type"]);
  const Fields values = camera["intrinsics"];
  std::vector<double> parameters;
  for (const std::string& name : model.names) parameters.push_back(values[name].number());
  if (model.ours != std::string("radtan")) return makeCamera(values, model.ours, size, parameters);
  const auto first = parameters.begin() + 4;
  return radtanOrPinhole(values, size, {parameters.begin(), first}, {first, parameters.end()});
}

SE3d poseOf(const Fields& pose) {
  const double q[] = {pose["qx"].number(), pose["qy"].number(), pose["qz"].number(),
                      pose["qw"].number()};
  const double norm = std::sqrt(q[0] * q[0] + q[1] * q[1] + q[2] * q[2] + q[3] * q[3]);
  if (!(std::fabs(norm - 1) < 0.02)) {
    pose.fail("has a quaternion of norm " + std::to_string(norm) + ", expected 1");
  }
  return SE3d(SO3d::fromQuaternion(q[0], q[1], q[2], q[3]),
              {{pose["px"].number(), pose["py"].number(), pose["pz"].number()}});
}

void readBasaltImu(const Fields& root, Calibration& result) {
  result.rig.has_imu = true;
  ImuCalibration& imu = result.rig.imu;
  imu.rate = root.number("imu_update_rate", 0);
  const auto noise = [&](const char* name) {
    return root.has(name) ? noiseOf(root[name], result) : 0;
  };
  imu.gyro_noise = noise("gyro_noise_std");
  imu.accel_noise = noise("accel_noise_std");
  imu.gyro_bias_walk = noise("gyro_bias_std");
  imu.accel_bias_walk = noise("accel_bias_std");
  if (imu.gyro_noise == 0) result.remarks.push_back("the noise of the IMU is not in this file");
  for (const char* name : {"calib_accel_bias", "calib_gyro_bias"}) {
    if (!root.has(name)) continue;
    const std::vector<double> values = root[name].numbers();
    if (std::any_of(values.begin(), values.end(), [](double v) { return v != 0; })) {
      result.remarks.push_back(std::string(name) +
                               ": bias, scale and misalignment of the IMU were not taken over");
    }
  }
}

std::int64_t timeOffsetOf(const Fields& root) {
  if (!root.has("cam_time_offset_ns")) return 0;
  const double value = root["cam_time_offset_ns"].number();
  if (!(std::fabs(value) < 9e18) || value != std::floor(value)) {
    root["cam_time_offset_ns"].fail("is no whole number of nanoseconds");
  }
  return static_cast<std::int64_t>(value);
}

}  // namespace

bool isBasalt(const Document& document) {
  return document.root.has("value0") && document.root["value0"].has("intrinsics");
}

Calibration parseBasalt(const Document& document) {
  const Fields root = document.root["value0"];
  const Fields cameras = root["intrinsics"], sizes = root["resolution"], places = root["T_imu_cam"];
  Calibration result;
  result.body = "the IMU";
  for (const Fields* list : {&sizes, &places}) {
    if (list->size() != cameras.size()) {
      list->fail("has " + std::to_string(list->size()) + " elements, expected one for each of " +
                 std::to_string(cameras.size()) + " cameras");
    }
  }
  if (cameras.size() == 0) cameras.fail("is empty, expected cameras");
  const std::int64_t offset = timeOffsetOf(root);
  for (std::size_t i = 0; i < cameras.size(); ++i) {
    const Camera camera = basaltCamera(cameras.at(i), sizeOf(sizes.at(i)));
    const std::string name = "cam" + std::to_string(i);
    result.rig.cameras.push_back(makeSensor(name, camera, poseOf(places.at(i))));
    result.time_offsets.push_back(offset);
  }
  if (offset != 0) {
    result.remarks.push_back("stamps of the cameras are to be shifted by " +
                             std::to_string(offset) + " ns to be those of the IMU");
  }
  readBasaltImu(root, result);
  return result;
}

}  // namespace calibration
}  // namespace v1
}  // namespace gslam
