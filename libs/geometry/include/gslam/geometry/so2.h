#ifndef GSLAM_GEOMETRY_SO2_H
#define GSLAM_GEOMETRY_SO2_H

#include <gslam/base/error.h>
#include <gslam/geometry/detail/rotation_matrix.h>
#include <gslam/geometry/mat.h>
#include <gslam/geometry/vec.h>

#include <cmath>
#include <cstddef>
#include <iosfwd>
#include <limits>
#include <type_traits>

/// @file
/// Rotations of the plane.

namespace gslam {
inline namespace v1 {

/// A rotation of the plane, from the x axis towards the y axis; `R_world_body` takes body to world
/// coordinates. The interface is that of SO3.
///
/// Invariant: inside is a unit complex number z. Every function that makes an SO2 keeps | |z| - 1 |
/// below 4 epsilon of T, but a product, whose norm is the product of the norms. normalized() mends
/// that.
///
/// Conventions: stored and printed as cosine and sine of the angle. Tangents are the angle, in
/// radians. `R_a_b * R_b_c` is `R_a_c`.
///
/// Exactness: exp and log are accurate at every angle, with no special angle in between: the error
/// is below 4e-15 of the result's norm for double and 2e-6 for float (18 epsilon).
///
/// Layout: two T, cosine and sine, trivially copyable, aligned as T. T is float or double.
/// Thread-safety: as a number; it may be read by many threads, or written by one.
template <class T>
class SO2 {
  static_assert(std::is_same<T, float>::value || std::is_same<T, double>::value,
                "SO2 is made for float and double");

 public:
  using Scalar = T;                           ///< float or double
  static constexpr std::size_t kFreedom = 1;  ///< degrees of freedom
  using Tangent = Vec<T, 1>;                  ///< the angle, radians
  using Point = Vec<T, 2>;                    ///< what a rotation acts on, any unit
  using Matrix = Mat<T, 2, 2>;                ///< rotation matrix
  using Jacobian = Mat<T, 1, 1>;              ///< tangents to tangents

  /// The identity.
  SO2() noexcept : z_{{T(1), T(0)}} {}

  /// The identity.
  static SO2 identity() noexcept { return SO2(); }

  /// The rotation by an angle in radians. Every angle is right, also beyond pi.
  /// @throws ArgumentError when it is not finite
  static SO2 fromAngle(T angle) {
    if (!std::isfinite(angle)) {
      throw ArgumentError("angle", "is " + detail::numberText(angle) + ", expected a finite one");
    }
    return SO2(Vec<T, 2>{{std::cos(angle), std::sin(angle)}});
  }

  /// The rotation of a complex number cosine + i sine, which need not have norm 1. One that has it
  /// to the last bits is stored as it is: what was written with all digits is read back the same.
  /// @throws ArgumentError when an element is not finite or the norm is epsilon of T or less
  static SO2 fromComplex(T cosine, T sine) {
    const Vec<T, 2> z = {{cosine, sine}};
    if (!std::isfinite(cosine) || !std::isfinite(sine)) refuse(z, "has one that is not finite");
    if (!(z.norm() > epsilon())) {
      refuse(z, "have a norm near zero, expected one that can be normalised to 1");
    }
    const bool is_unit = std::fabs(z.squaredNorm() - 1) <= 4 * epsilon();
    return SO2(is_unit ? z : z.normalized());
  }

  /// The rotation of a rotation matrix, or the nearest one of a matrix that is nearly one.
  /// @param m          rotation matrix
  /// @param tolerance  largest allowed element of |m m^T - I|
  /// @throws ArgumentError when an element is not finite, when m is not orthonormal (it says which
  ///   row is not of length 1, or that the two are not at right angles), or when m is a reflection
  static SO2 fromMatrix(const Matrix& m, T tolerance = T(1e-5)) {
    detail::checkFinite(m);
    detail::checkRotation(
        Mat<T, 3, 3>{{m(0, 0), m(0, 1), T(0), m(1, 0), m(1, 1), T(0), T(0), T(0), T(1)}},
        tolerance);
    return SO2(Vec<T, 2>{{m(0, 0) + m(1, 1), m(1, 0) - m(0, 1)}}.normalized());
  }

  /// The rotation by an angle, which is the only element.
  /// @throws ArgumentError when it is not finite
  static SO2 exp(const Tangent& angle) { return fromAngle(angle[0]); }

  /// The angle, from -pi to pi radians. Never fails.
  Tangent log() const noexcept { return {{angle()}}; }

  /// The angle, from -pi to pi radians. (That of SO3 has no sign.)
  T angle() const noexcept { return std::atan2(sine(), cosine()); }

  /// The rotation back: R_b_a of R_a_b. Exact.
  SO2 inverse() const noexcept { return SO2(Vec<T, 2>{{cosine(), -sine()}}); }

  /// First `other`, then this one.
  SO2 operator*(const SO2& other) const noexcept { return SO2(*this * other.z_); }
  /// This one is followed by `other` on the right: `a = a * other`.
  SO2& operator*=(const SO2& other) noexcept { return *this = *this * other; }

  /// The rotated point or direction.
  Point operator*(const Point& p) const noexcept {
    return {{cosine() * p[0] - sine() * p[1], sine() * p[0] + cosine() * p[1]}};
  }

  /// The same rotation with the norm mended, for the end of long products.
  SO2 normalized() const noexcept { return SO2(z_ / z_.norm()); }

  /// The rotation matrix; `r.matrix() * p` is `r * p`.
  Matrix matrix() const noexcept { return {{cosine(), -sine(), sine(), cosine()}}; }

  /// Cosine of the angle.
  T cosine() const noexcept { return z_[0]; }
  /// Sine of the angle.
  T sine() const noexcept { return z_[1]; }
  /// Two elements, cosine and sine.
  const T* data() const noexcept { return z_.data(); }
  /// The same rotation with numbers of another type.
  template <class U>
  SO2<U> cast() const {
    return SO2<U>::fromComplex(static_cast<U>(cosine()), static_cast<U>(sine()));
  }

  /// The skew-symmetric matrix [0 -a; a 0] of an angle.
  static Matrix hat(const Tangent& a) noexcept { return {{T(0), -a[0], a[0], T(0)}}; }
  /// The angle of a skew-symmetric matrix, the inverse of hat(). Of another matrix, that of its
  /// skew-symmetric part.
  static Tangent vee(const Matrix& m) noexcept { return {{T(0.5) * (m(1, 0) - m(0, 1))}}; }

  /// Ad, with R exp(d) R^-1 = exp(Ad d): 1, because rotations of the plane commute.
  Jacobian adjoint() const noexcept { return {{T(1)}}; }
  /// ad, the derivative of Ad at the identity: 0.
  static Jacobian ad(const Tangent&) noexcept { return {{T(0)}}; }
  /// J with exp(a + d) = exp(J d) exp(a): 1.
  static Jacobian leftJacobian(const Tangent&) noexcept { return {{T(1)}}; }
  /// The inverse of leftJacobian(): 1.
  static Jacobian leftJacobianInverse(const Tangent&) noexcept { return {{T(1)}}; }
  /// J with exp(a + d) = exp(a) exp(J d): 1.
  static Jacobian rightJacobian(const Tangent&) noexcept { return {{T(1)}}; }
  /// The inverse of rightJacobian(): 1.
  static Jacobian rightJacobianInverse(const Tangent&) noexcept { return {{T(1)}}; }

  /// Derivative of (R exp(d)) p with respect to d at 0: R p, a quarter turn on. That to p is
  /// matrix().
  Mat<T, 2, 1> actionJacobian(const Point& p) const noexcept {
    const Point turned = *this * p;
    return {{-turned[1], turned[0]}};
  }

  /// Whether the angle between the two rotations is at most `tolerance` radians.
  bool isApprox(const SO2& other, T tolerance) const noexcept {
    return std::fabs((inverse() * other).angle()) <= tolerance;
  }

  /// `cosine sine`, with the precision of the stream.
  template <class Char, class Traits>
  friend std::basic_ostream<Char, Traits>& operator<<(std::basic_ostream<Char, Traits>& out,
                                                      const SO2& r) {
    return out << r.z_;
  }

 private:
  explicit SO2(const Vec<T, 2>& unit) noexcept : z_(unit) {}
  template <class>
  friend class SE2;

  static constexpr T epsilon() noexcept { return std::numeric_limits<T>::epsilon(); }

  [[noreturn]] static void refuse(const Vec<T, 2>& z, const char* problem) {
    throw ArgumentError("cosine and sine " + detail::vectorText(z), problem);
  }

  Vec<T, 2> z_;  // cosine, sine
};

template <class T>
constexpr std::size_t SO2<T>::kFreedom;  // NOLINT(readability-redundant-declaration): before C++17

using SO2d = SO2<double>;  ///< double
using SO2f = SO2<float>;   ///< float

}  // namespace v1
}  // namespace gslam

#endif  // GSLAM_GEOMETRY_SO2_H
