#ifndef GSLAM_DATASETS_EXPORT_DATASET_H
#define GSLAM_DATASETS_EXPORT_DATASET_H

#include <gslam/core/dataset.h>
#include <gslam/datasets/export.h>

#include <atomic>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <limits>
#include <string>
#include <vector>

/// @file
/// Writes any dataset as files in the layout of a public one, so that what reads that one reads it.

namespace gslam {
inline namespace v1 {

/// A layout that exportDataset() can write.
struct ExportFormat {
  std::string name;     ///< such as "tum"
  std::string summary;  ///< one line: whose layout it is, and what it holds
};

/// All of them: tum, euroc, kitti, icl, tummono, tumvi.
GSLAM_DATASETS_EXPORT std::vector<ExportFormat> exportFormats();

/// How to export.
struct ExportOptions {
  /// Names the sequence where the layout does: the folder "00" of kitti, "traj0" of icl's
  /// "traj0.gt.freiburg". Empty: these.
  std::string sequence;
  /// Most frames that are taken.
  std::size_t count = std::numeric_limits<std::size_t>::max();
  /// Is called after each frame, in the same thread; what it throws ends the export.
  /// `done` frames were taken, of `total`; 0: unknown.
  std::function<void(std::size_t done, std::size_t total)> progress;
  /// Once true, the export ends after the frame in work; null: it cannot be stopped. Any thread may
  /// set it.
  const std::atomic<bool>* stop = nullptr;
};

/// What was written, and what was not.
struct ExportReport {
  std::size_t frames = 0;             ///< with at least one image each
  std::size_t files = 0;              ///< images and text
  std::uint64_t bytes = 0;            ///< of all files
  bool is_stopped = false;            ///< by ExportOptions::stop
  std::vector<std::string> left_out;  ///< a sentence for each thing the layout has no place for
  std::vector<std::string> remarks;   ///< a sentence for each thing that was changed or assumed
};

/// Writes the frames that next() still gives, in the layout of a public dataset.
///
/// * tum: one camera as 8-bit colour, its depth, acceleration. Poses of that camera. Models: none,
///   pinhole, radtan with up to 5 coefficients.
/// * euroc: all cameras as 8-bit grey, IMU. Poses of the body. Models: pinhole, radtan with 4
///   coefficients, kannala_brandt.
/// * kitti: one or two rectified cameras as 8-bit grey. Poses of the left one, relative to its
///   first. Model: pinhole.
/// * icl: one camera as 8-bit colour, its depth. Poses of that camera, mirrored as there. Models:
///   none, pinhole.
/// * tummono: one camera as 8-bit grey, exposures. Poses of that camera. Models: pinhole, fov,
///   radtan with 4 coefficients, kannala_brandt.
/// * tumvi: all cameras as 16-bit grey, exposures, IMU. Poses of the IMU. Model: kannala_brandt.
///
/// Pixels are lossless PNG. Colour becomes grey, grey colour, u16 grey its upper 8 bits where the
/// layout wants it. A colour image of 16 bits cannot be written. Stamps are exact to the nanosecond
/// in all but icl, which counts frames. Poses are DatasetInfo::ground_truth, T_world_body, taken to
/// the frame of the layout.
///
/// What a layout cannot do without and the dataset lacks, or the other way round a camera model, is
/// an error before anything is written. What of other sensors has no place is left out and
/// reported, and so are frames that cannot be read or written and frames not later than the one
/// before.
///
/// When it is stopped, or fails, what was written before is a whole dataset of fewer frames.
///
/// @param dataset  read from where it is; nobody else may use it meanwhile
/// @param folder   made where it is not there; it must be empty
/// @param format   one of exportFormats()
/// @param options  the rest
/// @throws ArgumentError when the format is not known, or cannot hold the dataset
/// @throws FileError when the folder is not empty, or a file cannot be written
/// @throws Error when 100 frames in a row, or all, cannot be read or written
GSLAM_DATASETS_EXPORT ExportReport exportDataset(Dataset& dataset, const std::string& folder,
                                                 const std::string& format,
                                                 const ExportOptions& options = ExportOptions());

}  // namespace v1
}  // namespace gslam

#endif  // GSLAM_DATASETS_EXPORT_DATASET_H
