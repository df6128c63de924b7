#ifndef GSLAM_OPTIMIZER_CERES_SRC_CORRESPONDENCE_COST_H
#define GSLAM_OPTIMIZER_CERES_SRC_CORRESPONDENCE_COST_H

#include <ceres/cost_function.h>
#include <factors/pose_edge.h>
#include <gslam/optimizer/alignment_problem.h>

#include <algorithm>
#include <cmath>
#include <cstddef>

#include "manifolds.h"

// Residuals of alignments.

namespace gslam {
inline namespace v1 {
namespace detail {
namespace by_ceres {

enum class Correspondence { Point, Plane, Line, Pose };

// One correspondence; the transform is the block.
template <class Group>
class CorrespondenceCost : public ceres::CostFunction {
 public:
  void set(const AlignmentProblem& problem, Correspondence kind, std::size_t index) {
    problem_ = &problem;
    kind_ = kind;
    index_ = index;
    set_num_residuals(kind == Correspondence::Pose ? 6 : kind == Correspondence::Plane ? 1 : 3);
    *mutable_parameter_block_sizes() = {ambientSize<Group>()};
  }

  bool Evaluate(double const* const* parameters, double* residuals,
                double** jacobians) const override {
    const Group transform = loaded<Group>(parameters[0]);
    double* const jacobian = jacobians != nullptr ? jacobians[0] : nullptr;
    if (jacobian != nullptr) {
      std::fill(jacobian, jacobian + num_residuals() * ambientSize<Group>(), 0.0);
    }
    switch (kind_) {
      case Correspondence::Point:
        setPoint(transform, residuals, jacobian);
        break;
      case Correspondence::Plane:
        setPlane(transform, residuals, jacobian);
        break;
      case Correspondence::Line:
        setLine(transform, residuals, jacobian);
        break;
      case Correspondence::Pose:
        setPose(transform, residuals, jacobian);
        break;
    }
    return areFinite(residuals, num_residuals());
  }

  double squaredNorm(const Group& transform) const {
    double residuals[6] = {0, 0, 0, 0, 0, 0}, sum = 0;
    const double* const block = transform.data();
    Evaluate(&block, residuals, nullptr);
    for (const double residual : residuals) sum += residual * residual;
    return sum;
  }

 private:
  template <std::size_t R>
  static void put(const Vec<double, R>& residual, const Mat<double, R, Group::kFreedom>& slope,
                  double* residuals, double* jacobian) {
    std::copy(residual.data(), residual.data() + R, residuals);
    constexpr auto width = static_cast<std::size_t>(ambientSize<Group>());
    for (std::size_t r = 0; r < R && jacobian != nullptr; ++r) {
      for (std::size_t c = 0; c < Group::kFreedom; ++c) jacobian[r * width + c] = slope(r, c);
    }
  }

  void setPoint(const Group& transform, double* residuals, double* jacobian) const {
    const Vec3d& b = problem_->points_b[index_];
    const Mat3d root = problem_->point_information.empty()
                           ? Mat3d::identity()
                           : edgeRoot(problem_->point_information[index_]);
    put(root * (transform * b - problem_->points_a[index_]), root * transform.actionJacobian(b),
        residuals, jacobian);
  }

  void setPlane(const Group& transform, double* residuals, double* jacobian) const {
    const Vec3d& b = problem_->plane_points_b[index_];
    const Vec4d& plane = problem_->planes_a[index_];
    const double root =
        problem_->plane_information.empty() ? 1 : std::sqrt(problem_->plane_information[index_]);
    const Mat<double, 1, 3> normal = {{root * plane[0], root * plane[1], root * plane[2]}};
    const Vec<double, 1> residual = normal * (transform * b);
    put<1>({residual[0] + root * plane[3]}, normal * transform.actionJacobian(b), residuals,
           jacobian);
  }

  void setLine(const Group& transform, double* residuals, double* jacobian) const {
    const Vec3d& b = problem_->line_points_b[index_];
    const Vec3d& along = problem_->line_directions_a[index_];
    const double root =
        problem_->line_information.empty() ? 1 : std::sqrt(problem_->line_information[index_]);
    const Mat3d across = root * (Mat3d::identity() - outer(along, along));
    put(across * (transform * b - problem_->line_origins_a[index_]),
        across * transform.actionJacobian(b), residuals, jacobian);
  }

  // A step (v, w[, s]) of the transform moves the position of the body as a point of b, and turns
  // the body by R_b_body^T w.
  void setPose(const Group& transform, double* residuals, double* jacobian) const {
    const SE3d& in_b = problem_->T_b_body[index_];
    const SE3d in_a(transform.rotation() * in_b.rotation(), transform * in_b.translation());
    const SE3d::Tangent error = (problem_->T_a_body[index_].inverse() * in_a).log();
    Mat<double, 6, Group::kFreedom> moved{};
    moved.setBlock(
        0, 0, in_a.rotation().matrix().transpose() * transform.actionJacobian(in_b.translation()));
    moved.setBlock(3, 3, in_b.rotation().matrix().transpose());
    const SE3d::Jacobian root = problem_->pose_information.empty()
                                    ? SE3d::Jacobian::identity()
                                    : edgeRoot(problem_->pose_information[index_]);
    put(root * error, root * SE3d::rightJacobianInverse(error) * moved, residuals, jacobian);
  }

  const AlignmentProblem* problem_ = nullptr;
  Correspondence kind_ = Correspondence::Point;
  std::size_t index_ = 0;
};

}  // namespace by_ceres
}  // namespace detail
}  // namespace v1
}  // namespace gslam

#endif  // GSLAM_OPTIMIZER_CERES_SRC_CORRESPONDENCE_COST_H
