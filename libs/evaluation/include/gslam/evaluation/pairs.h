#ifndef GSLAM_EVALUATION_PAIRS_H
#define GSLAM_EVALUATION_PAIRS_H

#include <gslam/core/trajectory.h>
#include <gslam/evaluation/export.h>
#include <gslam/geometry/se3.h>

#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

/// @file
/// Which pose of an estimate is compared with which of the reference.

namespace gslam {
inline namespace v1 {

/// How poses are put together.
enum class AssociationMethod : std::uint8_t {
  /// Each pose with at most one of the other trajectory: the most pairs, then the least sum of
  /// distances in time (associate() of core).
  one_to_one,
  /// The trajectory with the smaller median step is interpolated (on SE3, along a screw) at the
  /// stamps of the other, where one of the two poses around is within the tolerance.
  interpolate,
  /// As evo 1.x does: each pose of the shorter trajectory (the estimate, where both are as long)
  /// takes the nearest of the other within the tolerance, which others may have taken, too. In
  /// seconds as double, with their rounding.
  evo
};

/// Its name, such as "one-to-one"; "unknown" for a number that is no method.
GSLAM_EVALUATION_EXPORT const char* associationMethodName(AssociationMethod method) noexcept;
/// The method of a name.
/// @throws ArgumentError when there is none; it lists them
GSLAM_EVALUATION_EXPORT AssociationMethod associationMethod(const std::string& name);

/// How pairPoses() works.
struct AssociationOptions {
  AssociationMethod method = AssociationMethod::one_to_one;  ///< see there
  std::int64_t max_dt = 10000000;  ///< most nanoseconds between the two of a pair
  std::int64_t time_offset = 0;    ///< nanoseconds that are added to stamps of the estimate
  bool finds_offset = false;       ///< whether the offset is estimated (estimateTimeOffset())
  /// Whether stamps are numbers of frames, as of KITTI's files, and no times. Equal numbers are
  /// paired then, and the tolerance does not count.
  bool is_numbered = false;
};

/// The pairs, in the order of time.
///
/// Thread-safety: plain data.
struct PosePairs {
  std::vector<std::int64_t> stamps;           ///< on the clock of the reference, ns
  std::vector<SE3d> reference;                ///< T_world_body
  std::vector<SE3d> estimate;                 ///< T_map_body, as it was given
  std::vector<std::size_t> reference_places;  ///< in the trajectory; of interpolated ones, the one
                                              ///< before
  std::vector<std::size_t> estimate_places;   ///< the same for the estimate
  std::size_t dropped_reference = 0;          ///< poses that no pair was made of
  std::size_t dropped_estimate = 0;           ///< the same for the estimate
  std::int64_t max_gap = 0;    ///< longest time of the reference without a pair, ends included, ns
  std::int64_t max_apart = 0;  ///< most nanoseconds between the two of a pair
  std::int64_t time_offset = 0;   ///< that was added to stamps of the estimate, ns
  double offset_correlation = 0;  ///< 0 to 1 where the offset was estimated, else 0
  bool is_numbered = false;       ///< whether stamps are numbers of frames

  /// How many there are.
  std::size_t size() const noexcept { return stamps.size(); }
};

/// Pairs the poses of two trajectories. There is one pair at least. O(n log n).
/// @param reference  ground truth, T_world_body
/// @param estimate   what is measured, T_map_body
/// @param options    how
/// @throws ArgumentError when a trajectory is empty or has a pose that is not finite, when a
///   tolerance is below 0, when stamps count different units (it names the factor), when there is
///   not one pair (it says by how much the times miss each other), when numbers of frames are to be
///   interpolated, or when an offset cannot be estimated
GSLAM_EVALUATION_EXPORT PosePairs pairPoses(const Trajectory& reference, const Trajectory& estimate,
                                            const AssociationOptions& options = {});

/// What estimateTimeOffset() found.
struct TimeOffset {
  bool is_valid = false;    ///< whether there is one
  std::string reason;       ///< why not, for people; empty where there is one
  std::int64_t offset = 0;  ///< nanoseconds to add to stamps of the estimate
  double correlation = 0;   ///< of the speeds, -1 to 1
};

/// The offset of two clocks, by the correlation of the speeds at which both trajectories move and
/// turn: these do not depend on where the worlds lie, nor on the scale. Offsets within 10 s are
/// looked for; where the two trajectories share no time, all that let them overlap by half. Then
/// positions, after a similarity, say it to a small part of a step.
///
/// Precision: a small part of the time between two poses, where the motion is not uniform. An
/// offset is refused where the speeds do not vary, or do not correlate by 0.3 at least.
/// @param reference  ground truth
/// @param estimate   what is measured
GSLAM_EVALUATION_EXPORT TimeOffset estimateTimeOffset(const Trajectory& reference,
                                                      const Trajectory& estimate);

}  // namespace v1
}  // namespace gslam

#endif  // GSLAM_EVALUATION_PAIRS_H
