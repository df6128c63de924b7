#ifndef GSLAM_GEOMETRY_CAMERA_PINHOLE_H
#define GSLAM_GEOMETRY_CAMERA_PINHOLE_H

#include <gslam/geometry/camera/focal_camera.h>

#include <cstddef>

/// @file
/// The pinhole camera.

namespace gslam {
inline namespace v1 {

/// Perspective projection; it sees what is in front of it, z > 0.
///
///     mx = x / z        my = y / z
///
/// No parameters beside fx fy cx cy.
template <class T>
class PinholeProjection {
 public:
  using Scalar = T;                                            ///< float or double
  using Jacobians = detail::ProjectionJacobians<T, 0>;         ///< derivatives
  static constexpr const char* name() { return "pinhole"; }    ///< name of the model
  static constexpr std::size_t parameterCount() { return 0; }  ///< none
  /// There is none to name.
  static const char* parameterName(std::size_t) noexcept { return ""; }

  /// Takes nothing.
  explicit PinholeProjection(const T*) noexcept {}
  /// There is none to give.
  T parameter(std::size_t) const noexcept { return T(0); }

  /// @param point      camera coordinates
  /// @param m          result
  /// @param jacobians  result unless null
  /// @return whether z > 0
  bool project(const Vec<T, 3>& point, Vec<T, 2>& m, Jacobians* jacobians) const noexcept {
    const T z = point[2];
    if (!(z > 0)) return false;
    m = {{point[0] / z, point[1] / z}};
    if (jacobians != nullptr) {
      detail::setQuotientJacobian(m, z, {{T(0), T(0), T(1)}}, jacobians->point);
    }
    return true;
  }

  /// @param m    on the plane z = 1
  /// @param ray  result, of any length
  bool unproject(const Vec<T, 2>& m, Vec<T, 3>& ray) const noexcept {
    ray = {{m[0], m[1], T(1)}};
    return true;
  }
};

/// Pinhole: fx fy cx cy.
template <class T>
using PinholeCamera = FocalCamera<PinholeProjection<T>>;

}  // namespace v1
}  // namespace gslam

#endif  // GSLAM_GEOMETRY_CAMERA_PINHOLE_H
