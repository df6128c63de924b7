// Positions of receivers that do not say how sure they are.
#ifndef GSLAM_DATASETS_SRC_FORMATS_GNSS_SAMPLES_H
#define GSLAM_DATASETS_SRC_FORMATS_GNSS_SAMPLES_H

#include <gslam/core/sensor.h>

#include <cmath>
#include <cstdint>
#include <limits>

namespace gslam {
inline namespace v1 {
namespace reading {

/// Degrees. False for NaN, too.
inline bool isPlace(double latitude, double longitude) {
  return std::fabs(latitude) <= 90 && std::fabs(longitude) <= 180;
}

/// A position with unknown covariance and velocity.
inline GnssSample gnssSample(std::int64_t stamp, const Geodetic& position) {
  const double unknown = std::numeric_limits<double>::quiet_NaN();
  GnssSample sample{};
  sample.stamp = stamp;
  sample.position = position;
  sample.velocity = Vec3d{{unknown, unknown, unknown}};
  sample.fix = GnssFix::single;
  return sample;
}

}  // namespace reading
}  // namespace v1
}  // namespace gslam

#endif  // GSLAM_DATASETS_SRC_FORMATS_GNSS_SAMPLES_H
