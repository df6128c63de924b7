#include <gslam/base/error.h>
#include <gslam/geometry/detail/symmetric_eigen.h>
#include <gslam/geometry/nearest_rotation.h>
#include <gslam/optimizer/align_trajectories.h>

#include <Eigen/Dense>
#include <chrono>
#include <cmath>
#include <cstddef>
#include <string>
#include <vector>

#include "check_input.h"

namespace gslam {
inline namespace v1 {
namespace {

// Means, and sums of products of the distances from them.
struct TrajectoryMoments {
  Vec3d mean_a{}, mean_b{};
  Mat3d aa{}, ab{}, bb{};
  Mat3d turns{};  // sum of R_a R_b^T
};

double traceOf(const Mat3d& m) {
  return m(0, 0) + m(1, 1) + m(2, 2);
}

TrajectoryMoments momentsOf(const TrajectoryPair& pair) {
  TrajectoryMoments m;
  const std::size_t n = pair.T_a_body.size();
  for (std::size_t i = 0; i < n; ++i) {
    m.mean_a += pair.T_a_body[i].translation() / static_cast<double>(n);
    m.mean_b += pair.T_b_body[i].translation() / static_cast<double>(n);
  }
  for (std::size_t i = 0; i < n; ++i) {
    const Vec3d a = pair.T_a_body[i].translation() - m.mean_a;
    const Vec3d b = pair.T_b_body[i].translation() - m.mean_b;
    m.aa += outer(a, a);
    m.ab += outer(a, b);
    m.bb += outer(b, b);
    m.turns += (pair.T_a_body[i].rotation() * pair.T_b_body[i].rotation().inverse()).matrix();
  }
  // 1e154 metres and more.
  if (!(std::isfinite(traceOf(m.aa)) && std::isfinite(traceOf(m.bb)))) {
    throw ArgumentError("T_a_body", "or T_b_body has positions too far apart to be squared");
  }
  return m;
}

// Whether positions lie on a line, as far as a millionth of its length tells.
bool isLine(const Mat3d& products, const Vec3d& mean, std::size_t count) {
  const detail::SymmetricEigen<double, 3> eigen(products);
  const double rounding = 1e-15 * mean.norm();
  return eigen.values[1] <=
         1e-12 * eigen.values[0] + static_cast<double>(count) * rounding * rounding;
}

// What the fit begins with; false where positions do not determine it.
struct ClosedForm {
  SO3d rotation;
  double scale = 1;
  bool is_determined = false;
};

ClosedForm closedForm(const TrajectoryPair& pair, const TrajectoryMoments& m, bool has_scale) {
  const std::size_t n = pair.T_a_body.size();
  ClosedForm result;
  const NearestRotation<double> nearest = nearestRotation(m.ab);
  result.is_determined =
      nearest.is_unique && !isLine(m.aa, m.mean_a, n) && !isLine(m.bb, m.mean_b, n);
  result.rotation = result.is_determined || !pair.uses_orientations
                        ? nearest.rotation
                        : nearestRotation(m.turns).rotation;
  if (!has_scale) return result;
  // Umeyama, equation 42.
  const double scale = traceOf(result.rotation.matrix().transpose() * m.ab) / traceOf(m.bb);
  const bool is_scale = scale > 0 && std::isfinite(scale);
  result.scale = is_scale ? scale : 1;
  result.is_determined = result.is_determined && is_scale;
  return result;
}

template <class Group>
Group fromClosedForm(const ClosedForm& form, const TrajectoryMoments& m);
template <>
SE3d fromClosedForm(const ClosedForm& form, const TrajectoryMoments& m) {
  return SE3d(form.rotation, m.mean_a - form.rotation * m.mean_b);
}
template <>
SIM3d fromClosedForm(const ClosedForm& form, const TrajectoryMoments& m) {
  return SIM3d(form.rotation, m.mean_a - form.scale * (form.rotation * m.mean_b), form.scale);
}

void requireTrajectorySize(const char* name, std::size_t size, std::size_t expected) {
  if (size == expected) return;
  throw ArgumentError(name, "has " + std::to_string(size) + " elements, expected " +
                                std::to_string(expected) + " as of T_a_body");
}

void requireFinitePoses(const char* name, Span<const SE3d> poses) {
  for (std::size_t i = 0; i < poses.size(); ++i) {
    for (std::size_t k = 0; k < 7; ++k) {
      if (std::isfinite(poses[i].data()[k])) continue;
      throw ArgumentError(std::string(name) + "[" + std::to_string(i) + "]", "is not finite");
    }
  }
}

void checkTrajectories(const TrajectoryPair& pair) {
  const std::size_t n = pair.T_a_body.size();
  if (n == 0) throw ArgumentError("T_a_body", "is empty, expected one pose or more");
  requireTrajectorySize("T_b_body", pair.T_b_body.size(), n);
  if (!pair.position_information.empty()) {
    requireTrajectorySize("position_information", pair.position_information.size(), n);
    if (pair.uses_orientations) {
      throw ArgumentError("position_information",
                          "is given with uses_orientations, expected pose_information");
    }
  }
  if (!pair.pose_information.empty()) {
    requireTrajectorySize("pose_information", pair.pose_information.size(), n);
    if (!pair.uses_orientations) {
      throw ArgumentError("pose_information", "is given without uses_orientations");
    }
  }
  requireFinitePoses("T_a_body", pair.T_a_body);
  requireFinitePoses("T_b_body", pair.T_b_body);
}

// The cost, and the inverse of the normal equations, of positions without information.
template <class Group>
void completeClosedForm(const TrajectoryPair& pair, OptimizedAlignment<Group>& result) {
  constexpr int kFreedom = static_cast<int>(Group::kFreedom);
  using Hessian = Eigen::Matrix<double, kFreedom, kFreedom, Eigen::RowMajor>;
  Hessian hessian = Hessian::Zero();
  double cost = 0, cost_before = 0;
  for (std::size_t i = 0; i < pair.T_a_body.size(); ++i) {
    const Vec3d& a = pair.T_a_body[i].translation();
    const Vec3d& b = pair.T_b_body[i].translation();
    cost += 0.5 * (result.T_a_b * b - a).squaredNorm();
    cost_before += 0.5 * (b - a).squaredNorm();
    const Mat<double, 3, Group::kFreedom> slope = result.T_a_b.actionJacobian(b);
    const Eigen::Map<const Eigen::Matrix<double, 3, kFreedom, Eigen::RowMajor>> j(slope.data());
    hessian += j.transpose() * j;
  }
  // With a diagonal of 1 the unit of length does not matter.
  const Eigen::Matrix<double, kFreedom, 1> unit = hessian.diagonal().cwiseSqrt().cwiseInverse();
  const Hessian scaled = unit.asDiagonal() * hessian * unit.asDiagonal();
  const Hessian inverse = unit.asDiagonal() * scaled.inverse() * unit.asDiagonal();
  if (inverse.allFinite()) {
    Eigen::Map<Hessian>(result.covariance.data()) = 0.5 * (inverse + inverse.transpose());
  }
  OptimizerSummary& summary = result.summary;
  summary.initial_cost = cost_before;
  summary.final_cost = cost;
  summary.is_usable = true;
  summary.status = OptimizerStatus::Converged;
  summary.message = "the best fit of positions, in closed form";
}

template <class Group>
OptimizedAlignment<Group> refine(const TrajectoryPair& pair, const Group& start,
                                 const OptimizerOptions& options) {
  AlignmentProblem problem;
  std::vector<Vec3d> a, b;
  if (pair.uses_orientations) {
    problem.T_a_body = pair.T_a_body;
    problem.T_b_body = pair.T_b_body;
    problem.pose_information = pair.pose_information;
  } else {
    for (const SE3d& pose : pair.T_a_body) a.push_back(pose.translation());
    for (const SE3d& pose : pair.T_b_body) b.push_back(pose.translation());
    problem.points_a = a;
    problem.points_b = b;
    problem.point_information = pair.position_information;
  }
  return optimizeAlignment(problem, start, options);
}

template <class Group>
OptimizedAlignment<Group> alignTrajectoriesOf(const TrajectoryPair& pair,
                                              const OptimizerOptions& options) {
  const auto began = std::chrono::steady_clock::now();
  detail::checkOptions(options);
  checkTrajectories(pair);
  const TrajectoryMoments moments = momentsOf(pair);
  const ClosedForm form = closedForm(pair, moments, Group::kFreedom == 7);
  const bool is_refined = pair.uses_orientations || !pair.position_information.empty() ||
                          options.loss.kind != LossKind::Squared;
  if (is_refined && (form.is_determined || pair.uses_orientations)) {
    return refine(pair, fromClosedForm<Group>(form, moments), options);
  }
  OptimizedAlignment<Group> result;
  OptimizerSummary& summary = result.summary;
  summary.backend = summary.linear_solver = "closed form";
  summary.observations = summary.inliers = pair.T_a_body.size();
  summary.residuals = 3 * pair.T_a_body.size();
  summary.parameters = Group::kFreedom;
  if (form.is_determined) {
    result.T_a_b = fromClosedForm<Group>(form, moments);
    completeClosedForm(pair, result);
  } else {
    summary.inliers = 0;
    summary.message =
        "positions do not determine the transform: they lie on a line or in one place, or are "
        "mirrored; orientations may help";
  }
  summary.times.total =
      std::chrono::duration<double>(std::chrono::steady_clock::now() - began).count();
  return result;
}

}  // namespace

template <>
OptimizedAlignment<SE3d> alignTrajectories<SE3d>(const TrajectoryPair& pair,
                                                 const OptimizerOptions& options) {
  return alignTrajectoriesOf<SE3d>(pair, options);
}
template <>
OptimizedAlignment<SIM3d> alignTrajectories<SIM3d>(const TrajectoryPair& pair,
                                                   const OptimizerOptions& options) {
  return alignTrajectoriesOf<SIM3d>(pair, options);
}

}  // namespace v1
}  // namespace gslam
