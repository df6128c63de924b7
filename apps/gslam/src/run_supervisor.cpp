#include "run_supervisor.h"

#include <gslam/core/isolated_slam.h>
#include <gslam/evaluation/allocation_counts.h>
#include <gslam/evaluation/limits.h>
#include <unistd.h>

#include <chrono>
#include <csignal>
#include <cstdint>
#include <cstdio>
#include <memory>
#include <optional>

#include "command.h"
#include "frame_log.h"
#include "live_trajectory.h"
#include "run_board.h"
#include "run_worker.h"
#include "session.h"

namespace app {
namespace {

using gslam::IsolationFailure;
using gslam::Svar;
using std::chrono::milliseconds;

// Watches what the process of a run uses, from `ready` to `played` or its end.
class Meter {
 public:
  explicit Meter(RunBoard& board) : board_(board) {}

  // To be called now and then.
  void look() {
    const RunPhase phase = board_.phase;
    if (phase >= RunPhase::ready && monitor_ == nullptr && !board_.is_watched) begin();
    if (phase >= RunPhase::played && !board_.is_read) end();
  }
  void end() {
    if (monitor_ != nullptr && !is_ended_) {
      is_ended_ = true;
      source_.resources = monitor_->stop();
      source_.allocations = gslam::allocatedBetween(before_, gslam::allocationCountsOf(process_));
    }
    board_.is_read = true;
  }
  const gslam::CostSource& source() const { return source_; }

 private:
  void begin() {
    process_ = long(board_.process);
    gslam::ProcessTreeOptions of;
    of.root = process_;
    try {
      const auto tree = std::make_shared<gslam::ProcessTree>(of);
      before_ = gslam::allocationCountsOf(process_);
      monitor_ = std::make_unique<gslam::ResourceMonitor>(tree);
    } catch (const gslam::Error&) {
      // It is gone already; how is told elsewhere.
    }
    board_.is_watched = true;
  }

