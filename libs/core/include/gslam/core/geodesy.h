#ifndef GSLAM_CORE_GEODESY_H
#define GSLAM_CORE_GEODESY_H

#include <gslam/base/error.h>
#include <gslam/core/sensor.h>
#include <gslam/geometry/mat.h>
#include <gslam/geometry/se3.h>
#include <gslam/geometry/so3.h>
#include <gslam/geometry/vec.h>

#include <cmath>
#include <string>

/// @file
/// Places on the WGS 84 ellipsoid: latitude, longitude and altitude; earth-centred axes (ECEF);
/// east, north and up at an origin (ENU).
///
///     const gslam::EnuFrame frame(first_fix.position);
///     const gslam::Vec3d p = frame.fromGeodetic(fix.position);  // metres east, north, up
///
/// ECEF: metres from the earth's centre, x towards latitude and longitude 0, z towards the north
/// pole. Altitudes are above the ellipsoid; above the sea they differ by up to 107 m.

namespace gslam {
inline namespace v1 {

constexpr double kWgs84Radius = 6378137.0;              ///< at the equator, metres
constexpr double kWgs84Flattening = 1 / 298.257223563;  ///< (equator - pole) / equator

/// Radians of degrees; 90 and 180 become the doubles next to pi / 2 and pi.
constexpr double radiansOfDegrees(double degrees) {
  return degrees / 180 * 3.14159265358979323846;
}
/// Degrees of radians.
constexpr double degreesOfRadians(double radians) {
  return radians / 3.14159265358979323846 * 180;
}

/// A place as files and receivers have it.
/// @param latitude, longitude  **degrees**, north and east are positive
/// @param altitude             metres above the ellipsoid
inline Geodetic geodeticOfDegrees(double latitude, double longitude, double altitude) noexcept {
  return Geodetic{radiansOfDegrees(latitude), radiansOfDegrees(longitude), altitude};
}

namespace detail {

/// @throws ArgumentError for what is no place; degrees are the usual reason
inline void checkGeodetic(const Geodetic& place) {
  const double pi = 3.14159265358979323846;
  const double slack = 1e-12;  // for what was computed
  if (!(std::fabs(place.latitude) <= pi / 2 + slack)) {
    throw ArgumentError("latitude", "is " + std::to_string(place.latitude) +
                                        " rad, expected -pi/2 to pi/2; is it in degrees?");
  }
  if (!(std::fabs(place.longitude) <= 2 * pi + slack)) {
    throw ArgumentError("longitude", "is " + std::to_string(place.longitude) +
                                         " rad, expected -2 pi to 2 pi; is it in degrees?");
  }
  if (!std::isfinite(place.altitude)) {
    throw ArgumentError("altitude",
                        "is " + std::to_string(place.altitude) + " m, expected a finite number");
  }
}

/// The meridian plane's answer: distance from the axis and height above the equator give latitude
/// and altitude.
struct Meridian {
  double latitude;
  double altitude;
};

constexpr double kWgs84E2 = kWgs84Flattening * (2 - kWgs84Flattening);  // eccentricity squared

/// k of Vermeille's equations: the normal has the direction (k r / (k + e^2), z) in the meridian's
/// plane, r the distance from the axis.
/// @param p, q  (axis distance / a)^2 and (1 - e^2) (z / a)^2, one of them not 0
inline double vermeilleK(double p, double q) noexcept {
  const double e4 = kWgs84E2 * kWgs84E2;
  const double r = (p + q - e4) / 6;
  const double r3 = 8 * r * r * r;
  const double s = e4 * p * q;
  double u = 0;
  if (r3 + s > 0) {  // outside of the evolute: one real root
    const double root = std::cbrt(std::sqrt(r3 + s) + std::sqrt(s));
    u = r + root * root / 2 + 2 * r * r / (root * root);
  } else {  // inside, within 43 km of the centre: three, of which this is the one for the nearest
    const double t = 2.0 / 3 * std::atan2(std::sqrt(s), std::sqrt(-(r3 + s)) + std::sqrt(-r3));
    u = -4 * r * std::sin(t) * std::cos(0.52359877559829887308 + t);  // pi / 6
  }
  const double v = std::sqrt(u * u + e4 * q);
  const double sum = u < 0 ? e4 * q / (v - u) : u + v;  // u + v would cancel
  const double w = kWgs84E2 * (sum - q) / (2 * v);
  return sum / (std::sqrt(w * w + sum) + w);
}

/// @param axis_distance  0 or more, metres
/// @param z              metres
inline Meridian meridianOf(double axis_distance, double z) noexcept {
  const double e2 = kWgs84E2;
  const double x = axis_distance / kWgs84Radius, y = z / kWgs84Radius;
  const double p = x * x, q = (1 - e2) * y * y;
  double sine = 0, cosine = 1;
  if (q == 0 && p <= e2 * e2) {
    // On the disc in the equator's plane whose points are as near to the north as to the south.
    sine = std::sqrt(e2 * e2 - p);
    cosine = std::sqrt((1 - e2)) * x;
  } else {
    const double k = vermeilleK(p, q);
    cosine = k * x / (k + e2);
    sine = y;
  }
  const double norm = std::hypot(sine, cosine);
  sine /= norm;
  cosine /= norm;
  // Altitude along the normal: an error of the latitude enters squared.
  const double root = std::sqrt(1 - e2 * sine * sine);
  return {std::atan2(sine, cosine), axis_distance * cosine + z * sine - kWgs84Radius * root};
}

}  // namespace detail

/// ECEF coordinates, metres. Exact to 3 nm near the surface.
/// @throws ArgumentError when an element is not finite, the latitude is beyond pi/2 or the
/// longitude
///   beyond 2 pi
inline Vec3d toEcef(const Geodetic& place) {
  detail::checkGeodetic(place);
  const double sine = std::sin(place.latitude), cosine = std::cos(place.latitude);
  // The radius of curvature across the meridian.
  const double n = kWgs84Radius / std::sqrt(1 - detail::kWgs84E2 * sine * sine);
  const double axis_distance = (n + place.altitude) * cosine;
  return {{axis_distance * std::cos(place.longitude), axis_distance * std::sin(place.longitude),
           ((1 - detail::kWgs84E2) * n + place.altitude) * sine}};
}

/// Latitude, longitude and altitude of ECEF coordinates, in closed form: the point of the ellipsoid
/// that is nearest.
///
/// Near the surface, from the deepest mine to the highest aircraft, it is exact to 3 nm, as far as
/// doubles can say where a point is; elsewhere to 4e-16 of the distance to the centre. This holds
/// within the earth, too, but within 43 km of the centre, where normals cross (on the evolute of
/// the ellipse), the digits of the latitude go down to half of them. Points nearer than 42.7 km to
/// the centre in the equator's plane are as near to the north as to the south: they get the north,
/// the centre itself the pole. The longitude is from -pi to pi, and 0 on the axis.
///
/// Source: H. Vermeille, "An analytical method to transform geocentric into geodetic coordinates",
/// Journal of Geodesy 85, 2011, whose k gives the direction; the altitude is measured along it.
/// @param ecef  metres, up to 1e50
/// @throws ArgumentError when an element is not finite or beyond 1e50
inline Geodetic toGeodetic(const Vec3d& ecef) {
  for (std::size_t i = 0; i < 3; ++i) {
    if (!(std::fabs(ecef[i]) <= 1e50)) {
      throw ArgumentError("ecef", "has the element " + std::to_string(ecef[i]) +
                                      ", expected finite numbers up to 1e50");
    }
  }
  const double axis_distance = std::hypot(ecef[0], ecef[1]);
  const detail::Meridian meridian = detail::meridianOf(axis_distance, ecef[2]);
  const double longitude = axis_distance == 0 ? 0 : std::atan2(ecef[1], ecef[0]);
  return Geodetic{meridian.latitude, longitude, meridian.altitude};
}

/// East, north and up at a place: axes that stand still on the earth. Near the origin coordinates
/// are exact to 2 nm.
///
/// At a pole east is where it is on the meridian of the origin's longitude. Immutable, so that
/// threads may share it.
class EnuFrame {
 public:
  /// @param origin  where coordinates are 0
  /// @throws ArgumentError as toEcef()
  explicit EnuFrame(const Geodetic& origin)
      : origin_(origin),
        matrix_(matrixAt(origin)),
        T_ecef_enu_(rotationAt(origin), gslam::toEcef(origin)) {}

  const Geodetic& origin() const noexcept { return origin_; }      ///< where coordinates are 0
  const SE3d& T_ecef_enu() const noexcept { return T_ecef_enu_; }  ///< takes ENU to ECEF
  const Mat3d& R_ecef_enu() const noexcept { return matrix_; }     ///< columns: east, north, up

  /// @{
  /// To metres east, north and up.
  Vec3d fromEcef(const Vec3d& ecef) const noexcept {
    return matrix_.transpose() * (ecef - T_ecef_enu_.translation());
  }
  /// @throws ArgumentError as toEcef()
  Vec3d fromGeodetic(const Geodetic& place) const { return fromEcef(gslam::toEcef(place)); }
  /// @}

  /// @{
  /// From metres east, north and up.
  Vec3d toEcef(const Vec3d& enu) const noexcept {
    return matrix_ * enu + T_ecef_enu_.translation();
  }
  /// @throws ArgumentError as gslam::toGeodetic()
  Geodetic toGeodetic(const Vec3d& enu) const { return gslam::toGeodetic(toEcef(enu)); }
  /// @}

 private:
  static Mat3d matrixAt(const Geodetic& place) noexcept {
    const double sine = std::sin(place.latitude), cosine = std::cos(place.latitude);
    const double sine_l = std::sin(place.longitude), cosine_l = std::cos(place.longitude);
    return {{-sine_l, -sine * cosine_l, cosine * cosine_l,  //
             cosine_l, -sine * sine_l, cosine * sine_l,     //
             0.0, cosine, sine}};
  }
  static SO3d rotationAt(const Geodetic& place) {
    detail::checkGeodetic(place);
    return SO3d::fromMatrix(matrixAt(place));
  }

  Geodetic origin_;
  Mat3d matrix_;
  SE3d T_ecef_enu_;
};

}  // namespace v1
}  // namespace gslam

#endif  // GSLAM_CORE_GEODESY_H
