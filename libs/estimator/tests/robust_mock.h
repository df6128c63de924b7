// The simplest problem: lines through points of the plane.
#ifndef GSLAM_ESTIMATOR_TESTS_ROBUST_MOCK_H
#define GSLAM_ESTIMATOR_TESTS_ROBUST_MOCK_H

#include <gslam/geometry/random.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <random>
#include <vector>

#include "robust/problem.h"
#include "robust/random_order.h"

namespace robust_test {

using gslam::Vec2d;

/// Points of which some lie on the line cos(angle) x + sin(angle) y = distance, with noise, and the
/// others anywhere from 0 to 100.
struct LineData {
  double angle = 0, distance = 0;
  std::vector<Vec2d> points;
  std::vector<std::uint8_t> is_inlier;

  LineData(std::mt19937& generator, std::size_t count, double outliers, double noise) {
    angle = gslam::randomUniform(generator, 0.3, 1.2);
    distance = gslam::randomUniform(generator, 40.0, 70.0);
    const Vec2d n = {std::cos(angle), std::sin(angle)}, along = {-n[1], n[0]};
    for (std::size_t i = 0; i < count; ++i) {
      const bool outlier = gslam::randomUniform(generator, 0.0, 1.0) < outliers;
      is_inlier.push_back(outlier ? 0 : 1);
      points.push_back({gslam::randomUniform(generator, 0.0, 100.0),
                        gslam::randomUniform(generator, 0.0, 100.0)});
      if (outlier) continue;
      const double offset = noise * gslam::randomNormal<double, 1>(generator)[0];
      points.back() =
          (distance + offset) * n + gslam::randomUniform(generator, -30.0, 30.0) * along;
    }
  }
};

/// A model is (angle, distance).
class LineProblem : public gslam::detail::Problem {
 public:
  using ModelNumbers = gslam::detail::ModelNumbers;

  LineProblem(const std::vector<Vec2d>& points, const gslam::detail::RandomOrder& order) {
    for (const std::uint32_t i : order) points_.push_back(points[i]);
  }

  std::size_t size() const override { return points_.size(); }
  std::size_t sampleSize() const override { return 2; }
  std::size_t maxSolutions() const override { return 1; }
  std::size_t dof() const override { return 2; }
  std::size_t residualDimension() const override { return 1; }

  std::size_t solve(const std::uint32_t* sample, ModelNumbers* models) const override {
    const Vec2d& a = points_[sample[0]];
    const Vec2d d = points_[sample[1]] - a;
    if (!(d.norm() > 0)) return 0;
    const double angle = std::atan2(d[0], -d[1]);
    models[0] = ModelNumbers{{angle, std::cos(angle) * a[0] + std::sin(angle) * a[1]}};
    return 1;
  }

  void squaredResiduals(const ModelNumbers& model, std::size_t first, std::size_t count,
                        float* squared) const override {
    const double c = std::cos(model[0]), s = std::sin(model[0]);
    for (std::size_t i = 0; i < count; ++i) {
      const Vec2d& p = points_[first + i];
      const double r = c * p[0] + s * p[1] - model[1];
      squared[i] = static_cast<float>(r * r);
    }
  }

  void exactSquaredResiduals(const ModelNumbers& model, double* squared) const override {
    for (std::size_t i = 0; i < size(); ++i) {
      const double r = std::cos(model[0]) * points_[i][0] + std::sin(model[0]) * points_[i][1];
      squared[i] = (r - model[1]) * (r - model[1]);
    }
  }

  // Of pairs: from a line of any direction through the first point.
  void squaredResidualsOfPairs(const ModelNumbers&, std::size_t shift, std::size_t count,
                               double* squared) const override {
    for (std::size_t i = 0; i < count; ++i) {
      const double angle = 0.1 * static_cast<double>((i + 7 * shift) % 31);
      const Vec2d d = points_[(i + shift) % size()] - points_[i];
      const double r = std::cos(angle) * d[0] + std::sin(angle) * d[1];
      squared[i] = r * r;
    }
  }

  std::size_t placeOf(const ModelNumbers&, std::size_t i, double* place) const override {
    place[0] = points_[i][0], place[1] = points_[i][1];
    return 2;
  }

  void accumulate(const ModelNumbers& model, const double* weights, std::size_t count,
                  gslam::detail::NormalEquations& sums) const override {
    const double c = std::cos(model[0]), s = std::sin(model[0]);
    for (std::size_t i = 0; i < count; ++i) {
      if (!(weights[i] > 0)) continue;
      const Vec2d& p = points_[i];
      const double r = c * p[0] + s * p[1] - model[1];
      const double row[2] = {-s * p[0] + c * p[1], -1};
      for (std::size_t k = 0; k < 2; ++k) {
        for (std::size_t l = k; l < 2; ++l) {
          sums.hessian[k * gslam::detail::kMaxDof + l] += weights[i] * row[k] * row[l];
        }
        sums.gradient[k] += weights[i] * row[k] * r;
      }
      sums.cost += weights[i] * r * r;
    }
  }

  ModelNumbers retract(const ModelNumbers& model, const double* delta) const override {
    return ModelNumbers{{model[0] + delta[0], model[1] + delta[1]}};
  }

  double chance(double threshold) const override {
    return std::min(1.0, 2 * std::sqrt(2.0) * threshold / 100);
  }

 protected:
  std::vector<Vec2d> points_;
};

/// How far a model is from a line, the sign of its normal aside.
inline double lineError(const gslam::detail::ModelNumbers& model, double angle, double distance) {
  const double same = std::cos(model[0] - angle) < 0 ? -1 : 1;
  return std::fabs(std::sin(model[0] - angle)) + std::fabs(same * model[1] - distance) / 100;
}

}  // namespace robust_test

#endif  // GSLAM_ESTIMATOR_TESTS_ROBUST_MOCK_H
