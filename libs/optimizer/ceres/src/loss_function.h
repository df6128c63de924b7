#ifndef GSLAM_OPTIMIZER_CERES_SRC_LOSS_FUNCTION_H
#define GSLAM_OPTIMIZER_CERES_SRC_LOSS_FUNCTION_H

#include <ceres/loss_function.h>
#include <factors/loss.h>

namespace gslam {
inline namespace v1 {
namespace detail {
namespace by_ceres {

// One for all residuals. As rho'' is nowhere positive, Ceres weights residuals by rho' and leaves
// its second-order correction out.
class SharedLoss : public ceres::LossFunction {
 public:
  explicit SharedLoss(const RobustLoss& loss) : loss_(loss) {}
  void Evaluate(double s, double rho[3]) const override {
    const LossValue value = lossAt(loss_, s);
    rho[0] = value.rho;
    rho[1] = value.first;
    rho[2] = value.second;
  }
  // What Ceres is to be given: nothing for squares.
  SharedLoss* orNull() { return loss_.kind == LossKind::Squared ? nullptr : this; }
  bool isSquared() const { return loss_.kind == LossKind::Squared; }
  // Whether a whitened residual of this squared norm counts as an inlier.
  bool isInlier(double s) const { return lossAt(loss_, s).first >= 0.5; }

 private:
  RobustLoss loss_;
};

}  // namespace by_ceres
}  // namespace detail
}  // namespace v1
}  // namespace gslam

#endif  // GSLAM_OPTIMIZER_CERES_SRC_LOSS_FUNCTION_H
