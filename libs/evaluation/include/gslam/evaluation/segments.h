#ifndef GSLAM_EVALUATION_SEGMENTS_H
#define GSLAM_EVALUATION_SEGMENTS_H

#include <gslam/base/span.h>
#include <gslam/evaluation/export.h>
#include <gslam/evaluation/pairs.h>
#include <gslam/evaluation/statistics.h>
#include <gslam/geometry/sim3.h>

#include <vector>

/// @file
/// Statistics over parts of the way of any lengths, so that short sequences have them, too.

namespace gslam {
inline namespace v1 {

/// Errors at the end of all parts of the way of one length.
///
/// Thread-safety: plain data.
struct SegmentErrors {
  double length = 0;               ///< of the parts, metres
  Statistics translation;          ///< metres
  Statistics translation_percent;  ///< of the length
  Statistics rotation_deg;         ///< degrees
  Statistics rotation_deg_per_m;   ///< degrees for each metre of the length
  Statistics yaw_deg;              ///< about the vertical, degrees
  Statistics gravity_deg;          ///< between the two verticals, degrees
};

/// Sub-trajectory statistics as in rpg_trajectory_evaluation (Z. Zhang, D. Scaramuzza, IROS 2018,
/// section VI.B): each pose begins a part that ends at the pose whose distance along the reference
/// is nearest to the length, where it misses by a fifth of it at most. Errors are those of the
/// relative motion, turned into the axes of the world, whose z is up. O(n) for each length.
/// @param pairs        poses
/// @param lengths      metres, above 0
/// @param S_world_map  the alignment: its scale counts, and its rotation for yaw and gravity
/// @return one for each length; with count 0 where the way is too short
/// @throws ArgumentError when a length is not above 0
GSLAM_EVALUATION_EXPORT std::vector<SegmentErrors> segmentErrors(
    const PosePairs& pairs, Span<const double> lengths, const SIM3d& S_world_map = SIM3d());

}  // namespace v1
}  // namespace gslam

#endif  // GSLAM_EVALUATION_SEGMENTS_H
