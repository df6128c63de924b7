#include "prior_costs.h"

#include <gslam/base/error.h>

#include <Eigen/Eigenvalues>
#include <algorithm>
#include <cmath>
#include <string>

namespace gslam {
inline namespace v1 {
namespace detail {
namespace by_ceres {

PositionCost::PositionCost(const PositionPrior& prior, const PoseEnd& pose)
    : position_(prior.position), root_(edgeRoot(prior.information)), pose_(pose) {
  set_num_residuals(3);
  if (pose.ambient != 0) mutable_parameter_block_sizes()->push_back(pose.ambient);
}

bool PositionCost::Evaluate(double const* const* parameters, double* residuals,
                            double** jacobians) const {
  const SE3d pose = loaded<SE3d>(pose_.ambient != 0 ? parameters[0] : pose_.data);
  const Vec3d residual = root_ * (pose.translation() - position_);
  std::copy(residual.data(), residual.data() + 3, residuals);
  if (jacobians == nullptr || pose_.ambient == 0 || jacobians[0] == nullptr) return true;
  const Mat3d by_translation = root_ * pose.rotation().matrix();
  std::fill(jacobians[0], jacobians[0] + 3 * pose_.ambient, 0.0);
  for (std::size_t r = 0; r < 3; ++r) {
    double* const row = jacobians[0] + r * static_cast<std::size_t>(pose_.ambient);
    for (std::size_t c = 0; c < 3; ++c) row[c] = by_translation(r, c);
  }
  return true;
}

double PositionCost::squaredNorm() const {
  return (root_ * (loaded<SE3d>(pose_.data).translation() - position_)).squaredNorm();
}

WindowCost::WindowCost(const WindowPrior& prior, const std::vector<PoseEnd>& poses,
                       const std::string& name)
    : T_linear_(prior.T_linear), poses_(poses) {
  const auto n = static_cast<Eigen::Index>(prior.gradient.size());
  const Eigen::Map<const Rows> information(prior.information.data(), n, n);
  const Eigen::Map<const Eigen::VectorXd> gradient(prior.gradient.data(), n);
  const Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd> eigen(information);
  const Eigen::VectorXd& values = eigen.eigenvalues();
  const double least = n > 0 ? std::max(values[n - 1], 0.0) * 1e-14 * static_cast<double>(n) : 0;
  Eigen::Index first = 0;  // eigenvalues rise
  while (first < n && !(values[first] > least)) ++first;
  const Eigen::VectorXd along = eigen.eigenvectors().transpose() * gradient;
  // Where poses were marginalised out at their optimum the gradient is nothing but rounding.
  const double rounding = 1e-12 * std::max(n > 0 ? values[n - 1] : 0.0, 0.0);
  if (first > 0 && along.head(first).norm() > 1e-6 * gradient.norm() + rounding) {
    throw ArgumentError(name + ".gradient",
                        "leads where the information is zero, which ceres cannot follow");
  }
  const Eigen::VectorXd roots = values.tail(n - first).cwiseSqrt();
  root_ = roots.asDiagonal() * eigen.eigenvectors().rightCols(n - first).transpose();
  offset_ = along.tail(n - first).cwiseQuotient(roots);
  set_num_residuals(static_cast<int>(n - first));
  for (const PoseEnd& pose : poses_) {
    if (pose.ambient != 0) mutable_parameter_block_sizes()->push_back(pose.ambient);
  }
}

bool WindowCost::Evaluate(double const* const* parameters, double* residuals,
                          double** jacobians) const {
  const auto count = static_cast<Eigen::Index>(poses_.size());
  Eigen::VectorXd d(6 * count);
  std::size_t place = 0;
  for (std::size_t i = 0; i < poses_.size(); ++i) {
    const PoseEnd& end = poses_[i];
    const SE3d pose = loaded<SE3d>(end.ambient != 0 ? parameters[place] : end.data);
    const SE3d::Tangent tangent = (T_linear_[i].inverse() * pose).log();
    d.segment<6>(6 * static_cast<Eigen::Index>(i)) =
        Eigen::Map<const Eigen::Matrix<double, 6, 1>>(tangent.data());
    if (end.ambient == 0) continue;
    double* const to = jacobians != nullptr ? jacobians[place] : nullptr;
    ++place;
    if (to == nullptr) continue;
    const SE3d::Jacobian slope = SE3d::rightJacobianInverse(tangent);
    Eigen::Map<Rows> rows(to, root_.rows(), end.ambient);
    rows.setZero();
    rows.leftCols<6>() =
        root_.middleCols<6>(6 * static_cast<Eigen::Index>(i)) *
        Eigen::Map<const Eigen::Matrix<double, 6, 6, Eigen::RowMajor>>(slope.data());
  }
  Eigen::Map<Eigen::VectorXd>(residuals, root_.rows()) = root_ * d + offset_;
  return areFinite(residuals, num_residuals());
}

double WindowCost::squaredNorm() const {
  std::vector<const double*> parameters;
  for (const PoseEnd& pose : poses_) {
    if (pose.ambient != 0) parameters.push_back(pose.data);
  }
  Eigen::VectorXd residual(root_.rows());
  Evaluate(parameters.data(), residual.data(), nullptr);
  return residual.squaredNorm();
}

}  // namespace by_ceres
}  // namespace detail
}  // namespace v1
}  // namespace gslam
