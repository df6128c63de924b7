#include <gslam/optimizer/alignment_problem.h>

#include <cmath>
#include <cstddef>
#include <limits>

#include "factors/loss.h"
#include "small/dense.h"
#include "solvers.h"
#include "trust_region.h"

namespace gslam {
inline namespace v1 {
namespace detail {
namespace pba {
namespace {

constexpr double kAlignmentDamping = 1e-6;
constexpr double kMostTurn = 1e3;  // radians, or log of a scale, in a step that is tried

// E = T_a_body^-1 T_a_b T_b_body without its scale, and d log E by the tangent of T_a_b.
SE3d poseError(const SE3d& T_a_b, const SE3d& T_b_body, const SE3d& T_a_body,
               Mat<double, 6, 6>* slope) {
  const SE3d error = T_a_body.inverse() * T_a_b * T_b_body;
  if (slope != nullptr) {
    *slope = SE3d::rightJacobianInverse(error.log()) * T_b_body.inverse().adjoint();
  }
  return error;
}

// A step (r, v, s) of E moves the rigid part of E by (scale r, v).
SE3d poseError(const SIM3d& T_a_b, const SE3d& T_b_body, const SE3d& T_a_body,
               Mat<double, 6, 7>* slope) {
  const SIM3d error = SIM3d(T_a_body.inverse()) * T_a_b * SIM3d(T_b_body);
  if (slope != nullptr) {
    const SIM3d::Jacobian adjoint = SIM3d(T_b_body.inverse()).adjoint();
    Mat<double, 6, 7> rigid = adjoint.block<6, 7>(0, 0);
    for (std::size_t i = 0; i < 21; ++i) rigid.values[i] *= error.scale();
    *slope = SE3d::rightJacobianInverse(error.rigid().log()) * rigid;
  }
  return error.rigid();
}

template <class Group>
class AlignmentTrustRegion final : public TrustRegionProblem {
 public:
  static constexpr std::size_t kFreedom = Group::kFreedom;

  AlignmentTrustRegion(const AlignmentProblem& problem, const Group& start, const RobustLoss& loss)
      : problem_(problem), loss_(loss), T_(start), candidate_(start) {}

  const Group& transform() const { return T_; }
  std::size_t inliers() const { return inliers_; }
  const SmallEquations<kFreedom>& equations() const { return equations_; }

  double linearize() override {
    equations_ = {};
    inliers_ = 0;
    return costAt(T_, &equations_);
  }
  double gradientMax() const override { return equations_.gradientMax(); }

  LinearStep solve(double damping) override {
    LinearStep result;
    typename Group::Tangent step{};
    result.is_solved = solveDetermined(equations_, damping, step);
    if (!result.is_solved) return result;
    result.model_decrease = equations_.decrease(step);
    result.step_norm = step.norm();
    result.variable_norm = std::hypot(1.0, T_.translation().norm());
    step_ = step;
    return result;
  }

  double evaluateStep() override {
    for (std::size_t i = 3; i < kFreedom; ++i) {
      if (!(std::fabs(step_[i]) < (i < 6 ? kMostTurn : 0.1 * kMostTurn))) {
        return std::numeric_limits<double>::infinity();
      }
    }
    candidate_ = T_ * Group::exp(step_);
    return costAt(candidate_, nullptr);
  }
  void acceptStep() override { T_ = candidate_; }

 private:
  using Equations = SmallEquations<kFreedom>;

  double costAt(const Group& T, Equations* equations) {
    return addPoints(T, equations) + addPlanes(T, equations) + addLines(T, equations) +
           addPoses(T, equations);
  }

  // The cost of one correspondence, whose residual is R long.
  template <std::size_t R>
  double add(const Vec<double, R>& residual, const Mat<double, R, R>& information,
             const Mat<double, R, kFreedom>& slope, Equations* equations) {
    const Vec<double, R> pull = information * residual;
    const LossValue loss = lossAt(loss_, residual.dot(pull));
    if (equations == nullptr) return 0.5 * loss.rho;
    if (loss.first >= 0.5) ++inliers_;
    const Mat<double, R, kFreedom> weighted = information * slope;
    for (std::size_t i = 0; i < kFreedom; ++i) {
      double gradient = 0;
      for (std::size_t r = 0; r < R; ++r) {
        const double left = loss.first * slope(r, i);
        gradient += left * pull[r];
        for (std::size_t j = i; j < kFreedom; ++j) {
          equations->hessian(i, j) += left * weighted(r, j);
        }
      }
      equations->gradient[i] += gradient;
    }
    return 0.5 * loss.rho;
  }

  double addPoints(const Group& T, Equations* equations) {
    double cost = 0;
    for (std::size_t i = 0; i < problem_.points_b.size(); ++i) {
      const Vec3d& p = problem_.points_b[i];
      cost += add(
          T * p - problem_.points_a[i],
          problem_.point_information.empty() ? Mat3d::identity() : problem_.point_information[i],
          equations != nullptr ? T.actionJacobian(p) : Mat<double, 3, kFreedom>{}, equations);
    }
    return cost;
  }

  double addPlanes(const Group& T, Equations* equations) {
    double cost = 0;
    for (std::size_t i = 0; i < problem_.plane_points_b.size(); ++i) {
      const Vec3d& p = problem_.plane_points_b[i];
      const Vec4d& plane = problem_.planes_a[i];
      const Mat<double, 1, 3> normal = {plane[0], plane[1], plane[2]};
      Mat<double, 1, kFreedom> slope{};
      if (equations != nullptr) slope = normal * T.actionJacobian(p);
      const double information =
          problem_.plane_information.empty() ? 1 : problem_.plane_information[i];
      cost += add<1>({(normal * (T * p))[0] + plane[3]}, {information}, slope, equations);
    }
    return cost;
  }

  double addLines(const Group& T, Equations* equations) {
    double cost = 0;
    for (std::size_t i = 0; i < problem_.line_points_b.size(); ++i) {
      const Vec3d& p = problem_.line_points_b[i];
      const Vec3d& along = problem_.line_directions_a[i];
      const Mat3d across = Mat3d::identity() - outer(along, along);
      Mat<double, 3, kFreedom> slope{};
      if (equations != nullptr) slope = across * T.actionJacobian(p);
      const double information =
          problem_.line_information.empty() ? 1 : problem_.line_information[i];
      cost += add(across * (T * p - problem_.line_origins_a[i]), information * Mat3d::identity(),
                  slope, equations);
    }
    return cost;
  }

  double addPoses(const Group& T, Equations* equations) {
    double cost = 0;
    for (std::size_t i = 0; i < problem_.T_b_body.size(); ++i) {
      Mat<double, 6, kFreedom> slope{};
      const SE3d error = poseError(T, problem_.T_b_body[i], problem_.T_a_body[i],
                                   equations != nullptr ? &slope : nullptr);
      cost += add(error.log(),
                  problem_.pose_information.empty() ? Mat<double, 6, 6>::identity()
                                                    : problem_.pose_information[i],
                  slope, equations);
    }
    return cost;
  }

  const AlignmentProblem& problem_;
  const RobustLoss& loss_;
  Group T_, candidate_;
  typename Group::Tangent step_{};
  Equations equations_;
  std::size_t inliers_ = 0;
};

template <class Group>
OptimizedAlignment<Group> solveAlignmentOf(const AlignmentProblem& problem, const Group& start,
                                           const OptimizerOptions& options) {
  const Clock::time_point began = Clock::now();
  OptimizedAlignment<Group> result;
  OptimizerSummary& summary = result.summary;
  const std::size_t points = problem.points_b.size(), planes = problem.plane_points_b.size();
  const std::size_t lines = problem.line_points_b.size(), poses = problem.T_b_body.size();
  summary.linear_solver = "dense Cholesky";
  summary.parameters = Group::kFreedom;
  summary.observations = points + planes + lines + poses;
  summary.residuals = 3 * points + planes + 3 * lines + 6 * poses;
  AlignmentTrustRegion<Group> loop(problem, start, options.loss);
  runTrustRegion(loop, options, kAlignmentDamping, began, summary);
  result.T_a_b = summary.is_usable ? loop.transform() : start;
  if (!summary.is_usable) return result;
  summary.inliers = loop.inliers();
  if (!invertSmall(loop.equations().hessian, result.covariance)) {
    result.covariance = {};
    summary.warnings.push_back(
        "not all directions are determined: along the others the transform is that of the start, "
        "and there is no covariance");
  }
  return result;
}

}  // namespace

OptimizedAlignment<SE3d> solveAlignment(const AlignmentProblem& problem, const SE3d& T_a_b,
                                        const OptimizerOptions& options) {
  return solveAlignmentOf(problem, T_a_b, options);
}

OptimizedAlignment<SIM3d> solveAlignment(const AlignmentProblem& problem, const SIM3d& T_a_b,
                                         const OptimizerOptions& options) {
  return solveAlignmentOf(problem, T_a_b, options);
}

}  // namespace pba
}  // namespace detail
}  // namespace v1
}  // namespace gslam
