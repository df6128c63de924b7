#ifndef GSLAM_GEOMETRY_CAMERA_MEI_H
#define GSLAM_GEOMETRY_CAMERA_MEI_H

#include <gslam/geometry/camera/focal_camera.h>
#include <gslam/geometry/detail/camera_radtan.h>

#include <cmath>
#include <cstddef>

/// @file
/// The camera with a mirror of Mei and Rives: OpenCV's omnidir, Kalibr's omni-radtan.

namespace gslam {
inline namespace v1 {

/// A projection to the unit sphere, from there to the plane through a point xi behind its centre,
/// and radial and tangential distortion on the plane:
///
///     d = sqrt(x^2 + y^2 + z^2)      a = x / (z + xi d)      b = y / (z + xi d)
///     s = a^2 + b^2                  g = 1 + k1 s + k2 s^2
///     mx = a g + 2 p1 a b + p2 (s + 2 a^2)
///     my = b g + p1 (s + 2 b^2) + 2 p2 a b
///
/// It sees where z > -xi d (for xi > 1: z > -d / xi), as far as the distortion is one-to-one (see
/// RadtanProjection). The focal lengths are the generalised ones, gamma, which contain 1 + xi.
///
/// C. Mei, P. Rives, "Single view point omnidirectional camera calibration from planar grids",
/// ICRA 2007.
template <class T>
class MeiProjection {
 public:
  using Scalar = T;                                            ///< float or double
  using Jacobians = detail::ProjectionJacobians<T, 5>;         ///< derivatives
  static constexpr const char* name() { return "mei"; }        ///< name of the model
  static constexpr std::size_t parameterCount() { return 5; }  ///< xi k1 k2 p1 p2
  /// Name of parameter i.
  static const char* parameterName(std::size_t i) noexcept {
    return i == 0 ? "xi" : detail::RadtanDistortion<T, 4>::parameterName(i - 1);
  }

  /// @param parameters  xi, 0 or more; k1 k2 p1 p2
  /// @throws ArgumentError when xi is negative or one is not finite
  explicit MeiProjection(const T* parameters) : xi_(parameters[0]), distortion_(parameters + 1) {
    detail::checkFinite("xi", xi_);
    detail::checkParameter(xi_ >= 0, "xi", xi_, "0 or more");
  }

  /// Parameter i.
  T parameter(std::size_t i) const noexcept { return i == 0 ? xi_ : distortion_.parameter(i - 1); }

  /// @param point      camera coordinates
  /// @param m          result
  /// @param jacobians  result unless null
  /// @return whether the point is in the cone that the camera sees
  bool project(const Vec<T, 3>& point, Vec<T, 2>& m, Jacobians* jacobians) const noexcept {
    const T squared = point.squaredNorm();
    const T d = std::sqrt(squared);
    const T z = point[2];
    if (!detail::isSafeSquare(squared) || !(z > -(xi_ > 1 ? 1 / xi_ : xi_) * d)) return false;
    const T n = z + xi_ * d;
    const Vec<T, 2> flat = {{point[0] / n, point[1] / n}};
    if (jacobians == nullptr) return distortion_.distort(flat, m, nullptr, nullptr);
    Mat<T, 2, 2> by_flat;
    Mat<T, 2, 4> by_coefficients;
    if (!distortion_.distort(flat, m, &by_flat, &by_coefficients)) return false;
    Mat<T, 2, 3> flat_by_point;
    Vec<T, 3> n_by_point = (xi_ / d) * point;
    n_by_point[2] += 1;
    detail::setQuotientJacobian(flat, n, n_by_point, flat_by_point);
    jacobians->point = by_flat * flat_by_point;
    const Vec<T, 2> by_xi = by_flat * (flat * (-d / n));
    for (std::size_t row = 0; row < 2; ++row) {
      jacobians->parameters[row][0] = by_xi[row];
      for (std::size_t i = 0; i < 4; ++i) {
        jacobians->parameters[row][1 + i] = by_coefficients(row, i);
      }
    }
    return true;
  }

  /// @param m    distorted
  /// @param ray  result
  /// @return whether the iteration converged and the plane point is the image of a direction
  bool unproject(const Vec<T, 2>& m, Vec<T, 3>& ray) const noexcept {
    Vec<T, 2> flat{};
    if (!distortion_.undistort(m, flat)) return false;
    const T r2 = flat.squaredNorm();
    const T root = 1 + (1 - xi_ * xi_) * r2;
    if (!(root > 0)) return false;
    const T scale = (xi_ + std::sqrt(root)) / (1 + r2);
    ray = {{scale * flat[0], scale * flat[1], scale - xi_}};
    return true;
  }

 private:
  T xi_;
  detail::RadtanDistortion<T, 4> distortion_;
};

/// Mei: fx fy cx cy xi k1 k2 p1 p2.
template <class T>
using MeiCamera = FocalCamera<MeiProjection<T>>;

}  // namespace v1
}  // namespace gslam

#endif  // GSLAM_GEOMETRY_CAMERA_MEI_H
