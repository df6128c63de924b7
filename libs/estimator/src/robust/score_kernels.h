// Sums over squared residuals, in SIMD variants that give the same bits.
#ifndef GSLAM_ESTIMATOR_ROBUST_SCORE_KERNELS_H
#define GSLAM_ESTIMATOR_ROBUST_SCORE_KERNELS_H

#include <gslam/base/simd.h>

#include <cstddef>

namespace gslam {
inline namespace v1 {
namespace detail {

// Residuals of one call at most, so that sums in float stay exact enough.
constexpr std::size_t kScoreBlock = 256;

// u = r^2 / (2 sigma^2) beyond which MAGSAC's loss is flat: half the square of the 0.99 quantile
// of the chi distribution with 3 degrees of freedom.
constexpr float kMagsacEnd = 5.6724334f;
constexpr float kMagsacFloor = 0.0034394856f;  // exp(-kMagsacEnd)

// Each gives a sum over `count` squared residuals, at most kScoreBlock; NaN counts as infinite.
// Additions are in sixteen lanes in every variant.
struct ScoreKernels {
  using Sum = double (*)(const float* squared, std::size_t count, float limit);
  using Kernel = SimdKernel<Sum>;
  static const Kernel& truncated();  // min(r^2, limit)
  static const Kernel& above();      // number of those that are not at most limit
  // MAGSAC++'s loss (Barath et al., CVPR 2020, equation 7) with residuals of three degrees of
  // freedom, where it has a closed form: (1 - exp(-u) - u exp(-end)) / its value at the end, of
  // u = min(r^2 / limit, 1) end. The same to the last bits of exp() in other variants.
  static const Kernel& magsac();
};

// The derivative of MAGSAC's loss by u, not normalised: the weight of a match. u in [0, end].
double magsacWeight(double squared, double limit);
// The loss itself, in double.
double magsacLoss(double squared, double limit);

}  // namespace detail
}  // namespace v1
}  // namespace gslam

#endif  // GSLAM_ESTIMATOR_ROBUST_SCORE_KERNELS_H
