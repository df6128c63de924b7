#include "robust/messages.h"

#include <cstdio>

namespace gslam {
inline namespace v1 {
namespace detail {
namespace {

std::string text(double value) {
  char buffer[32];
  std::snprintf(buffer, sizeof(buffer), "%.3g", value);
  return buffer;
}

// "31 of 200 matches within 3"
std::string inliersOf(const EstimateSummary& summary) {
  return std::to_string(summary.inlier_count) + " of " + std::to_string(summary.inliers.size()) +
         " matches within " + text(summary.threshold);
}

}  // namespace

std::string okMessage(const EstimateSummary& summary) {
  return inliersOf(summary) + " after " + std::to_string(summary.iterations) + " samples";
}

std::string noModelMessage(std::size_t iterations) {
  return "no model came out of " + std::to_string(iterations) +
         " samples, all degenerate or impossible: try more iterations, or better matches";
}

std::string noConsensusMessage(const EstimateSummary& summary, const ConsensusLimits& limits) {
  const std::size_t n = summary.inliers.size();
  std::string message = inliersOf(summary);
  if (n == limits.sample_size) {
    return message +
           ": each model fits as many as it is made from, so nothing confirms it; give "
           "more matches, or use the solver";
  }
  if (limits.distinct < n) {
    message += ", " + std::to_string(limits.distinct_inliers) + " of " +
               std::to_string(limits.distinct) + " without repeated ones";
  }
  if (limits.fewest_inliers > limits.distinct) {
    message += ", but chance explains even all: give ";
    message += limits.fewest_matches > 0
                   ? std::to_string(limits.fewest_matches) + " or more different matches"
                   : "more different matches";
    return message + (limits.has_threshold ? ", or a smaller threshold" : "");
  }
  message += ", but chance explains " + std::to_string(limits.fewest_inliers - 1) + " after " +
             std::to_string(summary.iterations) + " samples: try ";
  if (limits.is_at_limit) message += "more iterations, better matches, ";
  if (limits.has_threshold) message += "another threshold, ";
  return message + "or more matches";
}

}  // namespace detail
}  // namespace v1
}  // namespace gslam
