// What problems ask of models when they examine them.
#ifndef GSLAM_ESTIMATOR_ROBUST_EXAMINATION_H
#define GSLAM_ESTIMATOR_ROBUST_EXAMINATION_H

#include <cstdint>
#include <vector>

#include "robust/problem.h"

namespace gslam {
inline namespace v1 {
namespace detail {

// Radians. What is known no better than that is not known.
constexpr double kLargestRotationSigma = 0.1;

// Models are as good as each other up to this difference of squared residuals, in variances: three
// sigmas and a few matches at the threshold.
constexpr double kAsGood = 12;

// The matches whose byte is not 0.
std::vector<std::uint32_t> indicesOf(const std::uint8_t* inliers, std::size_t size);

// Sum of squared residuals, each cut off at the threshold.
double truncatedCost(const Problem& problem, const ModelNumbers& model, double threshold);

// Whether matches that a special model (a plane, a turn, a line) leaves over are more than chance
// explains, and so determine what that model leaves open. count: all matches that it leaves over;
// agreeing: those of them that fit the general model; sample: as many as that takes beside the
// special one; probability: of one to fit by chance.
bool isBeyondChance(std::size_t count, std::size_t agreeing, std::size_t sample,
                    double probability);

// Covariance of retract()'s delta, rows of kMaxDof columns, from the residuals of the matches
// whose weight is positive. False where it has none.
bool covarianceOf(const Problem& problem, const std::vector<double>& weights,
                  const ModelNumbers& model, std::array<double, kMaxDof * kMaxDof>& covariance);

// By how much the covariance of one-dimensional residuals that are cut off at a threshold exceeds
// that from those within it: fewer of them, and a cost that is flatter, since matches come and go
// at the threshold (the asymptotic variance of Huber's M-estimators, of normal noise).
// @param ratio  of their mean square to the square of the threshold
double cutOffFactor(double ratio);

// Largest eigenvalue of the block of `size` rows and columns from `first` on.
double largestVariance(const std::array<double, kMaxDof * kMaxDof>& covariance, std::size_t first,
                       std::size_t size);

}  // namespace detail
}  // namespace v1
}  // namespace gslam

#endif  // GSLAM_ESTIMATOR_ROBUST_EXAMINATION_H
