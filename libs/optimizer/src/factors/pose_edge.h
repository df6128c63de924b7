#ifndef GSLAM_OPTIMIZER_SRC_FACTORS_POSE_EDGE_H
#define GSLAM_OPTIMIZER_SRC_FACTORS_POSE_EDGE_H

#include <gslam/geometry/se2.h>
#include <gslam/geometry/se3.h>
#include <gslam/geometry/sim3.h>
#include <gslam/optimizer/pose_graph_problem.h>

#include <cmath>
#include <cstddef>

// Residuals of measured relative poses, and their derivatives, for the three PoseGraphResiduals.

namespace gslam {
inline namespace v1 {
namespace detail {

// Numbers in the residual of an edge.
template <class Group>
constexpr std::size_t mostEdgeRows() {
  return 12;  // chordal in space: 9 of the rotation, 3 of the translation
}

template <class Group>
struct EdgeValue {
  std::size_t rows = 0;
  double residual[12] = {};              // whitened: its squared norm is the s of the loss
  double by_from[12 * Group::kFreedom];  // rows of kFreedom columns, of the tangent on the right
  double by_to[12 * Group::kFreedom];
};

// What is made of the information once: its root, or the two weights of Chordal.
template <class Group>
struct EdgeWeight {
  typename Group::Jacobian root{};  // W with W^T W = information
  double kappa_root = 1;
  double tau_root = 1;
};

// The upper triangle W with W^T W = m. A row is zero where m, which is positive semi-definite, has
// nothing left but rounding.
template <std::size_t N>
Mat<double, N, N> edgeRoot(const Mat<double, N, N>& m) noexcept {
  Mat<double, N, N> w{};
  for (std::size_t i = 0; i < N; ++i) {
    double pivot = m(i, i);
    for (std::size_t k = 0; k < i; ++k) pivot -= w(k, i) * w(k, i);
    if (!(pivot > 1e-14 * m(i, i))) continue;
    w(i, i) = std::sqrt(pivot);
    for (std::size_t j = i + 1; j < N; ++j) {
      double sum = m(i, j);
      for (std::size_t k = 0; k < i; ++k) sum -= w(k, i) * w(k, j);
      w(i, j) = sum / w(i, i);
    }
  }
  return w;
}

// 1 / trace(m^-1), by the root, which keeps more digits than cofactors where m is nearly singular;
// 0 where it is singular. trace(m^-1) is the squared norm of W^-1.
template <std::size_t N>
double inverseTraceOfInverse(const Mat<double, N, N>& m) noexcept {
  const Mat<double, N, N> w = edgeRoot(m);
  double sum = 0;
  for (std::size_t c = 0; c < N; ++c) {
    double column[N] = {};  // of W^-1
    for (std::size_t i = c + 1; i-- > 0;) {
      if (!(w(i, i) > 0)) return 0;
      double value = i == c ? 1 : 0;
      for (std::size_t k = i + 1; k <= c; ++k) value -= w(i, k) * column[k];
      column[i] = value / w(i, i);
      sum += column[i] * column[i];
    }
  }
  return std::isfinite(sum) ? 1 / sum : 0;
}

// kappa and tau of PoseGraphResidual::Chordal.
inline void chordalWeight(const SE2d::Jacobian& information, EdgeWeight<SE2d>& weight) noexcept {
  weight.kappa_root = std::sqrt(std::fmax(information(2, 2), 0.0));
  weight.tau_root = std::sqrt(2 * inverseTraceOfInverse(information.block<2, 2>(0, 0)));
}

template <class Group>
void chordalWeight(const typename Group::Jacobian& information,
                   EdgeWeight<Group>& weight) noexcept {
  // Of vec(q), half the angle, its information is four times ours: 4 * 3 / 2 = 6.
  const Mat3d rotation = information.template block<3, 3>(3, 3);
  const Mat3d translation = information.template block<3, 3>(0, 0);
  weight.kappa_root = std::sqrt(6 * inverseTraceOfInverse(rotation));
  weight.tau_root = std::sqrt(3 * inverseTraceOfInverse(translation));
}

template <class Group>
EdgeWeight<Group> edgeWeight(PoseGraphResidual kind, const typename Group::Jacobian& information) {
  EdgeWeight<Group> weight;
  if (kind == PoseGraphResidual::Chordal) {
    chordalWeight(information, weight);
  } else {
    weight.root = edgeRoot(information);
  }
  return weight;
}

// The residual of PoseGraphResidual::Quaternion, and its derivative by the tangent on the right of
// the error.
inline SE2d::Tangent quaternionResidual(const SE2d& error, SE2d::Jacobian* by_error) {
  const Vec2d& t = error.translation();
  if (by_error != nullptr) {
    *by_error = SE2d::Jacobian::identity();
    by_error->setBlock(0, 0, error.rotation().matrix());
  }
  return {{t[0], t[1], error.rotation().angle()}};
}

// q (phi / 2, 1) has the vector part v + (w phi + v x phi) / 2.
template <class Group>
void quaternionBlocks(const Group& error, double scale, typename Group::Tangent& residual,
                      typename Group::Jacobian* by_error) noexcept {
  const Vec4d& q = error.rotation().quaternion();
  const double sign = q[3] < 0 ? -1 : 1;
  const Vec3d v = {{sign * q[0], sign * q[1], sign * q[2]}};
  residual.setSegment(0, Vec3d(error.translation()));
  residual.setSegment(3, 2 * v);
  if (by_error == nullptr) return;
  *by_error = Group::Jacobian::identity();
  by_error->setBlock(0, 0, scale * error.rotation().matrix());
  by_error->setBlock(3, 3, sign * q[3] * Mat3d::identity() + SO3d::hat(v));
}

inline SE3d::Tangent quaternionResidual(const SE3d& error, SE3d::Jacobian* by_error) {
  SE3d::Tangent residual;
  quaternionBlocks(error, 1, residual, by_error);
  return residual;
}

inline SIM3d::Tangent quaternionResidual(const SIM3d& error, SIM3d::Jacobian* by_error) {
  SIM3d::Tangent residual;
  quaternionBlocks(error, error.scale(), residual, by_error);
  residual[6] = std::log(error.scale());
  return residual;
}

// Logarithm and Quaternion: functions of T_error = T_from_to^-1 B with B = T_from^-1 T_to. A step a
// of T_from and b of T_to make it T_error exp(b - Ad(B^-1) a).
template <class Group>
void errorEdgeValue(bool is_logarithm, const Group& from, const Group& to, const Group& T_from_to,
                    const EdgeWeight<Group>& weight, bool with_jacobians, EdgeValue<Group>& value) {
  constexpr std::size_t n = Group::kFreedom;
  const Group between = from.inverse() * to;
  const Group error = T_from_to.inverse() * between;
  typename Group::Jacobian by_error;
  typename Group::Tangent raw;
  if (is_logarithm) {
    raw = error.log();
    if (with_jacobians) by_error = Group::rightJacobianInverse(raw);
  } else {
    raw = quaternionResidual(error, with_jacobians ? &by_error : nullptr);
  }
  const typename Group::Tangent residual = weight.root * raw;
  value.rows = n;
  for (std::size_t i = 0; i < n; ++i) value.residual[i] = residual[i];
  if (!with_jacobians) return;
  const typename Group::Jacobian by_to = weight.root * by_error;
  const typename Group::Jacobian by_from = by_to * between.inverse().adjoint();
  for (std::size_t i = 0; i < n * n; ++i) {
    value.by_to[i] = by_to.values[i];
    value.by_from[i] = -by_from.values[i];
  }
}

// d R / d (angle k) = R hat(unit k), of a rotation on the right.
inline Mat2d rotationGenerator(const Mat2d& rotation, std::size_t /*axis*/) noexcept {
  return {{rotation(0, 1), -rotation(0, 0), rotation(1, 1), -rotation(1, 0)}};
}

inline Mat3d rotationGenerator(const Mat3d& rotation, std::size_t axis) noexcept {
  const std::size_t next = (axis + 1) % 3, last = (axis + 2) % 3;
  Mat3d turned{};
  for (std::size_t r = 0; r < 3; ++r) {
    turned(r, next) = rotation(r, last);
    turned(r, last) = -rotation(r, next);
  }
  return turned;
}

// Rows: the elements of the rotation row by row, then the translation.
template <class Group>
void chordalEdgeValue(const Group& from, const Group& to, const Group& T_from_to,
                      const EdgeWeight<Group>& weight, bool with_jacobians,
                      EdgeValue<Group>& value) {
  constexpr std::size_t d = Group::Point::size();
  constexpr std::size_t n = Group::kFreedom;
  using Square = Mat<double, d, d>;
  const Square a = from.rotation().matrix();
  const Square b = to.rotation().matrix();
  const Square m = T_from_to.rotation().matrix();
  const Square turned = b - a * m;
  const auto moved =
      to.translation() - from.translation() - from.rotation() * T_from_to.translation();
  value.rows = d * d + d;
  for (std::size_t i = 0; i < d * d; ++i) value.residual[i] = weight.kappa_root * turned.values[i];
  for (std::size_t i = 0; i < d; ++i) value.residual[d * d + i] = weight.tau_root * moved[i];
  if (!with_jacobians) return;
  for (std::size_t i = 0; i < value.rows * n; ++i) value.by_from[i] = value.by_to[i] = 0;
  for (std::size_t k = 0; k + d < n; ++k) {  // axes of the rotation
    const Square by_a = rotationGenerator(a, k);
    const Square by_b = rotationGenerator(b, k);
    const Square by_am = by_a * m;
    const auto by_at = by_a * T_from_to.translation();
    for (std::size_t i = 0; i < d * d; ++i) {
      value.by_from[i * n + d + k] = -weight.kappa_root * by_am.values[i];
      value.by_to[i * n + d + k] = weight.kappa_root * by_b.values[i];
    }
    for (std::size_t i = 0; i < d; ++i) {
      value.by_from[(d * d + i) * n + d + k] = -weight.tau_root * by_at[i];
    }
  }
  for (std::size_t i = 0; i < d; ++i) {
    for (std::size_t k = 0; k < d; ++k) {
      value.by_from[(d * d + i) * n + k] = -weight.tau_root * a(i, k);
      value.by_to[(d * d + i) * n + k] = weight.tau_root * b(i, k);
    }
  }
}

// There is no chordal distance of similarities; checkPoseGraph() refuses it.
inline void chordalEdgeValue(const SIM3d& from, const SIM3d& to, const SIM3d& T_from_to,
                             const EdgeWeight<SIM3d>& weight, bool with_jacobians,
                             EdgeValue<SIM3d>& value) {
  errorEdgeValue(true, from, to, T_from_to, weight, with_jacobians, value);
}

// with_jacobians false: only rows and residual are set.
template <class Group>
void edgeValue(PoseGraphResidual kind, const Group& from, const Group& to, const Group& T_from_to,
               const EdgeWeight<Group>& weight, bool with_jacobians, EdgeValue<Group>& value) {
  if (kind == PoseGraphResidual::Chordal) {
    chordalEdgeValue(from, to, T_from_to, weight, with_jacobians, value);
  } else {
    errorEdgeValue(kind == PoseGraphResidual::Logarithm, from, to, T_from_to, weight,
                   with_jacobians, value);
  }
}

}  // namespace detail
}  // namespace v1
}  // namespace gslam

#endif  // GSLAM_OPTIMIZER_SRC_FACTORS_POSE_EDGE_H
