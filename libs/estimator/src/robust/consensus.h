// Who agrees with a model, and whether that means anything.
#ifndef GSLAM_ESTIMATOR_ROBUST_CONSENSUS_H
#define GSLAM_ESTIMATOR_ROBUST_CONSENSUS_H

#include <gslam/estimator/options.h>

#include <cstddef>
#include <cstdint>

#include "robust/a_contrario.h"
#include "robust/problem.h"

namespace gslam {
inline namespace v1 {
namespace detail {

struct Consensus {
  double threshold = 0;  // that was used
  std::size_t inliers = 0;
  double log10_false_alarms = 0;
  double chance = 1;         // of an unrelated match to be an inlier
  std::size_t distinct = 0;  // of all matches, those that are evidence; 0: not counted
  std::size_t distinct_inliers = 0;
};

// Finds the threshold, where it is not given, the inliers, and what chance makes of them.
//
// Msac, Ransac: the given threshold. Lmeds: 1.4826 (1 + 5 / (n - s)) sqrt(median) as an estimate of
// the standard deviation (Rousseeuw, Leroy 1987), times the 0.9876 quantile (2.5 in one
// dimension). Magsac: the one of several, up to the given, with which the consensus is least likely
// by chance (Moisan, Moulon, Monasse, "Automatic homographic registration of a pair of images, with
// a contrario elimination of outliers", IPOL 2, 2012).
class Judge {
 public:
  Judge(const Problem& problem, const EstimateOptions& options, double threshold);

  // squared: of all matches.
  Consensus judge(const float* squared) const;
  Consensus judge(const double* squared) const;
  // The same with the threshold known.
  Consensus judge(const double* squared, double threshold) const;

  // What the consensus of a model is worth, more carefully than judge() has time for: chance as
  // pairs that are no matches show it (evidence.h), and matches within the threshold of each other
  // counted once. inliers: size() bytes.
  void examine(const ModelNumbers& model, const std::uint8_t* inliers, Consensus& consensus) const;

  bool isSignificant(const Consensus& consensus) const {
    return consensus.log10_false_alarms < log10_limit_;
  }
  // Whether it would be, if all matches were inliers.
  bool couldBeSignificant(const Consensus& consensus) const;
  // The least inliers that were significant, of distinct matches where they were counted.
  std::size_t fewestInliers(const Consensus& consensus) const;
  // How many matches would do, were all of them inliers; 0: not even thousands.
  std::size_t fewestMatches(const Consensus& consensus) const;

 private:
  FalseAlarms alarmsOf(const Consensus& consensus) const;
  template <class T>
  Consensus judgeAll(const T* squared) const;
  template <class T>
  Consensus judgeAt(const T* squared, double threshold) const;
  template <class T>
  Consensus judgeMagsac(const T* squared) const;
  template <class T>
  double lmedsThreshold(const T* squared) const;

  const Problem& problem_;
  EstimateScoring scoring_;
  double threshold_;
  double log10_limit_;
  FalseAlarms false_alarms_;
};

}  // namespace detail
}  // namespace v1
}  // namespace gslam

#endif  // GSLAM_ESTIMATOR_ROBUST_CONSENSUS_H
