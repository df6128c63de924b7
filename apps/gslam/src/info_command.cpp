#include <gslam/core/stamp.h>
#include <gslam/core/trajectory_file.h>
#include <gslam/datasets/check_dataset.h>
#include <gslam/svar/json.h>

#include <atomic>
#include <iostream>
#include <sstream>

#include "command.h"
#include "dataset_option.h"
#include "interrupt.h"
#include "progress.h"
#include "stdout_guard.h"

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

bool hasStamps(const DatasetInfo& info) {
  return info.first_stamp != 0 || info.last_stamp != 0;
}

double secondsOf(const DatasetInfo& info) {
  return double(info.last_stamp - info.first_stamp) * 1e-9;
}

Svar describeDataset(const DatasetInfo& info) {
  Svar cameras = Svar::array();
  for (const CameraSensor& sensor : info.sensors.cameras) {
    cameras.push_back(describeCamera(sensor));
  }
  Svar result = Svar::object({{"name", info.name},
                              {"format", info.format},
                              {"licence", info.licence},
                              {"frames", info.frame_count},
                              {"live", info.is_live},
                              {"body", info.body},
                              {"clock", info.clock},
                              {"cameras", cameras},
                              {"gnss", info.sensors.has_gnss}});
  if (info.sensors.has_imu) result.set("imu", describeImu(info.sensors.imu));
  if (hasStamps(info)) {
    result.set("first_stamp", info.first_stamp);
    result.set("last_stamp", info.last_stamp);
    result.set("seconds", secondsOf(info));
  }
  if (!info.ground_truth.empty()) {
    result.set("ground_truth",
               Svar::object({{"poses", info.ground_truth.size()},
                             {"length_m", info.ground_truth.length()},
                             {"seconds", double(info.ground_truth.duration()) * 1e-9}}));
  }
  result.set("remarks", info.remarks);
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

void printImu(const gslam::ImuCalibration& imu) {
  std::cout << "IMU          " << imu.rate << " Hz\n  in body    " << imu.T_body_imu
            << "\n  noise      gyro " << imu.gyro_noise << " rad/s/sqrt(Hz), accel "
            << imu.accel_noise << " m/s^2/sqrt(Hz)\n";
}

void printGroundTruth(const gslam::Trajectory& truth) {
  if (truth.empty()) {
    std::cout << "ground truth none\n";
    return;
  }
  std::cout << "ground truth " << truth.size() << " poses, " << truth.length() << " m, "
            << double(truth.duration()) * 1e-9 << " s, from "
            << gslam::secondsText(truth.front().stamp) << " s on\n";
}

void printFrames(const DatasetInfo& info) {
  std::cout << "frames       "
            << (info.frame_count > 0 ? std::to_string(info.frame_count) : "unknown")
            << (info.is_live ? ", live" : "");
  if (hasStamps(info)) {
    std::cout << ", " << secondsOf(info) << " s, from " << gslam::secondsText(info.first_stamp)
              << " s on";
  }
  std::cout << '\n';
}

void printInfo(const DatasetInfo& info) {
  std::cout << "name         " << info.name << "\nformat       " << info.format << "\nlicence      "
            << (info.licence.empty() ? "unknown" : info.licence) << '\n';
  printFrames(info);
  std::cout << "clock        " << (info.clock.empty() ? "unknown" : info.clock) << "\nbody         "
            << (info.body.empty() ? "unknown" : info.body) << '\n';
  for (const CameraSensor& sensor : info.sensors.cameras) printCamera(sensor);
  if (info.sensors.has_imu) printImu(info.sensors.imu);
  if (info.sensors.has_gnss) std::cout << "GNSS         yes\n";
  printGroundTruth(info.ground_truth);
  for (const std::string& remark : info.remarks) std::cout << "note: " << remark << '\n';
}

Svar describeCheck(const gslam::DatasetCheck& check) {
  return Svar::object({{"frames", check.frames},
                       {"images", check.images},
                       {"imu_samples", check.imu_samples},
                       {"gnss_samples", check.gnss_samples},
                       {"longest_step_s", double(check.longest_step) * 1e-9},
                       {"stopped", check.is_stopped},
                       {"errors", check.errors},
                       {"warnings", check.warnings}});
}

void printCheck(const gslam::DatasetCheck& check) {
  std::cout << (check.is_stopped ? "stopped after " : "checked ") << check.frames << " frames, "
            << check.images << " images, " << check.imu_samples << " inertial samples, "
            << check.gnss_samples << " satellite positions; longest step "
            << double(check.longest_step) * 1e-9 << " s\n";
  for (const std::string& error : check.errors) std::cout << "error: " << error << '\n';
  for (const std::string& warning : check.warnings) std::cout << "warning: " << warning << '\n';
  if (check.errors.empty() && check.warnings.empty()) std::cout << "nothing is wrong with it\n";
}

gslam::DatasetCheck check(gslam::Dataset& dataset) {
  std::atomic<bool> stop{false};
  Progress progress;
  gslam::CheckOptions how;
  how.progress = [&progress](std::size_t done, std::size_t total) { progress.show(done, total); };
  how.stop = &stop;
  const OnInterrupt interrupt([&stop] { stop = true; });
  const StdoutGuard guard;  // what plugins print
  return gslam::checkDataset(dataset, how);
}

void writeGroundTruth(const DatasetInfo& info, const std::string& file) {
  if (info.ground_truth.empty()) {
    throw gslam::Error("dataset '" + info.name + "' has no ground truth to write to " + file);
  }
  gslam::writeTrajectory(file, info.ground_truth);
}

int checkStatus(const gslam::DatasetCheck& check) {
  if (check.is_stopped) return kInterrupted;
  return check.errors.empty() ? kSuccess : kFailure;
}

}  // namespace

int infoCommand(const std::vector<std::string>& arguments) {
  Options options("gslam info [options] DATASET",
                  "Says what is in a dataset: a file or folder, or the name of a kind of dataset.");
  declareDataset(options);
  options.arg<bool>("check", false, "read all of it, and say what is wrong with it");
  options.arg<std::string>("ground-truth", "", "file to write ground truth to, TUM format");
  if (!options.read(arguments)) return kSuccess;
  gslam::Plugins plugins;
  std::unique_ptr<gslam::Dataset> dataset;
  {
    const StdoutGuard guard;  // what plugins print
    dataset = openDataset(plugins, options, options.oneWord("DATASET"));
  }
  const auto truth = options.get<std::string>("ground-truth");
  if (!truth.empty()) writeGroundTruth(dataset->info(), truth);
  Svar result = describeDataset(dataset->info());
  if (!options.isJson()) printInfo(dataset->info());
  int status = kSuccess;
  if (options.get<bool>("check")) {
    const gslam::DatasetCheck found = check(*dataset);
    if (!options.isJson()) printCheck(found);
    result.set("check", describeCheck(found));
    status = checkStatus(found);
  }
  if (options.isJson()) std::cout << gslam::printJson(result) << '\n';
  return status;
}

}  // namespace app
