#ifndef GSLAM_EVALUATION_APE_H
#define GSLAM_EVALUATION_APE_H

#include <gslam/evaluation/export.h>
#include <gslam/evaluation/pairs.h>
#include <gslam/evaluation/statistics.h>
#include <gslam/geometry/sim3.h>

#include <vector>

/// @file
/// Absolute pose errors: how far each pose is from where it should be.

namespace gslam {
inline namespace v1 {

/// Errors of poses E = Q^-1 P, with Q of the reference and P of the estimate: one number a pair.
///
/// Thread-safety: plain data.
struct PoseErrors {
  std::vector<double> translation;  ///< length of E's translation, metres
  std::vector<double> rotation;     ///< angle of E's rotation, 0 to pi radians
  std::vector<double> full;         ///< Frobenius norm of E - I, as evo's "full": it mixes units
};

/// The statistics of pose errors.
struct PoseErrorStatistics {
  Statistics translation;   ///< metres
  Statistics rotation_deg;  ///< degrees
  Statistics full;          ///< as PoseErrors::full
};

/// The absolute errors (APE; ATE is the rmse of its translation) of aligned poses. O(n).
/// (J. Sturm et al., "A benchmark for the evaluation of RGB-D SLAM systems", IROS 2012, eq. 3.)
/// @param pairs        poses
/// @param S_world_map  the alignment of the estimate
GSLAM_EVALUATION_EXPORT PoseErrors absoluteErrors(const PosePairs& pairs,
                                                  const SIM3d& S_world_map = SIM3d());

/// The statistics of errors. O(n).
/// @throws ArgumentError when one is not finite
GSLAM_EVALUATION_EXPORT PoseErrorStatistics statisticsOf(const PoseErrors& errors);

/// How far the estimate has drifted from the first to the last pair, for each metre of the way.
struct Drift {
  double length = 0;               ///< of the reference's way over the pairs, metres
  double translation_percent = 0;  ///< error of the last pose as seen from the first, of the length
  double rotation_deg_per_m = 0;   ///< the same of its rotation, degrees a metre
};

/// The drift; all 0 where the reference does not move.
/// @param pairs  one at least
/// @param scale  of the alignment
/// @throws ArgumentError when there are no pairs
GSLAM_EVALUATION_EXPORT Drift driftOf(const PosePairs& pairs, double scale = 1);

}  // namespace v1
}  // namespace gslam

#endif  // GSLAM_EVALUATION_APE_H
