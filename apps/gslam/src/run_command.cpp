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

Svar resultOf(const SupervisedRun& run) {
  return run.report.get<Svar>("result", Svar::object());
}

void printRun(const SupervisedRun& run) {
  printResult(resultOf(run), true);
}

// Also where stdout is for machines.
void printFailure(const SupervisedRun& run) {
  const Svar result = resultOf(run);
  app::printFailure(result);
  const auto remark = result.get<std::string>("remark", "");
  if (!remark.empty()) std::cerr << remark << '\n';
}

// What was wrong is on stderr already.
int notBegun(const SupervisedRun& run) {
  if (run.status == kInterrupted) std::cerr << "gslam run: was stopped before it began\n";
  return run.status;
}

// Marks a folder of repeated runs; each has a report of its own.
Svar reportOfAll(const RunOptions& options) {
  return Svar::object({{"program", kRunProgram}, {"repeat", options.repeats()}});
}

int runSingle(RunSupervisor& supervisor, const RunOptions& options,
              const std::vector<std::string>& arguments, const RunFolder& folder) {
  folder.check();
  const MeasuredRun one = runOnce(supervisor, options, arguments, folder);
  if (!one.run.has_begun) return notBegun(one.run);
  if (options.isJson()) {
    std::cout << gslam::printJson(one.metrics.json) << '\n';
  } else {
    printRun(one.run);
    std::cout << one.metrics.text << "results      " << folder.metrics() << ", run.json, ...\n";
  }
  std::cout.flush();
  printFailure(one.run);
  return one.run.status;
}

int runRepeated(RunSupervisor& supervisor, const RunOptions& options,
                const std::vector<std::string>& arguments, const RunFolder& folder) {
  folder.check();
  for (int number = 1; number <= options.repeats(); ++number) folder.repeat(number).check();
  std::vector<Svar> metrics;
  int status = kSuccess;
  for (int number = 1; number <= options.repeats() && !supervisor.isStopped(); ++number) {
    const MeasuredRun one = runOnce(supervisor, options, arguments, folder.repeat(number));
    if (!one.run.has_begun) {  // nor would the others
      status = notBegun(one.run);
      break;
    }
    if (one.run.status != kSuccess) status = one.run.status;
    if (number == 1) {
      folder.clear(2);
      reportOfAll(options).save(folder.report());
    }
    metrics.push_back(one.metrics.json);
    summaryOf(metrics).save(folder.metrics());  // should this be its last
    if (!options.isJson()) {
      std::cout << "run " << number << " of " << options.repeats() << ": ";
      printRun(one.run);
      std::cout.flush();
    }
    printFailure(one.run);
  }
  if (metrics.empty()) return supervisor.isStopped() ? kInterrupted : status;
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
