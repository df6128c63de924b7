#ifndef GSLAM_OPTIMIZER_SRC_FACTORS_LOSS_H
#define GSLAM_OPTIMIZER_SRC_FACTORS_LOSS_H

#include <gslam/optimizer/options.h>

#include <cmath>

namespace gslam {
inline namespace v1 {
namespace detail {

// rho(s) and its first two derivatives by s, the squared norm of a whitened residual.
struct LossValue {
  double rho;
  double first;   // the weight of the residual in the normal equations
  double second;  // not positive
};

inline LossValue lossAt(const RobustLoss& loss, double s) noexcept {
  const double a2 = loss.scale * loss.scale;
  switch (loss.kind) {
    case LossKind::Huber: {
      if (s <= a2) return {s, 1, 0};
      const double root = std::sqrt(s);
      return {2 * loss.scale * root - a2, loss.scale / root, -loss.scale / (2 * s * root)};
    }
    case LossKind::Cauchy: {
      const double u = 1 / (1 + s / a2);
      return {a2 * std::log1p(s / a2), u, -u * u / a2};
    }
    case LossKind::Tukey: {
      if (s >= a2) return {a2 / 3, 0, 0};
      const double u = 1 - s / a2;
      return {a2 / 3 * (1 - u * u * u), u * u, -2 * u / a2};
    }
    case LossKind::GemanMcClure: {
      const double u = a2 / (a2 + s);
      return {u * s, u * u, -2 * u * u * u / a2};
    }
    case LossKind::Squared:
      break;
  }
  return {s, 1, 0};
}

}  // namespace detail
}  // namespace v1
}  // namespace gslam

#endif  // GSLAM_OPTIMIZER_SRC_FACTORS_LOSS_H
