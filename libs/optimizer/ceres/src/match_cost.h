#ifndef GSLAM_OPTIMIZER_CERES_SRC_MATCH_COST_H
#define GSLAM_OPTIMIZER_CERES_SRC_MATCH_COST_H

#include <ceres/cost_function.h>
#include <factors/reprojection.h>
#include <gslam/optimizer/two_view_problem.h>

#include <algorithm>
#include <cmath>
#include <cstddef>

#include "factors/is_before.h"
#include "manifolds.h"

// Residuals of two views.

namespace gslam {
inline namespace v1 {
namespace detail {
namespace by_ceres {

// The second pixel of a match. Blocks: pose of the second camera in the first, inverse depth. The
// point is taken times its inverse depth, so that infinity is nothing special. Where a point is
// there, nothing else is known of it, and it would have to go on, its depth is no variable: the
// derivative is zero.
class MatchCost : public ceres::CostFunction {
 public:
  void set(const TwoViewProblem& problem, std::size_t index, const Vec3d& bearing,
           bool keeps_length, bool ends_at_infinity) {
    ends_at_infinity_ = ends_at_infinity;
    camera_ = &problem.second_camera;
    bearing_ = bearing;
    pixel_ = problem.second[index];
    root_ = problem.information.empty() ? 1 : std::sqrt(problem.information[index]);
    keeps_length_ = keeps_length;
    set_num_residuals(2);
    *mutable_parameter_block_sizes() = {7, 1};
  }

  // Whether the point lies before the second camera.
  bool isUsed(const SE3d& pose, double inverse) const {
    return isBefore(*camera_, pointInSecond(pose, inverse));
  }

  bool Evaluate(double const* const* parameters, double* residuals,
                double** jacobians) const override {
    const SE3d pose = loaded<SE3d>(parameters[0]);
    const double inverse = *parameters[1];
    const Vec3d point = pointInSecond(pose, inverse);
    Vec2d pixel{};
    Mat<double, 2, 3> by_point;
    if (!projectEverywhere(*camera_, point, pixel, jacobians != nullptr ? &by_point : nullptr)) {
      return false;
    }
    residuals[0] = root_ * (pixel[0] - pixel_[0]);
    residuals[1] = root_ * (pixel[1] - pixel_[1]);
    if (!areFinite(residuals, 2)) return false;
    if (jacobians == nullptr) return true;
    by_point *= root_;
    if (jacobians[0] != nullptr) setByPose(by_point, point, pose, inverse, jacobians[0]);
    if (jacobians[1] != nullptr) {
      Vec2d by_inverse = by_point * (pose.rotation().inverse() * -pose.translation());
      const double slope = by_inverse[0] * residuals[0] + by_inverse[1] * residuals[1];
      if (ends_at_infinity_ && inverse == 0 && slope > 0) by_inverse = {};
      std::copy(by_inverse.data(), by_inverse.data() + 2, jacobians[1]);
    }
    return true;
  }

 private:
  // Times its inverse depth.
  Vec3d pointInSecond(const SE3d& pose, double inverse) const {
    return pose.rotation().inverse() * (bearing_ - inverse * pose.translation());
  }

  void setByPose(const Mat<double, 2, 3>& by_point, const Vec3d& point, const SE3d& pose,
                 double inverse, double* to) const {
    Mat<double, 2, 6> by_tangent;
    by_tangent.setBlock(0, 0, -inverse * by_point);
    by_tangent.setBlock(0, 3, by_point * SO3d::hat(point));
    std::fill(to, to + 14, 0.0);
    if (keeps_length_) {
      copyRows(by_tangent * FixedLengthManifold::tangentBasis(pose), to);
    } else {
      copyRows(by_tangent, to);
    }
  }

  template <std::size_t C>
  static void copyRows(const Mat<double, 2, C>& from, double* to) {
    for (std::size_t r = 0; r < 2; ++r) {
      for (std::size_t c = 0; c < C; ++c) to[7 * r + c] = from(r, c);
    }
  }

  const Camera* camera_ = nullptr;
  Vec3d bearing_{};
  Vec2d pixel_{};
  double root_ = 1;
  bool keeps_length_ = false;
  bool ends_at_infinity_ = false;
};

class DepthCost : public ceres::CostFunction {
 public:
  void set(double mean, double information) {
    mean_ = mean;
    root_ = std::sqrt(information);
    set_num_residuals(1);
    *mutable_parameter_block_sizes() = {1};
  }
  bool Evaluate(double const* const* parameters, double* residuals,
                double** jacobians) const override {
    residuals[0] = root_ * (*parameters[0] - mean_);
    if (jacobians != nullptr && jacobians[0] != nullptr) jacobians[0][0] = root_;
    return std::isfinite(residuals[0]);
  }

 private:
  double mean_ = 0;
  double root_ = 0;
};

}  // namespace by_ceres
}  // namespace detail
}  // namespace v1
}  // namespace gslam

#endif  // GSLAM_OPTIMIZER_CERES_SRC_MATCH_COST_H
