#ifndef GSLAM_CORE_SENSOR_H
#define GSLAM_CORE_SENSOR_H

#include <gslam/geometry/mat.h>
#include <gslam/geometry/se3.h>
#include <gslam/geometry/vec.h>

#include <cstdint>
#include <type_traits>

/// @file
/// What sensors other than cameras measure.

namespace gslam {
inline namespace v1 {

/// One measurement of an inertial unit, in its own axes.
struct ImuSample {
  std::int64_t stamp;  ///< nanoseconds
  Vec3d gyro;          ///< angular velocity, rad/s
  Vec3d accel;         ///< specific force, m/s^2: at rest it points up, with the length of gravity
};

/// Where an inertial unit is, and how much it errs: continuous white noise and random walks, as
/// Kalibr has them. 0 stands for unknown.
struct ImuCalibration {
  SE3d T_body_imu;             ///< takes coordinates of the unit to those of the body
  double rate = 0;             ///< samples a second
  double gyro_noise = 0;       ///< rad/s/sqrt(Hz)
  double accel_noise = 0;      ///< m/s^2/sqrt(Hz)
  double gyro_bias_walk = 0;   ///< rad/s^2/sqrt(Hz)
  double accel_bias_walk = 0;  ///< m/s^3/sqrt(Hz)
};

/// A place on or above the WGS 84 ellipsoid. Angles are in radians; files have degrees.
struct Geodetic {
  double latitude;   ///< radians, north is positive
  double longitude;  ///< radians, east is positive
  double altitude;   ///< metres above the ellipsoid (not above the sea)
};

/// How a satellite receiver came to its position.
enum class GnssFix : std::uint8_t {
  none,       ///< no position: the fields mean nothing
  single,     ///< from the satellites alone
  augmented,  ///< with corrections, such as SBAS or DGPS
  rtk_float,  ///< carrier phases, ambiguities not resolved
  rtk_fixed   ///< carrier phases, ambiguities resolved
};

/// One position of a satellite receiver.
struct GnssSample {
  std::int64_t stamp;  ///< nanoseconds
  Geodetic position;   ///< of the antenna
  Mat3d covariance;    ///< of east, north, up, in m^2; all zero: unknown
  Vec3d velocity;      ///< east, north, up, in m/s; NaN: unknown
  GnssFix fix;         ///< how it came to be
};

static_assert(sizeof(ImuSample) == 56 && sizeof(Geodetic) == 24 && sizeof(GnssSample) == 136,
              "samples cross plugin borders");

}  // namespace v1
}  // namespace gslam

#endif  // GSLAM_CORE_SENSOR_H
