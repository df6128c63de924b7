#ifndef GSLAM_OPTIMIZER_CERES_SRC_PLAIN_COST_H
#define GSLAM_OPTIMIZER_CERES_SRC_PLAIN_COST_H

#include <ceres/cost_function.h>

#include <cstddef>

#include "observation_cost.h"

// The observations that most bundles are made of.

namespace gslam {
inline namespace v1 {
namespace detail {
namespace by_ceres {

// Whether PlainCost can stand for an observation: pose and point x, y, z are variables, the image
// is a single one of a pinhole camera with at most five coefficients that is fixed to the body.
bool isPlain(const BundleVariables& variables, std::size_t index, const ObservationBlocks& blocks);

// ObservationCost for these, at the cost of what one would write by hand for the problem.
class PlainCost : public ceres::CostFunction {
 public:
  void set(const BundleVariables& variables, std::size_t index, const ObservationBlocks& blocks);
  bool Evaluate(double const* const* parameters, double* residuals,
                double** jacobians) const override;

 private:
  struct Seen;
  bool see(const double* pose, const double* x, bool wants_slope, Seen& seen) const;
  void setByPoseAndPoint(const Seen& seen, double* by_pose, double* by_point) const;
  void setByLens(const Seen& seen, double* to, std::size_t stride) const;

  const PlainLens* lens_ = nullptr;
  Vec2d pixel_{};
  const Vec3d* information_ = nullptr;  // null: 1
  int pose_size_ = 0;
};

}  // namespace by_ceres
}  // namespace detail
}  // namespace v1
}  // namespace gslam

#endif  // GSLAM_OPTIMIZER_CERES_SRC_PLAIN_COST_H
