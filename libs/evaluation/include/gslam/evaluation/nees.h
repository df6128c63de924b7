#ifndef GSLAM_EVALUATION_NEES_H
#define GSLAM_EVALUATION_NEES_H

#include <gslam/base/span.h>
#include <gslam/evaluation/export.h>
#include <gslam/evaluation/pairs.h>
#include <gslam/geometry/mat.h>
#include <gslam/geometry/sim3.h>

#include <cstddef>
#include <string>
#include <vector>

/// @file
/// Whether a system knows how wrong it is.

namespace gslam {
inline namespace v1 {

/// Covariance of a pose: of d in T exp(d), d = (translation, rotation), as PoseWithCovariance has.
using PoseCovariance = Mat<double, 6, 6>;

/// The normalized estimation error squared of many poses.
///
/// Thread-safety: plain data.
struct Nees {
  std::vector<double> values;  ///< d^T S^-1 d of each pose with an invertible covariance
  std::size_t singular = 0;    ///< poses without, which are left out
  std::string reason;          ///< why there is no value; empty where there is one
  double mean = 0;             ///< 6 for a consistent system; more: overconfident
  double least_mean = 0;       ///< the mean of a consistent system lies from here ...
  double most_mean = 0;        ///< ... to here, in 95 % of all runs, if poses are independent
  double inside_percent = 0;   ///< of the values in the 95 % interval of one
};

/// The NEES: of a consistent system d is normal with covariance S, and the values have a chi-square
/// distribution with 6 degrees of freedom (Y. Bar-Shalom, X. Li, T. Kirubarajan, "Estimation with
/// applications to tracking and navigation", 2001, section 5.4.2). The error d is the logarithm of
/// P^-1 Q, with P of the aligned estimate and Q of the reference. Quantiles are those of Wilson and
/// Hilferty, right to 0.5 %. O(n).
/// @param pairs        poses
/// @param covariances  one for each pair, of the estimate as it was given
/// @param S_world_map  the alignment; its scale scales the covariances, too
/// @throws ArgumentError when there are not as many covariances as pairs, or one is not finite
GSLAM_EVALUATION_EXPORT Nees neesOf(const PosePairs& pairs, Span<const PoseCovariance> covariances,
                                    const SIM3d& S_world_map = SIM3d());

}  // namespace v1
}  // namespace gslam

#endif  // GSLAM_EVALUATION_NEES_H
