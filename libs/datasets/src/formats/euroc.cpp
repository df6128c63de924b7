// EuRoC MAV.
//
// M. Burri et al., "The EuRoC micro aerial vehicle datasets", IJRR 35(10), 2016, and
// projects.asl.ethz.ch/datasets/doku.php?id=kmavvisualinertialdatasets: mav0/ with cam0, cam1,
// imu0, leica0, vicon0, state_groundtruth_estimate0, each with data.csv and sensor.yaml.
#include <gslam/datasets/formats.h>

#include <utility>

#include "../reading/looks_like.h"
#include "asl.h"

namespace gslam {
inline namespace v1 {
namespace reading {
namespace {

// Whether it is one of EuRoC's, and not another sequence in the same layout: by its name, such as
// MH_01_easy or V2_03_difficult, or by its sensor.
bool isPublished(const Asl& asl) {
  for (const char* const place : {"MH_0", "V1_0", "V2_0"}) {
    const std::size_t at = asl.sequence.info.name.find(place);
    if (at == std::string::npos) continue;
    const std::string number = asl.sequence.info.name.substr(at + 4, 1);
    if (number >= "1" && number <= "5") return true;
  }
  const std::string file = asl.file("cam0/sensor.yaml");
  return asl.tree->has(file) && asl.tree->text(file).find("VI-Sensor") != std::string::npos;
}

std::unique_ptr<Dataset> openEuroc(const std::string& path, const Svar& parameters) {
  Asl asl = openAsl(path, parameters);
  DatasetInfo& info = asl.sequence.info;
  info.format = "euroc";
  if (isPublished(asl)) {
    info.licence =
        "EuRoC MAV, ASL, ETH Zurich: In Copyright - Non-Commercial Use Permitted; cite Burri et "
        "al., IJRR 2016";
  }
  info.clock = "POSIX time of the vehicle, in nanoseconds";
  readAslSensors(asl, isCalibrationOfUser(asl));
  takeCalibrationOfUser(asl);
  const bool is_imu = info.sensors.has_imu && info.sensors.imu.T_body_imu.isApprox(SE3d(), 1e-9);
  info.body = is_imu ? "the IMU (imu0), the body of T_BS in sensor.yaml"
                     : "the body of T_BS in sensor.yaml";
  readAslTruth(asl);
  return deliverAsl(std::move(asl));
}

}  // namespace
}  // namespace reading

DatasetFactory eurocFactory() {
  DatasetFactory factory;
  factory.name = "euroc";
  factory.description = "EuRoC MAV and others in the ASL layout: cameras, IMU, ground truth";
  factory.parameters = reading::aslParameters();
  factory.recognizes = reading::recognizesAs(factory.name);
  factory.open = reading::openEuroc;
  return factory;
}

}  // namespace v1
}  // namespace gslam
