#ifndef GSLAM_DATASETS_CHECK_DATASET_H
#define GSLAM_DATASETS_CHECK_DATASET_H

#include <gslam/core/dataset.h>
#include <gslam/datasets/export.h>

#include <atomic>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <string>
#include <vector>

/// @file
/// Reads all of a dataset, and says what is wrong with it.

namespace gslam {
inline namespace v1 {

/// How to check.
struct CheckOptions {
  /// Is called after each frame, in the same thread; what it throws ends the check.
  /// `done` frames were read, of `total`; 0: unknown.
  std::function<void(std::size_t done, std::size_t total)> progress;
  /// Once true, the check ends after the frame in work; null: it cannot be stopped. Any thread may
  /// set it.
  const std::atomic<bool>* stop = nullptr;
};

/// What a check found.
struct DatasetCheck {
  std::size_t frames = 0;         ///< that were read
  std::size_t images = 0;         ///< in them
  std::size_t imu_samples = 0;    ///< in them
  std::size_t gnss_samples = 0;   ///< in them
  std::int64_t first_stamp = 0;   ///< nanoseconds, of the first frame
  std::int64_t last_stamp = 0;    ///< nanoseconds, of the last frame
  std::int64_t longest_step = 0;  ///< nanoseconds between two frames, at most
  bool is_stopped = false;        ///< by CheckOptions::stop
  /// A sentence for each thing that cannot be right: frames that cannot be read, stamps that go
  /// back, images of another size than their camera, numbers that are not finite.
  std::vector<std::string> errors;
  /// A sentence for each thing that is hardly right: black images, depth or gravity of another
  /// unit, ground truth of another time or with jumps.
  std::vector<std::string> warnings;
};

/// Reads a dataset from its first frame to its last, with all images, and compares what it finds
/// with what DatasetInfo says. The same complaint about many frames is one sentence, which counts
/// them and names the first.
/// @param dataset  not a live one; nobody else may use it meanwhile; it is at its end then
/// @param options  as said there
/// @throws ArgumentError when it is live
GSLAM_DATASETS_EXPORT DatasetCheck checkDataset(Dataset& dataset,
                                                const CheckOptions& options = CheckOptions());

}  // namespace v1
}  // namespace gslam

#endif  // GSLAM_DATASETS_CHECK_DATASET_H
