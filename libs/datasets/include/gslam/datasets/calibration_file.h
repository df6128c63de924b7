#ifndef GSLAM_DATASETS_CALIBRATION_FILE_H
#define GSLAM_DATASETS_CALIBRATION_FILE_H

#include <gslam/core/rig.h>
#include <gslam/datasets/export.h>

#include <cstdint>
#include <string>
#include <vector>

/// @file
/// Calibrations in the files of other projects.
///
/// Conventions become those of GSLAM: pixel (0, 0) is the centre of the first pixel, cameras look
/// along z, and T_body_camera takes camera to body coordinates. What each format means by its
/// numbers is taken from the source of the program that reads it.

namespace gslam {
inline namespace v1 {

/// A format that readCalibration() knows.
struct CalibrationFormat {
  std::string name;     ///< such as "kalibr"
  std::string summary;  ///< one line: whose files they are, and which models they have
};

/// All of them: kalibr, opencv, ocamcalib, basalt, orbslam, colmap, euroc, dso, stella, svo.
GSLAM_DATASETS_EXPORT std::vector<CalibrationFormat> calibrationFormats();

/// How a calibration is read.
struct CalibrationOptions {
  /// One of calibrationFormats(); empty: what the content shows.
  std::string format;
  /// @{
  /// Size of the images, where the file does not say it; 0: an error then. Where it does, its own
  /// counts.
  int width = 0;
  int height = 0;
  /// @}
  /// What eight numbers without a word before them mean in DSO's files: "RadTan", as DSO has it, or
  /// "EquiDistant", as TUM-VI's files want it. Empty: RadTan, with a remark.
  std::string bare_model;
};

/// What a calibration file says.
struct Calibration {
  /// `has_imu` is set where the file says where cameras are by an inertial unit, or how that errs.
  SensorRig rig;
  std::string format;  ///< one of calibrationFormats()
  std::string body;    ///< what the body is, such as "the IMU"; empty: nothing says it
  /// For each camera, nanoseconds to add to its stamps so that they are on the inertial unit's
  /// clock. Nothing that reads datasets adds them by itself.
  std::vector<std::int64_t> time_offsets;
  /// A sentence for what was assumed, is missing, or was not used.
  std::vector<std::string> remarks;
};

// clang-format off
/// Reads a calibration.
///
/// | format | cameras | other |
/// | --- | --- | --- |
/// | kalibr | pinhole, omni, ds, eucm with radtan, equidistant, fov, none | chain, IMU, time shift |
/// | opencv | 0, 4, 5, 8, 12, 14 coefficients, fisheye, omnidir; YAML, XML; ROS' camera_info | R, T |
/// | ocamcalib | polynomial of up to 5 coefficients | |
/// | basalt | ds, eucm, ucm, kb4, fov, pinhole, pinhole-radtan8 | IMU, time offset |
/// | orbslam | PinHole, KannalaBrandt8, Rectified; of ORB-SLAM2, too | baseline, IMU, depth |
/// | colmap | cameras.txt: all models that Camera has | |
/// | euroc | sensor.yaml of a camera or an IMU | T_BS, rates |
/// | dso | camera.txt: Pinhole, FOV, RadTan, EquiDistant, KannalaBrandt | |
/// | stella | perspective, fisheye, equirectangular; OpenVSLAM's, too | baseline, rectification, depth |
/// | svo | ATAN, Pinhole, Equidistant | |
///
/// Cameras are those of the images as they were taken: what a file says of images that its program
/// makes of them (rectified, cropped or scaled ones) is a remark. A pinhole with radial and
/// tangential coefficients that are all 0 is the model `pinhole`.
///
/// @param path     the file
/// @param options  as said there
/// @throws FileError when it cannot be read; ParseError that names file, line or field, and what
///   was expected, when it is none of the formats, or not as its format wants it
/// @throws ArgumentError when an option is wrong
// clang-format on
GSLAM_DATASETS_EXPORT Calibration
readCalibration(const std::string& path, const CalibrationOptions& options = CalibrationOptions());

/// The same from the text of a file.
/// @param text     all of it
/// @param source   what errors call it
/// @param options  as above
/// @throws ParseError, ArgumentError as above
GSLAM_DATASETS_EXPORT Calibration
parseCalibration(const std::string& text, const std::string& source,
                 const CalibrationOptions& options = CalibrationOptions());

}  // namespace v1
}  // namespace gslam

#endif  // GSLAM_DATASETS_CALIBRATION_FILE_H
