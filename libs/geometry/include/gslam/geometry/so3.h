#ifndef GSLAM_GEOMETRY_SO3_H
#define GSLAM_GEOMETRY_SO3_H

#include <gslam/base/error.h>
#include <gslam/base/platform.h>
#include <gslam/geometry/detail/rotate.h>
#include <gslam/geometry/detail/rotation_matrix.h>
#include <gslam/geometry/detail/rotation_vector.h>
#include <gslam/geometry/mat.h>
#include <gslam/geometry/vec.h>

#include <cmath>
#include <cstddef>
#include <iosfwd>
#include <limits>
#include <type_traits>

/// @file
/// Rotations of space.

namespace gslam {
inline namespace v1 {

/// A rotation of three-dimensional space; `R_world_body` takes body to world coordinates.
///
/// Invariant: inside is a unit quaternion q. Every function that makes an SO3 keeps | |q| - 1 |
/// below 4 epsilon of T, but a product, whose norm is the product of the norms: after n factors it
/// is within 4 n epsilon, after a million 1e-9. normalized() mends that; there is no way to set q
/// past the checks. q and -q are the same rotation, and which of the two is stored is kept but
/// means nothing.
///
/// Conventions: Hamilton quaternions, stored, given and printed x y z w; v' = q v q*. Tangents are
/// rotation vectors, axis times angle, in radians. Perturbations are on the right:
/// `R * SO3::exp(delta)`. `R_a_b * R_b_c` is `R_a_c`.
///
/// Exactness: exp and log are accurate at every angle, with no special angle in between: the error
/// is below 4e-15 of the result's norm for double and 2e-6 for float (18 epsilon).
///
/// Layout: four T, x y z w, trivially copyable, aligned as T. T is float or double.
/// Thread-safety: as a number; it may be read by many threads, or written by one.
///
/// Source of the notation and of the Jacobians: J. Sola, J. Deray, D. Atchuthan, "A micro Lie
/// theory for state estimation in robotics", arXiv:1812.01537, whose equations are cited as (Sola
/// n).
template <class T>
class SO3 {
  static_assert(std::is_same<T, float>::value || std::is_same<T, double>::value,
                "SO3 is made for float and double");

 public:
  using Scalar = T;                           ///< float or double
  static constexpr std::size_t kFreedom = 3;  ///< degrees of freedom
  using Tangent = Vec<T, 3>;                  ///< rotation vector, radians
  using Point = Vec<T, 3>;                    ///< what a rotation acts on, any unit
  using Matrix = Mat<T, 3, 3>;                ///< rotation matrix
  using Jacobian = Mat<T, 3, 3>;              ///< tangents to tangents

  /// How far a matrix may be from orthonormal: enough for files with six digits.
  static constexpr T matrixTolerance() noexcept { return T(1e-5); }

  /// The identity.
  SO3() noexcept : q_{{T(0), T(0), T(0), T(1)}} {}

  /// The identity.
  static SO3 identity() noexcept { return SO3(); }

  /// The rotation of a quaternion, Hamilton, given x y z w, which need not have norm 1. One that
  /// has it to the last bits is stored as it is: what was written with all digits is read back the
  /// same.
  /// @throws ArgumentError when an element is not finite or the norm is epsilon of T or less
  static SO3 fromQuaternion(T x, T y, T z, T w) {
    const Vec<T, 4> q = {{x, y, z, w}};
    for (std::size_t i = 0; i < 4; ++i) {
      if (!std::isfinite(q[i])) refuse(q, "has an element that is not finite");
    }
    if (!(q.norm() > epsilon())) {
      refuse(q, "has a norm near zero, expected one that can be normalised to 1");
    }
    const bool is_unit = std::fabs(q.squaredNorm() - 1) <= 4 * epsilon();
    return SO3(is_unit ? q : q.normalized());
  }

  /// The rotation of a rotation matrix, or one within about `tolerance` (radians) of a matrix that
  /// is nearly one.
  /// @param m          rotation matrix
  /// @param tolerance  largest allowed element of |m m^T - I|
  /// @throws ArgumentError when an element is not finite, when m is not orthonormal (it says which
  ///   row is not of length 1, or which two are not at right angles), or when m is a reflection
  static SO3 fromMatrix(const Matrix& m, T tolerance = matrixTolerance()) {
    detail::checkRotation(m, tolerance);
    return SO3(detail::quaternionOfMatrix(m));
  }

  /// The rotation by |omega| radians about the axis omega. Every angle is right, also beyond pi (to
  /// 0.01 / epsilon of T: where T's numbers are that far apart, an angle means nothing any more).
  /// @throws ArgumentError when an element is not finite
  static GSLAM_ALWAYS_INLINE SO3 exp(const Tangent& omega) {
    return SO3(detail::quaternionOfVector(omega));
  }

  /// The shortest rotation vector, in radians, norm 0 to pi. A half turn has two; one of them is
  /// given. Never fails.
  GSLAM_ALWAYS_INLINE Tangent log() const noexcept { return detail::vectorOfQuaternion(q_); }

  /// The angle of the rotation, 0 to pi radians.
  T angle() const noexcept {
    return 2 * std::atan2((Vec<T, 3>{{x(), y(), z()}}.norm()), std::fabs(w()));
  }

  /// The rotation back: R_b_a of R_a_b. Exact.
  GSLAM_ALWAYS_INLINE SO3 inverse() const noexcept {
    return SO3(-detail::Pair<T>::load(data()), -detail::Pair<T>::load(data() + 2).conjugate());
  }

  /// First `other`, then this one.
  GSLAM_ALWAYS_INLINE SO3 operator*(const SO3& other) const noexcept {
    using detail::Pair;
    const Pair<T> b_xy = Pair<T>::load(other.data());
    const Pair<T> b_zw = Pair<T>::load(other.data() + 2);
    const Pair<T> ax = Pair<T>::both(x()), ay = Pair<T>::both(y()), az = Pair<T>::both(z());
    const Pair<T> aw = Pair<T>::both(w());
    const Pair<T> crossed = ax * b_zw.swapped() - az * b_xy.swapped();
    const Pair<T> opposed = ax * b_xy.swapped() + az * b_zw.swapped();
    return SO3((aw * b_xy + ay * b_zw) + crossed.conjugate(),
               (aw * b_zw - ay * b_xy) + opposed.conjugate());
  }
  /// This one is followed by `other` on the right: `a = a * other`.
  SO3& operator*=(const SO3& other) noexcept { return *this = *this * other; }

  /// The rotated point or direction.
  GSLAM_ALWAYS_INLINE Point operator*(const Point& v) const noexcept {
    return detail::rotated(data(), v);
  }

  /// The same rotation with the norm of the quaternion mended, for the end of long products.
  SO3 normalized() const noexcept { return SO3(q_ / q_.norm()); }

  /// The rotation matrix; `r.matrix() * v` is `r * v` up to rounding.
  Matrix matrix() const noexcept {
    const T x2 = 2 * x();
    const T y2 = 2 * y();
    const T z2 = 2 * z();
    const T xx = x2 * x(), xy = x2 * y(), xz = x2 * z(), xw = x2 * w();
    const T yy = y2 * y(), yz = y2 * z(), yw = y2 * w();
    const T zz = z2 * z(), zw = z2 * w();
    return {{1 - (yy + zz), xy - zw, xz + yw,  //
             xy + zw, 1 - (xx + zz), yz - xw,  //
             xz - yw, yz + xw, 1 - (xx + yy)}};
  }

  /// x of the unit quaternion, sin(angle / 2) times the axis' x.
  T x() const noexcept { return q_[0]; }
  /// y of the unit quaternion, sin(angle / 2) times the axis' y.
  T y() const noexcept { return q_[1]; }
  /// z of the unit quaternion, sin(angle / 2) times the axis' z.
  T z() const noexcept { return q_[2]; }
  /// w of the unit quaternion, cos(angle / 2).
  T w() const noexcept { return q_[3]; }
  /// The unit quaternion, x y z w.
  const Vec<T, 4>& quaternion() const noexcept { return q_; }
  /// Four elements, x y z w.
  const T* data() const noexcept { return q_.data(); }
  /// The same rotation with numbers of another type.
  template <class U>
  SO3<U> cast() const {
    return SO3<U>::fromQuaternion(static_cast<U>(x()), static_cast<U>(y()), static_cast<U>(z()),
                                  static_cast<U>(w()));
  }

  /// The skew-symmetric matrix of a vector: `hat(a) * b` is `a.cross(b)`.
  static Matrix hat(const Tangent& a) noexcept {
    return {{T(0), -a[2], a[1], a[2], T(0), -a[0], -a[1], a[0], T(0)}};
  }

  /// The vector of a skew-symmetric matrix, the inverse of hat(). Of another matrix, the vector of
  /// its skew-symmetric part (m - m^T) / 2.
  static Tangent vee(const Matrix& m) noexcept {
    return T(0.5) * Tangent{{m(2, 1) - m(1, 2), m(0, 2) - m(2, 0), m(1, 0) - m(0, 1)}};
  }

  /// Ad, with R exp(d) R^-1 = exp(Ad d): the rotation matrix (Sola 139).
  Jacobian adjoint() const noexcept { return matrix(); }
  /// ad, the derivative of Ad at the identity: ad(a) b = [a, b], hat(a) for rotations.
  static Jacobian ad(const Tangent& a) noexcept { return hat(a); }

  /// J with exp(v + d) = exp(J d) exp(v) to first order (Sola 145). Exact at every angle.
  static Jacobian leftJacobian(const Tangent& v) noexcept {
    return leftJacobian(v, detail::Stumpff<T>::at(v.squaredNorm()));
  }
  /// The inverse of leftJacobian(v) (Sola 146). At whole turns, |v| = 2 pi, 4 pi, ..., there is
  /// none, and the elements grow without bound towards them.
  static Jacobian leftJacobianInverse(const Tangent& v) noexcept {
    return leftJacobianInverse(v, detail::Stumpff<T>::at(v.squaredNorm()));
  }
  /// J with exp(v + d) = exp(v) exp(J d) to first order (Sola 143).
  static Jacobian rightJacobian(const Tangent& v) noexcept { return leftJacobian(-v); }
  /// The inverse of rightJacobian(v) (Sola 144).
  static Jacobian rightJacobianInverse(const Tangent& v) noexcept {
    return leftJacobianInverse(-v);
  }

  /// Derivative of (R exp(d)) p with respect to d at 0 (Sola 150); that to p is matrix().
  Mat<T, 3, 3> actionJacobian(const Point& p) const noexcept { return matrix() * hat(-p); }

  /// Whether the angle between the two rotations is at most `tolerance` radians. Rounding alone
  /// makes angles of a few epsilon of T.
  bool isApprox(const SO3& other, T tolerance) const noexcept {
    return (inverse() * other).angle() <= tolerance;
  }

  /// The quaternion, `x y z w`, with the precision of the stream.
  template <class Char, class Traits>
  friend std::basic_ostream<Char, Traits>& operator<<(std::basic_ostream<Char, Traits>& out,
                                                      const SO3& r) {
    return out << r.q_;
  }

 private:
  explicit SO3(const Vec<T, 4>& unit_quaternion) noexcept : q_(unit_quaternion) {}
  SO3(detail::Pair<T> xy, detail::Pair<T> zw) noexcept {
    xy.store(q_.values);
    zw.store(q_.values + 2);
  }
  template <class>
  friend class SE3;
  template <class>
  friend class SIM3;

  static GSLAM_ALWAYS_INLINE Jacobian leftJacobian(const Tangent& v,
                                                   const detail::Stumpff<T>& c) noexcept {
    return mixed(1 - v.squaredNorm() * c.c3, c.c2, c.c3, v);
  }
  // I - hat(v) / 2 + d hat(v)^2, where d |v|^2 = 1 - |v| / 2 cot(|v| / 2) = 1 - c1 / (2 c2), with
  // the division by |v|^2 done on paper.
  static Jacobian leftJacobianInverse(const Tangent& v, const detail::Stumpff<T>& c) noexcept {
    const T d = (c.c3 - 2 * c.c4) / (2 * c.c2);
    return mixed(1 - v.squaredNorm() * d, T(-0.5), d, v);
  }

  static constexpr T epsilon() noexcept { return std::numeric_limits<T>::epsilon(); }

  // one I + skew hat(v) + square v v^T
  static GSLAM_ALWAYS_INLINE Matrix mixed(T one, T skew, T square, const Tangent& v) noexcept {
    const T x = v[0], y = v[1], z = v[2];
    const T sx = square * x, sy = square * y, sz = square * z;
    return {{one + sx * x, sx * y - skew * z, sx * z + skew * y,  //
             sx * y + skew * z, one + sy * y, sy * z - skew * x,  //
             sx * z - skew * y, sy * z + skew * x, one + sz * z}};
  }

  [[noreturn]] static void refuse(const Vec<T, 4>& q, const char* problem) {
    throw ArgumentError("quaternion " + detail::vectorText(q), problem);
  }

  Vec<T, 4> q_;  // x y z w
};

#if __cplusplus < 201703L  // from then on the declaration is a definition
template <class T>
constexpr std::size_t SO3<T>::kFreedom;
#endif

using SO3d = SO3<double>;  ///< double
using SO3f = SO3<float>;   ///< float

}  // namespace v1
}  // namespace gslam

#endif  // GSLAM_GEOMETRY_SO3_H
