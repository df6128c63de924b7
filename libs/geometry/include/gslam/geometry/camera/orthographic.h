#ifndef GSLAM_GEOMETRY_CAMERA_ORTHOGRAPHIC_H
#define GSLAM_GEOMETRY_CAMERA_ORTHOGRAPHIC_H

#include <gslam/geometry/camera/focal_camera.h>

#include <cmath>
#include <cstddef>

/// @file
/// The orthographic fisheye camera.

namespace gslam {
inline namespace v1 {

/// The point on the unit sphere, seen along the axis; the distance from the principal point is
/// f sin(theta):
///
///     d = sqrt(x^2 + y^2 + z^2)      m = (x, y) / d
///
/// It sees what is in front of it, z > 0. (It is one of the central projections, equation 5 of
/// Kannala and Brandt 2006; a camera with parallel rays has no bearings to give.)
template <class T>
class OrthographicProjection {
 public:
  using Scalar = T;                                               ///< float or double
  using Jacobians = detail::ProjectionJacobians<T, 0>;            ///< derivatives
  static constexpr const char* name() { return "orthographic"; }  ///< name of the model
  static constexpr std::size_t parameterCount() { return 0; }     ///< none
  /// There is none to name.
  static const char* parameterName(std::size_t) noexcept { return ""; }

  /// Takes nothing.
  explicit OrthographicProjection(const T*) noexcept {}
  /// There is none to give.
  T parameter(std::size_t) const noexcept { return T(0); }

  /// @param point      camera coordinates
  /// @param m          result
  /// @param jacobians  result unless null
  /// @return whether z > 0
  bool project(const Vec<T, 3>& point, Vec<T, 2>& m, Jacobians* jacobians) const noexcept {
    const T squared = point.squaredNorm();
    if (!(point[2] > 0) || !detail::isSafeSquare(squared)) return false;
    const T d = std::sqrt(squared);
    m = {{point[0] / d, point[1] / d}};
    if (jacobians != nullptr) {
      detail::setQuotientJacobian(m, d, point / d, jacobians->point);
    }
    return true;
  }

  /// @param m    (x, y) of the bearing
  /// @param ray  result
  /// @return whether |m| < 1
  bool unproject(const Vec<T, 2>& m, Vec<T, 3>& ray) const noexcept {
    const T r = std::sqrt(m.squaredNorm());
    if (!(r < 1)) return false;
    ray = {{m[0], m[1], std::sqrt((1 - r) * (1 + r))}};
    return true;
  }
};

/// Orthographic fisheye: fx fy cx cy.
template <class T>
using OrthographicCamera = FocalCamera<OrthographicProjection<T>>;

}  // namespace v1
}  // namespace gslam

#endif  // GSLAM_GEOMETRY_CAMERA_ORTHOGRAPHIC_H
