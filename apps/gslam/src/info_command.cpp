#include <gslam/core/open_dataset.h>
#include <gslam/core/stamp.h>
#include <gslam/svar/json.h>

#include <iostream>
#include <sstream>

#include "command.h"
#include "options.h"

namespace app {
namespace {

using gslam::CameraSensor;
using gslam::DatasetInfo;
using gslam::Svar;

template <class T>
std::string textOf(const T& value) {
  std::ostringstream out;
  out << value;
  return out.str();
}

Svar describePose(const gslam::SE3d& pose) {
  const gslam::Vec3d& t = pose.translation();
  const gslam::SO3d& q = pose.rotation();
  return Svar::array({t[0], t[1], t[2], q.x(), q.y(), q.z(), q.w()});
}

Svar describeCamera(const CameraSensor& sensor) {
  Svar camera = Svar::object({{"name", sensor.name},
                              {"kind", gslam::imageKindName(sensor.kind)},
                              {"rate", sensor.rate},
                              {"T_body_camera", describePose(sensor.T_body_camera)}});
  if (sensor.depth_scale > 0) camera.set("depth_scale", sensor.depth_scale);
  if (!sensor.camera.isValid()) return camera;
  camera.set("model", sensor.camera.modelName());
  camera.set("width", sensor.camera.width());
  camera.set("height", sensor.camera.height());
  camera.set("parameters", sensor.camera.parameters());
  return camera;
}

Svar describeImu(const gslam::ImuCalibration& imu) {
  return Svar::object({{"rate", imu.rate},
                       {"T_body_imu", describePose(imu.T_body_imu)},
                       {"gyro_noise", imu.gyro_noise},
                       {"accel_noise", imu.accel_noise},
                       {"gyro_bias_walk", imu.gyro_bias_walk},
                       {"accel_bias_walk", imu.accel_bias_walk}});
}

Svar describe(const DatasetInfo& info) {
  Svar cameras = Svar::array();
  for (const CameraSensor& sensor : info.sensors.cameras) {
    cameras.push_back(describeCamera(sensor));
  }
  Svar result = Svar::object({{"name", info.name},
                              {"format", info.format},
                              {"licence", info.licence},
                              {"frames", info.frame_count},
                              {"live", info.is_live},
                              {"cameras", cameras},
                              {"gnss", info.sensors.has_gnss}});
  if (info.sensors.has_imu) result.set("imu", describeImu(info.sensors.imu));
  if (!info.ground_truth.empty()) {
    result.set("ground_truth",
               Svar::object({{"poses", info.ground_truth.size()},
                             {"length_m", info.ground_truth.length()},
                             {"seconds", double(info.ground_truth.duration()) * 1e-9}}));
  }
  return result;
}

void printCamera(const CameraSensor& sensor) {
  std::cout << "camera       " << sensor.name << ", " << gslam::imageKindName(sensor.kind);
  if (sensor.rate > 0) std::cout << ", " << sensor.rate << " Hz";
  if (sensor.depth_scale > 0) std::cout << ", " << sensor.depth_scale << " m a unit";
  std::cout << "\n  model      "
            << (sensor.camera.isValid() ? textOf(sensor.camera) : "not calibrated")
            << "\n  in body    " << sensor.T_body_camera << "   (tx ty tz qx qy qz qw)\n";
}

void printInfo(const DatasetInfo& info) {
  std::cout << "name         " << info.name << "\nformat       " << info.format << "\nlicence      "
            << (info.licence.empty() ? "unknown" : info.licence) << "\nframes       "
            << (info.frame_count > 0 ? std::to_string(info.frame_count) : "unknown")
            << (info.is_live ? ", live" : "") << '\n';
  for (const CameraSensor& sensor : info.sensors.cameras) printCamera(sensor);
  if (info.sensors.has_imu) {
    const gslam::ImuCalibration& imu = info.sensors.imu;
    std::cout << "IMU          " << imu.rate << " Hz\n  in body    " << imu.T_body_imu
              << "\n  noise      gyro " << imu.gyro_noise << " rad/s/sqrt(Hz), accel "
              << imu.accel_noise << " m/s^2/sqrt(Hz)\n";
  }
  if (info.sensors.has_gnss) std::cout << "GNSS         yes\n";
  if (info.ground_truth.empty()) {
    std::cout << "ground truth none\n";
    return;
  }
  const gslam::Trajectory& truth = info.ground_truth;
  std::cout << "ground truth " << truth.size() << " poses, " << truth.length() << " m, "
            << double(truth.duration()) * 1e-9 << " s, from "
            << gslam::secondsText(truth.front().stamp) << " s on\n";
}

}  // namespace

int infoCommand(const std::vector<std::string>& arguments) {
  Options options("gslam info [options] DATASET",
                  "Says what is in a dataset: a file or folder, or the name of a kind of dataset.");
  options.arg<gslam::Svar>("dataset-param", gslam::Svar::object(),
                           "parameters of the dataset, as --dataset-param.NAME VALUE");
  if (!options.read(arguments)) return kSuccess;
  gslam::Plugins plugins;
  const std::unique_ptr<gslam::Dataset> dataset = gslam::openDataset(
      plugins, options.oneWord("DATASET"), options.get<gslam::Svar>("dataset-param"));
  if (options.isJson()) {
    std::cout << gslam::printJson(describe(dataset->info())) << '\n';
  } else {
    printInfo(dataset->info());
  }
  return kSuccess;
}

}  // namespace app
