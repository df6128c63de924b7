// How the body goes its way: a closed spline of poses.
#ifndef GSLAM_DATASETS_SRC_SYNTHETIC_MOTION_H
#define GSLAM_DATASETS_SRC_SYNTHETIC_MOTION_H

#include <gslam/geometry/se3.h>
#include <gslam/geometry/spline.h>

#include <cstdint>
#include <vector>

#include "world.h"

namespace gslam {
inline namespace v1 {
namespace detail {
namespace synthetic {

/// A time at which the body turns and stays where it is, seconds.
struct Pause {
  double begin, end;
};

struct MotionOptions {
  double duration = 30;  ///< seconds from the first to the last frame
  double speed = 0;      ///< m/s; 0: once around in that time, but no faster than one can
  std::uint64_t seed = 1;
  std::vector<Pause> pauses;
};

/// Immutable, shared by threads.
class Motion {
 public:
  Motion(const Route& route, const MotionOptions& options);

  /// @param time  nanoseconds since the first frame, 0 or more; after a round the next begins
  SE3d at(std::int64_t time) const { return spline_.at(time % round_); }
  SplineSample<SE3d> sampleAt(std::int64_t time) const { return spline_.sampleAt(time % round_); }

 private:
  std::int64_t round_;  // nanoseconds
  Spline<SE3d> spline_;
};

}  // namespace synthetic
}  // namespace detail
}  // namespace v1
}  // namespace gslam

#endif  // GSLAM_DATASETS_SRC_SYNTHETIC_MOTION_H
