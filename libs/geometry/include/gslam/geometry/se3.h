#ifndef GSLAM_GEOMETRY_SE3_H
#define GSLAM_GEOMETRY_SE3_H

#include <gslam/base/error.h>
#include <gslam/base/platform.h>
#include <gslam/geometry/detail/rotation_matrix.h>
#include <gslam/geometry/detail/translation_part.h>
#include <gslam/geometry/mat.h>
#include <gslam/geometry/so3.h>
#include <gslam/geometry/vec.h>

#include <cmath>
#include <cstddef>
#include <iosfwd>

/// @file
/// Rigid transforms of space: poses.

namespace gslam {
inline namespace v1 {

/// A rotation and a translation of three-dimensional space, p' = R p + t; `T_world_body` takes body
/// to world coordinates, and is the pose of the body in the world.
///
/// Invariant: that of SO3 for the rotation. The translation is what it was given or became; what is
/// not finite passes through, as IEEE says.
///
/// Conventions: printed as in a line of a TUM trajectory, tx ty tz qx qy qz qw; in memory the
/// quaternion stands first (see Layout). Tangents are (translation, rotation), in the unit of the
/// translation and radians. Perturbations are on the right: `T * SE3::exp(delta)`. `T_a_b * T_b_c`
/// is `T_a_c`.
///
/// Exactness: exp and log are accurate at every angle, with no special angle in between: the error
/// is below 4e-15 of the result's norm for double (18 epsilon). Jacobians: 1e-13.
///
/// Layout: seven T, qx qy qz qw tx ty tz, trivially copyable, aligned as T. T is float or double.
/// Thread-safety: as a number; it may be read by many threads, or written by one.
///
/// Sources: J. Sola, J. Deray, D. Atchuthan, "A micro Lie theory for state estimation in robotics",
/// arXiv:1812.01537, cited as (Sola n); T. Barfoot, "State Estimation for Robotics", 2017.
template <class T>
class SE3 {
 public:
  using Scalar = T;                           ///< float or double
  static constexpr std::size_t kFreedom = 6;  ///< degrees of freedom
  using Tangent = Vec<T, 6>;                  ///< (translation, rotation vector)
  using Point = Vec<T, 3>;                    ///< what a transform acts on
  using Matrix = Mat<T, 4, 4>;                ///< homogeneous matrix
  using Jacobian = Mat<T, 6, 6>;              ///< tangents to tangents

  /// The identity.
  SE3() noexcept : translation_() {}
  /// p' = rotation p + translation.
  GSLAM_ALWAYS_INLINE SE3(const SO3<T>& rotation, const Vec<T, 3>& translation) noexcept
      : rotation_(rotation), translation_(translation) {}

  /// The identity.
  static SE3 identity() noexcept { return SE3(); }

  /// The transform of a homogeneous matrix [R t; 0 0 0 1].
  /// @param m          the matrix
  /// @param tolerance  largest allowed element of |R R^T - I|
  /// @throws ArgumentError as SO3::fromMatrix(), and when the last row is not 0 0 0 1
  static SE3 fromMatrix(const Matrix& m, T tolerance = SO3<T>::matrixTolerance()) {
    detail::checkFinite(m);
    if (m(3, 0) != 0 || m(3, 1) != 0 || m(3, 2) != 0 || m(3, 3) != 1) {
      detail::refuseMatrix("has the last row " + detail::vectorText(m.row(3)) +
                           ", expected 0 0 0 1");
    }
    return fromMatrix(m.template block<3, 4>(0, 0), tolerance);
  }
  /// The transform of a matrix [R t].
  /// @param m          the matrix
  /// @param tolerance  largest allowed element of |R R^T - I|
  /// @throws ArgumentError as SO3::fromMatrix()
  static SE3 fromMatrix(const Mat<T, 3, 4>& m, T tolerance = SO3<T>::matrixTolerance()) {
    detail::checkFinite(m);
    return SE3(SO3<T>::fromMatrix(m.template block<3, 3>(0, 0), tolerance), m.col(3));
  }

  /// The transform that goes along a screw for the unit of time: translation V r with
  /// V = I + c2 hat(v) + c3 hat(v)^2 for the tangent (r, v) (Sola 172, 174).
  /// @throws ArgumentError when an element of the rotation vector is not finite, or so large that
  ///   its square is not
  static GSLAM_ALWAYS_INLINE SE3 exp(const Tangent& tangent) {
    const Vec<T, 3> r = tangent.template segment<3>(0);
    const Vec<T, 3> v = tangent.template segment<3>(3);
    const T x = v.squaredNorm();
    if (!(x <= detail::nearSquare<T>())) return farExp(tangent);
    const detail::Pair<T> c10 = detail::stumpff10(T(0.25) * x);
    const T c2 = T(0.5) * c10.first() * c10.first();  // (1 - cos t) = 2 sin^2(t / 2)
    return SE3(SO3<T>(detail::quaternionOfNearVector(v, c10)),
               detail::mixed(c2, detail::stumpff3(x), v, r));
  }

  /// The tangent of the shortest rotation, its angle from 0 to pi (Sola 173). A half turn has two;
  /// one of them is given. Never fails.
  GSLAM_ALWAYS_INLINE Tangent log() const noexcept {
    const detail::RotationLog<T> log = detail::RotationLog<T>::of(rotation_.quaternion());
    return tangentOf(detail::mixed(T(-0.5) * log.factor, log.d, log.v, translation_),
                     log.factor * log.v);
  }

  /// The way back: T_b_a of T_a_b.
  GSLAM_ALWAYS_INLINE SE3 inverse() const noexcept {
    return SE3(rotation_.inverse(), detail::oppositeRotatedBack(data(), translation_));
  }

  /// First `other`, then this one.
  GSLAM_ALWAYS_INLINE SE3 operator*(const SE3& other) const noexcept {
    return SE3(rotation_ * other.rotation_, *this * other.translation_);
  }
  /// This one is followed by `other` on the right: `a = a * other`.
  SE3& operator*=(const SE3& other) noexcept { return *this = *this * other; }

  /// The transformed point, R p + t. (Directions are turned by rotation().)
  GSLAM_ALWAYS_INLINE Point operator*(const Point& p) const noexcept {
    const Vec<T, 3> r = rotation_ * p;
    return {{r[0] + translation_[0], r[1] + translation_[1], r[2] + translation_[2]}};
  }

  /// The transformed plane: for (n, d) with n p + d = 0, the one through the transformed points.
  Vec<T, 4> transformPlane(const Vec<T, 4>& plane) const noexcept {
    const Vec<T, 3> normal = rotation_ * plane.template segment<3>(0);
    return {{normal[0], normal[1], normal[2], plane[3] - normal.dot(translation_)}};
  }

  /// The same with the norm of the quaternion mended, for the end of long products.
  SE3 normalized() const noexcept { return SE3(rotation_.normalized(), translation_); }

  /// The homogeneous matrix [R t; 0 0 0 1].
  Matrix matrix() const noexcept {
    Matrix m = Matrix::identity();
    m.setBlock(0, 0, matrix3x4());
    return m;
  }
  /// The matrix [R t].
  Mat<T, 3, 4> matrix3x4() const noexcept {
    const Mat<T, 3, 3> r = rotation_.matrix();
    const Vec<T, 3>& t = translation_;
    return {{r(0, 0), r(0, 1), r(0, 2), t[0],  //
             r(1, 0), r(1, 1), r(1, 2), t[1],  //
             r(2, 0), r(2, 1), r(2, 2), t[2]}};
  }

  /// R.
  const SO3<T>& rotation() const noexcept { return rotation_; }
  /// t, in the frame that the transform leads to.
  const Vec<T, 3>& translation() const noexcept { return translation_; }
  /// Replaces R.
  void setRotation(const SO3<T>& rotation) noexcept { rotation_ = rotation; }
  /// Replaces t.
  void setTranslation(const Vec<T, 3>& translation) noexcept { translation_ = translation; }
  /// Seven elements, qx qy qz qw tx ty tz.
  const T* data() const noexcept { return reinterpret_cast<const T*>(this); }
  /// The same transform with numbers of another type.
  template <class U>
  SE3<U> cast() const {
    return SE3<U>(rotation_.template cast<U>(), translation_.template cast<U>());
  }

  /// The matrix [hat(v) r; 0 0] of a tangent (r, v).
  static Matrix hat(const Tangent& a) noexcept {
    Matrix m{};
    m.setBlock(0, 0, SO3<T>::hat(a.template segment<3>(3)));
    for (std::size_t i = 0; i < 3; ++i) m(i, 3) = a[i];
    return m;
  }
  /// The tangent of such a matrix, the inverse of hat(). Of another matrix, that of its
  /// skew-symmetric part, and its last column.
  static Tangent vee(const Matrix& m) noexcept {
    return tangentOf({{m(0, 3), m(1, 3), m(2, 3)}}, SO3<T>::vee(m.template block<3, 3>(0, 0)));
  }

  /// Ad, with T exp(d) T^-1 = exp(Ad d): [R hat(t) R; 0 R] (Sola 175). The derivative of a * b by a
  /// is b.inverse().adjoint(), by b the identity; that of a.inverse() is -a.adjoint().
  Jacobian adjoint() const noexcept {
    const Mat<T, 3, 3> r = rotation_.matrix();
    return blocks(r, SO3<T>::hat(translation_) * r);
  }
  /// ad, the derivative of Ad at the identity: ad(a) b = [a, b].
  static Jacobian ad(const Tangent& a) noexcept {
    return blocks(SO3<T>::hat(a.template segment<3>(3)), SO3<T>::hat(a.template segment<3>(0)));
  }

  /// J with exp(a + d) = exp(J d) exp(a) to first order: [J Q; 0 J] (Sola 179). Exact at every
  /// angle.
  static Jacobian leftJacobian(const Tangent& a) noexcept {
    const detail::Stumpff<T> c = stumpffOf(a);
    return blocks(SO3<T>::leftJacobian(a.template segment<3>(3), c), leftBlock(a, c));
  }
  /// The inverse of leftJacobian(a): [J^-1 -J^-1 Q J^-1; 0 J^-1]. At whole turns there is none, and
  /// the elements grow without bound towards them.
  static Jacobian leftJacobianInverse(const Tangent& a) noexcept {
    const detail::Stumpff<T> c = stumpffOf(a);
    const Mat<T, 3, 3> j = SO3<T>::leftJacobianInverse(a.template segment<3>(3), c);
    return blocks(j, -(j * leftBlock(a, c) * j));
  }
  /// J with exp(a + d) = exp(a) exp(J d) to first order (Sola 41).
  static Jacobian rightJacobian(const Tangent& a) noexcept { return leftJacobian(-a); }
  /// The inverse of rightJacobian(a).
  static Jacobian rightJacobianInverse(const Tangent& a) noexcept {
    return leftJacobianInverse(-a);
  }

  /// Derivative of (T exp(d)) p with respect to d at 0: [R, -R hat(p)] (Sola 182). That to p is
  /// rotation().matrix().
  Mat<T, 3, 6> actionJacobian(const Point& p) const noexcept {
    Mat<T, 3, 6> j;
    j.setBlock(0, 0, rotation_.matrix());
    j.setBlock(0, 3, rotation_.actionJacobian(p));
    return j;
  }

  /// Whether the two differ by at most `tolerance` radians, and at most `tolerance` in the unit of
  /// the translation.
  bool isApprox(const SE3& other, T tolerance) const noexcept {
    return rotation_.isApprox(other.rotation_, tolerance) &&
           (translation_ - other.translation_).norm() <= tolerance;
  }

  /// `tx ty tz qx qy qz qw`, with the precision of the stream.
  template <class Char, class Traits>
  friend std::basic_ostream<Char, Traits>& operator<<(std::basic_ostream<Char, Traits>& out,
                                                      const SE3& t) {
    return out << t.translation_ << ' ' << t.rotation_;
  }

 private:
  static Tangent tangentOf(const Vec<T, 3>& r, const Vec<T, 3>& v) noexcept {
    return {{r[0], r[1], r[2], v[0], v[1], v[2]}};
  }

  // Takes the tangent anew, so that exp() may keep its parts in registers.
  GSLAM_COLD static SE3 farExp(const Tangent& tangent) {
    const Vec<T, 3> r = tangent.template segment<3>(0);
    const Vec<T, 3> v = tangent.template segment<3>(3);
    const T x = v.squaredNorm();
    const SO3<T> rotation = SO3<T>::exp(v);
    detail::checkAngle(x);
    const detail::Stumpff<T> c = detail::Stumpff<T>::at(x);
    return SE3(rotation, detail::mixed(c.c2, c.c3, v, r));
  }

  static detail::Stumpff<T> stumpffOf(const Tangent& a) noexcept {
    return detail::Stumpff<T>::at(a.template segment<3>(3).squaredNorm());
  }

  static GSLAM_ALWAYS_INLINE Mat<T, 3, 3> leftBlock(const Tangent& a,
                                                    const detail::Stumpff<T>& c) noexcept {
    return detail::leftTranslationBlock(a.template segment<3>(3), a.template segment<3>(0), T(1),
                                        c.c2, c.c3, 2 * c.c4 - c.c3, 3 * c.c5 - c.c4, c);
  }

  // [d c; 0 d], element by element, because compilers keep loops as loops at -O2.
  static GSLAM_ALWAYS_INLINE Jacobian blocks(const Mat<T, 3, 3>& d,
                                             const Mat<T, 3, 3>& c) noexcept {
    return {{d(0, 0), d(0, 1), d(0, 2), c(0, 0), c(0, 1), c(0, 2),  //
             d(1, 0), d(1, 1), d(1, 2), c(1, 0), c(1, 1), c(1, 2),  //
             d(2, 0), d(2, 1), d(2, 2), c(2, 0), c(2, 1), c(2, 2),  //
             T(0),    T(0),    T(0),    d(0, 0), d(0, 1), d(0, 2),  //
             T(0),    T(0),    T(0),    d(1, 0), d(1, 1), d(1, 2),  //
             T(0),    T(0),    T(0),    d(2, 0), d(2, 1), d(2, 2)}};
  }

  SO3<T> rotation_;  // first, so that its halves lie in the registers in which a pose is copied
  Vec<T, 3> translation_;
};

#if __cplusplus < 201703L  // from then on the declaration is a definition
template <class T>
constexpr std::size_t SE3<T>::kFreedom;
#endif

using SE3d = SE3<double>;  ///< double
using SE3f = SE3<float>;   ///< float

}  // namespace v1
}  // namespace gslam

#endif  // GSLAM_GEOMETRY_SE3_H
