#ifndef GSLAM_OPTIMIZER_CERES_SRC_KNOWN_POINT_COST_H
#define GSLAM_OPTIMIZER_CERES_SRC_KNOWN_POINT_COST_H

#include <ceres/cost_function.h>
#include <factors/reprojection.h>
#include <gslam/optimizer/pose_problem.h>

#include <cmath>
#include <cstddef>

#include "factors/is_before.h"
#include "manifolds.h"

// Residuals of a pose whose points are known.

namespace gslam {
inline namespace v1 {
namespace detail {
namespace by_ceres {

constexpr int kPoseNumbers = ambientSize<SE3d>();

// A point that is known, where it is seen. The pose is the block.
class KnownPointCost : public ceres::CostFunction {
 public:
  void set(const PoseProblem& problem, std::size_t index) {
    problem_ = &problem;
    index_ = index;
    set_num_residuals(seen().has_right ? 3 : 2);
    *mutable_parameter_block_sizes() = {kPoseNumbers};
  }

  bool Evaluate(double const* const* parameters, double* residuals,
                double** jacobians) const override {
    Vec3d residual{};
    ReprojectionJacobians raw;
    const bool wants_jacobian = jacobians != nullptr && jacobians[0] != nullptr;
    if (!reprojectionResidual(loaded<SE3d>(parameters[0]), T_body_camera(), camera(),
                              problem_->points[index_], seen(), residual,
                              wants_jacobian ? &raw : nullptr)) {
      return false;
    }
    const double information = problem_->information.empty() ? 1 : problem_->information[index_];
    const double root = std::sqrt(information);
    const auto rows = static_cast<std::size_t>(num_residuals());
    for (std::size_t r = 0; r < rows; ++r) residuals[r] = root * residual[r];
    if (!areFinite(residuals, num_residuals())) return false;
    for (std::size_t r = 0; r < rows && wants_jacobian; ++r) {
      double* const row = jacobians[0] + r * std::size_t(kPoseNumbers);
      for (std::size_t i = 0; i < 6; ++i) row[i] = root * raw.by_pose(r, i);
      row[6] = 0;
    }
    return true;
  }

  // Whether it lies before its camera. Later on it is evaluated wherever it is, as the pba back end
  // and bundle adjustment do.
  bool isUsed(const SE3d& pose) const {
    return isBefore(camera(), (pose * T_body_camera()).inverse() * problem_->points[index_]);
  }

  // False where it has no value.
  bool squaredNorm(const SE3d& pose, double& sum) const {
    double residuals[3] = {0, 0, 0};
    const double* const block = pose.data();
    if (!Evaluate(&block, residuals, nullptr)) return false;
    sum = residuals[0] * residuals[0] + residuals[1] * residuals[1] + residuals[2] * residuals[2];
    return true;
  }

 private:
  std::size_t cameraIndex() const {
    return problem_->camera_of.empty() ? 0 : problem_->camera_of[index_];
  }
  const Camera& camera() const { return problem_->cameras[cameraIndex()]; }
  SE3d T_body_camera() const {
    return problem_->T_body_camera.empty() ? SE3d() : problem_->T_body_camera[cameraIndex()];
  }
  ReprojectionObservation seen() const {
    ReprojectionObservation seen;
    seen.pixel = problem_->pixels[index_];
    seen.has_right = !problem_->right_u.empty() && !std::isnan(problem_->right_u[index_]);
    if (!seen.has_right) return seen;
    seen.right_u = problem_->right_u[index_];
    seen.baseline = problem_->baseline;
    return seen;
  }

  const PoseProblem* problem_ = nullptr;
  std::size_t index_ = 0;
};

}  // namespace by_ceres
}  // namespace detail
}  // namespace v1
}  // namespace gslam

#endif  // GSLAM_OPTIMIZER_CERES_SRC_KNOWN_POINT_COST_H
