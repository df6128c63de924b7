#ifndef GSLAM_EVALUATION_KITTI_H
#define GSLAM_EVALUATION_KITTI_H

#include <gslam/evaluation/export.h>
#include <gslam/evaluation/pairs.h>
#include <gslam/geometry/mat.h>

#include <cstddef>
#include <string>
#include <vector>

/// @file
/// The figures of KITTI's odometry benchmark.

namespace gslam {
inline namespace v1 {

/// How kittiErrors() works; as the devkit unless changed.
struct KittiOptions {
  std::vector<double> lengths = {100, 200, 300, 400, 500, 600, 700, 800};  ///< of segments, metres
  std::size_t step = 10;      ///< a segment of each length begins at each so-many-th pair
  double frame_period = 0.1;  ///< seconds between frames, for the speed alone
};

/// A line of the devkit's tables.
struct KittiBin {
  double at = 0;               ///< length in metres, or speed in metres a second
  std::size_t count = 0;       ///< segments
  double t_err_percent = 0;    ///< mean error of the translation, of the length
  double r_err_deg_per_m = 0;  ///< mean error of the rotation, degrees a metre
};

/// What the devkit prints.
///
/// Thread-safety: plain data.
struct KittiErrors {
  std::size_t count = 0;          ///< segments; of 0 all else is 0 and means nothing
  std::string reason;             ///< why there are none; empty where there are
  double t_err_percent = 0;       ///< mean over all segments
  double r_err_deg_per_m = 0;     ///< the same, degrees a metre
  std::vector<KittiBin> lengths;  ///< for each length that has segments
  /// For each speed of 2, 4, ... 24 m/s: segments within 2 m/s of it (so most are in two), where
  /// there are more than two. The speed is length / (frame_period * frames).
  std::vector<KittiBin> speeds;
};

/// The figures of the devkit's evaluate_odometry (A. Geiger, P. Lenz, R. Urtasun, "Are we ready for
/// autonomous driving? The KITTI vision benchmark suite", CVPR 2012): a segment ends at the first
/// pair that is further along the reference's way than its length; its error is that of the
/// relative motion, divided by the length. Calculated in double, where the devkit has float. Pairs
/// count as frames: where poses were lost, segments span the gap. O(n) for each length.
/// @param pairs    poses
/// @param options  as said there
/// @param scale    of the alignment; the devkit has none
/// @throws ArgumentError when there is no length, one is not above 0, or the step is 0
GSLAM_EVALUATION_EXPORT KittiErrors kittiErrors(const PosePairs& pairs,
                                                const KittiOptions& options = {}, double scale = 1);

/// [R t] of a pose as it stands in a KITTI file: R is a rotation to about seven digits.
using KittiMatrix = Mat<double, 3, 4>;

/// The matrices of a KITTI file, as they stand there; readTrajectory() has the nearest rotations.
/// @param path  the file
/// @throws FileError when it cannot be opened, ParseError when a line has not 12 numbers
GSLAM_EVALUATION_EXPORT std::vector<KittiMatrix> readKittiMatrices(const std::string& path);

}  // namespace v1
}  // namespace gslam

#endif  // GSLAM_EVALUATION_KITTI_H
