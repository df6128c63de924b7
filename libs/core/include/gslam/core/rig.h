#ifndef GSLAM_CORE_RIG_H
#define GSLAM_CORE_RIG_H

#include <gslam/core/frame.h>
#include <gslam/core/sensor.h>
#include <gslam/geometry/vec.h>

#include <cstddef>
#include <string>
#include <vector>

/// @file
/// The sensors that a dataset has, and those that a SLAM system needs.

namespace gslam {
inline namespace v1 {

/// The sensors of a body, each with its calibration.
struct SensorRig {
  std::vector<CameraSensor> cameras;  ///< in the order of Frame::images
  bool has_imu = false;               ///< whether frames have inertial samples
  ImuCalibration imu;                 ///< where they are measured
  bool has_gnss = false;              ///< whether frames have satellite positions
  Vec3d gnss_antenna{};               ///< where the antenna is, body coordinates, metres
};

/// What a SLAM system cannot do without.
struct SensorNeeds {
  int cameras = 1;          ///< cameras for brightness or colour
  bool depth = false;       ///< a camera for depth
  bool imu = false;         ///< an inertial unit
  bool gnss = false;        ///< a satellite receiver
  bool calibration = true;  ///< the model of each camera
};

/// Whether images of a kind show brightness or colour.
inline bool isPhotographic(ImageKind kind) noexcept {
  switch (kind) {
    case ImageKind::grey:
    case ImageKind::rgb:
    case ImageKind::bgr:
    case ImageKind::rgba:
    case ImageKind::bgra:
    case ImageKind::bayer:
    case ImageKind::infrared:
      return true;
    default:
      return false;
  }
}

namespace detail {

inline void addNeed(std::string& list, const std::string& need) {
  list += (list.empty() ? "" : ", ") + need;
}

inline std::string countOf(int count, const std::string& thing) {
  return count == 1 ? "1 " + thing : std::to_string(count) + " " + thing + "s";
}

// Cameras of some kinds.
struct CameraCount {
  int all = 0;
  int calibrated = 0;
  std::string uncalibrated;  // their names
};

template <class IsCounted>
CameraCount countCameras(const SensorRig& rig, const IsCounted& is_counted) {
  CameraCount count;
  for (const CameraSensor& sensor : rig.cameras) {
    if (!is_counted(sensor.kind)) continue;
    ++count.all;
    if (sensor.camera.isValid()) {
      ++count.calibrated;
    } else {
      addNeed(count.uncalibrated, "camera '" + sensor.name + "'");
    }
  }
  return count;
}

}  // namespace detail

/// For people: "2 calibrated cameras, an IMU"; "nothing" for no needs.
inline std::string toText(const SensorNeeds& needs) {
  const std::string calibrated = needs.calibration ? "calibrated " : "";
  std::string text;
  if (needs.cameras > 0) {
    detail::addNeed(text, detail::countOf(needs.cameras, calibrated + "camera"));
  }
  if (needs.depth) detail::addNeed(text, calibrated + "depth");
  if (needs.imu) detail::addNeed(text, "an IMU");
  if (needs.gnss) detail::addNeed(text, "GNSS");
  return text.empty() ? "nothing" : text;
}

/// What a rig lacks, as the end of the sentence "the dataset lacks ..."; empty where nothing is
/// missing.
inline std::string missingSensors(const SensorNeeds& needs, const SensorRig& rig) {
  const detail::CameraCount cameras = detail::countCameras(rig, isPhotographic);
  const detail::CameraCount depth =
      detail::countCameras(rig, [](ImageKind kind) { return kind == ImageKind::depth; });
  std::string missing;
  if (cameras.all < needs.cameras) {
    detail::addNeed(missing, detail::countOf(needs.cameras, "camera") + " (it has " +
                                 std::to_string(cameras.all) + ")");
  }
  if (needs.depth && depth.all == 0) detail::addNeed(missing, "depth images");
  if (needs.imu && !rig.has_imu) detail::addNeed(missing, "an IMU");
  if (needs.gnss && !rig.has_gnss) detail::addNeed(missing, "GNSS positions");
  if (!needs.calibration) return missing;
  if (cameras.all >= needs.cameras && cameras.calibrated < needs.cameras) {
    detail::addNeed(missing, "the calibration of " + cameras.uncalibrated);
  }
  if (needs.depth && depth.all > 0 && depth.calibrated == 0) {
    detail::addNeed(missing, "the calibration of " + depth.uncalibrated);
  }
  return missing;
}

}  // namespace v1
}  // namespace gslam

#endif  // GSLAM_CORE_RIG_H
