// Sentences for people.
#ifndef GSLAM_ESTIMATOR_ROBUST_MESSAGES_H
#define GSLAM_ESTIMATOR_ROBUST_MESSAGES_H

#include <gslam/estimator/estimate.h>

#include <cstddef>
#include <string>

namespace gslam {
inline namespace v1 {
namespace detail {

// What a consensus would have needed.
struct ConsensusLimits {
  std::size_t sample_size = 0;
  std::size_t distinct = 0;          // matches, each of those at one place counted once
  std::size_t distinct_inliers = 0;  // of them
  std::size_t fewest_inliers = 0;    // distinct ones that chance does not explain
  std::size_t fewest_matches = 0;    // that would do if all were inliers; 0: none
  bool is_at_limit = false;          // no more samples were allowed
  bool has_threshold = true;         // the caller's
};

std::string okMessage(const EstimateSummary& summary);
std::string noModelMessage(std::size_t iterations);
std::string noConsensusMessage(const EstimateSummary& summary, const ConsensusLimits& limits);

}  // namespace detail
}  // namespace v1
}  // namespace gslam

#endif  // GSLAM_ESTIMATOR_ROBUST_MESSAGES_H
