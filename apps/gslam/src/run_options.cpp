#include "run_options.h"

#include <gslam/base/error.h>
#include <gslam/evaluation/limits.h>
#include <gslam/svar/error.h>

#include "comparison.h"
#include "session.h"
#include "settings.h"

namespace app {

RunOptions::RunOptions()
    : Options("gslam run DATASET [--slam S] --out DIR [options]",
              "Runs a SLAM system on a dataset, in a process of its own that may crash, and "
              "measures it. Writes to DIR: metrics.json (accuracy, coverage, cost), run.json (what "
              "ran where, and how it ended), trajectory.txt (each pose as it was first published), "
              "trajectory_final.txt (as the system says at the end), groundtruth.txt, frames.csv "
              "(each frame) and, where there is one, map.gmap, in place of those of a run before. "
              "A run that fails or is stopped keeps what it has.") {
  Session::declare(*this, "visual");
  arg<std::string>("out", "folder for the results").shortName("o").group("What");
  arg<int>("repeat", 0, "runs, whose results go to DIR/1, DIR/2 ...; DIR/metrics.json sums up")
      .range(0, 10000)
      .group("How");
  arg<std::string>("cpus", "", "cores that it may use, such as 0,1 or 0-3").group("How");
  arg<std::string>("memory", "", "most memory that it may use, such as 4G").group("How");
  declareComparison(*this);
}

bool RunOptions::take(const std::vector<std::string>& arguments) {
  if (!read(withSettings(withOneRpe(arguments)))) return false;
  if (get<std::string>("slam").empty()) {
    throw gslam::ConfigError("--slam", "must be given: name or file of the SLAM system");
  }
  if (get<std::string>("out").empty()) {
    throw gslam::ConfigError("--out", "is empty, expected a folder");
  }
  comparisonOf(*this);
  const std::string cpus = get<std::string>("cpus"), memory = get<std::string>("memory");
  try {
    if (!cpus.empty()) cpus_ = gslam::parseCpuList(cpus, "--cpus");
    if (!memory.empty()) memory_ = gslam::parseMemorySize(memory, "--memory");
  } catch (const gslam::ArgumentError& error) {
    // Its message is the argument, a blank, and what is wrong.
    throw gslam::ConfigError(error.argument(),
                             std::string(error.what()).substr(error.argument().size() + 1));
  }
  return true;
}

}  // namespace app
