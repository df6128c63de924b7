// Homographies for the robust loop.
#ifndef GSLAM_ESTIMATOR_ROBUST_HOMOGRAPHY_PROBLEM_H
#define GSLAM_ESTIMATOR_ROBUST_HOMOGRAPHY_PROBLEM_H

#include <gslam/base/span.h>
#include <gslam/geometry/camera.h>
#include <gslam/geometry/mat.h>
#include <gslam/geometry/vec.h>

#include <cstddef>
#include <cstdint>
#include <vector>

#include "robust/point_kernels.h"
#include "robust/point_set.h"
#include "robust/problem.h"

namespace gslam {
inline namespace v1 {
namespace detail {

// A model is the nine elements of H, norm 1, positive depth; delta moves along an orthonormal basis
// of the tangents of the unit sphere.
class HomographyProblem : public Problem {
 public:
  std::size_t sampleSize() const override { return 4; }
  std::size_t maxSolutions() const override { return 1; }
  std::size_t dof() const override { return 8; }
  std::size_t residualDimension() const override { return 2; }
  ModelNumbers retract(const ModelNumbers& model, const double* delta) const override;

 protected:
  // Adds J^T J by the nine elements, upper triangle, as by delta.
  static void project(const ModelNumbers& model, const double* hessian, const double* gradient,
                      NormalEquations& sums);
};

// Orthonormal tangents of the unit sphere at h, in columns.
Mat<double, 9, 8> sphereTangents(const double* h);

// Between points of two planes. Inside, points are about their middle and of size 1.
class PlaneHomographyProblem : public HomographyProblem {
 public:
  PlaneHomographyProblem(Span<const Vec2d> first, Span<const Vec2d> second,
                         const RandomOrder& order);

  std::size_t size() const override { return first_.points.size(); }
  std::size_t solve(const std::uint32_t* sample, ModelNumbers* models) const override;
  void squaredResiduals(const ModelNumbers& model, std::size_t first, std::size_t count,
                        float* squared) const override;
  void exactSquaredResiduals(const ModelNumbers& model, double* squared) const override;
  void squaredResidualsOfPairs(const ModelNumbers& model, std::size_t shift, std::size_t count,
                               double* squared) const override;
  std::size_t placeOf(const ModelNumbers& model, std::size_t i, double* place) const override;
  void accumulate(const ModelNumbers& model, const double* weights, std::size_t count,
                  NormalEquations& sums) const override;
  double chance(double threshold) const override;
  Examination examine(const ModelNumbers& model, const std::uint8_t* inliers,
                      double threshold) const override;

  // H between the points as they were given, of norm 1; its derivative by delta.
  Mat3d matrixOf(const ModelNumbers& model, Mat<double, 9, 8>* by_delta) const;

 private:
  PointSet<2> first_, second_;
  double scale1_, scale2_;
  const float* columns_[4];
  PointKernels::Squared kernel_;
};

// Between bearings, with residuals in pixels of the second camera: its projection, made linear at
// the pixel that was observed.
class BearingHomographyProblem : public HomographyProblem {
 public:
  struct Match {
    Vec3d first, second;         // bearings
    Mat<double, 2, 3> by_point;  // d pixel / d point at the second bearing
  };
  // image: its size, pixels.
  BearingHomographyProblem(std::vector<Match> matches, const Vec2d& image);

  std::size_t size() const override { return matches_.size(); }
  std::size_t solve(const std::uint32_t* sample, ModelNumbers* models) const override;
  void squaredResiduals(const ModelNumbers& model, std::size_t first, std::size_t count,
                        float* squared) const override;
  void exactSquaredResiduals(const ModelNumbers& model, double* squared) const override;
  void squaredResidualsOfPairs(const ModelNumbers& model, std::size_t shift, std::size_t count,
                               double* squared) const override;
  std::size_t placeOf(const ModelNumbers& model, std::size_t i, double* place) const override;
  void accumulate(const ModelNumbers& model, const double* weights, std::size_t count,
                  NormalEquations& sums) const override;
  double chance(double threshold) const override;
  Examination examine(const ModelNumbers& model, const std::uint8_t* inliers,
                      double threshold) const override;

 private:
  std::vector<Match> matches_;
  Vec2d image_;
  std::vector<float> numbers_;
  const float* columns_[12];
  PointKernels::Squared kernel_;
};

}  // namespace detail
}  // namespace v1
}  // namespace gslam

#endif  // GSLAM_ESTIMATOR_ROBUST_HOMOGRAPHY_PROBLEM_H
