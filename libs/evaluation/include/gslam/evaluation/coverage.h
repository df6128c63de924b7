#ifndef GSLAM_EVALUATION_COVERAGE_H
#define GSLAM_EVALUATION_COVERAGE_H

#include <gslam/base/span.h>
#include <gslam/core/trajectory.h>
#include <gslam/evaluation/export.h>

#include <cstddef>
#include <cstdint>
#include <vector>

/// @file
/// How much of the way was tracked: an error without it says nothing.

namespace gslam {
inline namespace v1 {

/// A frame that a tracker was given.
struct TrackedFrame {
  std::int64_t stamp;  ///< nanoseconds
  bool is_tracked;     ///< whether it gave a pose from what the sensors say: not one that it
                       ///< extrapolated, or published while lost
};

/// How much was tracked.
///
/// Thread-safety: plain data.
struct Coverage {
  double time = 0;                 ///< part of the time, 0 to 1
  double frames = 0;               ///< part of the frames, 0 to 1
  std::size_t tracked_frames = 0;  ///< how many
  std::size_t total_frames = 0;    ///< of how many
  std::size_t losses = 0;          ///< how often tracking ended before the end
  double longest_loss = 0;         ///< from the last tracked to the next, or to the end; seconds
  bool is_initialised = false;     ///< whether anything was tracked
  double time_to_initialise = 0;   ///< from the begin to the first tracked; seconds
  double lost_after = 0;           ///< longest step that is no loss; seconds; 0: frames are known
  bool is_numbered = false;        ///< whether "seconds" above are frames
};

/// The coverage of frames whose tracking is known. The time of a frame is that until the next; it
/// is tracked where both are. O(n).
/// @param frames       all that the tracker was given, ascending
/// @param is_numbered  whether stamps are numbers of frames; times are then counted in frames
/// @throws ArgumentError when there are none, or they are not ascending
GSLAM_EVALUATION_EXPORT Coverage coverageOf(Span<const TrackedFrame> frames,
                                            bool is_numbered = false);

/// How coverageOf() of trajectories works.
struct CoverageOptions {
  std::int64_t time_offset = 0;  ///< added to stamps of the estimate, nanoseconds
  /// The longest step between two poses of the estimate that is no loss, nanoseconds. 0: five times
  /// the median step, half a second at least, so that keyframes are no losses.
  std::int64_t lost_after = 0;
  bool is_numbered = false;  ///< whether stamps are numbers of frames: those of the reference are
                             ///< all frames, and each that the estimate lacks is lost
};

/// The coverage of an estimate of which only the poses are known. The time is that of the
/// reference: whatever it has before the tracker was started counts as not tracked. Each pose
/// speaks for half a median step around it, and for the time to the next unless that is a loss;
/// frames are the poses of the reference. O(n log n).
/// @param reference  one pose at least
/// @param estimate   poses that were tracked; may be empty
/// @param options    as said there
/// @throws ArgumentError when the reference is empty, or lost_after below 0
GSLAM_EVALUATION_EXPORT Coverage coverageOf(const Trajectory& reference, const Trajectory& estimate,
                                            const CoverageOptions& options = {});

}  // namespace v1
}  // namespace gslam

#endif  // GSLAM_EVALUATION_COVERAGE_H
