#ifndef GSLAM_APPS_RUN_WORKER_H
#define GSLAM_APPS_RUN_WORKER_H

#include <string>
#include <vector>

namespace app {

/// Name of the command that `gslam run` starts this program with for each run.
constexpr const char* kRunWorker = "run-worker";

/// That command: runs, and writes all but the metrics.
/// @param arguments  number of the file of the SharedBoard, folder, and those of `gslam run`
/// @return exit status
int runWorker(const std::vector<std::string>& arguments);

}  // namespace app

#endif  // GSLAM_APPS_RUN_WORKER_H
