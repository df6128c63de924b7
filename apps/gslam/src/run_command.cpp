#include <gslam/svar/json.h>

#include <iostream>

#include "command.h"
#include "comparison.h"
#include "interrupt.h"
#include "run_folder.h"
#include "run_metrics.h"
#include "run_options.h"
#include "run_supervisor.h"
#include "session.h"

namespace app {
namespace {

using gslam::Svar;

// One run from its begin to its metrics.
struct MeasuredRun {
  SupervisedRun run;
  RunMetrics metrics;
};

MeasuredRun runOnce(RunSupervisor& supervisor, const RunOptions& options,
                    const std::vector<std::string>& arguments, const RunFolder& folder) {
  MeasuredRun result;
  result.run = supervisor.run(arguments, folder);
  if (!result.run.has_begun) return result;
  result.metrics = measureRun(folder, result.run.report, comparisonOf(options), result.run.cost);
  result.metrics.json.save(folder.metrics());
  return result;
}

void print(const SupervisedRun& run) {
  const Svar result = run.report.get<Svar>("result", Svar::object());
  printResult(result, true);
  const auto remark = result.get<std::string>("remark", "");
  if (!remark.empty()) std::cerr << remark << '\n';
}

int runSingle(RunSupervisor& supervisor, const RunOptions& options,
              const std::vector<std::string>& arguments, const RunFolder& folder) {
  const MeasuredRun one = runOnce(supervisor, options, arguments, folder);
  if (!one.run.has_begun) return one.run.status;
  if (options.isJson()) {
    std::cout << gslam::printJson(one.metrics.json) << '\n';
  } else {
    print(one.run);
    std::cout << one.metrics.text << "results      " << folder.metrics() << ", run.json, ...\n";
  }
  return one.run.status;
}

int runRepeated(RunSupervisor& supervisor, const RunOptions& options,
                const std::vector<std::string>& arguments, const RunFolder& folder) {
  std::vector<Svar> metrics;
  int status = kSuccess;
  for (int number = 1; number <= options.repeats() && !supervisor.isStopped(); ++number) {
    const MeasuredRun one = runOnce(supervisor, options, arguments, folder.repeat(number));
    if (!one.run.has_begun) return one.run.status;  // nor would the others
    if (one.run.status != kSuccess) status = one.run.status;
    if (number == 1) folder.clear(2);
    metrics.push_back(one.metrics.json);
    summaryOf(metrics).save(folder.metrics());  // should this be its last
    if (options.isJson()) continue;
    std::cout << "run " << number << " of " << options.repeats() << ": " << std::flush;
    print(one.run);
    std::cout.flush();
  }
  if (metrics.empty()) return kInterrupted;
  const Svar summary = summaryOf(metrics);
  if (options.isJson()) {
    std::cout << gslam::printJson(summary) << '\n';
  } else {
    std::cout << summaryText(summary) << "results      " << folder.metrics() << ", and of each run "
              << folder.repeat(1).metrics() << ", ...\n";
  }
  return supervisor.isStopped() ? kInterrupted : status;
}

}  // namespace

int runCommand(const std::vector<std::string>& arguments) {
  RunOptions options;
  if (!options.take(arguments)) return kSuccess;
  gslam::countAllocationsOfChildren();
  const RunFolder folder(options.get<std::string>("out"));
  RunSupervisor supervisor(options);
  const OnInterrupt interrupt([&supervisor] { supervisor.stop(); },
                              [&supervisor] { supervisor.kill(); });
  return options.repeats() > 0 ? runRepeated(supervisor, options, arguments, folder)
                               : runSingle(supervisor, options, arguments, folder);
}

}  // namespace app
