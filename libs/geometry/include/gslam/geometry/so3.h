#ifndef GSLAM_GEOMETRY_SO3_H
#define GSLAM_GEOMETRY_SO3_H

#include <gslam/base/error.h>
#include <gslam/geometry/detail/rotation_vector.h>
#include <gslam/geometry/mat.h>
#include <gslam/geometry/vec.h>

#include <cmath>
#include <cstddef>
#include <limits>
#include <ostream>
#include <sstream>
#include <string>
#include <type_traits>

/// @file
/// Rotations of space.

namespace gslam {
inline namespace v1 {

/// A rotation of three-dimensional space; `R_world_body` takes body to world coordinates.
///
/// Invariant: inside is a unit quaternion q, | |q| - 1 | <= 4 epsilon of T. Every function that
/// makes an SO3 keeps it, products of any length too; there is no way to set q past the check. q
/// and -q are the same rotation, and which of the two is stored is kept but means nothing.
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
/// Source of the notation: J. Sola, J. Deray, D. Atchuthan, "A micro Lie theory for state
/// estimation in robotics", arXiv:1812.01537.
template <class T>
class SO3 {
  static_assert(std::is_same<T, float>::value || std::is_same<T, double>::value,
                "SO3 is made for float and double");

 public:
  using Scalar = T;             ///< float or double
  using Tangent = Vec<T, 3>;    ///< rotation vector, radians
  using Point = Vec<T, 3>;      ///< what a rotation acts on, any unit
  using Matrix = Mat<T, 3, 3>;  ///< rotation matrix

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
      if (!std::isfinite(q[i])) {
        throw ArgumentError("quaternion (" + text(q) + ")", "has an element that is not finite");
      }
    }
    if (!(q.norm() > epsilon())) {
      throw ArgumentError("quaternion (" + text(q) + ")",
                          "has a norm near zero, expected one that can be normalised to 1");
    }
    const bool is_unit = std::fabs(q.squaredNorm() - 1) <= 4 * epsilon();
    return SO3(is_unit ? q : q.normalized());
  }

  /// The rotation of a rotation matrix, or one within about `tolerance` (radians) of a matrix that
  /// is nearly one.
  ///
  /// Of the four ways to get a quaternion from the elements, each divides by one of its components;
  /// the one that divides by the largest is taken, so nothing cancels at any angle (S. W. Shepperd,
  /// "Quaternion from rotation matrix", J. Guidance and Control 1(3), 1978).
  /// @param m          rotation matrix
  /// @param tolerance  largest allowed element of |m m^T - I|
  /// @throws ArgumentError when an element is not finite, when m is not orthonormal (it says which
  ///   row is not of length 1, or which two are not at right angles), or when m is a reflection
  static SO3 fromMatrix(const Matrix& m, T tolerance = matrixTolerance()) {
    checkRotation(m, tolerance);
    const T trace = m(0, 0) + m(1, 1) + m(2, 2);
    std::size_t i = 0;
    if (m(1, 1) > m(0, 0)) i = 1;
    if (m(2, 2) > m(i, i)) i = 2;
    if (trace > m(i, i)) {  // w is the largest component; all four times 4 w
      return SO3(Vec<T, 4>{{m(2, 1) - m(1, 2), m(0, 2) - m(2, 0), m(1, 0) - m(0, 1), 1 + trace}}
                     .normalized());
    }
    const std::size_t j = (i + 1) % 3;
    const std::size_t k = (i + 2) % 3;
    Vec<T, 4> q;  // component i is the largest; all four times 4 q[i]
    q[i] = 1 + m(i, i) - m(j, j) - m(k, k);
    q[j] = m(j, i) + m(i, j);
    q[k] = m(k, i) + m(i, k);
    q[3] = m(k, j) - m(j, k);
    return SO3(q.normalized());
  }

  /// The rotation by |omega| radians about the axis omega. Every angle is right, also beyond pi (to
  /// 0.01 / epsilon of T: where T's numbers are that far apart, an angle means nothing any more).
  /// @throws ArgumentError when an element is not finite
  static SO3 exp(const Tangent& omega) { return SO3(detail::quaternionOfVector(omega)); }

  /// The shortest rotation vector, in radians, norm 0 to pi. A half turn has two; the one along the
  /// stored (x, y, z) is given. Never fails.
  Tangent log() const noexcept { return detail::vectorOfQuaternion(q_); }

  /// The angle of the rotation, 0 to pi radians.
  T angle() const noexcept {
    return 2 * std::atan2((Vec<T, 3>{{x(), y(), z()}}.norm()), std::fabs(w()));
  }

  /// The rotation back: R_b_a of R_a_b. Exact.
  SO3 inverse() const noexcept { return SO3(Vec<T, 4>{{-x(), -y(), -z(), w()}}); }

