#ifndef GSLAM_GEOMETRY_CAMERA_FOCAL_CAMERA_H
#define GSLAM_GEOMETRY_CAMERA_FOCAL_CAMERA_H

#include <gslam/geometry/detail/camera_math.h>
#include <gslam/geometry/mat.h>
#include <gslam/geometry/vec.h>

#include <cmath>
#include <cstddef>

/// @file
/// What most camera models have in common: focal lengths and principal point.

namespace gslam {
inline namespace v1 {

/// A camera: a projection to the plane of unit focal length, then fx, fy, cx and cy.
///
///     (mx, my) = projection(x, y, z)        u = fx mx + cx        v = fy my + cy
///
/// Points are given in camera coordinates: x right, y down, z forward, metres. Pixels (u, v) have
/// the centre of the first one at (0, 0). Neither knows the size of the image; Camera does.
/// Parameters: fx fy cx cy in pixels, then those of the projection.
///
/// Everything is checked: a function that returns false left its results as they were, and what is
/// not finite, behind the camera or beyond what the model can do gives false. Points whose squared
/// coordinates leave the range of T (1e-146 to 1e154 m for double, 1e-16 to 1e19 m for float) may
/// be refused.
///
/// @tparam Projection  one of the models of `gslam/geometry/camera/`; use their names, such as
///                     DoubleSphereCamera<double>
/// Layout: plain numbers of type T, trivially copyable. Immutable, so it may be shared by threads.
template <class Projection>
class FocalCamera {
 public:
  using Scalar = typename Projection::Scalar;  ///< float or double
  /// Number of parameters.
  static constexpr std::size_t parameterCount() noexcept {
    return 4 + Projection::parameterCount();
  }
  /// Values of all parameters: fx fy cx cy, then the projection's.
  using Parameters = Vec<Scalar, 4 + Projection::parameterCount()>;
  using Pixel = Vec<Scalar, 2>;               ///< (u, v), pixels
  using Point = Vec<Scalar, 3>;               ///< camera coordinates, metres
  using PointJacobian = Mat<Scalar, 2, 3>;    ///< of a pixel by a point
  using BearingJacobian = Mat<Scalar, 3, 2>;  ///< of a bearing by a pixel
  /// Of a pixel by the parameters.
  using ParameterJacobian = Mat<Scalar, 2, 4 + Projection::parameterCount()>;
  /// Of a bearing by the parameters.
  using BearingParameterJacobian = Mat<Scalar, 3, 4 + Projection::parameterCount()>;

  /// @param parameters  fx fy cx cy, then the projection's
  /// @throws ArgumentError when one is not finite, fx or fy is not positive, or the projection
  ///   refuses one of its own
  explicit FocalCamera(const Parameters& parameters)
      : fx_(parameters[0]),
        fy_(parameters[1]),
        cx_(parameters[2]),
        cy_(parameters[3]),
        projection_(parameters.data() + 4) {
    for (std::size_t i = 0; i < 4; ++i) detail::checkFinite(parameterName(i), parameters[i]);
    detail::checkParameter(fx_ > 0, "fx", fx_, "a positive number of pixels");
    detail::checkParameter(fy_ > 0, "fy", fy_, "a positive number of pixels");
  }

  /// Name of the model, such as "double_sphere".
  static const char* name() noexcept { return Projection::name(); }
  /// Name of parameter i, such as "fx"; i is below parameterCount().
  static const char* parameterName(std::size_t i) noexcept {
    static const char* const names[] = {"fx", "fy", "cx", "cy"};
    return i < 4 ? names[i] : Projection::parameterName(i - 4);
  }

  Scalar fx() const noexcept { return fx_; }  ///< focal length along u, pixels
  Scalar fy() const noexcept { return fy_; }  ///< focal length along v, pixels
  Scalar cx() const noexcept { return cx_; }  ///< u of the principal point, pixels
  Scalar cy() const noexcept { return cy_; }  ///< v of the principal point, pixels
  /// The projection, with its parameters and limits.
  const Projection& projection() const noexcept { return projection_; }

  /// All parameters, in the order of parameterName().
  Parameters parameters() const noexcept {
    Parameters all{};
    const Scalar focal[] = {fx_, fy_, cx_, cy_};
    for (std::size_t i = 0; i < parameterCount(); ++i) {
      all[i] = i < 4 ? focal[i] : projection_.parameter(i - 4);
    }
    return all;
  }

  /// Where a point is seen.
  /// @param point          camera coordinates, metres
  /// @param pixel          result
  /// @param by_point       result unless null: d pixel / d point, pixels per metre
  /// @param by_parameters  result unless null: d pixel / d parameters
  /// @return whether the model sees the point, inside the image or beside it
  bool project(const Point& point, Pixel& pixel, PointJacobian* by_point = nullptr,
               ParameterJacobian* by_parameters = nullptr) const noexcept {
    detail::ProjectionJacobians<Scalar, Projection::parameterCount()> jacobians;
    const bool is_derived = by_point != nullptr || by_parameters != nullptr;
    Vec<Scalar, 2> m;
    if (!projection_.project(point, m, is_derived ? &jacobians : nullptr)) return false;
    const Pixel result = {{fx_ * m[0] + cx_, fy_ * m[1] + cy_}};
    if (!detail::isFinite(result)) return false;
    // Next to the plane of the camera derivatives overflow before the pixel does.
    if (is_derived && !jacobians.isFinite()) return false;
    pixel = result;
    if (by_point != nullptr) {
      for (std::size_t c = 0; c < 3; ++c) {
        (*by_point)(0, c) = fx_ * jacobians.point(0, c);
        (*by_point)(1, c) = fy_ * jacobians.point(1, c);
      }
    }
    if (by_parameters != nullptr) setParameterJacobian(m, jacobians, *by_parameters);
    return true;
  }

  /// The direction that a pixel looks in.
  /// @param pixel          (u, v)
  /// @param bearing        result: camera coordinates, length 1
  /// @param by_pixel       result unless null: d bearing / d pixel
  /// @param by_parameters  result unless null: d bearing / d parameters
  /// @return whether project() gives the pixel back (for models that iterate: it did converge)
  bool unproject(const Pixel& pixel, Point& bearing, BearingJacobian* by_pixel = nullptr,
                 BearingParameterJacobian* by_parameters = nullptr) const noexcept {
    const Vec<Scalar, 2> m = {{(pixel[0] - cx_) / fx_, (pixel[1] - cy_) / fy_}};
    Point ray;
    if (!detail::isFinite(m) || !projection_.unproject(m, ray)) return false;
    const Scalar squared = ray.squaredNorm();
    if (!detail::isSafeSquare(squared)) return false;
    const Point result = ray / std::sqrt(squared);
    const bool is_derived = by_pixel != nullptr || by_parameters != nullptr;
    if (is_derived && !detail::unprojectJacobians(*this, result, by_pixel, by_parameters)) {
      return false;
    }
    bearing = result;
    return true;
  }

  /// The camera of the same image, resized by these factors (above 0).
  /// Borders of pixels stay borders: u' + 0.5 = (u + 0.5) factor_x.
  FocalCamera resized(Scalar factor_x, Scalar factor_y) const noexcept {
    const Scalar half = Scalar(0.5);
    FocalCamera result = *this;
    result.fx_ = fx_ * factor_x;
    result.fy_ = fy_ * factor_y;
    result.cx_ = (cx_ + half) * factor_x - half;
    result.cy_ = (cy_ + half) * factor_y - half;
    return result;
  }

  /// The camera of the part of the image that begins at pixel (x, y).
  FocalCamera cropped(Scalar x, Scalar y) const noexcept {
    FocalCamera result = *this;
    result.cx_ = cx_ - x;
    result.cy_ = cy_ - y;
    return result;
  }

 private:
  void setParameterJacobian(
      const Vec<Scalar, 2>& m,
      const detail::ProjectionJacobians<Scalar, Projection::parameterCount()>& jacobians,
      ParameterJacobian& result) const noexcept {
    result = ParameterJacobian{};
    const Scalar focal[] = {fx_, fy_};
    for (std::size_t row = 0; row < 2; ++row) {
      result(row, row) = m[row];
      result(row, 2 + row) = Scalar(1);
      for (std::size_t c = 0; c < Projection::parameterCount(); ++c) {
        result(row, 4 + c) = focal[row] * jacobians.parameters[row][c];
      }
    }
  }

  Scalar fx_, fy_, cx_, cy_;
  Projection projection_;
};

}  // namespace v1
}  // namespace gslam

#endif  // GSLAM_GEOMETRY_CAMERA_FOCAL_CAMERA_H
