// How much consensus chance explains.
#ifndef GSLAM_ESTIMATOR_ROBUST_A_CONTRARIO_H
#define GSLAM_ESTIMATOR_ROBUST_A_CONTRARIO_H

#include <cstddef>

namespace gslam {
inline namespace v1 {
namespace detail {

// log10 of n! / (k! (n - k)!), for k <= n.
double log10Binomial(std::size_t n, std::size_t k);

// log10 of the probability that at least k of n independent events of probability p happen.
double log10BinomialTail(std::size_t n, std::size_t k, double p);

// The question: among n matches that have nothing to do with each other, how many models with k or
// more inliers are to be expected (Moisan, Stival, IJCV 57(3), 2004)?
//
// A model through a sample of s matches has these as inliers by construction. Each of the n - s
// others is one with probability `chance`, independently. So the expected number of models through
// samples with k inliers or more is
//     C(n, s) * solutions * P(X >= k - s), X binomial of n - s and chance,
// by linearity of the expectation, however the models depend on each other; and the probability
// that there is even one is below that. All C(n, s) samples count, not only those that were drawn:
// local optimisation moves from the samples drawn towards the best model there is, so what comes
// out is about as good as the best of all samples. `thresholds` multiplies the result, where the
// best of so many thresholds was chosen by looking at the residuals.
struct FalseAlarms {
  std::size_t matches;
  std::size_t sample_size;
  std::size_t solutions;
  double thresholds = 1;

  // log10 of the expected number. At most sample_size inliers: the number of all models.
  double log10Expected(std::size_t inliers, double chance) const;
  // The least inliers with which it is below log10_limit; matches + 1 where none are enough.
  std::size_t fewestInliers(double chance, double log10_limit) const;
};

}  // namespace detail
}  // namespace v1
}  // namespace gslam

#endif  // GSLAM_ESTIMATOR_ROBUST_A_CONTRARIO_H
