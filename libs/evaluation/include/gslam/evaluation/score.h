#ifndef GSLAM_EVALUATION_SCORE_H
#define GSLAM_EVALUATION_SCORE_H

#include <gslam/core/trajectory.h>
#include <gslam/evaluation/export.h>

#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

/// @file
/// One number for accuracy and coverage together, which nobody improves by giving up.

namespace gslam {
inline namespace v1 {

/// How scoreOf() works.
struct ScoreOptions {
  double length = 0;              ///< of a part of the way, metres; 0: a tenth of the reference's
  std::int64_t slot = 100000000;  ///< length of a slot of time, ns; numbered frames: one each
  /// Largest errors of the translation at the end of a part, of its length.
  std::vector<double> thresholds = {0.01, 0.02, 0.05, 0.1, 0.2};
  bool has_scale = false;        ///< whether a scale of the estimate is free
  std::int64_t time_offset = 0;  ///< added to stamps of the estimate, ns
  bool is_numbered = false;      ///< whether stamps are numbers of frames
};

/// What share of the way is good enough for one threshold.
struct ScoreLevel {
  double threshold = 0;  ///< of the length
  double fraction = 0;   ///< of all parts, 0 to 1
  double scale = 1;      ///< with which it is so
};

/// The score.
///
/// Thread-safety: plain data.
struct Score {
  bool is_valid = false;           ///< whether there is one
  std::string reason;              ///< why not; empty where there is one
  double value = 0;                ///< mean of the fractions, 0 to 1; more is better
  double length = 0;               ///< of a part, metres
  std::size_t parts = 0;           ///< of how many
  std::vector<ScoreLevel> levels;  ///< one for each threshold
};

/// The part of the reference's way that the estimate has right.
///
/// The time of the reference is cut into slots. Each slot from which the reference still goes
/// `length` metres begins a part of the way, which ends in the slot where it has gone them. A part
/// is right, for a threshold, where **any** pose of the estimate in its first slot and **any** in
/// its last one have a relative translation that is off by at most threshold * length; the poses of
/// the reference at their very stamps are interpolated. The fraction of a threshold is that of
/// **all** parts, tracked or not, and of the free scale the one is taken with which most parts are
/// right.
///
/// **A tracker cannot improve it by giving up.** Which parts there are depends on the reference
/// alone. Whether a pair of poses is right for a scale depends on these two and the reference
/// alone: no alignment, no association and no scale is fitted to the other poses. So without a
/// pose, the scales for which a part is right are a subset of those with it, and the largest number
/// of parts that are right for one scale is no larger. A pose that is left out may cost, and never
/// gains. (Where the time offset is estimated, that is done with all poses; give it, to be strict.)
/// It follows that a pose that is wrong costs as much as none.
///
/// O(n log n), times the poses in a slot.
/// @param reference  ground truth
/// @param estimate   poses that were tracked; may be empty, which gives 0
/// @param options    as said there
/// @return invalid where the reference does not move, or a part is longer than its way
/// @throws ArgumentError when the reference is empty, the length below 0, the slot not above 0, or
/// a
///   threshold not above 0
GSLAM_EVALUATION_EXPORT Score scoreOf(const Trajectory& reference, const Trajectory& estimate,
                                      const ScoreOptions& options = {});

}  // namespace v1
}  // namespace gslam

#endif  // GSLAM_EVALUATION_SCORE_H
