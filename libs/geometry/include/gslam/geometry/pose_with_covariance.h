#ifndef GSLAM_GEOMETRY_POSE_WITH_COVARIANCE_H
#define GSLAM_GEOMETRY_POSE_WITH_COVARIANCE_H

#include <gslam/base/error.h>
#include <gslam/geometry/detail/rotation_matrix.h>
#include <gslam/geometry/mat.h>
#include <gslam/geometry/vec.h>

#include <cmath>
#include <cstddef>
#include <string>

/// @file
/// Uncertain rotations and poses.

namespace gslam {
inline namespace v1 {
namespace detail {

/// J S J^T, symmetric to the bit.
template <class T, std::size_t R, std::size_t C>
Mat<T, R, R> propagated(const Mat<T, R, C>& j, const Mat<T, C, C>& s) noexcept {
  const Mat<T, R, C> half = j * s;
  Mat<T, R, R> result;
  for (std::size_t r = 0; r < R; ++r) {
    for (std::size_t c = 0; c <= r; ++c) {
      result(r, c) = result(c, r) = half.row(r).dot(j.row(c));
    }
  }
  return result;
}

/// What is wrong with an element of a covariance; nothing: null.
template <class T, std::size_t N>
const char* problemOfCovariance(const Mat<T, N, N>& m, std::size_t r, std::size_t c) noexcept {
  if (!std::isfinite(m(r, c))) return "expected finite elements";
  if (r == c) return m(r, c) >= 0 ? nullptr : "expected a variance, 0 or more";
  const T largest = std::sqrt(std::fabs(m(r, r))) * std::sqrt(std::fabs(m(c, c)));
  if (!(std::fabs(m(r, c)) <= T(1.001) * largest)) return "more than the two variances allow";
  const bool is_symmetric = std::fabs(m(r, c) - m(c, r)) <= T(1e-3) * largest;
  return is_symmetric ? nullptr : "expected a symmetric matrix";
}

/// The least pivot of the Cholesky decomposition of m + slack I; it ends at the first that is not
/// above 0.
template <class T, std::size_t N>
T leastPivot(Mat<T, N, N> m, T slack) noexcept {
  T least = slack;
  for (std::size_t k = 0; k < N; ++k) {
    const T pivot = m(k, k) + slack;
    if (!(pivot > 0)) return pivot;
    if (pivot < least) least = pivot;
    for (std::size_t r = k + 1; r < N; ++r) {
      for (std::size_t c = k + 1; c < N; ++c) m(r, c) -= m(r, k) * m(k, c) / pivot;
    }
  }
  return least;
}

/// The covariance, symmetric to the bit.
template <class T, std::size_t N>
Mat<T, N, N> checkedCovariance(const Mat<T, N, N>& m) {
  for (std::size_t r = 0; r < N; ++r) {
    for (std::size_t c = 0; c < N; ++c) {
      const char* const problem = problemOfCovariance(m, r, c);
      if (problem == nullptr) continue;
      throw ArgumentError("covariance", "has the element " + numberText(m(r, c)) + " in row " +
                                            std::to_string(r) + ", column " + std::to_string(c) +
                                            ", " + problem);
    }
  }
  const Mat<T, N, N> symmetric = T(0.5) * (m + m.transpose());
  T trace = 0;
  for (std::size_t i = 0; i < N; ++i) trace += m(i, i);
  const T least = leastPivot(symmetric, T(1e-3) * trace);
  if (!(least >= 0)) {
    throw ArgumentError("covariance",
                        "is indefinite, expected no variance below 0 in any direction");
  }
  return symmetric;
}

}  // namespace detail

/// A point and its covariance.
template <class T, std::size_t N>
struct PointWithCovariance {
  Vec<T, N> point;          ///< the mean
  Mat<T, N, N> covariance;  ///< in the square of its unit
};

/// An uncertain rotation or pose: pose() exp(d) with a random tangent d of mean 0 and the given
/// covariance. Perturbations are on the right, in the frame of the body, and in the order of the
/// tangents: (translation, rotation[, log scale]), in the unit of the translation and radians. For
/// SE3 that is 6 x 6, translation first, as in ROS; but see covarianceInWorldAxes().
///
/// All functions are of the first order: right where d is small beside 1 radian. Two poses that are
/// given without their cross-covariance are taken as independent.
///
/// Invariant: the covariance is finite and symmetric, variances are 0 or more.
/// Layout: plain numbers, trivially copyable.
/// Thread-safety: as a number; it may be read by many threads, or written by one.
///
/// Sources: T. Barfoot, P. Furgale, "Associating uncertainty with three-dimensional poses for use
/// in estimation problems", IEEE T-RO 30(3), 2014; J. Mangelson, M. Ghaffari, R. Vasudevan, R.
/// Eustice, "Characterizing the uncertainty of jointly distributed poses in the Lie algebra", IEEE
/// T-RO 36(5), 2020. (There perturbations are on the left.)
template <class G>
class PoseWithCovariance {
 public:
  using Scalar = typename G::Scalar;                            ///< float or double
  using Covariance = typename G::Jacobian;                      ///< kFreedom x kFreedom
  static constexpr std::size_t kPointSize = G::Point::size();   ///< 2 or 3
  using Point = typename G::Point;                              ///< what it acts on
  using PointCovariance = Mat<Scalar, kPointSize, kPointSize>;  ///< of a point

  /// The identity, for sure.
  PoseWithCovariance() noexcept : covariance_{} {}
  /// A pose that is known exactly.
  explicit PoseWithCovariance(const G& pose) noexcept : pose_(pose), covariance_{} {}
  /// An uncertain pose.
  /// @param pose        the mean
  /// @param covariance  of d in pose exp(d)
  /// @throws ArgumentError when an element is not finite, a variance is below 0, an element is more
  ///   than its two variances allow, or the matrix is not symmetric (to 1e-3) or is indefinite
  PoseWithCovariance(const G& pose, const Covariance& covariance)
      : pose_(pose), covariance_(detail::checkedCovariance(covariance)) {}
  /// From the covariance of a perturbation on the left, exp(d) pose: d in the frame of the world.
  /// @param pose        the mean
  /// @param covariance  of d
  /// @throws ArgumentError as the constructor
  static PoseWithCovariance fromLeftCovariance(const G& pose, const Covariance& covariance) {
    return {pose,
            detail::propagated(pose.inverse().adjoint(), detail::checkedCovariance(covariance)),
            Unchecked()};
  }
  /// From the covariance that covarianceInWorldAxes() gives; for SE2 and SE3.
  /// @param pose        the mean
  /// @param covariance  of translation and rotation along the axes of the world
  /// @throws ArgumentError as the constructor
  static PoseWithCovariance fromCovarianceInWorldAxes(const G& pose, const Covariance& covariance) {
    const G turn(pose.rotation().inverse(), {});
    return {pose, detail::propagated(turn.adjoint(), detail::checkedCovariance(covariance)),
            Unchecked()};
  }

  /// The mean.
  const G& pose() const noexcept { return pose_; }
  /// The covariance of d in pose exp(d).
  const Covariance& covariance() const noexcept { return covariance_; }
  /// The covariance of d in exp(d) pose: Ad S Ad^T.
  Covariance leftCovariance() const noexcept {
    return detail::propagated(pose_.adjoint(), covariance_);
  }
  /// The covariance of the position in the world and of the rotation about the axes of the world,
  /// as geometry_msgs/PoseWithCovariance of ROS has it; for SE2 and SE3. (leftCovariance() is
  /// another: there the rotation is about the origin of the world and takes the position along.)
  Covariance covarianceInWorldAxes() const noexcept {
    const G turn(pose_.rotation(), {});
    return detail::propagated(turn.adjoint(), covariance_);
  }

  /// The way back: a^-1 exp(-Ad(a) d).
  PoseWithCovariance inverse() const noexcept {
    return {pose_.inverse(), leftCovariance(), Unchecked()};
  }

  /// a b of two independent poses.
  PoseWithCovariance operator*(const PoseWithCovariance& other) const noexcept {
    return compose(*this, other, Covariance{});
  }

  /// a b: the covariance is A Sa A^T + Sb + A C + C^T A^T with A = Ad(b^-1).
  /// @param a      T_world_body
  /// @param b      T_body_camera
  /// @param cross  C, the expectation of d_a d_b^T
  static PoseWithCovariance compose(const PoseWithCovariance& a, const PoseWithCovariance& b,
                                    const Covariance& cross) noexcept {
    return joined(a.pose_ * b.pose_, b.pose_.inverse().adjoint(), a, b, cross);
  }

  /// a^-1 b of two independent poses: the pose of b as seen from a. Poses of one trajectory are not
  /// independent: their common error cancels, which only the other between() knows.
  /// @param a  T_world_a
  /// @param b  T_world_b
  static PoseWithCovariance between(const PoseWithCovariance& a,
                                    const PoseWithCovariance& b) noexcept {
    return between(a, b, Covariance{});
  }
  /// a^-1 b: the covariance is A Sa A^T + Sb - A C - C^T A^T with A = Ad((a^-1 b)^-1).
  /// @param a      T_world_a
  /// @param b      T_world_b
  /// @param cross  C, the expectation of d_a d_b^T
  static PoseWithCovariance between(const PoseWithCovariance& a, const PoseWithCovariance& b,
                                    const Covariance& cross) noexcept {
    const G pose = a.pose_.inverse() * b.pose_;
    return joined(pose, -pose.inverse().adjoint(), a, b, cross);
  }

  /// The transformed point, uncertain as the pose is.
  /// @param p  known exactly
  PointWithCovariance<Scalar, kPointSize> operator*(const Point& p) const noexcept {
    return {pose_ * p, detail::propagated(pose_.actionJacobian(p), covariance_)};
  }
  /// The transformed point.
  /// @param p  uncertain, independent of the pose
  PointWithCovariance<Scalar, kPointSize> operator*(
      const PointWithCovariance<Scalar, kPointSize>& p) const noexcept {
    auto result = *this * p.point;
    const PointCovariance linear = pose_.matrix().template block<kPointSize, kPointSize>(0, 0);
    result.covariance += detail::propagated(linear, p.covariance);
    return result;
  }

 private:
  struct Unchecked {};
  PoseWithCovariance(const G& pose, const Covariance& covariance, Unchecked) noexcept
      : pose_(pose), covariance_(covariance) {}

  // The pose is perturbed by J d_a + d_b.
  static PoseWithCovariance joined(const G& pose, const Covariance& j, const PoseWithCovariance& a,
                                   const PoseWithCovariance& b, const Covariance& cross) noexcept {
    const Covariance mixed = j * cross;
    return {pose,
            detail::propagated(j, a.covariance_) + b.covariance_ + (mixed + mixed.transpose()),
            Unchecked()};
  }

  G pose_;
  Covariance covariance_;
};

template <class G>
constexpr std::size_t
    PoseWithCovariance<G>::kPointSize;  // NOLINT(readability-redundant-declaration): before C++17

}  // namespace v1
}  // namespace gslam

#endif  // GSLAM_GEOMETRY_POSE_WITH_COVARIANCE_H
