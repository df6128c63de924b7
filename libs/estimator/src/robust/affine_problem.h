// Affine maps, similarities and rigid transforms between points for the robust loop.
#ifndef GSLAM_ESTIMATOR_ROBUST_AFFINE_PROBLEM_H
#define GSLAM_ESTIMATOR_ROBUST_AFFINE_PROBLEM_H

#include <gslam/base/span.h>
#include <gslam/geometry/mat.h>
#include <gslam/geometry/sim3.h>
#include <gslam/geometry/vec.h>

#include <cstddef>
#include <cstdint>

#include "robust/point_kernels.h"
#include "robust/point_set.h"
#include "robust/problem.h"

namespace gslam {
inline namespace v1 {
namespace detail {

// What x2 = A (x1, 1) has in common for N = 2 and 3, whatever A may be. Inside, points are about
// their middle. A model begins with the N (N + 1) elements of A, row by row.
template <std::size_t N>
class MapProblem : public Problem {
 public:
  static constexpr std::size_t kElements = N * (N + 1);
  using Point = Vec<double, N>;
  using Matrix = Mat<double, N, N + 1>;

  // Sums of weighted squares: the Hessian has the same block, by (x1, 1), for each row of A.
  struct Sums {
    double block[N + 1][N + 1] = {};
    double gradient[kElements] = {};
    double cost = 0;
  };

  MapProblem(Span<const Point> first, Span<const Point> second, const RandomOrder& order);

  std::size_t size() const override { return first_.points.size(); }
  std::size_t maxSolutions() const override { return 1; }
  std::size_t residualDimension() const override { return N; }
  void squaredResiduals(const ModelNumbers& model, std::size_t first, std::size_t count,
                        float* squared) const override;
  void exactSquaredResiduals(const ModelNumbers& model, double* squared) const override;
  void squaredResidualsOfPairs(const ModelNumbers& model, std::size_t shift, std::size_t count,
                               double* squared) const override;
  std::size_t placeOf(const ModelNumbers& model, std::size_t i, double* place) const override;
  double chance(double threshold) const override;
  // Degenerate where the inliers' shape is one of those that do not determine A.
  Examination examine(const ModelNumbers& model, const std::uint8_t* inliers,
                      double threshold) const override;

  // A between the points as they were given.
  Matrix matrixOf(const ModelNumbers& model) const;
  const Point& firstCentre() const { return first_.centre(); }
  const Point& secondCentre() const { return second_.centre(); }

 protected:
  virtual bool isTooFlat(Degeneracy shape) const = 0;
  Sums sumUp(const ModelNumbers& model, const double* weights, std::size_t count) const;
  void gather(const std::uint32_t* sample, Point* first, Point* second) const;

 private:
  PointSet<N> first_, second_;
  const float* columns_[2 * N];
  PointKernels::Squared kernel_;
};

// All affine maps; delta is added to the elements of A.
template <std::size_t N>
class AffineProblem : public MapProblem<N> {
 public:
  using MapProblem<N>::MapProblem;
  std::size_t sampleSize() const override { return N + 1; }
  std::size_t dof() const override { return N * (N + 1); }
  std::size_t solve(const std::uint32_t* sample, ModelNumbers* models) const override;
  void accumulate(const ModelNumbers& model, const double* weights, std::size_t count,
                  NormalEquations& sums) const override;
  ModelNumbers retract(const ModelNumbers& model, const double* delta) const override;

 protected:
  bool isTooFlat(Degeneracy shape) const override { return shape != Degeneracy::None; }
};

// Similarities, delta is the right tangent (translation, rotation, log scale); or rigid transforms,
// whose scale is 1 and stays. After A a model has the quaternion, x y z w.
class SimilarityProblem : public MapProblem<3> {
 public:
  SimilarityProblem(Span<const Vec3d> first, Span<const Vec3d> second, const RandomOrder& order,
                    bool is_rigid)
      : MapProblem<3>(first, second, order), is_rigid_(is_rigid) {}

  std::size_t sampleSize() const override { return 3; }
  std::size_t dof() const override { return is_rigid_ ? 6 : 7; }
  std::size_t solve(const std::uint32_t* sample, ModelNumbers* models) const override;
  void accumulate(const ModelNumbers& model, const double* weights, std::size_t count,
                  NormalEquations& sums) const override;
  ModelNumbers retract(const ModelNumbers& model, const double* delta) const override;

  // Between the points as they were given.
  SIM3d similarityOf(const ModelNumbers& model) const;

 protected:
  // Three points in space lie on a plane and determine it.
  bool isTooFlat(Degeneracy shape) const override {
    return shape == Degeneracy::Collinear || shape == Degeneracy::Coincident;
  }

 private:
  bool is_rigid_;
};

}  // namespace detail
}  // namespace v1
}  // namespace gslam

#endif  // GSLAM_ESTIMATOR_ROBUST_AFFINE_PROBLEM_H
