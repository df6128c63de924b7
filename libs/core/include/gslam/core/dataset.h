#ifndef GSLAM_CORE_DATASET_H
#define GSLAM_CORE_DATASET_H

#include <gslam/core/frame.h>
#include <gslam/core/rig.h>
#include <gslam/core/trajectory.h>

#include <cstddef>
#include <cstdint>
#include <memory>
#include <string>
#include <vector>

/// @file
/// A source of frames: files or a device.

namespace gslam {
inline namespace v1 {

/// What is known of a dataset before its first frame.
struct DatasetInfo {
  std::string name;              ///< such as "MH_01_easy"
  std::string format;            ///< such as "euroc"
  std::string licence;           ///< one line; empty: unknown
  SensorRig sensors;             ///< with their calibrations
  Trajectory ground_truth;       ///< T_world_body; empty: there is none
  std::string body;              ///< what the body is, such as "the left camera"; empty: unknown
  std::string clock;             ///< what stamps count, such as "POSIX time"; empty: unknown
  std::size_t frame_count = 0;   ///< 0: unknown, as of a device
  std::int64_t first_stamp = 0;  ///< nanoseconds, of the first frame; 0, as the last: unknown
  std::int64_t last_stamp = 0;   ///< nanoseconds, of the last frame
  bool is_live = false;          ///< a device: frames are lost that are not taken in time
  /// A sentence for all that was skipped, with how much of it, for what was assumed, and for what
  /// looks wrong.
  std::vector<std::string> remarks;
};

/// A sequence of frames. What opens one is a DatasetFactory; an open dataset is ready.
///
/// A dataset changes no file. One thread at a time may use it. The frames it gives out stay as they
/// are when it goes on or is gone.
class Dataset {
 public:
  virtual ~Dataset() = default;

  /// What is known of it; the same for as long as it lives.
  virtual const DatasetInfo& info() const = 0;

  /// The next frame, with all that was measured since the one before.
  /// @return null behind the last one
  /// @throws Error when a file cannot be read, names it, and goes on with the frame after it
  virtual std::shared_ptr<const Frame> next() = 0;

  /// Makes a frame the one that next() gives, with id `index`. Its inertial and satellite samples
  /// are those since the frame before it.
  /// @param index  0 to frame_count; frame_count is the end
  /// @throws ArgumentError when it is none of these, Error when this is live
  virtual void seek(std::size_t index) = 0;
};

}  // namespace v1
}  // namespace gslam

#endif  // GSLAM_CORE_DATASET_H
