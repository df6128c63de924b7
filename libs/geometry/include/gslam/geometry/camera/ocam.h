#ifndef GSLAM_GEOMETRY_CAMERA_OCAM_H
#define GSLAM_GEOMETRY_CAMERA_OCAM_H

#include <gslam/geometry/detail/camera_math.h>
#include <gslam/geometry/detail/camera_polynomial.h>
#include <gslam/geometry/mat.h>
#include <gslam/geometry/vec.h>

#include <algorithm>
#include <cmath>
#include <cstddef>

/// @file
/// The omnidirectional camera of Scaramuzza's OCamCalib toolbox.

namespace gslam {
inline namespace v1 {

/// A polynomial gives the depth of the ray from the distance rho, in pixels, to the centre:
///
///     f(rho) = a0 + a1 rho + a2 rho^2 + a3 rho^3 + a4 rho^4
///     the bearing is along (p, q, -f(rho)) with rho = sqrt(p^2 + q^2)
///     u = p + e q + cx        v = d p + c q + cy
///
/// The values are those of the toolbox' file: a0 to a4 its polynomial of the direct mapping (a0 is
/// negative; leave out or set to 0 what a shorter one does not have), cx its second centre value
/// (the column), cy the first (the row), and c d e as they are. Coordinates are ours: the
/// toolbox' x is down, its y right and its z backwards.
///
/// The polynomial is the model, in both directions: project() solves it by Newton's steps in a
/// bracket, which always converge. The file's inverse polynomial, a fit that is good to some
/// thousandths of a pixel and to the border of the image only, is not needed. The camera sees every
/// angle up to the one where rho stops to grow with the angle, at most maxRadius() = 1000 |a0|
/// pixels from the centre.
///
/// D. Scaramuzza, A. Martinelli, R. Siegwart, "A toolbox for easily calibrating omnidirectional
/// cameras", IROS 2006.
///
/// Results, checks and layout are as in FocalCamera.
template <class T>
class OcamCamera {
 public:
  using Scalar = T;                                             ///< float or double
  static constexpr const char* name() { return "ocam"; }        ///< name of the model
  static constexpr std::size_t parameterCount() { return 10; }  ///< cx cy c d e a0 ... a4
  using Parameters = Vec<T, 10>;                                ///< values of all parameters
  using Pixel = Vec<T, 2>;                                      ///< (u, v), pixels
  using Point = Vec<T, 3>;                                      ///< camera coordinates, metres
  using PointJacobian = Mat<T, 2, 3>;                           ///< of a pixel by a point
  using BearingJacobian = Mat<T, 3, 2>;                         ///< of a bearing by a pixel
  using ParameterJacobian = Mat<T, 2, 10>;                      ///< of a pixel by parameters
  using BearingParameterJacobian = Mat<T, 3, 10>;               ///< of a bearing by parameters

  /// @param parameters  cx cy c d e a0 a1 a2 a3 a4
  /// @throws ArgumentError when one is not finite, a0 is not negative, or c is not more than d e
  explicit OcamCamera(const Parameters& parameters) : p_(parameters) {
    for (std::size_t i = 0; i < parameterCount(); ++i) detail::checkFinite(parameterName(i), p_[i]);
    detail::checkParameter(a(0) < 0, "a0", a(0), "a negative number of pixels");
    detail::checkParameter(c() - d() * e() > 0, "c", c(), "more than d e");
    detail::CameraPolynomial growth{};  // of the angle: rho f'(rho) - f(rho)
    for (std::size_t i = 0; i < 5; ++i) {
      growth.c[i] = (static_cast<double>(i) - 1) * static_cast<double>(a(i));
    }
    const T end = static_cast<T>(detail::firstPositiveRoot(growth));
    max_radius_ = std::min(end, -1000 * a(0));
  }

  /// Name of parameter i, which is below parameterCount().
  static const char* parameterName(std::size_t i) noexcept {
    static const char* const names[] = {"cx", "cy", "c", "d", "e", "a0", "a1", "a2", "a3", "a4"};
    return names[i];
  }

  /// All parameters, in the order of parameterName().
  Parameters parameters() const noexcept { return p_; }
  /// Largest rho of a pixel that the camera sees.
  T maxRadius() const noexcept { return max_radius_; }

  /// Where a point is seen; see FocalCamera::project().
  bool project(const Point& point, Pixel& pixel, PointJacobian* by_point = nullptr,
               ParameterJacobian* by_parameters = nullptr) const noexcept {
    const T x = point[0], y = point[1], z = point[2];
    const T r = std::sqrt(x * x + y * y);
    T rho;
    if (!solveRadius(r, z, rho)) return false;
    const T scale = r > 0 ? rho / r : -a(0) / z;
    const T p = scale * x, q = scale * y;
    const Pixel result = {{p + e() * q + p_[0], d() * p + c() * q + p_[1]}};
    if (!detail::isFinite(result)) return false;
    pixel = result;
    if (by_point == nullptr && by_parameters == nullptr) return true;
    // scale is defined by 0 = z scale + f(r scale)
    T slope;
    (void)depth(rho, slope);
    const T by_scale = z + r * slope;
    if (by_point != nullptr) {
      Mat<T, 2, 3> plane;
      detail::setRadialJacobian(point, r, scale, scale * z / by_scale, -rho / by_scale, plane);
      *by_point = affine() * plane;
    }
    if (by_parameters != nullptr) setParameterJacobian(point, p, q, rho, by_scale, *by_parameters);
    return true;
  }

  /// The direction that a pixel looks in; see FocalCamera::unproject().
  bool unproject(const Pixel& pixel, Point& bearing, BearingJacobian* by_pixel = nullptr,
                 BearingParameterJacobian* by_parameters = nullptr) const noexcept {
    const T u = pixel[0] - p_[0], v = pixel[1] - p_[1];
    const T determinant = c() - d() * e();
    const T p = (c() * u - e() * v) / determinant;
    const T q = (v - d() * u) / determinant;
    const T rho = std::sqrt(p * p + q * q);
    if (!(rho < max_radius_)) return false;
    T unused;
    const Point ray = {{p, q, -depth(rho, unused)}};
    const T squared = ray.squaredNorm();
    if (!detail::isSafeSquare(squared)) return false;
    const Point result = ray / std::sqrt(squared);
    const bool is_derived = by_pixel != nullptr || by_parameters != nullptr;
    if (is_derived && !detail::unprojectJacobians(*this, result, by_pixel, by_parameters)) {
      return false;
    }
    bearing = result;
    return true;
  }

  /// The camera of the same image, resized by these factors (above 0); see FocalCamera::resized().
  OcamCamera resized(T factor_x, T factor_y) const noexcept {
    OcamCamera result = *this;  // all distances grow with the columns, c and d mend the rows
    result.p_[0] = (p_[0] + T(0.5)) * factor_x - T(0.5);
    result.p_[1] = (p_[1] + T(0.5)) * factor_y - T(0.5);
    result.p_[2] *= factor_y / factor_x;
    result.p_[3] *= factor_y / factor_x;
    T factor = factor_x;
    for (std::size_t i = 5; i < 10; ++i) {
      result.p_[i] *= factor;
      factor /= factor_x;
    }
    result.max_radius_ *= factor_x;
    return result;
  }

  /// The camera of the part of the image that begins at pixel (x, y).
  OcamCamera cropped(T x, T y) const noexcept {
    OcamCamera result = *this;
    result.p_[0] -= x;
    result.p_[1] -= y;
    return result;
  }

 private:
  T c() const noexcept { return p_[2]; }
  T d() const noexcept { return p_[3]; }
  T e() const noexcept { return p_[4]; }
  T a(std::size_t i) const noexcept { return p_[5 + i]; }
  Mat<T, 2, 2> affine() const noexcept { return {{T(1), e(), d(), c()}}; }

  // f(rho) and its derivative.
  T depth(T rho, T& slope) const noexcept {
    slope = a(1) + rho * (2 * a(2) + rho * (3 * a(3) + rho * 4 * a(4)));
    return a(0) + rho * (a(1) + rho * (a(2) + rho * (a(3) + rho * a(4))));
  }

  // The rho whose ray has the angle of (r, z) from the axis. z rho + r f(rho) is the sine of the
  // angle between the two rays, times their lengths: negative below the solution, positive above.
  bool solveRadius(T r, T z, T& rho) const noexcept {
    const T squared = r * r + z * z;
    if (!detail::isSafeSquare(squared)) return false;
    rho = T(0);
    if (!(r > 0)) return z > 0;
    const auto miss = [this, r, z](T x, T& slope) {
      const T f = depth(x, slope);
      slope = z + r * slope;
      return z * x + r * f;
    };
    T unused;
    if (!(miss(max_radius_, unused) > 0)) return false;
    const T start = -2 * a(0) * r / (std::sqrt(squared) + z);  // right at the axis
    return detail::solveBracketed(miss, T(0), max_radius_, start, rho) && rho < max_radius_;
  }

  void setParameterJacobian(const Point& point, T p, T q, T rho, T by_scale,
                            ParameterJacobian& j) const noexcept {
    j = ParameterJacobian{};
    j(0, 0) = j(1, 1) = T(1);
    j(1, 2) = q;
    j(1, 3) = p;
    j(0, 4) = q;
    const Vec<T, 2> moved = affine() * Vec<T, 2>{{point[0], point[1]}};
    T scale_by_a = -1 / by_scale;
    for (std::size_t i = 5; i < 10; ++i) {
      j(0, i) = scale_by_a * moved[0];
      j(1, i) = scale_by_a * moved[1];
      scale_by_a *= rho;
    }
  }

  Parameters p_;
  T max_radius_;
};

}  // namespace v1
}  // namespace gslam

#endif  // GSLAM_GEOMETRY_CAMERA_OCAM_H
