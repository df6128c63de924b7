#include "run_worker.h"

#include <gslam/base/error.h>
#include <gslam/core/detail/exception_text.h>
#include <gslam/core/isolated_slam.h>
#include <gslam/core/map_file.h>
#include <gslam/core/map_trajectory.h>
#include <gslam/core/trajectory_file.h>
#include <gslam/core/version.h>
#include <gslam/evaluation.h>
#include <gslam/evaluation/limits.h>
#include <gslam/evaluation/version.h>
#include <gslam/svar/error.h>
#include <unistd.h>

#include <algorithm>
#include <chrono>
#include <cstdlib>
#include <ctime>
#include <filesystem>
#include <memory>
#include <optional>
#include <system_error>
#include <thread>
#include <utility>

#include "command.h"
#include "comparison.h"
#include "frame_log.h"
#include "interrupt.h"
#include "live_trajectory.h"
#include "machine.h"
#include "run_board.h"
#include "run_folder.h"
#include "run_options.h"
#include "session.h"
#include "watched_slam.h"

namespace app {
namespace {

using gslam::Svar;

// What this process may use, as long as it lives.
class Limits {
 public:
  explicit Limits(const RunOptions& options) {
    if (!options.cpus().empty()) setCpus(options.cpus());
    if (options.memory() > 0) memory_.emplace(options.memory());
    cpus_ = gslam::cpuAffinity();
  }
  Svar describe(const RunOptions& options) const {
    return Svar::object(
        {{"cpus", cpus_},
         {"cpus_by", options.cpus().empty() ? "nothing: all that this process has"
                                            : "affinity of all threads and processes"},
         {"memory_bytes", memory_ ? Svar(options.memory()) : Svar()},
         {"memory_by", memory_ ? memory_->text() : "nothing"}});
  }

 private:
  static void setCpus(const std::vector<int>& cpus) {
    try {
      gslam::setCpuAffinity(cpus, "");
    } catch (const gslam::ArgumentError& error) {
      // Its message is the argument, a blank, and what is wrong.
      throw gslam::ConfigError("--cpus",
                               std::string(error.what()).substr(error.argument().size() + 1));
    }
  }

