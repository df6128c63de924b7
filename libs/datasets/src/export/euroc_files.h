// The files of the ASL format, which EuRoC and TUM-VI have in common.
#ifndef GSLAM_DATASETS_SRC_EXPORT_EUROC_FILES_H
#define GSLAM_DATASETS_SRC_EXPORT_EUROC_FILES_H

#include <cstddef>
#include <cstdint>
#include <string>

#include "export_folder.h"
#include "source.h"

namespace gslam {
inline namespace v1 {
namespace exporting {

/// Measures the rate of what comes, for those who do not know it.
class RateMeter {
 public:
  void add(std::int64_t stamp) noexcept {
    if (count_++ == 0) first_ = stamp;
    last_ = stamp;
  }
  std::size_t count() const noexcept { return count_; }
  /// Per second; 0: unknown.
  double rate() const noexcept {
    const double seconds = double(nanosecondsBetween(first_, last_)) * 1e-9;
    return count_ < 2 || !(seconds > 0) ? 0 : double(count_ - 1) / seconds;
  }

 private:
  std::size_t count_ = 0;
  std::int64_t first_ = 0, last_ = 0;
};

/// A folder such as mav0/cam0: data/<ns>.png, data.csv, sensor.yaml.
class AslCamera {
 public:
  /// @param name    such as "mav0/cam0"
  /// @param T_base_body  what sensor.yaml takes for the body
  AslCamera(ExportFolder& folder, const std::string& name, const CameraSensor& sensor,
            const SE3d& T_base_body);

  void write(std::int64_t stamp, const Bytes& png);
  /// Writes the rate, where it was not known.
  void finish();

 private:
  void writeSensor(double rate);

  ExportFolder& folder_;
  std::string name_;
  CameraSensor sensor_;
  SE3d T_base_camera_;
  TextFile& csv_;
  RateMeter meter_;
};

/// A folder such as mav0/imu0: data.csv, sensor.yaml.
class AslImu {
 public:
  AslImu(ExportFolder& folder, const std::string& name, const ImuCalibration& calibration,
         const SE3d& T_base_body);

  void write(const ImuSample& sample);
  void finish();

 private:
  void writeSensor(double rate);

  ExportFolder& folder_;
  std::string name_;
  ImuCalibration calibration_;
  SE3d T_base_imu_;
  TextFile& csv_;
  RateMeter meter_;
};

/// Those samples of a frame that are finite and later than all before; the others are counted as
/// left out.
class ImuFilter {
 public:
  /// @return whether the sample is to be written
  bool accept(const ImuSample& sample, Notes& notes);

 private:
  std::int64_t last_ = 0;
  bool has_last_ = false;
};

/// The four lines of a pose in sensor.yaml.
std::string poseYaml(const SE3d& T_base_sensor);

/// @throws ArgumentError when the camera i has a model that sensor.yaml has no words for
void checkAslModel(const Source& source, std::size_t i);

/// What readers must know of the noise of the unit.
void noteImu(Source& source);

}  // namespace exporting
}  // namespace v1
}  // namespace gslam

#endif  // GSLAM_DATASETS_SRC_EXPORT_EUROC_FILES_H
