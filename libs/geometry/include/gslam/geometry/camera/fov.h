#ifndef GSLAM_GEOMETRY_CAMERA_FOV_H
#define GSLAM_GEOMETRY_CAMERA_FOV_H

#include <gslam/geometry/camera/focal_camera.h>
#include <gslam/geometry/detail/camera_angle.h>

#include <cmath>
#include <cstddef>
#include <limits>

/// @file
/// The field-of-view camera of Devernay and Faugeras, which PTAM calls ATAN.

namespace gslam {
inline namespace v1 {

/// One parameter, the angle w of an ideal fisheye lens:
///
///     r = sqrt(x^2 + y^2)      k = 2 tan(w / 2)      m = d (x, y) / r
///     d = atan(k r / z) / w
///
/// It sees what is in front of it, z > 0; w = 0 is the pinhole camera.
///
/// F. Devernay, O. Faugeras, "Straight lines have to be straight", Machine Vision and Applications
/// 13, 2001, equations 13 and 14.
template <class T>
class FovProjection {
 public:
  using Scalar = T;                                            ///< float or double
  using Jacobians = detail::ProjectionJacobians<T, 1>;         ///< derivatives
  static constexpr const char* name() { return "fov"; }        ///< name of the model
  static constexpr std::size_t parameterCount() { return 1; }  ///< w
  /// Name of parameter i.
  static const char* parameterName(std::size_t) noexcept { return "w"; }

  /// @param parameters  w, radians, from 0 to below pi
  /// @throws ArgumentError when it is not there
  explicit FovProjection(const T* parameters) : w_(parameters[0]), k_(2 * std::tan(w_ / 2)) {
    detail::checkParameter(w_ >= 0 && w_ < T(3.14159265358979323846), "w", w_,
                           "0 or more and less than pi");
    const T e = std::numeric_limits<T>::epsilon();
    if (w_ < e * e * e * e) w_ = k_ = T(0);  // bends nothing, but k r could underflow
  }

  /// w.
  T parameter(std::size_t) const noexcept { return w_; }

  /// @param point      camera coordinates
  /// @param m          result
  /// @param jacobians  result unless null
  /// @return whether z > 0
  bool project(const Vec<T, 3>& point, Vec<T, 2>& m, Jacobians* jacobians) const noexcept {
    const T x = point[0], y = point[1], z = point[2];
    const T r = std::sqrt(x * x + y * y);
    const T squared = r * r + z * z;
    if (!(z > 0) || !detail::isSafeSquare(squared)) return false;
    const bool is_bent = w_ > 0 && r > 0;
    const T angle = is_bent ? detail::angleFromAxis(k_ * r, z) : T(0);
    const T on_axis = (w_ > 0 ? k_ / w_ : T(1)) / z;  // limit of d / r
    const T scale = is_bent ? angle / (w_ * r) : on_axis;
    m = {{scale * x, scale * y}};
    if (jacobians != nullptr) {
      const T by_tangent = on_axis * z / (z * z + k_ * r * (k_ * r));  // (d d / d (r / z)) / z^2
      detail::setRadialJacobian(point, r, scale, by_tangent * z, -by_tangent * r, jacobians->point);
      const T by_w = r > 0 ? derivativeByW(r / z, angle) / r : T(0);
      jacobians->parameters[0][0] = by_w * x;
      jacobians->parameters[1][0] = by_w * y;
    }
    return true;
  }

  /// @param m    d times the direction in the image
  /// @param ray  result
  /// @return whether |m| w < pi / 2
  bool unproject(const Vec<T, 2>& m, Vec<T, 3>& ray) const noexcept {
    const T d = std::sqrt(m.squaredNorm());
    const T angle = d * w_;
    const T depth = std::cos(angle);
    if (!(angle < T(1.6)) || !(depth > 0)) return false;
    // (sin(angle) m / d, k cos(angle)) divided by w
    const T scale = angle > 0 ? std::sin(angle) / angle : T(1);
    ray = {{scale * m[0], scale * m[1], (w_ > 0 ? k_ / w_ : T(1)) * depth}};
    return true;
  }

 private:
  // d d / d w, where q = r / z. Its two terms cancel for small w; there, the series in w.
  T derivativeByW(T q, T angle) const noexcept {
    const T s = q * q;
    if (w_ * (1 + q) < std::cbrt(std::sqrt(std::numeric_limits<T>::epsilon()))) {
      const T first = T(1) / 6 - s * 2 / 3;
      const T third = T(1) / 30 - s / 3 + s * s * 4 / 5;
      return w_ * q * (first + w_ * w_ * third);
    }
    const T k_by_w = 1 + k_ * k_ / 4;
    return (k_by_w * q / (1 + k_ * k_ * s) - angle / w_) / w_;
  }

  T w_;
  T k_;
};

/// FOV, also called ATAN: fx fy cx cy w.
template <class T>
using FovCamera = FocalCamera<FovProjection<T>>;

}  // namespace v1
}  // namespace gslam

#endif  // GSLAM_GEOMETRY_CAMERA_FOV_H
