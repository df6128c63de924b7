// Models fitted to their inliers.
#ifndef GSLAM_ESTIMATOR_ROBUST_REFINER_H
#define GSLAM_ESTIMATOR_ROBUST_REFINER_H

#include <gslam/estimator/options.h>

#include <cstddef>
#include <vector>

#include "robust/problem.h"

namespace gslam {
inline namespace v1 {
namespace detail {

// Not for several threads at once: it keeps its buffers.
class Refiner {
 public:
  // threshold: beyond it a match has no weight. soft: Magsac's weights within, else all alike.
  Refiner(const Problem& problem, bool soft) : problem_(problem), soft_(soft) {}

  // A few steps on about kLocalInliers inliers: the local optimisation of LO-RANSAC (Chum, Matas,
  // Kittler, DAGM 2003). inliers: about how many there are. The best model on the way.
  ModelNumbers improve(const ModelNumbers& model, double threshold, std::size_t inliers);

  // Fits to the inliers and takes those of the new model until they stay: a minimum of the
  // truncated cost. Always the same one for the same set of matches, as far as that has one only.
  ModelNumbers converge(const ModelNumbers& model, double threshold);

 private:
  double weigh(double limit, std::size_t count);
  ModelNumbers convergeSoft(const ModelNumbers& model, double limit);
  ModelNumbers convergeHard(const ModelNumbers& model, double limit);

  const Problem& problem_;
  bool soft_;
  std::vector<float> squared_;
  std::vector<double> exact_;
  std::vector<double> weights_;
};

}  // namespace detail
}  // namespace v1
}  // namespace gslam

#endif  // GSLAM_ESTIMATOR_ROBUST_REFINER_H
