#ifndef GSLAM_OPTIMIZER_SRC_BUNDLE_WARNINGS_H
#define GSLAM_OPTIMIZER_SRC_BUNDLE_WARNINGS_H

#include <gslam/optimizer/bundle_problem.h>

#include <cstddef>

#include "findings.h"

namespace gslam {
inline namespace v1 {
namespace detail {

// Two bits of what is kept for a point are flags, the others an observation.
constexpr std::size_t kMostObservations = (std::size_t(1) << 30) - 1;

// What of a bundle without errors is suspect.
void findBundleWarnings(const BundleProblem& problem, Findings& findings);

}  // namespace detail
}  // namespace v1
}  // namespace gslam

#endif  // GSLAM_OPTIMIZER_SRC_BUNDLE_WARNINGS_H
