// A satellite receiver on an exact motion.
#ifndef GSLAM_DATASETS_SRC_SYNTHETIC_GNSS_H
#define GSLAM_DATASETS_SRC_SYNTHETIC_GNSS_H

#include <gslam/core/sensor.h>
#include <gslam/datasets/synthetic.h>

#include <cstdint>
#include <vector>

#include "motion.h"

namespace gslam {
inline namespace v1 {
namespace detail {
namespace synthetic {

/// The world's origin on the ellipsoid.
const Geodetic kOrigin = {0.8272860654, 0.1483529864, 450};  // 47.4 N 8.5 E

/// A place given as east, north, up of the origin, metres.
Geodetic geodeticOf(const Vec3d& place);

/// Immutable, shared by threads.
class Gnss {
 public:
  explicit Gnss(const SyntheticOptions& options);

  /// As Imu::samples().
  std::vector<GnssSample> samples(const Motion& motion, std::int64_t from, std::int64_t to,
                                  std::int64_t origin) const;

 private:
  GnssSample sample(const Motion& motion, std::int64_t i) const;
  std::int64_t timeOf(std::int64_t i) const;

  double rate_, noise_, velocity_noise_;
  std::uint64_t key_;
};

}  // namespace synthetic
}  // namespace detail
}  // namespace v1
}  // namespace gslam

#endif  // GSLAM_DATASETS_SRC_SYNTHETIC_GNSS_H
