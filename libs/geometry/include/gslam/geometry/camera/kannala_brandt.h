#ifndef GSLAM_GEOMETRY_CAMERA_KANNALA_BRANDT_H
#define GSLAM_GEOMETRY_CAMERA_KANNALA_BRANDT_H

#include <gslam/geometry/camera/focal_camera.h>
#include <gslam/geometry/detail/camera_angle.h>
#include <gslam/geometry/detail/camera_polynomial.h>

#include <algorithm>
#include <cmath>
#include <cstddef>

/// @file
/// The fisheye camera of Kannala and Brandt, which OpenCV calls fisheye and Kalibr equidistant.

namespace gslam {
inline namespace v1 {

/// The distance from the principal point is a polynomial in the angle from the axis:
///
///     r = sqrt(x^2 + y^2)      theta = atan2(r, z)      m = d(theta) (x, y) / r
///     d(theta) = theta (1 + k1 theta^2 + k2 theta^4 + k3 theta^6 + k4 theta^8)
///
/// It sees every angle up to the one where d(theta) stops to grow, at most pi (that is, behind it).
/// unproject() solves d(theta) = |m| by Newton's steps in a bracket, which always converge.
///
/// J. Kannala, S. S. Brandt, "A generic camera model and calibration method for conventional,
/// wide-angle, and fish-eye lenses", PAMI 28(8), 2006, equation 6 with the first factor in f.
template <class T>
class KannalaBrandtProjection {
 public:
  using Scalar = T;                                                 ///< float or double
  using Jacobians = detail::ProjectionJacobians<T, 4>;              ///< derivatives
  static constexpr const char* name() { return "kannala_brandt"; }  ///< name of the model
  static constexpr std::size_t parameterCount() { return 4; }       ///< k1 k2 k3 k4
  /// Name of parameter i.
  static const char* parameterName(std::size_t i) noexcept {
    static const char* const names[] = {"k1", "k2", "k3", "k4"};
    return names[i];
  }

  /// @param parameters  k1 k2 k3 k4
  /// @throws ArgumentError when one is not finite
  explicit KannalaBrandtProjection(const T* parameters) : k_{} {
    detail::CameraPolynomial slope{};  // of d, in theta^2
    slope.c[0] = 1;
    for (std::size_t i = 0; i < 4; ++i) {
      detail::checkFinite(parameterName(i), parameters[i]);
      k_[i] = parameters[i];
      slope.c[i + 1] = static_cast<double>(2 * i + 3) * static_cast<double>(parameters[i]);
    }
    const T pi = T(3.14159265358979323846264338327950288L);
    const T end = static_cast<T>(std::sqrt(detail::firstPositiveRoot(slope)));
    max_angle_ = std::min(end, pi);
    T unused;
    max_distance_ = distance(max_angle_, unused);
  }

  /// Parameter i.
  T parameter(std::size_t i) const noexcept { return k_[i]; }
  /// The angle from the axis, in radians, below which the camera sees.
  T maxAngle() const noexcept { return max_angle_; }

  /// @param point      camera coordinates
  /// @param m          result
  /// @param jacobians  result unless null
  /// @return whether the angle from the axis is below maxAngle()
  bool project(const Vec<T, 3>& point, Vec<T, 2>& m, Jacobians* jacobians) const noexcept {
    const T x = point[0], y = point[1], z = point[2];
    const T r = std::sqrt(x * x + y * y);
    const T squared = r * r + z * z;
    if (!detail::isSafeSquare(squared)) return false;
    const T theta = detail::angleFromAxis(r, z);
    if (!(theta < max_angle_)) return false;
    T slope;
    const T scale = r > 0 ? distance(theta, slope) / r : T(1) / z;
    m = {{scale * x, scale * y}};
    if (jacobians != nullptr) {
      distance(theta, slope);
      detail::setRadialJacobian(point, r, scale, slope * (z / squared), -slope * (r / squared),
                                jacobians->point);
      setParameterJacobian(point, r, theta, *jacobians);
    }
    return true;
  }

  /// @param m    d(theta) times the direction in the image
  /// @param ray  result
  /// @return whether |m| is d of an angle below maxAngle()
  bool unproject(const Vec<T, 2>& m, Vec<T, 3>& ray) const noexcept {
    const T squared = m.squaredNorm();
    if (!(squared > std::numeric_limits<T>::min())) {  // theta is |m| to the last digit
      ray = {{m[0], m[1], T(1)}};
      return true;
    }
    const T target = std::sqrt(squared);
    if (!(target < max_distance_)) return false;
    const auto excess = [this, target](T angle, T& slope) {
      return distance(angle, slope) - target;
    };
    T theta;
    if (!detail::solveBracketed(excess, T(0), max_angle_, target, theta)) return false;
    const T scale = std::sin(theta) / target;
    ray = {{scale * m[0], scale * m[1], std::cos(theta)}};
    return true;
  }

 private:
  // d(theta) and its derivative.
  T distance(T theta, T& slope) const noexcept {
    const T s = theta * theta;
    slope = 1 + s * (3 * k_[0] + s * (5 * k_[1] + s * (7 * k_[2] + s * 9 * k_[3])));
    return theta * (1 + s * (k_[0] + s * (k_[1] + s * (k_[2] + s * k_[3]))));
  }

  static void setParameterJacobian(const Vec<T, 3>& point, T r, T theta, Jacobians& j) noexcept {
    T power = theta;
    for (std::size_t i = 0; i < 4; ++i) {
      power *= theta * theta;
      const T scale = r > 0 ? power / r : T(0);
      j.parameters[0][i] = scale * point[0];
      j.parameters[1][i] = scale * point[1];
    }
  }

  Vec<T, 4> k_;
  T max_angle_;
  T max_distance_;
};

/// Kannala-Brandt: fx fy cx cy k1 k2 k3 k4.
template <class T>
using KannalaBrandtCamera = FocalCamera<KannalaBrandtProjection<T>>;

}  // namespace v1
}  // namespace gslam

#endif  // GSLAM_GEOMETRY_CAMERA_KANNALA_BRANDT_H
