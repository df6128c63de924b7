// What a consensus is worth: what chance looks like in these very matches, and which of them say
// the same.
#ifndef GSLAM_ESTIMATOR_ROBUST_EVIDENCE_H
#define GSLAM_ESTIMATOR_ROBUST_EVIDENCE_H

#include <cstddef>
#include <cstdint>
#include <vector>

#include "robust/problem.h"

namespace gslam {
inline namespace v1 {
namespace detail {

// Number of places, where a place is a cell of the size of `cell` in all that was observed of a
// match (Problem::placeOf()); a cell of 0: where all numbers are equal.
struct DistinctCount {
  std::size_t matches = 0;
  std::size_t inliers = 0;
};

DistinctCount countDistinct(const Problem& problem, const ModelNumbers& model, double cell,
                            const std::uint8_t* inliers);

// 1 / (inliers at the same place) of each inlier, and 0 of others; the number of places.
std::size_t weighDistinct(const Problem& problem, const ModelNumbers& model,
                          const std::uint8_t* inliers, std::vector<double>& weights);

// The part of pairs that are no matches which lie within the threshold all the same. Looks at some
// hundred pairs, and at up to 20'000 until is_enough(an upper bound of it) says so. Problem::chance
// takes observations to be spread evenly; this takes them as they are, clustered or on lines.
class ShuffledPairs {
 public:
  ShuffledPairs(const Problem& problem, const ModelNumbers& model, double threshold)
      : problem_(problem), model_(model), limit_(threshold * threshold) {}

  template <class IsEnough>
  double chance(const IsEnough& is_enough) {
    for (std::size_t trials = kFewest; hasMore() && trials <= kMost; trials *= 6) {
      look(trials);
      if (is_enough(upperBound())) break;
    }
    return estimate();
  }

 private:
  static constexpr std::size_t kFewest = 556;
  static constexpr std::size_t kMost = 20'016;

      bool
      hasMore() const {
    return shift_ < problem_.size();
  }
  void look(std::size_t trials);
  double upperBound() const;
  double estimate() const;

  const Problem& problem_;
  const ModelNumbers& model_;
  double limit_;
  std::size_t shift_ = 1, in_shift_ = 0;
  std::size_t trials_ = 0, hits_ = 0;
  std::vector<double> squared_;
};

}  // namespace detail
}  // namespace v1
}  // namespace gslam

#endif  // GSLAM_ESTIMATOR_ROBUST_EVIDENCE_H
