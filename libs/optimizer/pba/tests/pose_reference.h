// The cost of a pose and its normal equations from the plain factor, one observation after the
// other, in long double.
#ifndef GSLAM_OPTIMIZER_PBA_TESTS_POSE_REFERENCE_H
#define GSLAM_OPTIMIZER_PBA_TESTS_POSE_REFERENCE_H

#include <gslam/optimizer/pose_problem.h>

#include <cstddef>
#include <limits>
#include <string>

#include "factors/loss.h"
#include "factors/reprojection.h"

namespace pose_reference {

// Plain arrays: without optimisation Eigen takes minutes.
struct Value {
  long double cost = 0;
  long double hessian[6][6] = {};
  long double gradient[6] = {};
  std::size_t seen = 0;
  std::size_t inliers = 0;

  void addRow(const long double (&row)[6], long double weight, long double pull) {
    for (std::size_t i = 0; i < 6; ++i) {
      for (std::size_t j = 0; j < 6; ++j) hessian[i][j] += weight * row[i] * row[j];
      gradient[i] += pull * row[i];
    }
  }
};

/// bend: 0 for weights alone, 2 for the second derivative of the loss.
inline Value at(const gslam::PoseProblem& problem, const gslam::SE3d& start,
                const gslam::SE3d& pose, const gslam::RobustLoss& loss, double bend) {
  using gslam::SE3d;
  using gslam::Vec3d;
  Value value;
  for (std::size_t i = 0; i < problem.points.size(); ++i) {
    const std::size_t c = problem.camera_of.empty() ? 0 : problem.camera_of[i];
    const SE3d extrinsic = problem.T_body_camera.empty() ? SE3d() : problem.T_body_camera[c];
    const gslam::Camera& camera = problem.cameras[c];
    const std::string name = camera.modelName();
    const auto isBefore = [&](const SE3d& T) {
      const Vec3d p = (T * extrinsic).inverse() * problem.points[i];
      gslam::Vec2d pixel{};
      return name == "pinhole" || name == "radtan" ? p[2] > 0 : camera.project(p, pixel);
    };
    if (!isBefore(start)) continue;
    ++value.seen;
    gslam::detail::ReprojectionObservation observation;
    observation.pixel = problem.pixels[i];
    if (!problem.right_u.empty() && !std::isnan(problem.right_u[i])) {
      observation.has_right = true;
      observation.right_u = problem.right_u[i];
      observation.baseline = problem.baseline;
    }
    Vec3d r{};
    gslam::detail::ReprojectionJacobians jacobians;
    if (!gslam::detail::reprojectionResidual(pose, extrinsic, camera, problem.points[i],
                                             observation, r, &jacobians)) {
      value.cost = std::numeric_limits<long double>::infinity();
      continue;
    }
    const double w = problem.information.empty() ? 1 : problem.information[i];
    const gslam::detail::LossValue at = gslam::detail::lossAt(loss, w * r.squaredNorm());
    value.cost += 0.5L * at.rho;
    if (at.first >= 0.5 && isBefore(pose)) ++value.inliers;
    long double pulled[6] = {};
    for (std::size_t k = 0; k < (observation.has_right ? 3u : 2u); ++k) {
      long double row[6];
      for (std::size_t j = 0; j < 6; ++j) {
        row[j] = jacobians.by_pose(k, j);
        pulled[j] += w * r[k] * row[j];
      }
      value.addRow(row, w * at.first, w * at.first * r[k]);
    }
    value.addRow(pulled, bend * at.second, 0);
  }
  if (problem.prior != nullptr) {
    const SE3d::Tangent r = (problem.prior->pose.inverse() * pose).log();
    const gslam::Mat<double, 6, 6> j = SE3d::rightJacobianInverse(r);
    for (std::size_t a = 0; a < 6; ++a) {
      for (std::size_t b = 0; b < 6; ++b) {
        const long double weight = problem.prior->information(a, b);
        value.cost += 0.5L * weight * r[a] * r[b];
        for (std::size_t k = 0; k < 6; ++k) {
          value.gradient[k] += j(a, k) * weight * r[b];
          for (std::size_t l = 0; l < 6; ++l) value.hessian[k][l] += j(a, k) * weight * j(b, l);
        }
      }
    }
  }
  return value;
}

/// The inverse of a matrix that is positive definite; false where it is not.
inline bool invert(const long double (&matrix)[6][6], long double (&inverse)[6][6]) {
  long double a[6][12] = {};
  for (std::size_t i = 0; i < 6; ++i) {
    for (std::size_t j = 0; j < 6; ++j) a[i][j] = matrix[i][j];
    a[i][6 + i] = 1;
  }
  for (std::size_t p = 0; p < 6; ++p) {
    if (!(a[p][p] > 0)) return false;
    for (std::size_t i = 0; i < 6; ++i) {
      const long double factor = i == p ? 1 - 1 / a[p][p] : a[i][p] / a[p][p];
      for (std::size_t j = p; j < 12; ++j) a[i][j] -= factor * a[p][j];
    }
  }
  for (std::size_t i = 0; i < 6; ++i) {
    for (std::size_t j = 0; j < 6; ++j) inverse[i][j] = a[i][6 + j];
  }
  return true;
}

/// How far the cost is above the minimum nearby: half of g^T H^-1 g. Infinite where H, with the
/// second derivative of the loss, is not that of a minimum.
inline long double aboveMinimum(const Value& full) {
  long double inverse[6][6], sum = 0;
  if (!invert(full.hessian, inverse)) return std::numeric_limits<long double>::infinity();
  for (std::size_t i = 0; i < 6; ++i) {
    for (std::size_t j = 0; j < 6; ++j) sum += full.gradient[i] * inverse[i][j] * full.gradient[j];
  }
  return sum / 2;
}

}  // namespace pose_reference

#endif  // GSLAM_OPTIMIZER_PBA_TESTS_POSE_REFERENCE_H
