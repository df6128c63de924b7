#include "gnss.h"

#include <gslam/geometry/random.h>

#include <algorithm>
#include <cmath>

#include "hash.h"

namespace gslam {
inline namespace v1 {
namespace detail {
namespace synthetic {
namespace {

// WGS 84.
constexpr double kAxis = 6378137;
constexpr double kFlattening = 1 / 298.257223563;
constexpr double kSquaredEccentricity = kFlattening * (2 - kFlattening);
constexpr double kVelocityNoise = 0.1;  // of the position's, each second

double radiusAt(double latitude) {
  const double s = std::sin(latitude);
  return kAxis / std::sqrt(1 - kSquaredEccentricity * s * s);
}

Vec3d earthPlace(const Geodetic& g) {
  const double n = radiusAt(g.latitude), c = std::cos(g.latitude);
  return {{(n + g.altitude) * c * std::cos(g.longitude),
           (n + g.altitude) * c * std::sin(g.longitude),
           (n * (1 - kSquaredEccentricity) + g.altitude) * std::sin(g.latitude)}};
}

// The latitude is a fixed point, found to rounding in a few steps near the ground.
Geodetic geodeticOfEarthPlace(const Vec3d& p) {
  const double far = std::sqrt(p[0] * p[0] + p[1] * p[1]);
  Geodetic g = {std::atan2(p[2], far * (1 - kSquaredEccentricity)), std::atan2(p[1], p[0]), 0};
  for (int i = 0; i < 6; ++i) {
    const double n = radiusAt(g.latitude);
    g.altitude = far / std::cos(g.latitude) - n;
    const double part = n / (n + g.altitude);
    g.latitude = std::atan2(p[2], far * (1 - kSquaredEccentricity * part));
  }
  return g;
}

}  // namespace

Geodetic geodeticOf(const Vec3d& place) {
  const double sin_lat = std::sin(kOrigin.latitude), cos_lat = std::cos(kOrigin.latitude);
  const double sin_lon = std::sin(kOrigin.longitude), cos_lon = std::cos(kOrigin.longitude);
  const Vec3d east = {{-sin_lon, cos_lon, 0}};
  const Vec3d north = {{-sin_lat * cos_lon, -sin_lat * sin_lon, cos_lat}};
  const Vec3d up = {{cos_lat * cos_lon, cos_lat * sin_lon, sin_lat}};
  return geodeticOfEarthPlace(earthPlace(kOrigin) + place[0] * east + place[1] * north +
                              place[2] * up);
}

Gnss::Gnss(const SyntheticOptions& o)
    : rate_(o.gnss_rate),
      noise_(o.noise * o.gnss_noise),
      velocity_noise_(kVelocityNoise * noise_),
      key_(keyOf(o.seed, 40)) {}

std::int64_t Gnss::timeOf(std::int64_t i) const {
  return static_cast<std::int64_t>(std::llround(double(i) * 1e9 / rate_));
}

std::vector<GnssSample> Gnss::samples(const Motion& motion, std::int64_t from, std::int64_t to,
                                      std::int64_t origin) const {
  std::vector<GnssSample> samples;
  auto i = static_cast<std::int64_t>(double(std::max<std::int64_t>(from, 0)) * 1e-9 * rate_);
  for (i = std::max<std::int64_t>(i - 1, 0); timeOf(i) <= to; ++i) {
    if (timeOf(i) <= from) continue;
    samples.push_back(sample(motion, i));
    samples.back().stamp += origin;
  }
  return samples;
}

GnssSample Gnss::sample(const Motion& motion, std::int64_t i) const {
  Generator random(keyOf(key_, 0, static_cast<std::uint64_t>(i)));
  const Vec3d error = noise_ * randomNormal<double, 3>(random);
  const SplineSample<SE3d> at = motion.sampleAt(timeOf(i));
  const Vec3d place = at.value.translation() + Vec3d{{error[0], error[1], 2 * error[2]}};
  GnssSample sample{};
  sample.stamp = timeOf(i);
  sample.position = geodeticOf(place);
  const double square = noise_ * noise_;
  sample.covariance = {{square, 0, 0, 0, square, 0, 0, 0, 4 * square}};
  sample.velocity = at.value.rotation() * at.velocity.segment<3>(0) +
                    velocity_noise_ * randomNormal<double, 3>(random);
  sample.fix = GnssFix::single;
  return sample;
}

}  // namespace synthetic
}  // namespace detail
}  // namespace v1
}  // namespace gslam
