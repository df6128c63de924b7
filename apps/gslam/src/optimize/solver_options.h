// Options of the optimizer on the command line.
#ifndef GSLAM_APPS_OPTIMIZE_SOLVER_OPTIONS_H
#define GSLAM_APPS_OPTIMIZE_SOLVER_OPTIONS_H

#include <gslam/optimizer/initialize_poses.h>
#include <gslam/optimizer/options.h>
#include <gslam/optimizer/pose_graph_problem.h>

#include "../options.h"

namespace app {

/// Declares them.
void declareSolver(Options& options);

/// What --loss, --iterations and the like say.
/// @throws ConfigError for a loss or back end that there is none of
gslam::OptimizerOptions solverOf(const Options& options);

/// What --residual says.
gslam::PoseGraphResidual residualOf(const Options& options);

}  // namespace app

#endif  // GSLAM_APPS_OPTIMIZE_SOLVER_OPTIONS_H