  /// First `other`, then this one.
  SO3 operator*(const SO3& other) const noexcept {
    const T* const a = q_.values;
    const T* const b = other.q_.values;
    const T px = a[3] * b[0] + a[0] * b[3] + a[1] * b[2] - a[2] * b[1];
    const T py = a[3] * b[1] - a[0] * b[2] + a[1] * b[3] + a[2] * b[0];
    const T pz = a[3] * b[2] + a[0] * b[1] - a[1] * b[0] + a[2] * b[3];
    const T pw = a[3] * b[3] - a[0] * b[0] - a[1] * b[1] - a[2] * b[2];
    // Roundings of the norm add up over products, and double when a rotation is squared. One Newton
    // step for 1 / sqrt(s) at s = 1 removes them: 1 + d becomes 1 - 3/2 d^2.
    const T scale = T(1.5) - T(0.5) * (px * px + py * py + pz * pz + pw * pw);
    return SO3(Vec<T, 4>{{scale * px, scale * py, scale * pz, scale * pw}});
  }

  /// The rotated point or direction: v + 2 w (u x v) + 2 u x (u x v) with u = (x, y, z).
  Point operator*(const Point& v) const noexcept {
    const Vec<T, 3> u = {{x(), y(), z()}};
    const Vec<T, 3> t = T(2) * u.cross(v);
    return v + w() * t + u.cross(t);
  }

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

  /// The skew-symmetric matrix of a vector: `hat(a) * b` is `a.cross(b)`.
  static Matrix hat(const Tangent& a) noexcept {
    return {{T(0), -a[2], a[1], a[2], T(0), -a[0], -a[1], a[0], T(0)}};
  }

  /// The vector of a skew-symmetric matrix, the inverse of hat(). Of another matrix, the vector of
  /// its skew-symmetric part (m - m^T) / 2.
  static Tangent vee(const Matrix& m) noexcept {
    return T(0.5) * Tangent{{m(2, 1) - m(1, 2), m(0, 2) - m(2, 0), m(1, 0) - m(0, 1)}};
  }

  /// Whether the angle between the two rotations is at most `tolerance` radians. Rounding alone
  /// makes angles of a few epsilon of T.
  bool isApprox(const SO3& other, T tolerance) const noexcept {
    return (inverse() * other).angle() <= tolerance;
  }

  /// The quaternion, `x y z w`, with the precision of the stream.
  friend std::ostream& operator<<(std::ostream& out, const SO3& r) { return out << r.q_; }

 private:
  explicit SO3(const Vec<T, 4>& unit_quaternion) noexcept : q_(unit_quaternion) {}

  static constexpr T epsilon() noexcept { return std::numeric_limits<T>::epsilon(); }

  template <class Printable>
  static std::string text(const Printable& value) {
    std::ostringstream out;
    out.precision(std::numeric_limits<T>::digits10);
    out << value;
    return out.str();
  }

  static void checkRotation(const Matrix& m, T tolerance) {
    for (std::size_t i = 0; i < 9; ++i) {
      if (std::isfinite(m.values[i])) continue;
      fail("has the element " + text(m.values[i]) + " in row " + text(i / 3) + ", column " +
           text(i % 3) + ", expected finite elements");
    }
    Vec<T, 3> rows[3];
    for (std::size_t i = 0; i < 9; ++i) rows[i / 3][i % 3] = m.values[i];
    for (std::size_t i = 0; i < 3; ++i) checkRow(rows, i, tolerance);
    const T determinant = rows[0].dot(rows[1].cross(rows[2]));
    if (!(determinant > 0)) {
      fail("is a reflection, its determinant is " + text(determinant) + ", expected 1");
    }
  }

  static void checkRow(const Vec<T, 3> (&rows)[3], std::size_t i, T tolerance) {
    const std::string allowed = " within " + text(tolerance);
    const T squared = rows[i].squaredNorm();
    if (!(std::fabs(squared - 1) <= tolerance)) {
      fail("is not orthonormal, row " + text(i) + " has the squared length " + text(squared) +
           ", expected 1" + allowed);
    }
    for (std::size_t j = 0; j < i; ++j) {
      const T product = rows[i].dot(rows[j]);
      if (std::fabs(product) <= tolerance) continue;
      fail("is not orthonormal, rows " + text(j) + " and " + text(i) + " have the dot product " +
           text(product) + ", expected 0" + allowed);
    }
  }

  [[noreturn]] static void fail(const std::string& problem) {
    throw ArgumentError("matrix", problem);
  }

  Vec<T, 4> q_;  // x y z w
};

using SO3d = SO3<double>;  ///< double
using SO3f = SO3<float>;   ///< float

}  // namespace v1
}  // namespace gslam

#endif  // GSLAM_GEOMETRY_SO3_H
