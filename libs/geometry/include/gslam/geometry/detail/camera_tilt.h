// The sensor that is not at right angles to the axis: the last two of 14 distortion coefficients.
#ifndef GSLAM_GEOMETRY_DETAIL_CAMERA_TILT_H
#define GSLAM_GEOMETRY_DETAIL_CAMERA_TILT_H

#include <gslam/geometry/detail/camera_math.h>

#include <cmath>
#include <cstddef>

namespace gslam {
inline namespace v1 {
namespace detail {

// Models with fewer coefficients have no tilt.
template <class T, std::size_t N>
class SensorTilt {
 public:
  explicit SensorTilt(const T*) noexcept {}
  bool apply(Vec<T, 2>&, Mat<T, 2, 2>*, Mat<T, 2, N>*) const noexcept { return true; }
  bool invert(const Vec<T, 2>& image, Vec<T, 2>& point) const noexcept {
    point = image;
    return true;
  }
};

// With R = Ry(tauy) Rx(taux), the rotations of coordinates:
//
//     h = [R22 0 -R02; 0 R22 -R12; 0 0 1] R (x, y, 1)        (x', y') = (h0, h1) / h2
//
// T. Louhichi et al., "Self-calibration of Scheimpflug cameras: an easy protocol", Measurement
// Science and Technology 18, 2007, as in OpenCV.
template <class T>
class SensorTilt<T, 14> {
 public:
  explicit SensorTilt(const T* coefficients) : tau_{{coefficients[12], coefficients[13]}} {
    const T quarter = T(1.57079632679489661923);
    checkParameter(std::fabs(tau_[0]) < quarter, "taux", tau_[0], "an angle below pi / 2");
    checkParameter(std::fabs(tau_[1]) < quarter, "tauy", tau_[1], "an angle below pi / 2");
    const Angles a = angles();
    h_ = product(rotationY(a.cy, a.sy, T(1)) * rotationX(a.cx, a.sx, T(1)));
  }

  bool apply(Vec<T, 2>& image, Mat<T, 2, 2>* by_point,
             Mat<T, 2, 14>* by_parameters) const noexcept {
    const Vec<T, 3> flat = {{image[0], image[1], T(1)}};
    const Vec<T, 3> h = h_ * flat;
    if (!(h[2] > 0)) return false;
    image = {{h[0] / h[2], h[1] / h[2]}};
    if (by_point == nullptr && by_parameters == nullptr) return true;
    Mat<T, 2, 2> slope;
    for (std::size_t i = 0; i < 4; ++i) {
      slope.values[i] = (h_(i / 2, i % 2) - image[i / 2] * h_(2, i % 2)) / h[2];
    }
    if (by_point != nullptr) *by_point = slope * *by_point;
    if (by_parameters != nullptr) {
      *by_parameters = slope * *by_parameters;
      setTauColumns(flat, image, h[2], *by_parameters);
    }
    return true;
  }

  bool invert(const Vec<T, 2>& image, Vec<T, 2>& point) const noexcept {
    // h_ (x, y, 1) = lambda (image, 1): the adjugate of h_ times the image, lambda above 0.
    const Vec<T, 3> rows[] = {row(0), row(1), row(2)};
    const Vec<T, 3> v = image[0] * rows[1].cross(rows[2]) + image[1] * rows[2].cross(rows[0]) +
                        rows[0].cross(rows[1]);
    if (!(v[2] > 0)) return false;
    point = {{v[0] / v[2], v[1] / v[2]}};
    return isFinite(point);
  }

 private:
  struct Angles {
    T cx, sx, cy, sy;
  };
  Angles angles() const noexcept {
    return {std::cos(tau_[0]), std::sin(tau_[0]), std::cos(tau_[1]), std::sin(tau_[1])};
  }
  // one is 1, or 0 for the derivative by the angle.
  static Mat<T, 3, 3> rotationX(T c, T s, T one) noexcept {
    return {{one, T(0), T(0), T(0), c, s, T(0), -s, c}};
  }
  static Mat<T, 3, 3> rotationY(T c, T s, T one) noexcept {
    return {{c, T(0), -s, T(0), one, T(0), s, T(0), c}};
  }
  static Mat<T, 3, 3> shift(const Mat<T, 3, 3>& r, T one) noexcept {
    return {{r(2, 2), T(0), -r(0, 2), T(0), r(2, 2), -r(1, 2), T(0), T(0), one}};
  }
  static Mat<T, 3, 3> product(const Mat<T, 3, 3>& r) noexcept { return shift(r, T(1)) * r; }

  Vec<T, 3> row(std::size_t i) const noexcept { return {{h_(i, 0), h_(i, 1), h_(i, 2)}}; }

  void setTauColumns(const Vec<T, 3>& flat, const Vec<T, 2>& image, T h2,
                     Mat<T, 2, 14>& j) const noexcept {
    const Angles a = angles();
    const Mat<T, 3, 3> rx = rotationX(a.cx, a.sx, T(1)), ry = rotationY(a.cy, a.sy, T(1));
    const Mat<T, 3, 3> r = ry * rx;
    const Mat<T, 3, 3> slopes[] = {ry * rotationX(-a.sx, a.cx, T(0)),
                                   rotationY(-a.sy, a.cy, T(0)) * rx};
    for (std::size_t i = 0; i < 2; ++i) {
      const Vec<T, 3> d = shift(r, T(1)) * (slopes[i] * flat) + shift(slopes[i], T(0)) * (r * flat);
      for (std::size_t k = 0; k < 2; ++k) j(k, 12 + i) = (d[k] - image[k] * d[2]) / h2;
    }
  }

  Vec<T, 2> tau_;
  Mat<T, 3, 3> h_;
};

}  // namespace detail
}  // namespace v1
}  // namespace gslam

#endif  // GSLAM_GEOMETRY_DETAIL_CAMERA_TILT_H
