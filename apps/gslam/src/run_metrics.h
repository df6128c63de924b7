#ifndef GSLAM_APPS_RUN_METRICS_H
#define GSLAM_APPS_RUN_METRICS_H

#include <gslam/evaluation/cost.h>
#include <gslam/evaluation/evaluate.h>
#include <gslam/svar/svar.h>

#include <string>
#include <vector>

#include "run_folder.h"

namespace app {

/// How good a run was and what it cost: for machines, and for people.
struct RunMetrics {
  gslam::Svar json;
  std::string text;
};

/// Measures what a run left in its folder, whole or not.
/// @param report  what is in run.json
/// @param how     association, alignment and figures
/// @param cost    what was used; its frames are read from the folder
/// @throws FileError, ParseError when the files are not those of a run
RunMetrics measureRun(const RunFolder& folder, const gslam::Svar& report,
                      const gslam::EvaluationOptions& how, gslam::CostSource cost);

/// Sums up runs: in place of each number of theirs, its mean, median, std, min, max and count over
/// those that have it, and how many did not finish. Failed ones count with what they reached, and
/// with a score of 0 where they have none; those that were stopped do not count.
/// @param metrics  as measureRun() gives, of one run at least
gslam::Svar summaryOf(const std::vector<gslam::Svar>& metrics);
/// The most important of it, for people.
std::string summaryText(const gslam::Svar& summary);

}  // namespace app

#endif  // GSLAM_APPS_RUN_METRICS_H
