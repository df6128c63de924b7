#ifndef GSLAM_GEOMETRY_CAMERA_RADTAN_H
#define GSLAM_GEOMETRY_CAMERA_RADTAN_H

#include <gslam/geometry/camera/focal_camera.h>
#include <gslam/geometry/detail/camera_radtan.h>

#include <cstddef>

/// @file
/// The camera with radial and tangential distortion: OpenCV's, Kalibr's pinhole-radtan.

namespace gslam {
inline namespace v1 {

/// A pinhole with radial, tangential and, with 12 coefficients and more, thin-prism distortion:
///
///     a = x / z      b = y / z      s = a^2 + b^2
///     g = (1 + k1 s + k2 s^2 + k3 s^3) / (1 + k4 s + k5 s^2 + k6 s^3)
///     mx = a g + 2 p1 a b + p2 (s + 2 a^2) + s1 s + s2 s^2
///     my = b g + p1 (s + 2 b^2) + 2 p2 a b + s3 s + s4 s^2
///
/// and, with 14 coefficients, the image of this on a sensor tilted by taux and tauy.
///
/// It sees points with z > 0 and sqrt(s) < maxRadius(), on which the map is one-to-one: beyond, a
/// polynomial folds back and shows points in the image that the lens does not. unproject() is
/// Newton's method, and false where the result does not project back to the pixel.
///
/// D. C. Brown, "Close-range camera calibration", 1971; OpenCV's calib3d, for the order of the
/// coefficients: k1 k2 p1 p2 k3 k4 k5 k6 s1 s2 s3 s4 taux tauy.
/// @tparam N  number of coefficients: 4, 5, 8, 12 or 14
template <class T, std::size_t N>
class RadtanProjection {
 public:
  using Scalar = T;                                            ///< float or double
  using Jacobians = detail::ProjectionJacobians<T, N>;         ///< derivatives
  static constexpr const char* name() { return "radtan"; }     ///< name of the model
  static constexpr std::size_t parameterCount() { return N; }  ///< the coefficients
  /// Name of parameter i.
  static const char* parameterName(std::size_t i) noexcept {
    return detail::RadtanDistortion<T, N>::parameterName(i);
  }

  /// @param parameters  N coefficients in OpenCV's order
  /// @throws ArgumentError when one is not finite, or a tilt is a right angle or more
  explicit RadtanProjection(const T* parameters) : distortion_(parameters) {}

  /// Parameter i.
  T parameter(std::size_t i) const noexcept { return distortion_.parameter(i); }
  /// The tangent of the angle from the axis below which the camera sees; may be infinite.
  T maxRadius() const noexcept { return distortion_.limit(); }

  /// @param point      camera coordinates
  /// @param m          result
  /// @param jacobians  result unless null
  /// @return whether z > 0 and the tangent of the angle from the axis is below maxRadius()
  bool project(const Vec<T, 3>& point, Vec<T, 2>& m, Jacobians* jacobians) const noexcept {
    const T z = point[2];
    if (!(z > 0)) return false;
    const Vec<T, 2> flat = {{point[0] / z, point[1] / z}};
    if (jacobians == nullptr) return distortion_.distort(flat, m, nullptr, nullptr);
    Mat<T, 2, 2> by_flat;
    Mat<T, 2, N> by_parameters;
    if (!distortion_.distort(flat, m, &by_flat, &by_parameters)) return false;
    Mat<T, 2, 3> flat_by_point;
    detail::setQuotientJacobian(flat, z, {{T(0), T(0), T(1)}}, flat_by_point);
    jacobians->point = by_flat * flat_by_point;
    for (std::size_t i = 0; i < 2 * N; ++i) {
      jacobians->parameters[i / N][i % N] = by_parameters.values[i];
    }
    return true;
  }

  /// @param m    distorted
  /// @param ray  result
  /// @return whether the iteration converged
  bool unproject(const Vec<T, 2>& m, Vec<T, 3>& ray) const noexcept {
    Vec<T, 2> flat{};
    if (!distortion_.undistort(m, flat)) return false;
    ray = {{flat[0], flat[1], T(1)}};
    return true;
  }

 private:
  detail::RadtanDistortion<T, N> distortion_;
};

/// Radial-tangential: fx fy cx cy, then N coefficients in OpenCV's order.
template <class T, std::size_t N>
using RadtanCamera = FocalCamera<RadtanProjection<T, N>>;

}  // namespace v1
}  // namespace gslam

#endif  // GSLAM_GEOMETRY_CAMERA_RADTAN_H
