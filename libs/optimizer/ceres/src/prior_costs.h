#ifndef GSLAM_OPTIMIZER_CERES_SRC_PRIOR_COSTS_H
#define GSLAM_OPTIMIZER_CERES_SRC_PRIOR_COSTS_H

#include <ceres/cost_function.h>
#include <gslam/optimizer/bundle_problem.h>

#include <Eigen/Core>
#include <cstddef>
#include <vector>

#include "edge_cost.h"

// What is known of poses besides observations; for relative and absolute poses see EdgeCost.

namespace gslam {
inline namespace v1 {
namespace detail {
namespace by_ceres {

using PoseEnd = EdgeEnd<SE3d>;

// The position of a body; its pose is the only block.
class PositionCost : public ceres::CostFunction {
 public:
  PositionCost(const PositionPrior& prior, const PoseEnd& pose);
  bool Evaluate(double const* const* parameters, double* residuals,
                double** jacobians) const override;
  double squaredNorm() const;

 private:
  Vec3d position_;
  Mat3d root_;
  PoseEnd pose_;
};

// A joint prior on poses, as the square W d + W^+T b, which is 1/2 d^T H d + b^T d and a constant.
class WindowCost : public ceres::CostFunction {
 public:
  // Throws ArgumentError, naming `name`, where the gradient leads along what H says nothing about.
  WindowCost(const WindowPrior& prior, const std::vector<PoseEnd>& poses, const std::string& name);
  bool Evaluate(double const* const* parameters, double* residuals,
                double** jacobians) const override;
  // What has to be added to half the squared norm.
  double constant() const { return -0.5 * offset_.squaredNorm(); }
  double squaredNorm() const;

 private:
  using Rows = Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>;

  std::vector<SE3d> T_linear_;
  std::vector<PoseEnd> poses_;
  Rows root_;  // W, rank rows
  Eigen::VectorXd offset_;
};

}  // namespace by_ceres
}  // namespace detail
}  // namespace v1
}  // namespace gslam

#endif  // GSLAM_OPTIMIZER_CERES_SRC_PRIOR_COSTS_H