  RunBoard& board_;
  long process_ = 0;
  gslam::AllocationCounts before_;
  std::unique_ptr<gslam::ResourceMonitor> monitor_;
  gslam::CostSource source_;
  bool is_ended_ = false;
};

// How long the phase may last; 0: as long as it likes. An isolated system is watched by its own
// process's other half, which should come first.
milliseconds limitOf(RunPhase phase, const RunOptions& options) {
  const CallLimits limits = callLimits(options);
  const milliseconds more(options.get<bool>("isolate") ? 10000 : 0);
  switch (phase) {
    case RunPhase::making:
    case RunPhase::configuring:
      return limits.configure + more;
    case RunPhase::feeding:
      return limits.feed + more;
    case RunPhase::finishing:
    case RunPhase::mapping:
    case RunPhase::ended:  // destructors
      return limits.finish + more;
    default:
      return milliseconds(0);
  }
}

bool isLate(const RunBoard& board, const RunOptions& options) {
  const RunPhase phase = board.phase;
  const std::int64_t since = board.since;
  const milliseconds limit = limitOf(phase, options);
  if (limit.count() == 0 || board.phase != phase) return false;
  const auto now = std::chrono::steady_clock::now().time_since_epoch();
  return now - std::chrono::nanoseconds(since) > limit;
}

const char* callOf(RunPhase phase) {
  switch (phase) {
    case RunPhase::configuring:
      return "configure";
    case RunPhase::feeding:
      return "feed";
    case RunPhase::finishing:
      return "finish";
    case RunPhase::mapping:
      return "map";
    default:
      return "";
  }
}

// How a process came to its end that did not say so itself.
struct Abnormal {
  ProcessEnd end;
  RunPhase phase;
  bool is_late;     // it was killed because of that
  bool is_killed;   // by the user
  bool is_stopped;  // the user asked for it, or that
};

IsolationFailure failureOf(const Abnormal& how, const RunBoard& board, const RunOptions& options) {
  IsolationFailure failure;
  failure.kind = how.is_late         ? IsolationFailure::Kind::timeout
                 : how.end.is_signal ? IsolationFailure::Kind::signal
                                     : IsolationFailure::Kind::exit;
  failure.number = how.end.number;
  if (how.end.is_signal) failure.signal_name = gslam::detail::signalName(how.end.number);
  failure.call = callOf(how.phase);
  failure.has_frame = board.has_frame;
  failure.last_frame = board.frame;
  failure.limit = limitOf(how.phase, options);
  return failure;
}

bool mayBeMemory(const Abnormal& how, const RunOptions& options) {
  const int signal = how.end.is_signal ? how.end.number : 0;
  return options.memory() > 0 &&
         (signal == SIGKILL || signal == SIGABRT || signal == SIGSEGV || signal == SIGBUS);
}

std::string causeOf(const Abnormal& how, const RunOptions& options) {
  if (how.is_stopped) return "interrupt";
  if (how.is_late) return "timeout";
  if (mayBeMemory(how, options) && how.end.number == SIGKILL) return "memory";
  return how.end.is_signal ? "signal" : "exit";
}

std::string textOf(const Abnormal& how, const RunBoard& board, const RunOptions& options) {
  if (how.is_killed) return "was killed by a second interrupt";
  if (how.is_stopped && how.phase < RunPhase::configuring) return "was stopped before it began";
  // Results that cannot be written, for example.
  if (board.has_said) return "the program could not go on; stderr has the reason";
  const std::string failure = gslam::toText(failureOf(how, board, options));
  const std::string outside = failure.substr(0, failure.find(" between two calls"));
  const char* const process = "the process of the run ";
  if (how.phase == RunPhase::loading) return process + outside + ", while it loaded the dataset";
  if (how.phase == RunPhase::preparing || how.phase == RunPhase::ready) {
    return process + outside + ", before the first call";
  }
  if (how.phase >= RunPhase::played) return process + outside + ", while it wrote the results";
  std::string text =
      "the SLAM system " +
      (how.phase == RunPhase::making ? outside + ", while it was loaded and made" : failure);
  if (how.is_late) text += "; --timeout says how long a call may take";
  if (!how.is_late && mayBeMemory(how, options)) {
    text += "; it may have no more memory than --memory " + options.get<std::string>("memory");
  }
  if (!how.is_late && how.phase == RunPhase::waiting)
    text += " (one of its threads, or the dataset)";
  return text;
}

// The results of a run that could not write them.
Svar resultOf(const Abnormal& how, const RunBoard& board, const RunOptions& options,
              const RunFolder& folder) {
  const FrameRecords records = readFrames(folder.frames());
  const gslam::Trajectory poses = readLiveTrajectory(folder.trajectory());
  std::uint64_t dropped = 0, frames = records.frames.size();
  for (const gslam::FrameTime& frame : records.frames) dropped += frame.is_dropped ? 1 : 0;
  // The one at which it ended has no line.
  const bool is_listed = !records.frames.empty() && records.frames.back().frame >= board.frame;
  if (board.has_frame && !is_listed) ++frames;
  const double seconds =
      records.frames.empty() ? 0 : 1e-9 * double(records.frames.back().delivered);
  return Svar::object({{"end", how.is_stopped ? "stopped" : "failed"},
                       {"frames", frames},
                       {"dropped", dropped},
                       {"unreadable", records.unreadable},
                       {"last_frame", std::uint64_t(board.frame)},
                       {"seconds", seconds},
                       {"poses", poses.size()},
                       {"length_m", poses.length()},
                       {"invalid_poses", std::uint64_t(board.invalid_poses)},
                       {"wrong_stamps", std::uint64_t(board.wrong_stamps)},
                       {"failure", textOf(how, board, options)},
                       {"cause", causeOf(how, options)}});
}

// What is known of a run whose process ended before it could say anything.
Svar leastReport(const RunOptions& options) {
  return Svar::object({{"program", kRunProgram},
                       {"dataset", Svar::object({{"given", options.get<std::string>("dataset")}})},
                       {"slam", Svar::object({{"given", options.get<std::string>("slam")},
                                              {"isolated", options.get<bool>("isolate")}})}});
}

// After a crash the line of progress stands there.
void clearLine() {
  if (isatty(STDERR_FILENO) != 0) std::fputs("\r\033[K", stderr);
}

// Not begun, so that the results of a run before stay: it said why, such as a dataset that is not
// there or a wrong parameter, or it was stopped.
bool isRefusal(const Abnormal& how, const RunBoard& board) {
  return !board.has_files && (how.is_stopped || (board.has_said && !how.end.is_signal));
}

}  // namespace

// What stop() and kill() are for, as long as it lives. What came before counts as well.
class RunSupervisor::Hold {
 public:
  Hold(RunSupervisor& supervisor, RunProcess& process) : supervisor_(supervisor) {
    const std::lock_guard<std::mutex> lock(supervisor_.mutex_);
    supervisor_.process_ = &process;
    if (supervisor_.is_stopped_) process.stop();
    if (supervisor_.is_killed_) process.kill();
  }
  Hold(const Hold&) = delete;
  Hold& operator=(const Hold&) = delete;
  ~Hold() {
    const std::lock_guard<std::mutex> lock(supervisor_.mutex_);
    supervisor_.process_ = nullptr;
  }

