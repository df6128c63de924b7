// The ASL layout, mav0/cam0 and so on, which EuRoC MAV and TUM-VI have in common.
#ifndef GSLAM_DATASETS_SRC_FORMATS_ASL_H
#define GSLAM_DATASETS_SRC_FORMATS_ASL_H

#include <gslam/datasets/calibration_file.h>

#include <cstddef>
#include <map>
#include <memory>
#include <string>
#include <vector>

#include "../reading/image_list.h"
#include "../reading/sequence.h"

namespace gslam {
inline namespace v1 {
namespace reading {

/// A sequence that is being read.
struct Asl {
  std::shared_ptr<const FileTree> tree;  ///< seen from the folder around mav0; from mav0 itself
                                         ///< where the user names that
  std::string mav;                       ///< "mav0"; "" where the tree is it
  Svar parameters;                       ///< of the user, over aslParameters()
  std::vector<std::size_t> cameras;      ///< numbers of those that are read
  Sequence sequence;

  /// "mav0/cam0/data.csv" of "cam0/data.csv".
  std::string file(const std::string& name) const { return joined(mav, name); }
  /// "cam0/" of camera i of `cameras`.
  std::string cameraFolder(std::size_t i) const;
};

/// commonParameters() and these: `cameras` (numbers, "0,1"; "": all), `list` (file of each camera
/// that names its images), `tolerance` (seconds between images of one frame), `calibration` (a file
/// that readCalibration() reads, in place of the dataset's), `truth` (folder of the ground truth;
/// "": the first of state_groundtruth_estimate0, mocap0, vicon0).
Svar aslParameters();

/// Finds the sequence in what the user names: the folder around mav0, mav0, one around these, or
/// the archive of them. Sets name and cameras.
/// @throws FileError when there is none, ArgumentError when it has not the cameras of the user
Asl openAsl(const std::string& path, const Svar& parameters);

/// Whether the parameter `calibration` is given, so that what the dataset says of cameras may be
/// wrong.
bool isCalibrationOfUser(const Asl& asl);

/// Cameras by their sensor.yaml, and the inertial unit with its samples and sensor.yaml. What is
/// missing is said.
/// @param is_replaced  another calibration follows: a camera's file that cannot be read is said
///   then, and no error
void readAslSensors(Asl& asl, bool is_replaced);

/// Where a sensor is: T_BS of its folder's sensor.yaml, of which nothing else is looked at; the
/// identity where there is no such file.
/// @param folder  such as "cam0"
SE3d placeOfSensor(const Asl& asl, const std::string& folder);

/// Takes models of cameras from a calibration of all, by their numbers, and the noise of the
/// inertial unit where it has one. Where cameras are is taken, too, where the calibration says that
/// by the inertial unit; where it says that of one camera by another, the first of them stays where
/// it was.
/// @param file  what errors and remarks call it
void takeCalibration(Asl& asl, const Calibration& calibration, const std::string& file);
/// The same of the parameter `calibration`, where it is given.
/// @param bare_model  CalibrationOptions::bare_model
void takeCalibrationOfUser(Asl& asl, const std::string& bare_model = "");

/// Poses of the ground truth, as poses of the body.
void readAslTruth(Asl& asl);

/// How long images of a camera were exposed, nanoseconds.
struct AslExposures {
  std::string file;                              ///< that says it; "": none does
  std::map<std::int64_t, std::int64_t> exact;    ///< by the stamp
  std::map<std::int64_t, std::int64_t> rounded;  ///< by the stamp as it became of a number in
                                                 ///< seconds, where that is all there is
};

/// Reads the lists of images, makes frames and delivers.
/// @param exposures  for each camera that is read; empty: unknown
std::unique_ptr<Dataset> deliverAsl(Asl asl, const std::vector<AslExposures>& exposures = {});

/// A calibration file in a tree, with its remarks.
Calibration calibrationIn(const FileTree& tree, const std::string& file, Remarks& remarks,
                          const CalibrationOptions& options = CalibrationOptions());

}  // namespace reading
}  // namespace v1
}  // namespace gslam

#endif  // GSLAM_DATASETS_SRC_FORMATS_ASL_H
