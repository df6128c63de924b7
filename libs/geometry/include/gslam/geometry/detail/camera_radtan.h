// Radial, tangential and thin-prism distortion of a plane, and its inverse.
#ifndef GSLAM_GEOMETRY_DETAIL_CAMERA_RADTAN_H
#define GSLAM_GEOMETRY_DETAIL_CAMERA_RADTAN_H

#include <gslam/geometry/detail/camera_math.h>
#include <gslam/geometry/detail/camera_polynomial.h>
#include <gslam/geometry/detail/camera_tilt.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>

namespace gslam {
inline namespace v1 {
namespace detail {

// With s = x^2 + y^2 and g(s) = (1 + k1 s + k2 s^2 + k3 s^3) / (1 + k4 s + k5 s^2 + k6 s^3):
//
//     x' = x g + 2 p1 x y + p2 (s + 2 x^2) + s1 s + s2 s^2
//     y' = y g + p1 (s + 2 y^2) + 2 p2 x y + s3 s + s4 s^2
//
// and, with 14 coefficients, the tilt of the sensor. It is defined on a disc (limit()) on which it
// is one-to-one for certain: the radial part has the symmetric Jacobian with eigenvalues
// d(r g)/dr and g, the tangential part a symmetric one of norm at most 6 |p| r, and the thin prism
// adds at most 2 |(s1, s3)| r + 4 |(s2, s4)| r^3. Where the sum is surely positive definite on a
// convex set, two points cannot share their image.
//
// @tparam N  number of coefficients, in OpenCV's order: k1 k2 p1 p2 k3 k4 k5 k6 s1 s2 s3 s4 tx ty
template <class T, std::size_t N>
class RadtanDistortion {
  static_assert(N == 4 || N == 5 || N == 8 || N == 12 || N == 14,
                "radial-tangential distortion has 4, 5, 8, 12 or 14 coefficients");

 public:
  static const char* parameterName(std::size_t i) noexcept {
    static const char* const names[] = {"k1", "k2", "p1", "p2", "k3", "k4",   "k5",
                                        "k6", "s1", "s2", "s3", "s4", "taux", "tauy"};
    return names[i];
  }

  explicit RadtanDistortion(const T* coefficients)
      : c_(copyChecked(coefficients)), limit_(findLimit()), tilt_(coefficients) {
    squared_limit_ = limit_ * limit_;
  }

  T parameter(std::size_t i) const noexcept { return c_[i]; }
  // Points with x^2 + y^2 < limit^2 are taken.
  T limit() const noexcept { return limit_; }

  // @param by_point       result unless null
  // @param by_parameters  result unless null: N columns
  bool distort(const Vec<T, 2>& point, Vec<T, 2>& image, Mat<T, 2, 2>* by_point,
               Mat<T, 2, N>* by_parameters) const noexcept {
    if (!distortFlat(point, image, by_point, by_parameters)) return false;
    return tilt_.apply(image, by_point, by_parameters);
  }

  // Newton's method, with steps that are halved until they bring the image nearer.
  // @return whether the image of the result is `image` within rounding
  bool undistort(const Vec<T, 2>& image, Vec<T, 2>& point) const noexcept {
    Vec<T, 2> target{};
    State s;
    if (!tilt_.invert(image, target) || !start(target, s)) return false;
    const T unit = 1 + target.norm();
    const T accepted = 32 * epsilon() * unit;
    const T near = std::sqrt(epsilon()) / 8 * unit;  // one more step leaves rounding only
    for (int i = 0; i < 100; ++i) {
      const Mat<T, 2, 2>& j = s.slope;
      const T inverse = 1 / (j(0, 0) * j(1, 1) - j(0, 1) * j(1, 0));
      const Vec<T, 2> step = {{(j(1, 1) * s.miss[0] - j(0, 1) * s.miss[1]) * inverse,
                               (j(0, 0) * s.miss[1] - j(1, 0) * s.miss[0]) * inverse}};
      if (!isFinite(step)) return false;
      if (s.miss.squaredNorm() <= near * near && isAt(target, s.point - step, accepted)) {
        point = s.point - step;
        return true;
      }
      if (!improve(target, step, s)) {
        point = s.point;
        return s.miss.squaredNorm() <= accepted * accepted;
      }
    }
    return false;
  }

 private:
  static constexpr T epsilon() noexcept { return std::numeric_limits<T>::epsilon(); }
  static constexpr bool isRational() noexcept { return N >= 8; }
  static constexpr bool hasPrism() noexcept { return N >= 12; }

  static Vec<T, N> copyChecked(const T* coefficients) {
    Vec<T, N> result;
    for (std::size_t i = 0; i < N; ++i) {
      checkFinite(parameterName(i), coefficients[i]);
      result[i] = coefficients[i];
    }
    return result;
  }

  // Coefficient i, or 0 where the model has no such one.
  T at(std::size_t i) const noexcept { return i < N ? c_[i < N ? i : 0] : T(0); }

  struct State {
    Vec<T, 2> point{};
    Vec<T, 2> miss{};  // from the target to its image
    Mat<T, 2, 2> slope;
  };

  // @return false where the point is outside of the disc
  bool look(const Vec<T, 2>& target, const Vec<T, 2>& point, State& s) const noexcept {
    Vec<T, 2> reached{};
    if (!distortFlat(point, reached, &s.slope, nullptr)) return false;
    s.point = point;
    s.miss = reached - target;
    return true;
  }

  // The target itself, or a point on the way to it: from far outside, a polynomial of degree 7
  // falls too slowly under Newton's steps.
  bool start(const Vec<T, 2>& target, State& s) const noexcept {
    const T r = target.norm();
    Vec<T, 2> p = r < limit_ ? target : target * (T(0.9) * limit_ / r);
    for (int i = 0; i < 60; ++i) {
      if (!look(target, p, s)) return false;
      if (s.miss.squaredNorm() <= 9 * r * r) return true;
      p *= T(0.5);
    }
    return false;
  }

  bool isAt(const Vec<T, 2>& target, const Vec<T, 2>& point, T accepted) const noexcept {
    Vec<T, 2> reached{};
    return distortFlat(point, reached, nullptr, nullptr) &&
           (reached - target).squaredNorm() <= accepted * accepted;
  }

  // Moves by `step` or by the largest half, quarter ... of it that lowers the miss.
  bool improve(const Vec<T, 2>& target, const Vec<T, 2>& step, State& s) const noexcept {
    T factor = 1;
    for (int halvings = 0; halvings < 17; ++halvings, factor /= 2) {
      State candidate;
      if (!look(target, s.point - factor * step, candidate)) continue;
      if (!(candidate.miss.squaredNorm() < s.miss.squaredNorm())) continue;
      s = candidate;
      return true;
    }
    return false;
  }

  bool distortFlat(const Vec<T, 2>& point, Vec<T, 2>& image, Mat<T, 2, 2>* by_point,
                   Mat<T, 2, N>* by_parameters) const noexcept {
    const T x = point[0], y = point[1];
    const T xx = x * x, yy = y * y, xy = x * y, s = xx + yy;
    if (!(s < squared_limit_)) return false;
    const T k1 = c_[0], k2 = c_[1], p1 = c_[2], p2 = c_[3], k3 = at(4);
    const T numerator = 1 + s * (k1 + s * (k2 + s * k3));
    const T inverse = isRational() ? 1 / (1 + s * (at(5) + s * (at(6) + s * at(7)))) : T(1);
    const T g = numerator * inverse;
    image = {{x * g + 2 * p1 * xy + p2 * (s + 2 * xx), y * g + p1 * (s + 2 * yy) + 2 * p2 * xy}};
    if (hasPrism()) image += Vec<T, 2>{{s * (at(8) + s * at(9)), s * (at(10) + s * at(11))}};
    if (by_point != nullptr) {
      T g_by_s = (k1 + s * (2 * k2 + s * 3 * k3)) * inverse;
      if (isRational()) g_by_s -= g * inverse * (at(5) + s * (2 * at(6) + s * 3 * at(7)));
      const T mixed = 2 * (xy * g_by_s + p1 * x + p2 * y);
      *by_point = {{g + 2 * xx * g_by_s + 2 * p1 * y + 6 * p2 * x, mixed,  //
                    mixed, g + 2 * yy * g_by_s + 6 * p1 * y + 2 * p2 * x}};
      if (hasPrism()) addPrismSlope(x, y, s, *by_point);
    }
    if (by_parameters != nullptr) {
      const T powers[] = {s, s * s, s * s * s};
      setParameterJacobian(point, powers, g, inverse, *by_parameters);
    }
    return true;
  }

  void addPrismSlope(T x, T y, T s, Mat<T, 2, 2>& j) const noexcept {
    const T along_x = 2 * at(8) + 4 * at(9) * s;
    const T along_y = 2 * at(10) + 4 * at(11) * s;
    j(0, 0) += along_x * x;
    j(0, 1) += along_x * y;
    j(1, 0) += along_y * x;
    j(1, 1) += along_y * y;
  }

  static void setParameterJacobian(const Vec<T, 2>& point, const T (&powers)[3], T g, T inverse,
                                   Mat<T, 2, N>& j) noexcept {
    j = Mat<T, 2, N>{};
    const T s = powers[0];
    for (std::size_t row = 0; row < 2; ++row) {
      const T here = point[row];
      T* const d = j.data() + row * N;
      d[0] = here * powers[0] * inverse;
      d[1] = here * powers[1] * inverse;
      d[2 + row] = 2 * point[0] * point[1];
      d[3 - row] = s + 2 * here * here;
      for (std::size_t i = 4; i < N; ++i) {
        if (i == 4) d[i] = here * powers[2] * inverse;
        if (i >= 5 && i < 8) d[i] = -here * powers[i - 5] * g * inverse;
        if (i >= 8 && i < 12 && (i - 8) / 2 == row) d[i] = powers[i % 2];
      }
    }
  }

  // See the head of the class: the first radius at which positive definiteness is not sure.
  T findLimit() const noexcept {
    const CameraPolynomial n = {{{1, wide(0), wide(1), wide(4)}}};
    const CameraPolynomial d = {{{1, wide(5), wide(6), wide(7)}}};
    const CameraPolynomial twice_s = {{{0, 2}}};
    // of s: what d(r g)/dr and g are multiplied by d^2
    const CameraPolynomial slope =
        subtract(n * d, twice_s * subtract(n * d.derivative(), n.derivative() * d, 1), 1);
    const CameraPolynomial others = {
        {{0, 6 * std::hypot(wide(2), wide(3)) + 2 * std::hypot(wide(8), wide(10)), 0,
          4 * std::hypot(wide(9), wide(11))}}};
    const CameraPolynomial lost = others * (d * d).ofSquare();
    double limit = firstPositiveRoot(d.ofSquare());
    limit = std::min(limit, firstPositiveRoot(subtract(slope.ofSquare(), lost, 1)));
    limit = std::min(limit, firstPositiveRoot(subtract((n * d).ofSquare(), lost, 1)));
    return static_cast<T>(limit);
  }
  double wide(std::size_t i) const noexcept { return static_cast<double>(at(i)); }

  Vec<T, N> c_;
  T limit_;
  T squared_limit_;
  SensorTilt<T, N> tilt_;
};

}  // namespace detail
}  // namespace v1
}  // namespace gslam

#endif  // GSLAM_GEOMETRY_DETAIL_CAMERA_RADTAN_H
