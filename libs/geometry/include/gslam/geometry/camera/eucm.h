#ifndef GSLAM_GEOMETRY_CAMERA_EUCM_H
#define GSLAM_GEOMETRY_CAMERA_EUCM_H

#include <gslam/geometry/camera/focal_camera.h>

#include <cmath>
#include <cstddef>

/// @file
/// The unified camera and the enhanced unified camera.

namespace gslam {
inline namespace v1 {
namespace detail {

// m = (x, y) / (alpha d + (1 - alpha) z) with d = sqrt(beta (x^2 + y^2) + z^2)
// @param by_parameters  derivatives by alpha and beta unless null
template <class T>
bool projectUnified(const Vec<T, 3>& point, T alpha, T beta, Vec<T, 2>& m, Mat<T, 2, 3>* by_point,
                    Mat<T, 2, 2>* by_parameters) noexcept {
  const T x = point[0], y = point[1], z = point[2];
  const T r2 = x * x + y * y;
  const T squared = beta * r2 + z * z;
  const T d = std::sqrt(squared);
  if (!isSafeSquare(squared) || !(z > -unifiedLimit(alpha) * d)) return false;
  const T n = alpha * d + (1 - alpha) * z;
  m = {{x / n, y / n}};
  if (by_point != nullptr) {
    const Vec<T, 3> gradient = {
        {alpha * beta * x / d, alpha * beta * y / d, alpha * z / d + 1 - alpha}};
    setQuotientJacobian(m, n, gradient, *by_point);
  }
  if (by_parameters != nullptr) {
    for (std::size_t row = 0; row < 2; ++row) {
      (*by_parameters)(row, 0) = -m[row] / n * (d - z);
      (*by_parameters)(row, 1) = -m[row] / n * (alpha * r2 / (2 * d));
    }
  }
  return true;
}

template <class T>
bool unprojectUnified(const Vec<T, 2>& m, T alpha, T beta, Vec<T, 3>& ray) noexcept {
  const T r2 = beta * m.squaredNorm();
  const T root = 1 - (2 * alpha - 1) * r2;
  if (!(root > 0)) return false;
  ray = {{m[0], m[1], (1 - alpha * alpha * r2) / (alpha * std::sqrt(root) + 1 - alpha)}};
  return true;
}

}  // namespace detail

/// The enhanced unified camera: a projection to an ellipsoid of revolution, then to the plane.
///
///     d = sqrt(beta (x^2 + y^2) + z^2)      m = (x, y) / (alpha d + (1 - alpha) z)
///
/// It sees where z > -w d, with w = alpha / (1 - alpha), or its inverse for alpha > 0.5.
///
/// B. Khomutenko, G. Garcia, P. Martinet, "An enhanced unified camera model", RA-L 1(1), 2016.
template <class T>
class EucmProjection {
 public:
  using Scalar = T;                                            ///< float or double
  using Jacobians = detail::ProjectionJacobians<T, 2>;         ///< derivatives
  static constexpr const char* name() { return "eucm"; }       ///< name of the model
  static constexpr std::size_t parameterCount() { return 2; }  ///< alpha beta
  /// Name of parameter i.
  static const char* parameterName(std::size_t i) noexcept { return i == 0 ? "alpha" : "beta"; }

  /// @param parameters  alpha, from 0 to 1; beta, positive
  /// @throws ArgumentError when one is not there
  explicit EucmProjection(const T* parameters) : alpha_(parameters[0]), beta_(parameters[1]) {
    detail::checkParameter(alpha_ >= 0 && alpha_ <= 1, "alpha", alpha_, "0 to 1");
    detail::checkFinite("beta", beta_);
    detail::checkParameter(beta_ > 0, "beta", beta_, "a positive number");
  }

  /// Parameter i.
  T parameter(std::size_t i) const noexcept { return i == 0 ? alpha_ : beta_; }

  /// @param point      camera coordinates
  /// @param m          result
  /// @param jacobians  result unless null
  /// @return whether the point is in the cone that the camera sees
  bool project(const Vec<T, 3>& point, Vec<T, 2>& m, Jacobians* jacobians) const noexcept {
    if (jacobians == nullptr) {
      return detail::projectUnified<T>(point, alpha_, beta_, m, nullptr, nullptr);
    }
    Mat<T, 2, 2> by_parameters;
    if (!detail::projectUnified(point, alpha_, beta_, m, &jacobians->point, &by_parameters)) {
      return false;
    }
    for (std::size_t i = 0; i < 4; ++i) {
      jacobians->parameters[i / 2][i % 2] = by_parameters(i / 2, i % 2);
    }
    return true;
  }

  /// @param m    on the plane
  /// @param ray  result
  /// @return whether m is the image of a direction
  bool unproject(const Vec<T, 2>& m, Vec<T, 3>& ray) const noexcept {
    return detail::unprojectUnified(m, alpha_, beta_, ray);
  }

 private:
  T alpha_;
  T beta_;
};

/// The unified camera, the enhanced one with beta = 1: it projects to a sphere.
///
///     d = sqrt(x^2 + y^2 + z^2)      m = (x, y) / (alpha d + (1 - alpha) z)
///
/// With a mirror parameter xi (see MeiProjection) instead: alpha = xi / (1 + xi), and the focal
/// length is that of the other divided by 1 + xi.
template <class T>
class UcmProjection {
 public:
  using Scalar = T;                                            ///< float or double
  using Jacobians = detail::ProjectionJacobians<T, 1>;         ///< derivatives
  static constexpr const char* name() { return "ucm"; }        ///< name of the model
  static constexpr std::size_t parameterCount() { return 1; }  ///< alpha
  /// Name of parameter i.
  static const char* parameterName(std::size_t) noexcept { return "alpha"; }

  /// @param parameters  alpha, from 0 to 1
  /// @throws ArgumentError when it is not there
  explicit UcmProjection(const T* parameters) : alpha_(parameters[0]) {
    detail::checkParameter(alpha_ >= 0 && alpha_ <= 1, "alpha", alpha_, "0 to 1");
  }

  /// alpha.
  T parameter(std::size_t) const noexcept { return alpha_; }

  /// @param point      camera coordinates
  /// @param m          result
  /// @param jacobians  result unless null
  /// @return whether the point is in the cone that the camera sees
  bool project(const Vec<T, 3>& point, Vec<T, 2>& m, Jacobians* jacobians) const noexcept {
    if (jacobians == nullptr) {
      return detail::projectUnified<T>(point, alpha_, T(1), m, nullptr, nullptr);
    }
    Mat<T, 2, 2> by_parameters;
    if (!detail::projectUnified(point, alpha_, T(1), m, &jacobians->point, &by_parameters)) {
      return false;
    }
    jacobians->parameters[0][0] = by_parameters(0, 0);
    jacobians->parameters[1][0] = by_parameters(1, 0);
    return true;
  }

  /// @param m    on the plane
  /// @param ray  result
  /// @return whether m is the image of a direction
  bool unproject(const Vec<T, 2>& m, Vec<T, 3>& ray) const noexcept {
    return detail::unprojectUnified(m, alpha_, T(1), ray);
  }

 private:
  T alpha_;
};

/// Enhanced unified camera: fx fy cx cy alpha beta.
template <class T>
using EucmCamera = FocalCamera<EucmProjection<T>>;

/// Unified camera: fx fy cx cy alpha.
template <class T>
using UcmCamera = FocalCamera<UcmProjection<T>>;

}  // namespace v1
}  // namespace gslam

#endif  // GSLAM_GEOMETRY_CAMERA_EUCM_H