  std::optional<gslam::MemoryLimit> memory_;
  std::vector<int> cpus_;
};

std::string timeOfDay() {
  const std::time_t now = std::time(nullptr);
  std::tm parts{};
  gmtime_r(&now, &parts);
  char text[32];
  std::strftime(text, sizeof text, "%Y-%m-%dT%H:%M:%SZ", &parts);
  return text;
}

// What is known before the first frame.
Svar reportOf(const Session& session, const RunOptions& options, const Limits& limits) {
  Svar report = Svar::object({{"program", kRunProgram}});
  const Svar protocol = session.protocol();
  for (const Svar::Member& member : protocol.members()) {
    report.set(member.first, member.second);
  }
  report.set("gslam", GSLAM_CORE_VERSION);
  report.set("versions", Svar::object({{"core", GSLAM_CORE_VERSION},
                                       {"evaluation", GSLAM_EVALUATION_VERSION}}));
  report.set("seed", report.get<Svar>("slam.parameters.seed", Svar()));
  report.set("machine", describeMachine());
  report.set("limits", limits.describe(options));
  report.set("begun", timeOfDay());
  report.set("association",
             Svar::object({{"method", options.get<std::string>("association")},
                           {"max_dt_s", options.get<std::string>("max-dt")},
                           {"time_offset", options.get<std::string>("time-offset")}}));
  report.set("alignment", options.get<std::string>("align"));
  report.set("units", Svar::object({{"translation", "m"},
                                    {"rotation", "quaternion x y z w"},
                                    {"trajectory", "T_world_body, seconds"},
                                    {"frames", "milliseconds, nanoseconds, as their names end"}}));
  report.set("poses", Svar::object({{"live",
                                     "trajectory.txt: each frame's first pose, tracking "
                                     "or guessed, as it was published"},
                                    {"final", nullptr}}));
  report.set("result", Svar::object({{"end", "unfinished"}}));
  return report;
}

// What the system says at the end, and what that is.
std::pair<gslam::Trajectory, std::string> finalTrajectory(const gslam::RunResult& result,
                                                          const WatchedSlam& slam,
                                                          const LiveTrajectory& live) {
  const std::vector<gslam::FrameTime> frames = slam.measured().frames();
  const bool is_corrected =
      std::any_of(frames.begin(), frames.end(),
                  [](const gslam::FrameTime& frame) { return frame.corrections > 0; });
  if (!is_corrected && result.map != nullptr && result.map->keyframes().size() > 0) {
    try {
      return {gslam::keyframeTrajectory(*result.map), "keyframes of the map"};
    } catch (const gslam::ArgumentError&) {
      // Two have the same stamp: no trajectory.
    }
  }
  return {live.last(), "last pose of each frame"};
}

// Even a dataset that has results of a run is none to write to.
void checkIsNotDataset(const RunFolder& folder, const std::string& dataset) {
  const std::size_t colon = dataset.find(':');  // KIND:PATH
  for (const std::string& path : {dataset, dataset.substr(colon + 1)}) {
    std::error_code ignored;
    if (!std::filesystem::equivalent(path, folder.path(), ignored)) continue;
    throw gslam::ConfigError("--out", "is the dataset: results go to a folder of their own");
  }
}

// Waits until whoever watches has seen it; not for ever, should it be stopped.
void await(RunBoard& board, RunPhase phase, const std::atomic<bool>& answer) {
  board.enter(phase);
  for (int i = 0; i < 5000 && !answer; ++i) {
    std::this_thread::sleep_for(std::chrono::milliseconds(1));
  }
}

// The system and the dataset with what records around them.
std::shared_ptr<WatchedSlam> watch(Session& session, const RunRecorders& recorders) {
  gslam::ProcessTreeOptions of;
  of.root = session.slamProcess();
  const auto tree = std::make_shared<gslam::ProcessTree>(of);
  recorders.board.process = of.root > 0 ? of.root : getpid();
  std::shared_ptr<WatchedSlam> watched;
  session.wrap([&](std::shared_ptr<gslam::Slam> slam) {
    watched = std::make_shared<WatchedSlam>(std::move(slam), tree, recorders);
    return watched;
  });
  session.wrap([&](std::unique_ptr<gslam::Dataset> dataset) {
    return std::make_unique<WatchedDataset>(std::move(dataset), recorders.frames);
  });
  return watched;
}

Svar resultOf(const gslam::RunResult& result, const WatchedSlam& slam, const LiveTrajectory& live) {
  Svar described = describe(result);
  const gslam::Trajectory poses = live.last();
  described.set("poses", poses.size());
  described.set("length_m", poses.length());
  described.set("invalid_poses", live.invalidCount());
  described.set("wrong_stamps", live.wrongStamps());
  if (!slam.cause().empty()) described.set("cause", slam.cause());
  if (result.play.end == gslam::PlayEnd::failed && slam.cause().empty()) {
    described.set("cause", "dataset");
  }
  described.set("configure_s", slam.measured().configureSeconds());
  described.set("finish_s", slam.measured().finishSeconds());
  return described;
}

void writeResults(const RunFolder& folder, const gslam::RunResult& result, const WatchedSlam& slam,
                  const LiveTrajectory& live, Svar& report) {
  const auto final = finalTrajectory(result, slam, live);
  report.set("poses.final", "trajectory_final.txt: " + final.second);
  report.set("result", resultOf(result, slam, live));
  report.save(folder.report());  // first: it is there even where the others cannot be written
  gslam::writeTrajectory(folder.final(), final.first);
  if (result.map != nullptr) gslam::saveMap(folder.map(), *result.map);
}

// The result of a run whose SLAM system could not be made, from the exception in work.
Svar failureToMake() {
  return Svar::object({{"end", "failed"},
                       {"frames", 0},
                       {"poses", 0},
                       {"length_m", 0.0},
                       {"failure", gslam::detail::exceptionText()},
                       {"cause", causeOfException()}});
}

// Loads and makes the SLAM system, and begins the results between the two: before its constructor
// crashes, and after what makes no sense was refused.
// @return the result when that failed; else null
Svar make(Session& session, RunBoard& board, const RunFolder& folder, const RunOptions& options,
          const Limits& limits, Svar& report) {
  Svar failure;
  board.enter(RunPhase::making);
  try {
    session.findSlam(options);
  } catch (const gslam::IsolationError&) {
    failure = failureToMake();
  }
  board.enter(RunPhase::preparing);
  folder.prepare();
  report = reportOf(session, options, limits);
  report.save(folder.report());
  board.has_files = true;
  const gslam::Trajectory& truth = session.dataset().info().ground_truth;
  if (!truth.empty()) gslam::writeTrajectory(folder.truth(), truth);
  if (!failure.isNull()) return failure;
  board.enter(RunPhase::making);
  try {
    session.makeSlam();
  } catch (...) {
    failure = failureToMake();
  }
  board.enter(RunPhase::preparing);
  return failure;
}

int run(RunBoard& board, const RunFolder& folder, const RunOptions& options) {
  const Limits limits(options);
  Session session(options);
  checkIsNotDataset(folder, session.protocol().get<std::string>("dataset.given"));
  folder.check();
  Svar report;
  const Svar failure = make(session, board, folder, options, limits, report);
  if (!failure.isNull()) {
    report.set("result", failure);
    report.save(folder.report());
    board.enter(RunPhase::ended);
    return kFailure;
  }
  LiveTrajectory live(folder.trajectory());
  FrameLog frames(folder.frames());
  const std::shared_ptr<WatchedSlam> slam = watch(session, {board, live, frames});
  const gslam::Subscriber played = session.messenger().subscribe<gslam::Frame>(
      "/sensor/frame", [&slam](const gslam::Frame& frame) { slam->notePlayed(frame); });

  const OnInterrupt interrupt([&session] { session.stop(); });
  await(board, RunPhase::ready, board.is_watched);
  const gslam::RunResult result = session.play();
  await(board, RunPhase::played, board.is_read);
  board.enter(RunPhase::writing);
  slam->end();
  writeResults(folder, result, *slam, live, report);
  live.check();
  frames.check();
  board.enter(RunPhase::ended);
  return statusOf(result.play);
}

}  // namespace

int runWorker(const std::vector<std::string>& arguments) {
  if (arguments.size() < 2) throw gslam::Error("this is for `gslam run`, not to be typed");
  const SharedBoard board(std::atoi(arguments[0].c_str()));
  gslam::countAllocationsOfChildren();  // of an isolated system
  try {
    RunOptions options;
    options.take({arguments.begin() + 2, arguments.end()});
    return run(*board, RunFolder(arguments[1]), options);
  } catch (...) {
    board->has_said = true;  // main() will
    throw;
  }
}

}  // namespace app
