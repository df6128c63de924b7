#ifndef GSLAM_GEOMETRY_CAMERA_DOUBLE_SPHERE_H
#define GSLAM_GEOMETRY_CAMERA_DOUBLE_SPHERE_H

#include <gslam/geometry/camera/focal_camera.h>

#include <cmath>
#include <cstddef>

/// @file
/// The double sphere camera.

namespace gslam {
inline namespace v1 {

/// The point goes to a unit sphere, from there to a second one shifted by xi, from there to the
/// plane through a pinhole shifted by alpha / (1 - alpha):
///
///     d1 = sqrt(x^2 + y^2 + z^2)      k = xi d1 + z      d2 = sqrt(x^2 + y^2 + k^2)
///     m = (x, y) / (alpha d2 + (1 - alpha) k)
///
/// It sees where k > -w d2, with w = alpha / (1 - alpha), or its inverse for alpha > 0.5. This is
/// exact. (The paper's bound on z / d1 is the same only for xi = 0 or alpha = 0.5; elsewhere it
/// leaves out the last degrees of the cone.)
///
/// V. Usenko, N. Demmel, D. Cremers, "The double sphere camera model", 3DV 2018.
template <class T>
class DoubleSphereProjection {
 public:
  using Scalar = T;                                                ///< float or double
  using Jacobians = detail::ProjectionJacobians<T, 2>;             ///< derivatives
  static constexpr const char* name() { return "double_sphere"; }  ///< name of the model
  static constexpr std::size_t parameterCount() { return 2; }      ///< xi alpha
  /// Name of parameter i.
  static const char* parameterName(std::size_t i) noexcept { return i == 0 ? "xi" : "alpha"; }

  /// @param parameters  xi, between -1 and 1; alpha, from 0 to 1
  /// @throws ArgumentError when one is not there
  explicit DoubleSphereProjection(const T* parameters) : xi_(parameters[0]), alpha_(parameters[1]) {
    detail::checkParameter(xi_ > -1 && xi_ < 1, "xi", xi_, "more than -1 and less than 1");
    detail::checkParameter(alpha_ >= 0 && alpha_ <= 1, "alpha", alpha_, "0 to 1");
  }

  /// Parameter i.
  T parameter(std::size_t i) const noexcept { return i == 0 ? xi_ : alpha_; }

  /// @param point      camera coordinates
  /// @param m          result
  /// @param jacobians  result unless null
  /// @return whether the point is in the cone that the camera sees
  bool project(const Vec<T, 3>& point, Vec<T, 2>& m, Jacobians* jacobians) const noexcept {
    const T x = point[0], y = point[1], z = point[2];
    const T r2 = x * x + y * y;
    const T squared = r2 + z * z;
    const T d1 = std::sqrt(squared);
    const T k = xi_ * d1 + z;
    const T d2 = std::sqrt(r2 + k * k);
    if (!detail::isSafeSquare(squared) || !(k > -detail::unifiedLimit(alpha_) * d2)) return false;
    const T n = alpha_ * d2 + (1 - alpha_) * k;
    m = {{x / n, y / n}};
    if (jacobians != nullptr) {
      const T n_by_k = alpha_ * k / d2 + 1 - alpha_;
      const Vec<T, 3> k_by_point = {{xi_ * x / d1, xi_ * y / d1, xi_ * z / d1 + 1}};
      Vec<T, 3> n_by_point = n_by_k * k_by_point;
      n_by_point[0] += alpha_ * x / d2;
      n_by_point[1] += alpha_ * y / d2;
      detail::setQuotientJacobian(m, n, n_by_point, jacobians->point);
      const T n_by_parameters[] = {n_by_k * d1, d2 - k};
      for (std::size_t row = 0; row < 2; ++row) {
        for (std::size_t i = 0; i < 2; ++i) {
          jacobians->parameters[row][i] = -m[row] / n * n_by_parameters[i];
        }
      }
    }
    return true;
  }

  /// @param m    on the plane
  /// @param ray  result
  /// @return whether m is the image of a direction
  bool unproject(const Vec<T, 2>& m, Vec<T, 3>& ray) const noexcept {
    const T r2 = m.squaredNorm();
    const T root = 1 - (2 * alpha_ - 1) * r2;
    if (!(root > 0)) return false;
    const T mz = (1 - alpha_ * alpha_ * r2) / (alpha_ * std::sqrt(root) + 1 - alpha_);
    const T squared = mz * mz + r2;
    const T scale = (mz * xi_ + std::sqrt(mz * mz + (1 - xi_ * xi_) * r2)) / squared;
    ray = {{scale * m[0], scale * m[1], scale * mz - xi_}};
    return true;
  }

 private:
  T xi_;
  T alpha_;
};

/// Double sphere: fx fy cx cy xi alpha.
template <class T>
using DoubleSphereCamera = FocalCamera<DoubleSphereProjection<T>>;

}  // namespace v1
}  // namespace gslam

#endif  // GSLAM_GEOMETRY_CAMERA_DOUBLE_SPHERE_H
