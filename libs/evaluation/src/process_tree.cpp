#include <gslam/base/error.h>
#include <gslam/evaluation/process_usage.h>

#include <algorithm>
#include <cerrno>
#include <cstddef>
#include <iterator>
#include <map>
#include <mutex>
#include <utility>
#include <vector>

#include "proc_files.h"
#include "steady_time.h"

#if defined(__linux__)
#include <sys/resource.h>
#include <time.h>
#include <unistd.h>
#endif

namespace gslam {
inline namespace v1 {

ProcessUsage usedBetween(const ProcessUsage& earlier, const ProcessUsage& later) {
  ProcessUsage used = later;
  used.cpu_seconds -= earlier.cpu_seconds;
  used.user_seconds -= earlier.user_seconds;
  used.system_seconds -= earlier.system_seconds;
  const auto subtract = [](std::uint64_t& from, std::uint64_t number) {
    from -= std::min(from, number);
  };
  subtract(used.voluntary_switches, earlier.voluntary_switches);
  subtract(used.involuntary_switches, earlier.involuntary_switches);
  subtract(used.minor_faults, earlier.minor_faults);
  subtract(used.major_faults, earlier.major_faults);
  return used;
}

#if defined(__linux__)

namespace {

using detail::ProcStat;

// Totals that only grow.
struct Totals {
  std::int64_t cpu = 0;                // nanoseconds
  std::uint64_t user = 0, system = 0;  // ticks
  std::uint64_t minor_faults = 0, major_faults = 0;
  std::uint64_t voluntary = 0, involuntary = 0;

  void add(const Totals& other) {
    cpu += other.cpu;
    user += other.user;
    system += other.system;
    minor_faults += other.minor_faults;
    major_faults += other.major_faults;
    voluntary += other.voluntary;
    involuntary += other.involuntary;
  }
  void raiseTo(const Totals& other) {
    cpu = std::max(cpu, other.cpu);
    user = std::max(user, other.user);
    system = std::max(system, other.system);
    minor_faults = std::max(minor_faults, other.minor_faults);
    major_faults = std::max(major_faults, other.major_faults);
    voluntary = std::max(voluntary, other.voluntary);
    involuntary = std::max(involuntary, other.involuntary);
  }
  std::uint64_t ticks() const { return user + system; }
};

struct Switches {
  std::uint64_t voluntary = 0, involuntary = 0;
};
struct ThreadSwitches : Switches {
  long thread = 0;
};

// A process as it was read last.
struct Process {
  ProcStat stat;
  bool lives = true;
  bool has_clock = false;
  clockid_t clock = 0;
  Totals own;                           // of its threads
  Totals reaped;                        // of children it was told of
  Totals reaped_before;                 // at the reading before
  std::vector<ThreadSwitches> threads;  // ascending; only where switches are read for each
  Switches ended_threads;
  std::uint64_t rss = 0, anonymous = 0, pss = 0, peak = 0;  // bytes

  Totals all() const {
    Totals sum = own;
    sum.add(reaped);
    return sum;
  }
};

// Of a process that lived at the last reading.
struct Clock {
  clockid_t id;
  std::int64_t time;  // nanoseconds
  bool is_over;
};

std::int64_t readClock(clockid_t clock) {
  timespec time = {};
  if (::clock_gettime(clock, &time) != 0) return -1;
  return std::int64_t(time.tv_sec) * 1000000000 + time.tv_nsec;
}

}  // namespace

class ProcessTree::Impl {
 public:
  explicit Impl(ProcessTreeOptions options) : options_(std::move(options)) {
    const bool is_own = options_.root == 0 || options_.root == long(::getpid());
    if (options_.root == 0) options_.root = long(::getpid());
    is_real_ = options_.proc == "/proc";
    is_own_ = is_real_ && is_own;
    const long ticks = ::sysconf(_SC_CLK_TCK);
    tick_ = 1000000000 / std::int64_t(ticks > 0 ? ticks : 100);
    const std::string path = pathOf(options_.root, "/stat");
    const int problem = detail::readFile(path, text_);
    if (problem != 0) throw FileError(path, "cannot be read, expected a process", problem);
    ProcStat stat;
    if (!detail::parseStat(text_, stat)) {
      throw FileError(path, "is not understood, expected what proc(5) describes");
    }
    add(options_.root, stat);
  }

  ProcessUsage read() {
    const std::lock_guard<std::mutex> lock(mutex_);
    findDescendants();
    for (auto& entry : processes_) {
      Process& process = entry.second;
      process.reaped_before.raiseTo(process.reaped);
    }
    // Where one ended meanwhile, all are read again: then its parent has been told of it. And since
    // parents are read first, nobody is there whom a parent has been told of.
    std::vector<long> ended;
    for (int i = 0; i < kMostPasses; ++i) {
      const std::size_t before = ended.size();
      for (const long number : parentsFirst()) {
        const bool is_gone = std::find(ended.begin(), ended.end(), number) != ended.end();
        if (!is_gone && !update(number, processes_[number])) ended.push_back(number);
      }
      if (ended.size() == before) break;
    }
    bury(ended);
    return sum();
  }

  std::int64_t cpuTime() {
    const std::lock_guard<std::mutex> lock(clock_mutex_);
    std::int64_t sum = other_cpu_;
    for (Clock& clock : clocks_) {
      const std::int64_t time = clock.is_over ? -1 : readClock(clock.id);
      // One that is gone or goes back is of a process that ended; the number may be another's now.
      clock.is_over = time < clock.time;
      clock.time = std::max(clock.time, time);
      sum += clock.time;
    }
    last_cpu_ = std::max(last_cpu_, sum);
    return last_cpu_;
  }

  long root() const { return options_.root; }

 private:
  static constexpr int kMostPasses = 4;

  // What is read again and again allocates nothing, so that it is not in counts of allocations.
  const std::vector<long>& parentsFirst() {
    const auto isIn = [this](long number) {
      return std::find(order_.begin(), order_.end(), number) != order_.end();
    };
    order_.clear();
    while (order_.size() < processes_.size()) {
      const std::size_t before = order_.size();
      for (const auto& entry : processes_) {
        const long parent = long(entry.second.stat.parent);
        const bool waits = processes_.count(parent) != 0 && !isIn(parent);
        if (!waits && !isIn(entry.first)) order_.push_back(entry.first);
      }
      if (order_.size() == before) break;  // a circle: no real system
    }
    return order_;
  }

  // A path, until the next call.
  const std::string& pathOf(long process, const char* file) {
    path_.assign(options_.proc).append("/").append(std::to_string(process)).append(file);
    return path_;
  }
  const std::string& pathOf(long process, long thread, const char* file) {
    pathOf(process, "/task/");
    path_.append(std::to_string(thread)).append(file);
    return path_;
  }

  void add(long number, const ProcStat& stat) {
    Process& process = processes_[number];
    process = Process();
    process.stat = stat;
    if (is_real_) process.has_clock = ::clock_getcpuclockid(pid_t(number), &process.clock) == 0;
    // What it was told of before it was seen is nothing that vanished under our eyes.
    process.reaped_before.user = stat.reaped_user;
    process.reaped_before.system = stat.reaped_system;
    process.reaped_before.minor_faults = stat.reaped_minor_faults;
  }

  bool readStat(long number, ProcStat& stat) {
    return detail::readFile(pathOf(number, "/stat"), text_) == 0 && detail::parseStat(text_, stat);
  }

  // The system tells the children of each thread; where it does not (CONFIG_PROC_CHILDREN), all
  // processes are asked for their parents, as seldom as that takes long.
  void findDescendants() {
    open_.clear();
    for (const auto& entry : processes_) open_.push_back(entry.first);
    bool is_told = true;
    while (!open_.empty()) {
      const long parent = open_.back();
      open_.pop_back();
      if (!detail::numbersIn(pathOf(parent, "/task"), threads_)) continue;
      for (const long thread : threads_) {
        const int problem = detail::readFile(pathOf(parent, thread, "/children"), text_);
        if (problem == ENOENT && thread == parent) is_told = false;  // its end is told by stat
        if (problem == 0) takeChildren();
      }
    }
    if (!is_told && detail::steadyTime() >= next_scan_) scan();
  }

  void takeChildren() {
    children_.clear();
    std::size_t at = 0;
    std::uint64_t number = 0;
    while (detail::takeNumber(text_, at, number)) children_.push_back(long(number));
    ProcStat stat;
    for (const long child : children_) {
      if (processes_.count(child) != 0 || !readStat(child, stat)) continue;
      add(child, stat);
      open_.push_back(child);
    }
  }

  void scan() {
    const std::int64_t begin = detail::steadyTime();
    std::vector<long> all;
    detail::numbersIn(options_.proc, all);
    std::map<long, ProcStat> others;
    ProcStat stat;
    for (const long number : all) {
      if (processes_.count(number) == 0 && readStat(number, stat)) others[number] = stat;
    }
    bool is_growing = true;
    while (is_growing) {
      is_growing = false;
      for (auto it = others.begin(); it != others.end();) {
        const bool is_ours = processes_.count(long(it->second.parent)) != 0;
        if (is_ours) add(it->first, it->second);
        is_growing = is_growing || is_ours;
        it = is_ours ? others.erase(it) : std::next(it);
      }
    }
    next_scan_ = detail::steadyTime() + 400 * (detail::steadyTime() - begin);
  }

  // False when it has ended; then it stays as it was.
  bool update(long number, Process& process) {
    ProcStat stat;
    if (!readStat(number, stat) || stat.start != process.stat.start) return false;
    process.stat = stat;
    process.lives = stat.state != 'Z' && stat.state != 'X';
    Totals own;
    own.user = stat.user;
    own.system = stat.system;
    own.cpu = std::int64_t(own.ticks()) * tick_;
    if (process.has_clock) {
      const std::int64_t exact = readClock(process.clock);
      if (exact >= 0) own.cpu = exact;
    }
    own.minor_faults = stat.minor_faults;
    own.major_faults = stat.major_faults;
    process.own.raiseTo(own);
    Totals reaped;
    reaped.user = stat.reaped_user;
    reaped.system = stat.reaped_system;
    reaped.cpu = std::int64_t(reaped.ticks()) * tick_;
    reaped.minor_faults = stat.reaped_minor_faults;
    reaped.major_faults = stat.reaped_major_faults;
    process.reaped.raiseTo(reaped);
    updateMemory(number, process);
    updateSwitches(number, process);
    return true;
  }

  void updateMemory(long number, Process& process) {
    process.rss = process.anonymous = process.pss = 0;
    if (!process.lives || detail::readFile(pathOf(number, "/status"), text_) != 0) return;
    process.rss = 1024 * detail::numberOf(text_, "VmRSS");
    process.anonymous = 1024 * detail::numberOf(text_, "RssAnon");
    process.peak = std::max(
        {process.peak, process.rss, std::uint64_t(1024 * detail::numberOf(text_, "VmHWM"))});
    if (options_.has_pss && detail::readFile(pathOf(number, "/smaps_rollup"), text_) == 0) {
      process.pss = 1024 * detail::numberOf(text_, "Pss");
    }
  }

  // The status of a process has those of its first thread only.
  void updateSwitches(long number, Process& process) {
    if (is_own_ && number == options_.root) {
      rusage usage = {};
      if (::getrusage(RUSAGE_SELF, &usage) == 0) {
        process.own.voluntary = std::uint64_t(usage.ru_nvcsw);
        process.own.involuntary = std::uint64_t(usage.ru_nivcsw);
        return;
      }
    }
    if (!detail::numbersIn(pathOf(number, "/task"), threads_)) return;
    std::sort(threads_.begin(), threads_.end());
    switches_.clear();
    Totals total;
    for (const long thread : threads_) {
      if (detail::readFile(pathOf(number, thread, "/status"), text_) != 0) continue;
      ThreadSwitches one;
      one.thread = thread;
      one.voluntary = detail::numberOf(text_, "voluntary_ctxt_switches");
      one.involuntary = detail::numberOf(text_, "nonvoluntary_ctxt_switches");
      total.voluntary += one.voluntary;
      total.involuntary += one.involuntary;
      switches_.push_back(one);
    }
    for (const ThreadSwitches& before : process.threads) {
      const auto is_less = [](const ThreadSwitches& a, const ThreadSwitches& b) {
        return a.thread < b.thread;
      };
      if (std::binary_search(switches_.begin(), switches_.end(), before, is_less)) continue;
      process.ended_threads.voluntary += before.voluntary;
      process.ended_threads.involuntary += before.involuntary;
    }
    total.voluntary += process.ended_threads.voluntary;
    total.involuntary += process.ended_threads.involuntary;
    process.threads.assign(switches_.begin(), switches_.end());
    process.own.raiseTo(total);
  }

  // What ended is in what its parent was told, or else kept here. Its switches always are.
  void bury(const std::vector<long>& ended) {
    std::map<long, Totals> untold;  // by parent
    for (const long number : ended) {
      const Process& process = processes_[number];
      Totals kept;
      kept.voluntary = process.own.voluntary;
      kept.involuntary = process.own.involuntary;
      gone_.add(kept);
      peak_of_one_ = std::max(peak_of_one_, process.peak);
      Totals told = process.all();
      told.voluntary = told.involuntary = 0;
      untold[livingParent(process, ended)].add(told);
    }
    for (const long number : ended) processes_.erase(number);
    for (const auto& entry : untold) {
      const auto parent = processes_.find(entry.first);
      if (parent == processes_.end() || !isTold(parent->second, entry.second)) {
        gone_.add(entry.second);
      }
    }
  }

  // Whether a parent was told of this since the reading before. Faults are exact, and no process
  // has none; ticks of user and system are each rounded down, so that they show little of a short
  // life.
  static bool isTold(const Process& parent, const Totals& ended) {
    const Totals& before = parent.reaped_before;
    return parent.reaped.minor_faults >= before.minor_faults + ended.minor_faults &&
           parent.reaped.ticks() + 2 >= before.ticks() + ended.ticks();
  }

  // Where a parent ended, too, it told its own.
  long livingParent(const Process& process, const std::vector<long>& ended) const {
    long parent = long(process.stat.parent);
    for (std::size_t i = 0; i < ended.size(); ++i) {
      if (std::find(ended.begin(), ended.end(), parent) == ended.end()) break;
      parent = long(processes_.at(parent).stat.parent);
    }
    return parent;
  }

  ProcessUsage sum() {
    ProcessUsage usage;
    usage.time = detail::steadyTime();
    Totals totals = gone_;
    clocks_read_.clear();
    std::int64_t other_cpu = gone_.cpu;
    for (const auto& entry : processes_) {
      const Process& process = entry.second;
      totals.add(process.all());
      if (process.has_clock) clocks_read_.push_back({process.clock, process.own.cpu, false});
      other_cpu += process.reaped.cpu + (process.has_clock ? 0 : process.own.cpu);
      peak_of_one_ = std::max(peak_of_one_, process.peak);
      if (!process.lives) continue;
      ++usage.processes;
      usage.threads += std::size_t(process.stat.threads);
      usage.rss_bytes += process.rss;
      usage.private_bytes += process.anonymous;
      usage.pss_bytes += process.pss;
    }
    most_.raiseTo(totals);
    peak_of_all_ = std::max(peak_of_all_, usage.rss_bytes);
    usage.peak_rss_bytes = std::max(peak_of_one_, peak_of_all_);
    usage.cpu_seconds = 1e-9 * double(most_.cpu);
    usage.user_seconds = 1e-9 * double(most_.user) * double(tick_);
    usage.system_seconds = 1e-9 * double(most_.system) * double(tick_);
    usage.voluntary_switches = most_.voluntary;
    usage.involuntary_switches = most_.involuntary;
    usage.minor_faults = most_.minor_faults;
    usage.major_faults = most_.major_faults;
    const std::lock_guard<std::mutex> lock(clock_mutex_);
    std::swap(clocks_, clocks_read_);
    other_cpu_ = other_cpu;
    last_cpu_ = std::max(last_cpu_, most_.cpu);
    return usage;
  }

  ProcessTreeOptions options_;
  bool is_real_ = false;  // not made up for a test
  bool is_own_ = false;
  std::int64_t tick_ = 10000000;  // nanoseconds
  std::mutex mutex_;
  std::string text_, path_;  // of the file in work
  std::vector<long> order_, open_, threads_, children_;
  std::vector<ThreadSwitches> switches_;
  std::vector<Clock> clocks_read_;
  std::map<long, Process> processes_;
  std::int64_t next_scan_ = 0;
  Totals gone_;
  Totals most_;
  std::uint64_t peak_of_one_ = 0, peak_of_all_ = 0;

  // What a frame needs, so that it never waits for a whole reading.
  std::mutex clock_mutex_;
  std::vector<Clock> clocks_;
  std::int64_t other_cpu_ = 0;
  std::int64_t last_cpu_ = 0;
};

ProcessTree::ProcessTree(const ProcessTreeOptions& options) : impl_(new Impl(options)) {
  impl_->read();
}
ProcessTree::~ProcessTree() = default;
ProcessUsage ProcessTree::read() {
  return impl_->read();
}
std::int64_t ProcessTree::cpuTime() {
  return impl_->cpuTime();
}
long ProcessTree::root() const noexcept {
  return impl_->root();
}

#else

class ProcessTree::Impl {};

ProcessTree::ProcessTree(const ProcessTreeOptions&) {
  throw Error("what processes use is read from /proc, which only Linux has");
}
ProcessTree::~ProcessTree() = default;
ProcessUsage ProcessTree::read() {
  return {};
}
std::int64_t ProcessTree::cpuTime() {
  return 0;
}
long ProcessTree::root() const noexcept {
  return 0;
}

#endif  // __linux__

}  // namespace v1
}  // namespace gslam
