// How a trajectory is compared with ground truth: what `run` and `eval` share.
#ifndef GSLAM_APPS_COMPARISON_H
#define GSLAM_APPS_COMPARISON_H

#include <gslam/evaluation/evaluate.h>

#include <cstdint>
#include <string>
#include <vector>

#include "options.h"

namespace app {

/// Declares association, alignment and figures.
void declareComparison(Options& options);

/// What was declared there, as far as it does not depend on the files.
/// @throws ConfigError for what means nothing
gslam::EvaluationOptions comparisonOf(const Options& options);

/// Makes one --rpe of several, of which Config would take the last.
std::vector<std::string> withOneRpe(const std::vector<std::string>& arguments);

}  // namespace app

#endif  // GSLAM_APPS_COMPARISON_H
