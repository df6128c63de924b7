#ifndef GSLAM_GEOMETRY_SE2_H
#define GSLAM_GEOMETRY_SE2_H

#include <gslam/base/error.h>
#include <gslam/geometry/detail/arctangent.h>
#include <gslam/geometry/detail/rotation_matrix.h>
#include <gslam/geometry/detail/stumpff.h>
#include <gslam/geometry/mat.h>
#include <gslam/geometry/so2.h>
#include <gslam/geometry/vec.h>

#include <cmath>
#include <cstddef>
#include <iosfwd>

/// @file
/// Rigid transforms of the plane: poses of robots on a floor.

namespace gslam {
inline namespace v1 {

/// A rotation and a translation of the plane, p' = R p + t; `T_world_body` takes body to world
/// coordinates, and is the pose of the body in the world. The interface is that of SE3.
///
/// Invariant: that of SO2 for the rotation. The translation is what it was given or became; what is
/// not finite passes through, as IEEE says.
///
/// Conventions: stored and printed tx ty cosine sine. Tangents are (x, y, angle), in the unit of
/// the translation and radians. Perturbations are on the right: `T * SE2::exp(delta)`.
/// `T_a_b * T_b_c` is `T_a_c`. The x, y, angle that robots give as their pose is no tangent, but
/// `SE2(SO2::fromAngle(angle), {x, y})`.
///
/// Exactness: exp and log are accurate at every angle, with no special angle in between: the error
/// is below 4e-15 of the result's norm for double (18 epsilon). Jacobians: 1e-13.
///
/// Layout: four T, trivially copyable, aligned as T. T is float or double.
/// Thread-safety: as a number; it may be read by many threads, or written by one.
///
/// Source: J. Sola, J. Deray, D. Atchuthan, "A micro Lie theory for state estimation in robotics",
/// arXiv:1812.01537, cited as (Sola n).
template <class T>
class SE2 {
 public:
  using Scalar = T;                           ///< float or double
  static constexpr std::size_t kFreedom = 3;  ///< degrees of freedom
  using Tangent = Vec<T, 3>;                  ///< (x, y, angle)
  using Point = Vec<T, 2>;                    ///< what a transform acts on
  using Matrix = Mat<T, 3, 3>;                ///< homogeneous matrix
  using Jacobian = Mat<T, 3, 3>;              ///< tangents to tangents

  /// The identity.
  SE2() noexcept : translation_{} {}
  /// p' = rotation p + translation.
  SE2(const SO2<T>& rotation, const Vec<T, 2>& translation)
      : translation_(translation), rotation_(rotation) {}

  /// The identity.
  static SE2 identity() noexcept { return SE2(); }

  /// The transform of a homogeneous matrix [R t; 0 0 1].
  /// @param m          the matrix
  /// @param tolerance  largest allowed element of |R R^T - I|
  /// @throws ArgumentError as SO2::fromMatrix(), and when the last row is not 0 0 1
  static SE2 fromMatrix(const Matrix& m, T tolerance = T(1e-5)) {
    detail::checkFinite(m);
    if (m(2, 0) != 0 || m(2, 1) != 0 || m(2, 2) != 1) {
      detail::refuseMatrix("has the last row " + detail::vectorText(m.row(2)) + ", expected 0 0 1");
    }
    return fromMatrix(m.template block<2, 3>(0, 0), tolerance);
  }
  /// The transform of a matrix [R t].
  /// @param m          the matrix
  /// @param tolerance  largest allowed element of |R R^T - I|
  /// @throws ArgumentError as SO2::fromMatrix()
  static SE2 fromMatrix(const Mat<T, 2, 3>& m, T tolerance = T(1e-5)) {
    detail::checkFinite(m);
    return SE2(SO2<T>::fromMatrix(m.template block<2, 2>(0, 0), tolerance), m.col(2));
  }

  /// The transform that goes along an arc for the unit of time: translation V r with
  /// V = sin(h) / h e^(i h), h half the angle, for the tangent (r, angle) (Sola 156, 158).
  /// @throws ArgumentError when the angle is not finite
  static SE2 exp(const Tangent& tangent) {
    const T half = T(0.5) * tangent[2];
    const T square = half * half;
    if (!(square <= T(0.25) * detail::nearSquare<T>())) return farExp(tangent, half);
    const detail::Pair<T> c10 = detail::stumpff10(square);
    const T sine = half * c10.first();
    const T cosine = c10.second();
    const SO2<T> rotation(Vec<T, 2>{{(cosine - sine) * (cosine + sine), 2 * sine * cosine}});
    return SE2(rotation,
               spiral(c10.first() * cosine, c10.first() * sine, {{tangent[0], tangent[1]}}));
  }

  /// The tangent of the shortest rotation, its angle from -pi to pi (Sola 157). Never fails.
  Tangent log() const noexcept {
    const T angle = rotation_.angle();
    const T half = T(0.5) * angle;
    const Vec<T, 2> r = spiral(halfTimesCotangent(half), -half, translation_);
    return {{r[0], r[1], angle}};
  }

  /// The way back: T_b_a of T_a_b.
  SE2 inverse() const noexcept {
    const SO2<T> back = rotation_.inverse();
    return SE2(back, back * -translation_);
  }

  /// First `other`, then this one.
  SE2 operator*(const SE2& other) const noexcept {
    return SE2(rotation_ * other.rotation_, rotation_ * other.translation_ + translation_);
  }
  /// This one is followed by `other` on the right: `a = a * other`.
  SE2& operator*=(const SE2& other) noexcept { return *this = *this * other; }

  /// The transformed point, R p + t. (Directions are turned by rotation().)
  Point operator*(const Point& p) const noexcept { return rotation_ * p + translation_; }

  /// The same with the norm of the rotation mended, for the end of long products.
  SE2 normalized() const noexcept { return SE2(rotation_.normalized(), translation_); }

  /// The homogeneous matrix [R t; 0 0 1].
  Matrix matrix() const noexcept {
    Matrix m = Matrix::identity();
    m.setBlock(0, 0, matrix2x3());
    return m;
  }
  /// The matrix [R t].
  Mat<T, 2, 3> matrix2x3() const noexcept {
    const T c = rotation_.cosine();
    const T s = rotation_.sine();
    return {{c, -s, translation_[0], s, c, translation_[1]}};
  }

  /// R.
  const SO2<T>& rotation() const noexcept { return rotation_; }
  /// t, in the frame that the transform leads to.
  const Vec<T, 2>& translation() const noexcept { return translation_; }
  /// Replaces R.
  void setRotation(const SO2<T>& rotation) noexcept { rotation_ = rotation; }
  /// Replaces t.
  void setTranslation(const Vec<T, 2>& translation) noexcept { translation_ = translation; }
  /// Four elements, tx ty cosine sine.
  const T* data() const noexcept { return reinterpret_cast<const T*>(this); }
  /// The same transform with numbers of another type.
  template <class U>
  SE2<U> cast() const {
    return SE2<U>(rotation_.template cast<U>(), translation_.template cast<U>());
  }

  /// The matrix [hat(angle) r; 0 0] of a tangent (r, angle).
  static Matrix hat(const Tangent& a) noexcept {
    return {{T(0), -a[2], a[0], a[2], T(0), a[1], T(0), T(0), T(0)}};
  }
  /// The tangent of such a matrix, the inverse of hat(). Of another matrix, that of its
  /// skew-symmetric part, and its last column.
  static Tangent vee(const Matrix& m) noexcept {
    return {{m(0, 2), m(1, 2), T(0.5) * (m(1, 0) - m(0, 1))}};
  }

  /// Ad, with T exp(d) T^-1 = exp(Ad d): [R, (ty, -tx); 0 1] (Sola 159). The derivative of a * b by
  /// a is b.inverse().adjoint(), by b the identity; that of a.inverse() is -a.adjoint().
  Jacobian adjoint() const noexcept {
    return blocks({{rotation_.cosine(), rotation_.sine()}}, {{translation_[1], -translation_[0]}},
                  T(1));
  }
  /// ad, the derivative of Ad at the identity: ad(a) b = [a, b].
  static Jacobian ad(const Tangent& a) noexcept {
    return blocks({{T(0), a[2]}}, {{a[1], -a[0]}}, T(0));
  }

  /// J with exp(a + d) = exp(J d) exp(a) to first order: [V q; 0 1] with V = c1 + i angle c2 and
  /// q = r (angle c3 - i c2) in complex numbers (Sola 164, without its quotients). Exact at every
  /// angle.
  static Jacobian leftJacobian(const Tangent& a) noexcept {
    const Left l(a);
    return blocks({{1 - l.square * l.c.c3, a[2] * l.c.c2}}, l.q, T(1));
  }
  /// The inverse of leftJacobian(a): [V^-1 -V^-1 q; 0 1] with V^-1 = h cot(h) - i h, h half the
  /// angle. At whole turns there is none, and the elements grow without bound towards them.
  static Jacobian leftJacobianInverse(const Tangent& a) noexcept {
    const Left l(a);
    const T half = T(0.5) * a[2];
    const T d = (l.c.c3 - 2 * l.c.c4) / (2 * l.c.c2);  // as in SO3: h cot(h) = 1 - angle^2 d
    const Vec<T, 2> v = {{1 - l.square * d, -half}};
    return blocks(v, -spiral(v[0], v[1], l.q), T(1));
  }
  /// J with exp(a + d) = exp(a) exp(J d) to first order (Sola 163).
  static Jacobian rightJacobian(const Tangent& a) noexcept { return leftJacobian(-a); }
  /// The inverse of rightJacobian(a).
  static Jacobian rightJacobianInverse(const Tangent& a) noexcept {
    return leftJacobianInverse(-a);
  }

  /// Derivative of (T exp(d)) p with respect to d at 0: [R, R p a quarter turn on] (Sola 166). That
  /// to p is rotation().matrix().
  Mat<T, 2, 3> actionJacobian(const Point& p) const noexcept {
    Mat<T, 2, 3> j;
    j.setBlock(0, 0, rotation_.matrix());
    j.setBlock(0, 2, rotation_.actionJacobian(p));
    return j;
  }

  /// Whether the two differ by at most `tolerance` radians, and at most `tolerance` in the unit of
  /// the translation.
  bool isApprox(const SE2& other, T tolerance) const noexcept {
    return rotation_.isApprox(other.rotation_, tolerance) &&
           (translation_ - other.translation_).norm() <= tolerance;
  }

  /// `tx ty cosine sine`, with the precision of the stream.
  template <class Char, class Traits>
  friend std::basic_ostream<Char, Traits>& operator<<(std::basic_ostream<Char, Traits>& out,
                                                      const SE2& t) {
    return out << t.translation_ << ' ' << t.rotation_;
  }

 private:
  // The complex product (real + i imaginary) r.
  static Vec<T, 2> spiral(T real, T imaginary, const Vec<T, 2>& r) noexcept {
    return {{real * r[0] - imaginary * r[1], imaginary * r[0] + real * r[1]}};
  }

  static SE2 farExp(const Tangent& a, T half) {
    const SO2<T> rotation = SO2<T>::fromAngle(a[2]);
    const T sine = std::sin(half);
    const T quotient = sine / half;
    return SE2(rotation, spiral(quotient * std::cos(half), quotient * sine, {{a[0], a[1]}}));
  }

  // h cot(h) of half the angle. Up to a quarter turn it is atan(x) / x for x = tan(h); beyond, the
  // denominator is far from 0. Nothing cancels, and 0 / 0 does not occur.
  T halfTimesCotangent(T half) const noexcept {
    const T cosine = rotation_.cosine();
    const T sine = rotation_.sine();
    if (!(cosine > 0)) return half * sine / (1 - cosine);
    const T tangent = sine / (1 + cosine);
    const T x = tangent * tangent;
    const detail::Pair<T> quotient = detail::arctangentQuotient(x);
    return 1 + x * quotient.first() / quotient.second();
  }

  // What the left Jacobian is made of.
  struct Left {
    explicit Left(const Tangent& a) noexcept
        : square(a[2] * a[2]),
          c(detail::Stumpff<T>::at(square)),
          q(spiral(a[2] * c.c3, -c.c2, {{a[0], a[1]}})) {}
    T square;
    detail::Stumpff<T> c;
    Vec<T, 2> q;
  };

  // [corner, column; 0 last], where the corner is the matrix of a complex number.
  static Jacobian blocks(const Vec<T, 2>& corner, const Vec<T, 2>& column, T last) noexcept {
    return {{corner[0], -corner[1], column[0],  //
             corner[1], corner[0], column[1],   //
             T(0), T(0), last}};
  }

  Vec<T, 2> translation_;
  SO2<T> rotation_;
};

template <class T>
constexpr std::size_t SE2<T>::kFreedom;  // NOLINT(readability-redundant-declaration): before C++17

using SE2d = SE2<double>;  ///< double
using SE2f = SE2<float>;   ///< float

}  // namespace v1
}  // namespace gslam

#endif  // GSLAM_GEOMETRY_SE2_H
