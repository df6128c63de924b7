// Planes through points for the robust loop.
#ifndef GSLAM_ESTIMATOR_ROBUST_PLANE_PROBLEM_H
#define GSLAM_ESTIMATOR_ROBUST_PLANE_PROBLEM_H

#include <gslam/base/span.h>
#include <gslam/geometry/mat.h>
#include <gslam/geometry/vec.h>

#include <cstddef>
#include <cstdint>

#include "robust/point_kernels.h"
#include "robust/point_set.h"
#include "robust/problem.h"

namespace gslam {
inline namespace v1 {
namespace detail {

// A model is (n, d) with n x + d = 0 and |n| = 1, x about the middle; delta are two turns of n
// towards the tangents of tangentsOf(), and a change of d.
class PlaneProblem : public Problem {
 public:
  PlaneProblem(Span<const Vec3d> points, const RandomOrder& order);

  std::size_t size() const override { return points_.points.size(); }
  std::size_t sampleSize() const override { return 3; }
  std::size_t maxSolutions() const override { return 1; }
  std::size_t dof() const override { return 3; }
  std::size_t residualDimension() const override { return 1; }
  std::size_t solve(const std::uint32_t* sample, ModelNumbers* models) const override;
  void squaredResiduals(const ModelNumbers& model, std::size_t first, std::size_t count,
                        float* squared) const override;
  void exactSquaredResiduals(const ModelNumbers& model, double* squared) const override;
  // Of pairs: how far the second point is from a plane of any direction through the first one. (A
  // parallel one might be another plane of the scene, such as a ceiling.)
  void squaredResidualsOfPairs(const ModelNumbers& model, std::size_t shift, std::size_t count,
                               double* squared) const override;
  std::size_t placeOf(const ModelNumbers& model, std::size_t i, double* place) const override;
  void accumulate(const ModelNumbers& model, const double* weights, std::size_t count,
                  NormalEquations& sums) const override;
  ModelNumbers retract(const ModelNumbers& model, const double* delta) const override;
  // The thickest slab of twice the threshold in a cube as long as the points' box is: a box would
  // make the plane of a floor a matter of course.
  double chance(double threshold) const override;
  Examination examine(const ModelNumbers& model, const std::uint8_t* inliers,
                      double threshold) const override;

  // (n, d) of the points as they were given, and its derivative by delta.
  Vec4d planeOf(const ModelNumbers& model, Mat<double, 4, 3>* by_delta) const;

 private:
  PointSet<3> points_;
  double length_;
  const float* columns_[3];
  PointKernels::Squared kernel_;
};

}  // namespace detail
}  // namespace v1
}  // namespace gslam

#endif  // GSLAM_ESTIMATOR_ROBUST_PLANE_PROBLEM_H
