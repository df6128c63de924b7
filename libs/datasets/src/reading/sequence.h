// What the readers of all formats make: a list of what there is, and how an image is loaded. One
// Dataset delivers them all.
#ifndef GSLAM_DATASETS_SRC_READING_SEQUENCE_H
#define GSLAM_DATASETS_SRC_READING_SEQUENCE_H

#include <gslam/core/dataset.h>
#include <gslam/core/sensor.h>
#include <gslam/datasets/export.h>
#include <gslam/svar/svar.h>

#include <cstddef>
#include <cstdint>
#include <functional>
#include <memory>
#include <string>
#include <vector>

#include "file_tree.h"
#include "remarks.h"

namespace gslam {
inline namespace v1 {
namespace reading {

/// Frame::has_prior and Frame::prior.
struct Prior {
  bool is_known = false;
  PoseWithCovariance<SE3d> pose;
};

/// A sequence that was looked through, and not loaded.
struct Sequence {
  /// `frame_count`, `first_stamp`, `last_stamp` and `remarks` are set by deliver(); `rate` of
  /// cameras and of the inertial unit, where it is 0, too.
  DatasetInfo info;
  /// Of the frames, nanoseconds, none before the one before it.
  std::vector<std::int64_t> stamps;
  /// Of image [frame * cameras + camera], nanoseconds; empty: all unknown.
  std::vector<std::int64_t> exposures;
  /// All samples of the sequence, by stamp.
  std::vector<ImuSample> imu;
  std::vector<GnssSample> gnss;
  /// Poses as another source has them, for each frame; empty: none has one.
  std::vector<Prior> priors;
  /// Loads the image of a camera in a frame; no image where this frame has none of this camera.
  /// Several threads call it at once, unless `in_order`. What it throws next() throws.
  std::function<Image(std::size_t frame, std::size_t camera)> load;
  /// One thread loads, frame by frame, as videos want it.
  bool in_order = false;
  Remarks remarks;  ///< become those of `info`
};

/// How frames are loaded ahead.
struct Prefetch {
  int threads = 2;  ///< that load; 0: none do, next() loads
  int frames = 8;   ///< most frames that are loaded and not taken
};

/// The parameters that all formats have, with their defaults: "threads", "ahead". Those of a format
/// are added with set().
GSLAM_DATASETS_EXPORT Svar commonParameters();
/// @throws ArgumentError when one is out of range
GSLAM_DATASETS_EXPORT Prefetch prefetchOf(const Svar& parameters);

/// The parameter `tolerance`, which is in seconds, in nanoseconds.
/// @param usual, most  seconds
/// @throws ArgumentError when it is below 0 or above `most`
std::int64_t toleranceOf(const Svar& parameters, double usual, int most);

/// Delivers a sequence: frames go out in order, with the inertial and satellite samples after the
/// frame before and up to the frame's stamp (the first frame has all up to its own). Those of a
/// frame that cannot be loaded go out with the one after it. Gaps between frames, and samples that
/// no frame has, become remarks.
/// @throws Error when there is no frame, or stamps are not in order or centuries apart
GSLAM_DATASETS_EXPORT std::unique_ptr<Dataset> deliver(Sequence sequence, const Prefetch& prefetch);

/// Image files for Sequence::load: a name for image [frame * cameras + camera], relative to `tree`;
/// an empty one where the frame has none. Each camera's images must be of the shape that its first
/// one has; those of depth have one channel of u16 or f32.
struct ImageFiles {
  std::shared_ptr<const FileTree> tree;
  std::vector<std::string> names;
};

/// Sets `sequence.load` to load these, and the `kind` of cameras by looking at the first image of
/// each. A calibrated camera whose size is not that of its images is an error.
/// @throws FileError that names the image
void loadImageFiles(Sequence& sequence, ImageFiles files);

/// Sorts samples by stamp, and takes out those that have the stamp of another before them. Says how
/// many were out of order, and which were taken out.
/// @param file  what remarks call their file
void sortByStamp(std::vector<ImuSample>& samples, const std::string& file, Remarks& remarks);
void sortByStamp(std::vector<GnssSample>& samples, const std::string& file, Remarks& remarks);

}  // namespace reading
}  // namespace v1
}  // namespace gslam

#endif  // GSLAM_DATASETS_SRC_READING_SEQUENCE_H
