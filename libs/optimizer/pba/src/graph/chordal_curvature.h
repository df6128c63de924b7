#ifndef GSLAM_OPTIMIZER_PBA_SRC_GRAPH_CHORDAL_CURVATURE_H
#define GSLAM_OPTIMIZER_PBA_SRC_GRAPH_CHORDAL_CURVATURE_H

#include <cstddef>

#include "factors/pose_edge.h"

// What Gauss and Newton leave out of the second derivatives of PoseGraphResidual::Chordal. With
// much noise their steps are too short, and converge linearly; these are exact, and only within a
// pose.
//
// With P = R_to^T R_from and M the measured rotation, the rotations cost a constant less
// kappa tr(P M); R exp(a) = R (1 + [a] + [a]^2 / 2) and [a]^2 = a a^T - |a|^2 give the second
// derivatives kappa (tr(S) - sym(S)), S = M P of `from` and P M of `to`, where J^T J is 2 kappa.
// The residual r of the translation is bent by [a]^2 in `from`, and by [a] rho / 2 in both, since
// the tangent's translation goes along an arc.

namespace gslam {
inline namespace v1 {
namespace detail {
namespace pba {

// kappa (tr(s) - 2 - sym(s)), of rotations: in the plane there is but one.
inline void addRotationCurvature(const Mat2d& s, double kappa, SE2d::Jacobian& sum) noexcept {
  sum(2, 2) += kappa * (s(0, 0) + s(1, 1) - 2);
}
inline void addRotationCurvature(const Mat3d& s, double kappa, SE3d::Jacobian& sum) noexcept {
  const double trace = s(0, 0) + s(1, 1) + s(2, 2) - 2;
  for (std::size_t i = 0; i < 3; ++i) {
    sum(3 + i, 3 + i) += kappa * trace;
    for (std::size_t j = 0; j < 3; ++j) sum(3 + i, 3 + j) -= 0.5 * kappa * (s(i, j) + s(j, i));
  }
}

// tau (p m - sym(p m^T)).
inline void addLeverCurvature(const Vec2d& p, const Vec2d& m, double tau,
                              SE2d::Jacobian& sum) noexcept {
  sum(2, 2) += tau * p.dot(m);
}
inline void addLeverCurvature(const Vec3d& p, const Vec3d& m, double tau,
                              SE3d::Jacobian& sum) noexcept {
  for (std::size_t i = 0; i < 3; ++i) {
    sum(3 + i, 3 + i) += tau * p.dot(m);
    for (std::size_t j = 0; j < 3; ++j) {
      sum(3 + i, 3 + j) -= 0.5 * tau * (p[i] * m[j] + p[j] * m[i]);
    }
  }
}

// weight p [a] rho, with rho the translation of the tangent.
inline void addArcCurvature(const Vec2d& p, double weight, SE2d::Jacobian& sum) noexcept {
  sum(0, 2) += weight * p[1];
  sum(2, 0) += weight * p[1];
  sum(1, 2) -= weight * p[0];
  sum(2, 1) -= weight * p[0];
}
inline void addArcCurvature(const Vec3d& p, double weight, SE3d::Jacobian& sum) noexcept {
  const Mat3d cross = weight * SO3d::hat(p);
  for (std::size_t i = 0; i < 3; ++i) {
    for (std::size_t j = 0; j < 3; ++j) {
      sum(i, 3 + j) += cross(i, j);
      sum(3 + j, i) += cross(i, j);
    }
  }
}

template <class Group>
void chordalCurvature(const Group& from, const Group& to, const Group& T_from_to,
                      const EdgeWeight<Group>& weight, typename Group::Jacobian& by_from,
                      typename Group::Jacobian& by_to) {
  const double kappa = weight.kappa_root * weight.kappa_root;
  const double tau = weight.tau_root * weight.tau_root;
  const auto back = to.rotation().inverse() * from.rotation();
  const auto& m = T_from_to.rotation();
  const auto rest =
      to.translation() - from.translation() - from.rotation() * T_from_to.translation();
  const auto rest_from = from.rotation().inverse() * rest;
  by_from = by_to = typename Group::Jacobian{};
  addRotationCurvature((m * back).matrix(), kappa, by_from);
  addRotationCurvature((back * m).matrix(), kappa, by_to);
  addLeverCurvature(rest_from, T_from_to.translation(), tau, by_from);
  addArcCurvature(rest_from, -0.5 * tau, by_from);
  addArcCurvature(to.rotation().inverse() * rest, 0.5 * tau, by_to);
}

// There is no such residual.
inline void chordalCurvature(const SIM3d&, const SIM3d&, const SIM3d&, const EdgeWeight<SIM3d>&,
                             SIM3d::Jacobian& by_from, SIM3d::Jacobian& by_to) {
  by_from = by_to = SIM3d::Jacobian{};
}

}  // namespace pba
}  // namespace detail
}  // namespace v1
}  // namespace gslam

#endif  // GSLAM_OPTIMIZER_PBA_SRC_GRAPH_CHORDAL_CURVATURE_H
