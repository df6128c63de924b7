// Fundamental matrices for the robust loop.
#ifndef GSLAM_ESTIMATOR_ROBUST_FUNDAMENTAL_PROBLEM_H
#define GSLAM_ESTIMATOR_ROBUST_FUNDAMENTAL_PROBLEM_H

#include <gslam/geometry/mat.h>

#include <vector>

#include "robust/epipolar_matches.h"
#include "robust/problem.h"

namespace gslam {
inline namespace v1 {
namespace detail {

// A model is the nine elements of F between the coordinates of the matches, of norm 1 and rank 2;
// its delta moves along an orthonormal basis of that surface's tangents.
class FundamentalProblem : public Problem {
 public:
  // @param matches  of EpipolarMatches::fromPoints(); must stay
  explicit FundamentalProblem(const EpipolarMatches& matches) : matches_(matches) {}

  std::size_t size() const override { return matches_.size(); }
  std::size_t sampleSize() const override { return 7; }
  std::size_t maxSolutions() const override { return 3; }
  std::size_t dof() const override { return 7; }
  std::size_t residualDimension() const override { return 1; }
  std::size_t solve(const std::uint32_t* sample, ModelNumbers* models) const override;
  void squaredResiduals(const ModelNumbers& model, std::size_t first, std::size_t count,
                        float* squared) const override;
  void exactSquaredResiduals(const ModelNumbers& model, double* squared) const override;
  void squaredResidualsOfPairs(const ModelNumbers& model, std::size_t shift, std::size_t count,
                               double* squared) const override;
  std::size_t placeOf(const ModelNumbers& model, std::size_t i, double* place) const override;
  void accumulate(const ModelNumbers& model, const double* weights, std::size_t count,
                  NormalEquations& sums) const override;
  ModelNumbers retract(const ModelNumbers& model, const double* delta) const override;
  double chance(double threshold) const override { return matches_.chance(threshold); }
  std::size_t propose(const ModelNumbers& model, const std::uint32_t* sample,
                      const std::uint8_t* inliers, double threshold,
                      ModelNumbers* models) const override;
  Examination examine(const ModelNumbers& model, const std::uint8_t* inliers,
                      double threshold) const override;

  // F between pixels, of norm 1, and its derivative by delta.
  Mat3d pixelMatrix(const ModelNumbers& model, Mat<double, 9, 7>* by_delta = nullptr) const;

 private:
  std::size_t parallaxModels(const Mat3d& homography, const Mat3d& inverse, double threshold,
                             std::size_t most, ModelNumbers* models) const;
  const EpipolarMatches& matches_;
};

// Orthonormal tangents, in columns, of the surface of matrices of norm 1 and rank 2.
Mat<double, 9, 7> rankTwoTangents(const double* f);
// The matrix of rank 2 and norm 1 nearby.
bool toRankTwo(double* f);

}  // namespace detail
}  // namespace v1
}  // namespace gslam

#endif  // GSLAM_ESTIMATOR_ROBUST_FUNDAMENTAL_PROBLEM_H
