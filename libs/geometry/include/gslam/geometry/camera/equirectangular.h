#ifndef GSLAM_GEOMETRY_CAMERA_EQUIRECTANGULAR_H
#define GSLAM_GEOMETRY_CAMERA_EQUIRECTANGULAR_H

#include <gslam/geometry/camera/focal_camera.h>

#include <cmath>
#include <cstddef>

/// @file
/// The equirectangular image of a panorama camera.

namespace gslam {
inline namespace v1 {

/// Longitude along u, latitude along v; z is in the middle of the image, y points down:
///
///     mx = atan2(x, z)        my = atan2(y, sqrt(x^2 + z^2))
///
/// fx and fy are pixels per radian. It sees all directions but the poles (x = z = 0), which have no
/// longitude. No parameters beside fx fy cx cy; see equirectangularForImage().
template <class T>
class EquirectangularProjection {
 public:
  using Scalar = T;                                                  ///< float or double
  using Jacobians = detail::ProjectionJacobians<T, 0>;               ///< derivatives
  static constexpr const char* name() { return "equirectangular"; }  ///< name of the model
  static constexpr std::size_t parameterCount() { return 0; }        ///< none
  /// There is none to name.
  static const char* parameterName(std::size_t) noexcept { return ""; }

  /// Takes nothing.
  explicit EquirectangularProjection(const T*) noexcept {}
  /// There is none to give.
  T parameter(std::size_t) const noexcept { return T(0); }

  /// @param point      camera coordinates
  /// @param m          result: longitude and latitude, radians
  /// @param jacobians  result unless null
  /// @return whether the point has a longitude
  bool project(const Vec<T, 3>& point, Vec<T, 2>& m, Jacobians* jacobians) const noexcept {
    const T x = point[0], y = point[1], z = point[2];
    const T h2 = x * x + z * z;
    const T squared = h2 + y * y;
    if (!detail::isSafeSquare(h2) || !detail::isSafeSquare(squared)) return false;
    const T h = std::sqrt(h2);
    m = {{std::atan2(x, z), std::atan2(y, h)}};
    if (jacobians != nullptr) {
      jacobians->point = {{z / h2, T(0), -x / h2,  //
                           -y / squared * (x / h), h / squared, -y / squared * (z / h)}};
    }
    return true;
  }

  /// @param m    longitude and latitude, radians
  /// @param ray  result
  /// @return whether the longitude is within half a turn, the latitude less than a quarter
  bool unproject(const Vec<T, 2>& m, Vec<T, 3>& ray) const noexcept {
    const T pi = T(3.14159265358979323846264338327950288L);
    const T h = std::cos(m[1]);
    if (!(std::fabs(m[0]) <= pi) || !(std::fabs(m[1]) < pi / 2) || !(h > 0)) return false;
    ray = {{h * std::sin(m[0]), std::sin(m[1]), h * std::cos(m[0])}};
    return true;
  }
};

/// Equirectangular: fx fy cx cy.
template <class T>
using EquirectangularCamera = FocalCamera<EquirectangularProjection<T>>;

/// The camera of an image that shows the whole sphere: its left and right borders (u = -0.5 and
/// u = width - 0.5) are the direction -z, its upper and lower ones -y and y.
/// @throws ArgumentError when a size is not positive
template <class T>
EquirectangularCamera<T> equirectangularForImage(int width, int height) {
  const T pi = T(3.14159265358979323846264338327950288L);
  const T columns = static_cast<T>(width), rows = static_cast<T>(height);
  return EquirectangularCamera<T>(
      Vec<T, 4>{{columns / (2 * pi), rows / pi, columns / 2 - T(0.5), rows / 2 - T(0.5)}});
}

}  // namespace v1
}  // namespace gslam

#endif  // GSLAM_GEOMETRY_CAMERA_EQUIRECTANGULAR_H
