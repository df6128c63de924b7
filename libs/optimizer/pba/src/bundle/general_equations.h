#ifndef GSLAM_OPTIMIZER_PBA_SRC_BUNDLE_GENERAL_EQUATIONS_H
#define GSLAM_OPTIMIZER_PBA_SRC_BUNDLE_GENERAL_EQUATIONS_H

#include <gslam/base/parallel.h>
#include <gslam/geometry/mat.h>
#include <gslam/geometry/vec.h>
#include <gslam/optimizer/options.h>

#include <cstddef>
#include <vector>

#include "bundle/general_structure.h"

// The normal equations of a bundle, and their Schur complement:
//
//     [ H  W^T ] [ x ]     [ g ]        S = H - W^T V^-1 W
//     [ W  V   ] [ y ] = - [ h ]
//
// H, g and x of poses, extrinsics and intrinsics; V, h and y of points; V is block-diagonal. Robust
// losses enter as weights rho'(s) of the residuals (iteratively reweighted least squares).

namespace gslam {
inline namespace v1 {
namespace detail {
namespace pba {

// Inverse of a symmetric, positive semi-definite matrix; directions without information (pivots
// that vanish within rounding) are left where they are. Returns the number of the others.
std::size_t invertPointMatrix(const Mat3d& v, Mat3d& inverse);

class GeneralEquations {
 public:
  // Keeps references.
  GeneralEquations(const BundleProblem& problem, const GeneralStructure& structure,
                   const RobustLoss& loss, unsigned threads);

  // Both give the cost; NaN where an observation is not seen. Same values, same bits.
  double linearize(const BundleValues& values);
  double cost(const BundleValues& values);
  // After linearize(): takes the inverse distances out of the equations that have come to their
  // end, and whose gradient leads beyond it.
  void holdFarthest(const BundleValues& values);
  // Observations with a weight of at least a half.
  std::size_t inliers(const BundleValues& values) const;

  // Adds damping times the diagonal to H and V, inverts V, and makes the right side. S is made
  // whole, or its diagonal blocks alone, for which GeneralFill::Unreduced is enough.
  void eliminate(double damping, bool only_diagonal);
  // y = S x by way of the points, after eliminate().
  void multiply(const double* x, double* y);
  // The same by S itself, after it was made whole.
  void multiplyReduced(const double* x, double* y) { multiplyPattern(reduced_, x, y); }
  // Steps of all points (three each, in the order of the problem) after those of the blocks.
  void substitute(const double* step, double* point_step) const;

  const std::vector<double>& hessian() const { return hessian_; }  // without damping
  const std::vector<double>& gradient() const { return gradient_; }
  const std::vector<double>& reduced() const { return reduced_; }
  const std::vector<double>& rightSide() const { return right_; }
  const double* coupling(std::size_t entry) const {
    return &coupling_[structure_.groups.entry_offset[entry]];
  }
  const Mat3d& pointHessian(std::size_t group) const { return point_hessian_[group]; }
  const Vec3d& pointGradient(std::size_t group) const { return point_gradient_[group]; }
  const Mat3d& pointInverse(std::size_t group) const { return point_inverse_[group]; }

  double diagonal(std::size_t row) const { return diagonal_[row]; }  // of H, bounded
  static double bounded(double diagonal);

 private:
  double linearizeGroup(const BundleValues& values, std::size_t group, double* hessian,
                        double* gradient);
  void addPriors(const BundleValues& values);
  double priorCost(const BundleValues& values) const;
  void multiplyPattern(const std::vector<double>& values, const double* x, double* y);
  void sumParts(const std::vector<double>& parts, double* sum, std::size_t size) const;
  void eliminateChunk(std::size_t chunk, bool only_diagonal, double* reduced, double* right);
  template <class Body>
  void forEachChunk(const Body& body) const;

  const BundleProblem& problem_;
  const GeneralStructure& structure_;
  const RobustLoss loss_;
  const ParallelOptions parallel_;
  const std::size_t rows_;  // of an observation
  double damping_ = 0;
  std::vector<double> hessian_, gradient_, diagonal_, coupling_;
  std::vector<Mat3d> point_hessian_, point_inverse_;
  std::vector<Vec3d> point_gradient_;
  std::vector<double> reduced_, right_;
  std::vector<double> parts_, vector_parts_;  // of each chunk
  std::vector<double> row_parts_;             // of each chunk of rows
  std::vector<double> costs_;                 // of each chunk
};

}  // namespace pba
}  // namespace detail
}  // namespace v1
}  // namespace gslam

#endif  // GSLAM_OPTIMIZER_PBA_SRC_BUNDLE_GENERAL_EQUATIONS_H
