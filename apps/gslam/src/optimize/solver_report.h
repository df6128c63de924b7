// What is said of a problem and of how it was solved.
#ifndef GSLAM_APPS_OPTIMIZE_SOLVER_REPORT_H
#define GSLAM_APPS_OPTIMIZE_SOLVER_REPORT_H

#include <gslam/optimizer/summary.h>
#include <gslam/svar/svar.h>

#include <string>

#include "problem_file.h"

namespace app {

/// What is in a problem: "bundle of 49 poses, 49 cameras, 7776 points, 31843 observations".
std::string contentText(const Problem& problem);
/// The same for machines.
gslam::Svar describe(const Problem& problem);

/// The heads of the columns of printIteration(), to stdout.
void printIterationHead();
/// A line to stdout, at once.
void printIteration(const gslam::OptimizerIteration& iteration);

/// The costs at the start and at the end: "850912.5 to 13344.5"; "no value" where there is none.
std::string costsText(const gslam::OptimizerSummary& summary);
/// How it ended, costs and warnings, to stdout.
void print(const gslam::OptimizerSummary& summary);
/// The same with all iterations, for machines.
gslam::Svar describe(const gslam::OptimizerSummary& summary);

}  // namespace app

#endif  // GSLAM_APPS_OPTIMIZE_SOLVER_REPORT_H
