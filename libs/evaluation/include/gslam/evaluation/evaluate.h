#ifndef GSLAM_EVALUATION_EVALUATE_H
#define GSLAM_EVALUATION_EVALUATE_H

#include <gslam/core/trajectory.h>
#include <gslam/evaluation/align.h>
#include <gslam/evaluation/ape.h>
#include <gslam/evaluation/cloud.h>
#include <gslam/evaluation/coverage.h>
#include <gslam/evaluation/export.h>
#include <gslam/evaluation/kitti.h>
#include <gslam/evaluation/nees.h>
#include <gslam/evaluation/pairs.h>
#include <gslam/evaluation/rpe.h>
#include <gslam/evaluation/score.h>
#include <gslam/evaluation/segments.h>
#include <gslam/svar/svar.h>

#include <cstdint>
#include <string>
#include <vector>

/// @file
/// All figures of an estimate at once, as a struct, as JSON and as a text.

namespace gslam {
inline namespace v1 {

/// What evaluate() does.
struct EvaluationOptions {
  AssociationOptions association;  ///< which poses are compared
  AlignmentOptions alignment;      ///< what the estimate is laid over the reference by
  std::vector<RpeOptions> rpe;     ///< which relative errors; none: none
  bool has_kitti = false;          ///< whether the figures of KITTI are wanted
  std::vector<double> segments;    ///< lengths of parts of the way, metres; none: none
  /// All frames that the tracker was given, where they are known; the coverage is over them then,
  /// and otherwise over the time of the reference.
  std::vector<TrackedFrame> frames;
  std::int64_t lost_after = 0;  ///< as CoverageOptions::lost_after
  /// @{
  /// Of KITTI files, one for each pose: with the association `evo`, translations are calculated
  /// with these as evo does, which takes them for rotations. None: with the nearest rotations.
  std::vector<KittiMatrix> reference_matrices, estimate_matrices;
  /// @}
  /// One for each pose of the estimate, for the NEES; none: no NEES. Not for interpolated
  /// estimates.
  std::vector<PoseCovariance> covariances;
  /// What JSON says under "protocol" beside what is here: files, dataset, SLAM, parameters,
  /// machine, seed. An object, or null.
  Svar protocol;
};

/// Relative errors of one kind.
struct RelativeErrors {
  RpeOptions options;              ///< which
  PoseErrorStatistics statistics;  ///< with count 0 where the way is too short
};

/// All figures.
///
/// Thread-safety: plain data, but for the protocol, which is as Svar is.
struct Evaluation {
  EvaluationOptions options;  ///< what was asked for
  PosePairs pairs;            ///< what was compared
  Coverage coverage;          ///< beside every error
  Alignment alignment;   ///< where it is not valid, there are no errors that need it: no APE, and
                         ///< where it has a scale none at all
  bool has_ape = false;  ///< whether there is one
  bool has_relative = false;            ///< whether there are errors of relative motions
  PoseErrorStatistics ape;              ///< of the aligned poses
  std::vector<RelativeErrors> rpe;      ///< in the order of the options
  KittiErrors kitti;                    ///< where asked for
  std::vector<SegmentErrors> segments;  ///< in the order of the options
  Drift drift;                          ///< over all pairs
  Score score;                          ///< accuracy and coverage together
  bool has_nees = false;                ///< whether covariances were given
  Nees nees;                            ///< where they were
  bool has_cloud = false;               ///< whether there is a cloud
  CloudErrors cloud;                    ///< set by the caller
};

/// Pairs, aligns and measures. An alignment that is refused is no exception: it says why, and what
/// does not need it is there. The score has a free scale where the alignment has one.
///
/// Time: 1e6 poses take about a second.
/// @param reference  ground truth, T_world_body
/// @param estimate   what is measured, T_map_body; only poses that were tracked
/// @param options    as said there
/// @throws ArgumentError as pairPoses(), rangesOf(), segmentErrors() and neesOf(), and when there
/// are
///   matrices, but not one for each pose
GSLAM_EVALUATION_EXPORT Evaluation evaluate(const Trajectory& reference, const Trajectory& estimate,
                                            const EvaluationOptions& options = {});

/// The object that `gslam eval --json` prints; the README of this library describes it. What there
/// is no value of is null.
GSLAM_EVALUATION_EXPORT Svar evaluationToSvar(const Evaluation& evaluation);

/// A table for people, with a line end at its end: association and coverage first, and no error
/// without its coverage.
GSLAM_EVALUATION_EXPORT std::string evaluationText(const Evaluation& evaluation);

}  // namespace v1
}  // namespace gslam

#endif  // GSLAM_EVALUATION_EVALUATE_H
