#ifndef GSLAM_GEOMETRY_SIM3_H
#define GSLAM_GEOMETRY_SIM3_H

#include <gslam/base/error.h>
#include <gslam/base/platform.h>
#include <gslam/geometry/detail/rotation_matrix.h>
#include <gslam/geometry/detail/similarity_part.h>
#include <gslam/geometry/mat.h>
#include <gslam/geometry/se3.h>
#include <gslam/geometry/so3.h>
#include <gslam/geometry/vec.h>

#include <cmath>
#include <cstddef>
#include <iosfwd>

/// @file
/// Similarities of space: poses of maps that have no scale of their own.

namespace gslam {
inline namespace v1 {

/// A rotation, a scale and a translation of three-dimensional space, p' = s R p + t; `S_world_map`
/// takes map to world coordinates.
///
/// Invariant: that of SO3 for the rotation; the scale is finite and above 0, until a product leaves
/// T's range. The translation is what it was given or became.
///
/// Conventions: printed tx ty tz qx qy qz qw s. Tangents are (translation, rotation, log scale).
/// Perturbations are on the right: `S * SIM3::exp(delta)`. `S_a_b * S_b_c` is `S_a_c`.
///
/// Exactness: exp, log and Jacobians are accurate at every angle and scale, with no special value
/// in between: the error is below 1e-13 of the result's norm for double (500 epsilon).
///
/// Layout: eight T, qx qy qz qw tx ty tz s, trivially copyable, aligned as T. T is float or double.
/// Thread-safety: as a number; it may be read by many threads, or written by one.
///
/// Sources: H. Strasdat, "Local Accuracy and Global Consistency for Efficient Visual SLAM", 2012,
/// section 2.4.2; E. Eade, "Lie Groups for 2D and 3D Transformations", 2017, cited as (Eade n).
template <class T>
class SIM3 {
 public:
  using Scalar = T;                           ///< float or double
  static constexpr std::size_t kFreedom = 7;  ///< degrees of freedom
  using Tangent = Vec<T, 7>;                  ///< (translation, rotation vector, log scale)
  using Point = Vec<T, 3>;                    ///< what a similarity acts on
  using Matrix = Mat<T, 4, 4>;                ///< homogeneous matrix
  using Jacobian = Mat<T, 7, 7>;              ///< tangents to tangents

  /// The identity.
  SIM3() noexcept : translation_scale_{{T(0), T(0), T(0), T(1)}} {}
  /// p' = scale rotation p + translation.
  /// @throws ArgumentError when the scale is not finite and above 0
  SIM3(const SO3<T>& rotation, const Vec<T, 3>& translation, T scale)
      : SIM3(rotation, translation, checkedScale(scale), Unchecked()) {}
  /// A rigid transform with a scale for what it acts on.
  /// @throws ArgumentError when the scale is not finite and above 0
  explicit SIM3(const SE3<T>& rigid, T scale = T(1))
      : SIM3(rigid.rotation(), rigid.translation(), scale) {}

  /// The identity.
  static SIM3 identity() noexcept { return SIM3(); }

  /// The similarity of a homogeneous matrix [s R t; 0 0 0 1].
  /// @param m          the matrix
  /// @param tolerance  largest allowed element of |R R^T - I|
  /// @throws ArgumentError as SE3::fromMatrix(), and when the determinant is not above 0
  static SIM3 fromMatrix(const Matrix& m, T tolerance = SO3<T>::matrixTolerance()) {
    detail::checkFinite(m);
    const Mat<T, 3, 3> scaled = m.template block<3, 3>(0, 0);
    const T scale = std::cbrt(detail::determinant(scaled));
    if (!(scale > 0)) {
      detail::refuseMatrix("has the determinant " +
                           detail::numberText(detail::determinant(scaled)) +
                           ", expected that of a rotation times a scale, above 0");
    }
    Matrix rigid = m;
    rigid.setBlock(0, 0, (1 / scale) * scaled);
    return SIM3(SE3<T>::fromMatrix(rigid, tolerance), scale);
  }

  /// The similarity that goes along a spiral for the unit of time: translation W r for the tangent
  /// (r, v, log scale) (Eade 137).
  /// @throws ArgumentError when an element of the rotation vector is not finite, or so large that
  /// its
  ///   square is not, and when the scale is not finite and above 0
  static GSLAM_ALWAYS_INLINE SIM3 exp(const Tangent& tangent) {
    const Vec<T, 3> r = tangent.template segment<3>(0);
    const Vec<T, 3> v = tangent.template segment<3>(3);
    const T s = tangent[6];
    const T x = v.squaredNorm();
    if (!(x <= detail::nearSquare<T>() && std::fabs(s) <= 1)) return farExp(tangent);
    const detail::Pair<T> c10 = detail::stumpff10(T(0.25) * x);
    const detail::Pair<T> c54 = detail::stumpff54(x);
    const T c2 = T(0.5) * c10.first() * c10.first();
    const auto m = detail::ExponentialIntegrals<T>::near(s);
    const auto w =
        detail::SimilarityPart<T>::at(s, x, m, c2, T(1.0 / 6) - x * c54.first(), c54.second());
    return SIM3(SO3<T>(detail::quaternionOfNearVector(v, c10)), w(v, r), m.e, Unchecked());
  }

  /// The tangent of the shortest rotation, its angle from 0 to pi (Eade 157). A half turn has two;
  /// one of them is given. Never fails.
  GSLAM_ALWAYS_INLINE Tangent log() const noexcept {
    const Vec<T, 3> v = rotation().log();
    const T s = std::log(scale());
    const T x = v.squaredNorm();
    const auto w = detail::SimilarityPart<T>::at(s, x, detail::ExponentialIntegrals<T>::at(s));
    const Vec<T, 3> r = w.solve(v, translation(), x);
    return {{r[0], r[1], r[2], v[0], v[1], v[2], s}};
  }

  /// The way back: S_b_a of S_a_b.
  GSLAM_ALWAYS_INLINE SIM3 inverse() const noexcept {
    const Vec<T, 3> t = detail::oppositeRotatedBack(data(), translation());
    const T back = 1 / scale();
    return SIM3(rotation_.inverse(), {{back * t[0], back * t[1], back * t[2]}}, back, Unchecked());
  }

  /// First `other`, then this one.
  GSLAM_ALWAYS_INLINE SIM3 operator*(const SIM3& other) const noexcept {
    return SIM3(rotation_ * other.rotation_, *this * other.translation(), scale() * other.scale(),
                Unchecked());
  }
  /// This one is followed by `other` on the right: `a = a * other`.
  SIM3& operator*=(const SIM3& other) noexcept { return *this = *this * other; }

  /// The transformed point, s R p + t.
  GSLAM_ALWAYS_INLINE Point operator*(const Point& p) const noexcept {
    const Vec<T, 3> r = rotation_ * p;
    const T* const t = translation_scale_.values;
    return {{t[3] * r[0] + t[0], t[3] * r[1] + t[1], t[3] * r[2] + t[2]}};
  }
  /// The transformed difference of two points, s R v.
  Vec<T, 3> transformVector(const Vec<T, 3>& v) const noexcept {
    return scale() * (rotation() * v);
  }
  /// The transformed plane: for (n, d) with n p + d = 0, the one through the transformed points,
  /// with a normal as long as before.
  Vec<T, 4> transformPlane(const Vec<T, 4>& plane) const noexcept {
    const Vec<T, 3> normal = rotation() * plane.template segment<3>(0);
    return {{normal[0], normal[1], normal[2], scale() * plane[3] - normal.dot(translation())}};
  }

  /// The same with the norm of the quaternion mended, for the end of long products.
  SIM3 normalized() const noexcept {
    return SIM3(rotation_.normalized(), translation(), scale(), Unchecked());
  }

  /// The homogeneous matrix [s R t; 0 0 0 1].
  Matrix matrix() const noexcept {
    Matrix m = rigid().matrix();
    m.setBlock(0, 0, scale() * rotation().matrix());
    return m;
  }

  /// R.
  const SO3<T>& rotation() const noexcept { return rotation_; }
  /// t, in the frame that the similarity leads to.
  Vec<T, 3> translation() const noexcept { return translation_scale_.template segment<3>(0); }
  /// s.
  T scale() const noexcept { return translation_scale_[3]; }
  /// R and t without the scale.
  SE3<T> rigid() const noexcept { return SE3<T>(rotation_, translation()); }
  /// Eight elements, qx qy qz qw tx ty tz s.
  const T* data() const noexcept { return reinterpret_cast<const T*>(this); }
  /// The same similarity with numbers of another type.
  /// @throws ArgumentError when the scale leaves the range of U
  template <class U>
  SIM3<U> cast() const {
    return SIM3<U>(rigid().template cast<U>(), static_cast<U>(scale()));
  }

  /// The matrix [s I + hat(v), r; 0 0] of a tangent (r, v, s).
  static Matrix hat(const Tangent& a) noexcept {
    Matrix m = SE3<T>::hat(a.template segment<6>(0));
    for (std::size_t i = 0; i < 3; ++i) m(i, i) = a[6];
    return m;
  }
  /// The tangent of such a matrix, the inverse of hat(). Of another matrix, that of its part of
  /// this form: the mean of the diagonal, the skew-symmetric part, the last column.
  static Tangent vee(const Matrix& m) noexcept {
    Tangent a;
    a.setSegment(0, SE3<T>::vee(m));
    a[6] = (m(0, 0) + m(1, 1) + m(2, 2)) / 3;
    return a;
  }

  /// Ad, with S exp(d) S^-1 = exp(Ad d): [s R, hat(t) R, -t; 0 R 0; 0 0 1] (Eade 118). The
  /// derivative of a * b by a is b.inverse().adjoint(), by b the identity; that of a.inverse() is
  /// -a.adjoint().
  Jacobian adjoint() const noexcept {
    const Mat<T, 3, 3> r = rotation().matrix();
    return blocks(scale() * r, SO3<T>::hat(translation()) * r, -translation(), r, T(1));
  }
  /// ad, the derivative of Ad at the identity: ad(a) b = [a, b].
  static Jacobian ad(const Tangent& a) noexcept {
    const Vec<T, 3> r = a.template segment<3>(0);
    const Mat<T, 3, 3> turn = SO3<T>::hat(a.template segment<3>(3));
    return blocks(a[6] * Mat<T, 3, 3>::identity() + turn, SO3<T>::hat(r), -r, turn, T(0));
  }

  /// J with exp(a + d) = exp(J d) exp(a) to first order: [W Q q; 0 J 0; 0 0 1], where J is that of
  /// SO3, and Q and q follow from the derivatives of exp's translation.
  static Jacobian leftJacobian(const Tangent& a) noexcept {
    const Left l(a);
    return blocks(l.w, l.q, l.scale, l.rotation, T(1));
  }
  /// The inverse of leftJacobian(a). At whole turns there is none, and the elements grow without
  /// bound towards them.
  static Jacobian leftJacobianInverse(const Tangent& a) noexcept {
    const Left l(a);
    const Vec<T, 3> v = a.template segment<3>(3);
    const Mat<T, 3, 3> j = SO3<T>::leftJacobianInverse(v, l.stumpff);
    const Mat<T, 3, 3> w = l.solved(Mat<T, 3, 3>::identity());
    return blocks(w, -(w * l.q * j), -(w * l.scale), j, T(1));
  }
  /// J with exp(a + d) = exp(a) exp(J d) to first order.
  static Jacobian rightJacobian(const Tangent& a) noexcept { return leftJacobian(-a); }
  /// The inverse of rightJacobian(a).
  static Jacobian rightJacobianInverse(const Tangent& a) noexcept {
    return leftJacobianInverse(-a);
  }

  /// Derivative of (S exp(d)) p with respect to d at 0: s R [I, -hat(p), p]. That to p is s R.
  Mat<T, 3, 7> actionJacobian(const Point& p) const noexcept {
    Mat<T, 3, 7> j;
    j.setBlock(0, 0, scale() * rotation().matrix());
    j.setBlock(0, 3, scale() * rotation().actionJacobian(p));
    const Vec<T, 3> along = transformVector(p);
    for (std::size_t i = 0; i < 3; ++i) j(i, 6) = along[i];
    return j;
  }

  /// Whether the two differ by at most `tolerance` radians, in the unit of the translation, and in
  /// the logarithm of the scale.
  bool isApprox(const SIM3& other, T tolerance) const noexcept {
    return rigid().isApprox(other.rigid(), tolerance) &&
           std::fabs(std::log(scale() / other.scale())) <= tolerance;
  }

  /// `tx ty tz qx qy qz qw s`, with the precision of the stream.
  template <class Char, class Traits>
  friend std::basic_ostream<Char, Traits>& operator<<(std::basic_ostream<Char, Traits>& out,
                                                      const SIM3& s) {
    return out << s.rigid() << ' ' << s.scale();
  }

 private:
  struct Unchecked {};
  GSLAM_ALWAYS_INLINE SIM3(const SO3<T>& rotation, const Vec<T, 3>& t, T scale, Unchecked) noexcept
      : rotation_(rotation), translation_scale_{{t[0], t[1], t[2], scale}} {}

  static T checkedScale(T scale) {
    if (scale > 0 && std::isfinite(scale)) return scale;
    throw ArgumentError("scale",
                        "is " + detail::numberText(scale) + ", expected a finite one above 0");
  }

  // Takes the tangent anew, so that exp() may keep its parts in registers.
  GSLAM_COLD static SIM3 farExp(const Tangent& tangent) {
    const Vec<T, 3> r = tangent.template segment<3>(0);
    const Vec<T, 3> v = tangent.template segment<3>(3);
    const T s = tangent[6];
    const T x = v.squaredNorm();
    const SO3<T> rotation = SO3<T>::exp(v);
    detail::checkAngle(x);
    const auto m = detail::ExponentialIntegrals<T>::at(s);
    const auto w = detail::SimilarityPart<T>::at(s, x, m);
    return SIM3(rotation, w(v, r), m.e);
  }

  // The blocks of the left Jacobian.
  struct Left {
    explicit Left(const Tangent& a) noexcept
        : v(a.template segment<3>(3)),
          x(v.squaredNorm()),
          stumpff(detail::Stumpff<T>::at(x)),
          part(detail::SimilarityPart<T>::at(a[6], x, detail::ExponentialIntegrals<T>::at(a[6]))) {
      const Vec<T, 3> r = a.template segment<3>(0);
      const Vec<T, 3> t = part(v, r);
      const auto d = detail::SimilarityDerivatives<T>::at(a[6], x);
      w = applied(Mat<T, 3, 3>::identity());
      q = detail::leftTranslationBlock(v, r, part.a, part.b, part.c, d.b_x, d.c_x, stumpff);
      scale = detail::mixed(d.a_s, d.b_s, d.c_s, v, r) - t;
      rotation = SO3<T>::leftJacobian(v, stumpff);
    }
    Mat<T, 3, 3> applied(const Mat<T, 3, 3>& m) const noexcept {
      Mat<T, 3, 3> result;
      for (std::size_t c = 0; c < 3; ++c) setColumn(result, c, part(v, m.col(c)));
      return result;
    }
    Mat<T, 3, 3> solved(const Mat<T, 3, 3>& m) const noexcept {
      Mat<T, 3, 3> result;
      for (std::size_t c = 0; c < 3; ++c) setColumn(result, c, part.solve(v, m.col(c), x));
      return result;
    }
    static void setColumn(Mat<T, 3, 3>& m, std::size_t c, const Vec<T, 3>& column) noexcept {
      for (std::size_t r = 0; r < 3; ++r) m(r, c) = column[r];
    }

    Vec<T, 3> v;
    T x;
    detail::Stumpff<T> stumpff;
    detail::SimilarityPart<T> part;
    Mat<T, 3, 3> w, q, rotation;
    Vec<T, 3> scale;
  };

  // [first, corner, column; 0 second 0; 0 0 last]
  static Jacobian blocks(const Mat<T, 3, 3>& first, const Mat<T, 3, 3>& corner,
                         const Vec<T, 3>& column, const Mat<T, 3, 3>& second, T last) noexcept {
    Jacobian j{};
    j.setBlock(0, 0, first);
    j.setBlock(0, 3, corner);
    j.setBlock(3, 3, second);
    for (std::size_t i = 0; i < 3; ++i) j(i, 6) = column[i];
    j(6, 6) = last;
    return j;
  }

  SO3<T> rotation_;
  Vec<T, 4> translation_scale_;
};

#if __cplusplus < 201703L  // from then on the declaration is a definition
template <class T>
constexpr std::size_t SIM3<T>::kFreedom;
#endif

using SIM3d = SIM3<double>;  ///< double
using SIM3f = SIM3<float>;   ///< float

}  // namespace v1
}  // namespace gslam

#endif  // GSLAM_GEOMETRY_SIM3_H
