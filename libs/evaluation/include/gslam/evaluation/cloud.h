#ifndef GSLAM_EVALUATION_CLOUD_H
#define GSLAM_EVALUATION_CLOUD_H

#include <gslam/base/span.h>
#include <gslam/core/map_types.h>
#include <gslam/evaluation/export.h>
#include <gslam/evaluation/statistics.h>
#include <gslam/geometry/sim3.h>
#include <gslam/geometry/vec.h>

#include <cstddef>
#include <limits>
#include <string>
#include <vector>

/// @file
/// Accuracy of a map: how far its points are from the surface that they should lie on.

namespace gslam {
inline namespace v1 {

/// How cloudErrors() works.
struct CloudOptions {
  SIM3d S_world_cloud;         ///< the alignment, such as that of the trajectory
  std::size_t icp_rounds = 0;  ///< most rounds of refining it by nearest points; 0: as it is
  bool icp_has_scale = false;  ///< whether these may change the scale
  /// Nearest distances above it are counted as outliers and left out of the statistics, metres.
  double max_distance = std::numeric_limits<double>::infinity();
  double threshold = 0.05;  ///< of accuracy and completeness, metres
};

/// How good a cloud is.
///
/// Thread-safety: plain data.
struct CloudErrors {
  Statistics distance;         ///< from each point of the cloud to the surface, metres
  std::size_t outliers = 0;    ///< points further away than max_distance, or not finite
  double accuracy = 0;         ///< part of the cloud's points within the threshold of the reference
  double completeness = 0;     ///< part of the reference's points within the threshold of the cloud
  double f_score = 0;          ///< harmonic mean of the two
  SIM3d S_world_cloud;         ///< the alignment, refined where that was asked for
  std::size_t icp_rounds = 0;  ///< that it took
  std::string reason;          ///< why refining stopped before it converged; else empty
};

/// Distances of a cloud from a reference cloud, by a kd-tree: ICL-NUIM's surface error (A. Handa,
/// T. Whelan, J. McDonald, A. Davison, ICRA 2014: mean, median, std, min and max of the distances
/// to the nearest point of the model, after alignment), with accuracy, completeness and F-score (A.
/// Knapitsch et al., "Tanks and Temples", 2017).
///
/// Distances are those between points, so a reference adds about half its spacing: sample it more
/// densely than the errors that count. Faces of meshes are not looked at: sample points on them.
///
/// Refining is point-to-point ICP (P. Besl, N. McKay, 1992) over the points within max_distance,
/// until a round moves less than 1e-6 of the extent. O((n + m) log m) a round.
/// @param reference  surface in the world, metres
/// @param cloud      points in the map
/// @param options    as said there
/// @throws ArgumentError when one of the two has no finite point, or a distance is not above 0
GSLAM_EVALUATION_EXPORT CloudErrors cloudErrors(Span<const MapPoint> reference,
                                                Span<const MapPoint> cloud,
                                                const CloudOptions& options = {});

}  // namespace v1
}  // namespace gslam

#endif  // GSLAM_EVALUATION_CLOUD_H
