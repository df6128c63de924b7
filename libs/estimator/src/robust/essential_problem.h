// Relative poses of calibrated cameras for the robust loop.
#ifndef GSLAM_ESTIMATOR_ROBUST_ESSENTIAL_PROBLEM_H
#define GSLAM_ESTIMATOR_ROBUST_ESSENTIAL_PROBLEM_H

#include <gslam/geometry/mat.h>
#include <gslam/geometry/se3.h>

#include <vector>

#include "robust/epipolar_matches.h"
#include "robust/problem.h"

namespace gslam {
inline namespace v1 {
namespace detail {

// A model is E = [t]x R of T_second_first (9 numbers), R as a quaternion (4), and t of length 1.
// Its delta moves t along two directions at right angles to it, and R by exp() on its right.
class EssentialProblem : public Problem {
 public:
  // @param matches    of calibrated cameras; must stay
  // @param threshold  for what may be behind a camera, because it is that far away
  EssentialProblem(const EpipolarMatches& matches, double threshold)
      : matches_(matches), threshold_(threshold) {}

  std::size_t size() const override { return matches_.size(); }
  std::size_t sampleSize() const override { return 5; }
  std::size_t maxSolutions() const override { return 10; }
  std::size_t dof() const override { return 5; }
  std::size_t residualDimension() const override { return 1; }
  // Five noisy matches may say little of a translation.
  std::size_t goodSamples() const override { return 2; }
  std::size_t solve(const std::uint32_t* sample, ModelNumbers* models) const override;
  void squaredResiduals(const ModelNumbers& model, std::size_t first, std::size_t count,
                        float* squared) const override;
  // Infinite where the point is behind a camera, of the pose of this E that has most in front.
  void exactSquaredResiduals(const ModelNumbers& model, double* squared) const override;
  void squaredResidualsOfPairs(const ModelNumbers& model, std::size_t shift, std::size_t count,
                               double* squared) const override;
  std::size_t placeOf(const ModelNumbers& model, std::size_t i, double* place) const override;
  void accumulate(const ModelNumbers& model, const double* weights, std::size_t count,
                  NormalEquations& sums) const override;
  ModelNumbers retract(const ModelNumbers& model, const double* delta) const override;
  double chance(double threshold) const override { return matches_.chance(threshold); }
  Examination examine(const ModelNumbers& model, const std::uint8_t* inliers,
                      double threshold) const override;

  static SE3d poseOf(const ModelNumbers& model);
  static ModelNumbers modelOf(const SO3d& rotation, const Vec3d& translation);
  // Derivative of the pose's right tangent (translation, rotation) by delta.
  static Mat<double, 6, 5> tangentByDelta(const ModelNumbers& model);
  // Derivative of E by delta.
  static Mat<double, 9, 5> matrixByDelta(const ModelNumbers& model);

  // The one of the four poses with this E that has most of the matches within the threshold in
  // front: a sample with an outlier may have had another one.
  ModelNumbers oriented(const ModelNumbers& model) const;

 private:
  bool isInFront(const Mat3d& rotation, const Vec3d& translation, std::size_t i) const;
  bool examineRotation(const ModelNumbers& model, const std::vector<std::uint32_t>& inliers,
                       double threshold, Examination& result) const;
  void examinePlane(const ModelNumbers& model, const std::vector<std::uint32_t>& inliers,
                    double threshold, Examination& result) const;
  void surveyTranslation(const ModelNumbers& found, const std::uint8_t* inliers, double threshold,
                         Examination& result) const;
  void refinePlane(const std::vector<std::uint32_t>& on_plane, SO3d& rotation, Vec3d& translation,
                   Vec3d& normal) const;
  const EpipolarMatches& matches_;
  double threshold_;
};

// Both R and one t, of length 1, with [t]x R proportional to a matrix; false where there are none.
bool factoriseEssential(const Mat3d& matrix, SO3d (&rotations)[2], Vec3d& translation);

// The other pose and plane of the same homography R + t n^T, t of any length (H. Longuet-Higgins,
// "The reconstruction of a plane surface from two perspective projections", 1986): at most two.
std::size_t otherPosesOfPlane(const SO3d& rotation, const Vec3d& translation, const Vec3d& normal,
                              SE3d (&poses)[2]);

}  // namespace detail
}  // namespace v1
}  // namespace gslam

#endif  // GSLAM_ESTIMATOR_ROBUST_ESSENTIAL_PROBLEM_H
