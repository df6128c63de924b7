#ifndef GSLAM_APPS_RUN_SUPERVISOR_H
#define GSLAM_APPS_RUN_SUPERVISOR_H

#include <gslam/evaluation/cost.h>
#include <gslam/svar/svar.h>

#include <mutex>
#include <string>
#include <vector>

#include "run_folder.h"
#include "run_options.h"
#include "run_process.h"

namespace app {

/// What came of one run.
struct SupervisedRun {
  bool has_begun = false;  ///< otherwise it was stopped, or it could not be set up and said so
  int status = 0;          ///< that `gslam run` ends with
  gslam::Svar report;      ///< what is in run.json
  gslam::CostSource cost;  ///< what it used; without frames
};

/// Runs in other processes, one at a time, and sees how they end. stop() and kill() may be called
/// by any thread.
class RunSupervisor {
 public:
  explicit RunSupervisor(const RunOptions& options) : options_(options) {}
  RunSupervisor(const RunSupervisor&) = delete;
  RunSupervisor& operator=(const RunSupervisor&) = delete;

  /// Runs, and waits for the end. What it did not write itself because it crashed is written to
  /// run.json and frames.csv.
  /// @param arguments  of `gslam run`
  SupervisedRun run(const std::vector<std::string>& arguments, const RunFolder& folder);

  bool isStopped() const;  ///< whether stop() was called
  void stop();             ///< no frame after the one in work, and no further run
  void kill();             ///< the same at once

 private:
  class Hold;

  const RunOptions& options_;
  mutable std::mutex mutex_;
  RunProcess* process_ = nullptr;  // that runs
  bool is_stopped_ = false;
  bool is_killed_ = false;
};

}  // namespace app

#endif  // GSLAM_APPS_RUN_SUPERVISOR_H
