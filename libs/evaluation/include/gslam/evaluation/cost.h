#ifndef GSLAM_EVALUATION_COST_H
#define GSLAM_EVALUATION_COST_H

#include <gslam/evaluation/allocation_counts.h>
#include <gslam/evaluation/export.h>
#include <gslam/evaluation/frame_times.h>
#include <gslam/evaluation/resource_monitor.h>
#include <gslam/evaluation/statistics.h>
#include <gslam/svar/svar.h>

#include <cstddef>
#include <string>
#include <vector>

/// @file
/// What a run cost, in one struct, as JSON and as a text.
///
///     const gslam::AllocationCounts before = gslam::allocationCountsOf(tree->root());
///     gslam::ResourceMonitor monitor(tree);
///     ...                                            // the run, with a MeasuredSlam
///     gslam::CostSource source;
///     source.frames = slam.frames();
///     source.resources = monitor.stop();
///     source.allocations =
///         gslam::allocatedBetween(before, gslam::allocationCountsOf(tree->root()));
///     metrics.set("cost", gslam::costToSvar(gslam::costOf(source)));

namespace gslam {
inline namespace v1 {

/// What costOf() is made of.
struct CostSource {
  std::vector<FrameTime> frames;  ///< MeasuredSlam::frames()
  ResourceReport resources;       ///< of the run; with 0 seconds: not measured
  AllocationCounts allocations;   ///< of the run: allocatedBetween() its begin and its end
  /// Why allocations are not counted, where they are not; empty: whyNoAllocations().
  std::string why_no_allocations;
  /// What was measured: the whole process with the dataset's reading and all else that it does, or
  /// the isolated SLAM system alone.
  bool is_slam_alone = false;
};

/// What a run cost. Statistics over frames are over those that were given to the system: frame_ms
/// over those with a pose.
///
/// Thread-safety: plain data.
struct Cost {
  CostSource source;             ///< what it was made of
  std::size_t delivered = 0;     ///< frames that were given to the system
  std::size_t results = 0;       ///< of these with a pose
  std::size_t dropped = 0;       ///< frames that MeasuredSlam was told were not given to it
  std::size_t overlapping = 0;   ///< delivered ones whose work began before that of an earlier
                                 ///< one had ended: what was used meanwhile is in the figures of
                                 ///< both frames
  Statistics frame_ms;           ///< FrameTime::wall_ms
  Statistics feed_ms;            ///< FrameTime::feed_ms
  Statistics cpu_ms;             ///< FrameTime::cpu_ms
  double span_seconds = 0;       ///< from the first delivery to the last end of feed() or pose
  double frames_per_second = 0;  ///< delivered ones over that time; 0: not known
  bool has_allocations = false;  ///< whether those of the run are counted
  std::size_t counted = 0;       ///< delivered frames with counts of allocations
  /// @{
  /// What was used while some frame was in work, which counts once however many are, by the number
  /// of delivered frames (with counts of allocations).
  double cpu_ms_per_frame = 0;
  double allocations_per_frame = 0, allocated_bytes_per_frame = 0;
  /// @}
};

/// Sums up. O(n log n).
GSLAM_EVALUATION_EXPORT Cost costOf(CostSource source);

/// The object "cost" of metrics.json; the README of this library describes it. What there is no
/// value of is null, with the reason beside it.
GSLAM_EVALUATION_EXPORT Svar costToSvar(const Cost& cost);

/// A table for people, with a line end at its end.
GSLAM_EVALUATION_EXPORT std::string costText(const Cost& cost);

}  // namespace v1
}  // namespace gslam

#endif  // GSLAM_EVALUATION_COST_H