 private:
  RunSupervisor& supervisor_;
};

SupervisedRun RunSupervisor::run(const std::vector<std::string>& arguments,
                                 const RunFolder& folder) {
  SharedBoard board;
  std::vector<std::string> words = {kRunWorker, std::to_string(board.file()), folder.path()};
  words.insert(words.end(), arguments.begin(), arguments.end());
  RunProcess process(words, board.file());
  const Hold hold(*this, process);
  Meter meter(*board);
  Abnormal how{{}, RunPhase::loading, false, false, false};
  while (!process.waitFor(milliseconds(20))) {
    meter.look();
    if (how.is_late || !isLate(*board, options_)) continue;
    how.is_late = true;
    how.phase = board->phase;
    process.kill();
  }
  meter.end();
  how.end = process.collect();
  gslam::removeEndedMemoryGroups();  // of a process that had more memory than it may
  if (!how.is_late) how.phase = board->phase;
  {
    const std::lock_guard<std::mutex> lock(mutex_);
    how.is_killed = is_killed_;
    how.is_stopped = is_killed_ || (is_stopped_ && how.end.number == kInterrupted);
  }

  SupervisedRun result;
  result.cost = meter.source();
  result.status = how.is_stopped ? kInterrupted : how.end.number;
  if (isRefusal(how, *board)) return result;
  result.has_begun = true;
  clearLine();
  if (how.phase == RunPhase::ended) {
    result.report = Svar::load(folder.report());
    const auto end = result.report.get<std::string>("result.end", "");
    const int expected = end == "finished" ? kSuccess : end == "stopped" ? kInterrupted : kFailure;
    if (!how.is_late && !how.end.is_signal && how.end.number == expected) return result;
    result.report.set("result.remark",
                      "the process " + gslam::toText(failureOf(how, *board, options_)) +
                          ", after the results were written, while the SLAM system was destroyed");
    result.status = how.is_killed ? kInterrupted : kFailure;
  } else {
    if (!board->has_files) folder.prepare();
    result.report = board->has_files ? Svar::load(folder.report()) : leastReport(options_);
    result.report.set("result", resultOf(how, *board, options_, folder));
    result.status = how.is_stopped ? kInterrupted : kFailure;
  }
  result.report.save(folder.report());
  return result;
}

bool RunSupervisor::isStopped() const {
  const std::lock_guard<std::mutex> lock(mutex_);
  return is_stopped_;
}

void RunSupervisor::stop() {
  const std::lock_guard<std::mutex> lock(mutex_);
  is_stopped_ = true;
  if (process_ != nullptr) process_->stop();
}

void RunSupervisor::kill() {
  const std::lock_guard<std::mutex> lock(mutex_);
  is_stopped_ = is_killed_ = true;
  if (process_ != nullptr) process_->kill();
}

}  // namespace app
