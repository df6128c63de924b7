#include <gslam/base/error.h>
#include <gslam/evaluation/limits.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <utility>

#include "proc_files.h"

#if defined(__linux__)
#include <fcntl.h>
#include <sched.h>
#include <signal.h>
#include <sys/resource.h>
#include <sys/stat.h>
#include <unistd.h>

#include <cerrno>
#include <cstdint>
#include <system_error>
#endif

namespace gslam {
inline namespace v1 {
namespace {

constexpr int kMostCpus = 1024;

std::string listText(const std::vector<int>& cpus) {
  std::string text;
  for (std::size_t i = 0; i < cpus.size(); ++i) {
    std::size_t last = i;
    while (last + 1 < cpus.size() && cpus[last + 1] == cpus[last] + 1) ++last;
    text += (text.empty() ? "" : ",") + std::to_string(cpus[i]);
    if (last > i) text += '-' + std::to_string(cpus[last]);
    i = last;
  }
  return text.empty() ? "none" : text;
}

// A number of a core at `at`; -1 where there is none.
int takeCpu(const std::string& text, std::size_t& at) {
  int cpu = -1;
  for (; at < text.size() && text[at] >= '0' && text[at] <= '9' && cpu < kMostCpus; ++at) {
    cpu = 10 * std::max(cpu, 0) + (text[at] - '0');
  }
  return cpu < kMostCpus ? cpu : -1;
}

}  // namespace

std::vector<int> parseCpuList(const std::string& text, const std::string& argument) {
  std::vector<int> cpus;
  for (std::size_t at = 0; at <= text.size(); ++at) {
    const int first = takeCpu(text, at);
    int last = first;
    if (at < text.size() && text[at] == '-') last = takeCpu(text, ++at);
    if (first < 0 || last < first || (at < text.size() && text[at] != ',')) {
      throw ArgumentError(argument, "is '" + text +
                                        "', expected numbers of cores from 0 to 1023, such as "
                                        "\"0,1\" or \"0-3,8\"");
    }
    for (int cpu = first; cpu <= last; ++cpu) cpus.push_back(cpu);
  }
  std::sort(cpus.begin(), cpus.end());
  cpus.erase(std::unique(cpus.begin(), cpus.end()), cpus.end());
  return cpus;
}

std::uint64_t parseMemorySize(const std::string& text, const std::string& argument) {
  const ArgumentError error(argument, "is '" + text +
                                          "', expected bytes above 0, such as \"4G\", \"1.5G\" or "
                                          "\"512M\"");
  std::size_t at = 0;
  double value = 0, digit = 0;
  bool has_digits = false;
  for (; at < text.size() && ((text[at] >= '0' && text[at] <= '9') || text[at] == '.'); ++at) {
    if (text[at] == '.') {
      if (digit > 0) throw error;
      digit = 1;
      continue;
    }
    has_digits = true;
    digit /= 10;
    const int number = text[at] - '0';
    value = digit > 0 ? value + digit * number : 10 * value + number;
  }
  std::string unit = text.substr(at);
  for (const char* end : {"iB", "B"}) {
    const std::string ending = end;
    if (unit.size() == ending.size() + 1 && unit.compare(1, ending.size(), ending) == 0) {
      unit.resize(1);
    }
  }
  const std::string units = "KMGT";
  const std::size_t power = unit.size() == 1 ? units.find(char(unit[0] & ~0x20)) : 0;
  if (!has_digits || power == std::string::npos || unit.size() > 1) throw error;
  const double bytes = std::floor(value * (unit.empty() ? 1 : std::pow(1024.0, double(power + 1))));
  if (!(bytes >= 1 && bytes < 9.2e18)) throw error;
  return std::uint64_t(bytes);
}

#if defined(__linux__)

namespace {

[[noreturn]] void fail(const std::string& what) {
  throw Error(what + ": " + std::generic_category().message(errno));
}

std::vector<int> listOf(const cpu_set_t& set) {
  std::vector<int> cpus;
  for (int cpu = 0; cpu < kMostCpus; ++cpu) {
    if (CPU_ISSET(std::size_t(cpu), &set)) cpus.push_back(cpu);
  }
  return cpus;
}

// Threads that are started meanwhile by one that is not limited yet are found in another round.
void setForAllThreads(const cpu_set_t& set) {
  std::vector<long> threads, done;
  for (int round = 0; round < 100; ++round) {
    if (!detail::numbersIn("/proc/self/task", threads)) {
      throw Error("cannot choose cores for all threads: /proc/self/task cannot be read");
    }
    std::sort(threads.begin(), threads.end());
    if (threads == done) return;
    for (const long thread : threads) {
      const bool is_set = ::sched_setaffinity(pid_t(thread), sizeof set, &set) == 0;
      if (!is_set && errno != ESRCH)
        fail("cannot choose cores for thread " + std::to_string(thread));
    }
    done = threads;
  }
}

}  // namespace

std::vector<int> cpuAffinity() {
  cpu_set_t set;
  CPU_ZERO(&set);
  if (::sched_getaffinity(0, sizeof set, &set) != 0) fail("the cores of this thread are not known");
  return listOf(set);
}

void setCpuAffinity(const std::vector<int>& cpus, const std::string& argument) {
  cpu_set_t before, wanted;
  CPU_ZERO(&before);
  CPU_ZERO(&wanted);
  for (const int cpu : cpus) {
    if (cpu < 0 || cpu >= kMostCpus) {
      throw ArgumentError(argument, "has core " + std::to_string(cpu) + ", expected 0 to 1023");
    }
    CPU_SET(std::size_t(cpu), &wanted);
  }
  if (::sched_getaffinity(0, sizeof before, &before) != 0) {
    fail("the cores of this thread are not known");
  }
  // The system takes those that there are, and fails for none.
  const bool is_set = ::sched_setaffinity(0, sizeof wanted, &wanted) == 0;
  if (!is_set && errno != EINVAL) fail("cannot choose cores");
  const std::vector<int> got = is_set ? cpuAffinity() : std::vector<int>();
  if (got != listOf(wanted) || got.empty()) {
    ::sched_setaffinity(0, sizeof before, &before);
    throw ArgumentError(argument, "is '" + listText(listOf(wanted)) +
                                      "', but of these this process may run on " + listText(got) +
                                      "; it runs on " + listText(listOf(before)));
  }
  setForAllThreads(wanted);
}

namespace {

std::string gibibytes(std::uint64_t bytes) {
  char text[40];
  std::snprintf(text, sizeof text, "%.2f GiB", double(bytes) / 1073741824.0);
  return text;
}

// Writes into a file of a control group; false, with errno, where that is not allowed.
bool writeFile(const std::string& path, const std::string& text) {
  // Those files are there already; O_CREAT is for a folder that stands for a group in a test.
  const int file = ::open(path.c_str(), O_WRONLY | O_CREAT | O_CLOEXEC, 0644);
  if (file < 0) return false;
  const bool is_done = ::write(file, text.data(), text.size()) == ssize_t(text.size());
  const int problem = errno;
  ::close(file);
  errno = problem;
  return is_done;
}

// The word with an index, from 0, in a line of blanks and words; empty: none.
std::string wordOf(const std::string& line, std::size_t index) {
  std::size_t at = 0;
  for (;;) {
    at = line.find_first_not_of(' ', at);
    if (at == std::string::npos) return "";
    const std::size_t end = std::min(line.find(' ', at), line.size());
    if (index-- == 0) return line.substr(at, end - at);
    at = end;
  }
}

std::vector<std::string> linesOf(const std::string& text) {
  std::vector<std::string> lines;
  for (std::size_t at = 0; at < text.size();) {
    const std::size_t end = std::min(text.find('\n', at), text.size());
    lines.push_back(text.substr(at, end - at));
    at = end + 1;
  }
  return lines;
}

// Where cgroup v2 is, and this process in it.
struct GroupPlace {
  std::string mount;  // such as "/sys/fs/cgroup"
  std::string group;  // such as "/user.slice/app.scope"; "" is the root
  std::string why_not;

  // The folder for new groups.
  std::string parent() const { return mount + group.substr(0, group.rfind('/')); }
};

const std::string kGroupName = "gslam-";

// Groups of processes that are gone, as of those that had too much memory. The system removes none
// that somebody is in.
void removeEndedGroups(const std::string& parent) {
  for (const std::string& name : detail::namesIn(parent, kGroupName)) {
    std::uint64_t process = 0;
    std::size_t at = kGroupName.size();
    if (!detail::takeNumber(name, at, process) || process == 0 || process > INT32_MAX) continue;
    const bool is_gone = ::kill(pid_t(process), 0) != 0 && errno == ESRCH;
    if (is_gone || pid_t(process) == ::getpid()) ::rmdir((parent + '/' + name).c_str());
  }
}

GroupPlace findGroup(const std::string& proc) {
  GroupPlace place;
  std::string text;
  detail::readFile(proc + "/self/mountinfo", text);
  for (const std::string& line : linesOf(text)) {
    // proc(5): ... root mount-point options [fields] - type source options
    const std::size_t dash = line.find(" - ");
    if (dash == std::string::npos || line.compare(dash, 11, " - cgroup2 ") != 0) continue;
    if (place.mount.empty()) place.mount = wordOf(line, 4);
  }
  detail::readFile(proc + "/self/cgroup", text);
  bool is_in_group = false;
  for (const std::string& line : linesOf(text)) {
    if (line.compare(0, 3, "0::") != 0) continue;
    is_in_group = true;
    place.group = line.substr(3) == "/" ? "" : line.substr(3);
  }
  if (place.mount.empty() || !is_in_group) place.why_not = "there is no cgroup v2 here";
  return place;
}

}  // namespace

class MemoryLimit::Impl {
 public:
  Impl(std::uint64_t bytes, const MemoryLimitOptions& options) {
    std::string why_not = "it is not wanted";
    if (options.may_use_cgroup) {
      const GroupPlace place = findGroup(options.proc);
      why_not = place.why_not;
      if (why_not.empty()) why_not = makeGroup(place, bytes);
      if (why_not.empty()) {
        text_ = "memory limited to " + gibibytes(bytes) +
                " for this process and its children together, by cgroup v2 (" + group_ + ")";
        return;
      }
    }
    limitProcess(bytes, why_not);
  }
  Impl(const Impl&) = delete;
  Impl& operator=(const Impl&) = delete;
  ~Impl() {
    if (group_.empty()) {
      ::setrlimit(RLIMIT_DATA, &before_);
      return;
    }
    writeFile(home_ + "/cgroup.procs", std::to_string(::getpid()));
    ::rmdir(group_.c_str());  // fails where somebody is still in it
    switchOff();
  }

  const std::string& text() const { return text_; }
  const std::string& group() const { return group_; }
  bool isCgroup() const { return !group_.empty(); }

 private:
  // A group beside the own one, or, where processes may stand in an inner group (the root), below
  // it. Returns why neither can be done.
  std::string makeGroup(const GroupPlace& place, std::uint64_t bytes) {
    home_ = place.mount + place.group;
    const std::string why_not = makeGroupIn(place.parent(), place.group.empty(), bytes);
    if (!why_not.empty()) switchOff();
    return why_not;
  }

  std::string makeGroupIn(const std::string& parent, bool may_switch_on, std::uint64_t bytes) {
    std::string text;
    const std::string control = parent + "/cgroup.subtree_control";
    const int problem = detail::readFile(control, text);
    if (problem != 0) {
      return control + " cannot be read: " + std::generic_category().message(problem);
    }
    text = ' ' + text.substr(0, text.find('\n')) + ' ';
    if (text.find(" memory ") == std::string::npos) {
      if (!may_switch_on || !writeFile(control, "+memory")) {
        return control + " does not pass memory limits on to new groups";
      }
      switched_on_ = control;
    }
    removeEndedGroups(parent);
    // One may be there that belongs to another process which has this number in its container.
    const std::string name = parent + '/' + kGroupName + std::to_string(::getpid());
    std::string group = name;
    int problem_of_group = EEXIST;
    for (int i = 2; i < 100 && problem_of_group == EEXIST; ++i) {
      problem_of_group = ::mkdir(group.c_str(), 0755) == 0 ? 0 : errno;
      if (problem_of_group == EEXIST) group = name + '-' + std::to_string(i);
    }
    if (problem_of_group != 0) {
      return "a cgroup cannot be made in " + parent + ": " +
             std::generic_category().message(problem_of_group);
    }
    if (!writeFile(group + "/memory.max", std::to_string(bytes)) ||
        !writeFile(group + "/cgroup.procs", std::to_string(::getpid()))) {
      const int reason = errno;
      ::rmdir(group.c_str());
      return "a cgroup in " + parent +
             " cannot be used: " + std::generic_category().message(reason);
    }
    struct stat facts;
    const std::string swap = group + "/memory.swap.max";
    if (::stat(swap.c_str(), &facts) == 0) writeFile(swap, "0");  // not there without swap
    group_ = std::move(group);
    return "";
  }

  // Fails where another group needs it.
  void switchOff() const {
    if (!switched_on_.empty()) writeFile(switched_on_, "-memory");
  }

  void limitProcess(std::uint64_t bytes, const std::string& why_not) {
    if (::getrlimit(RLIMIT_DATA, &before_) != 0) fail("the limit of memory is not known");
    rlimit limit = before_;
    limit.rlim_cur = std::min(rlim_t(bytes), before_.rlim_cur);
    if (::setrlimit(RLIMIT_DATA, &limit) != 0) fail("cannot limit memory");
    text_ = "memory limited to " + gibibytes(limit.rlim_cur) +
            (limit.rlim_cur < rlim_t(bytes) ? " (as it was before, which is less)" : "") +
            " for each process, of what is not shared, by RLIMIT_DATA, since no cgroup is used: " +
            why_not;
  }

  std::string text_;
  std::string home_, group_;  // folders; no group: it is a limit of the process
  std::string switched_on_;   // file in which limits of memory were switched on
  rlimit before_ = {};
};

MemoryLimit::MemoryLimit(std::uint64_t bytes, const MemoryLimitOptions& options) {
  if (bytes == 0) throw ArgumentError("bytes", "is 0, expected a limit of memory above 0");
  impl_.reset(new Impl(bytes, options));
}
MemoryLimit::~MemoryLimit() = default;
const std::string& MemoryLimit::text() const noexcept {
  return impl_->text();
}
bool MemoryLimit::isCgroup() const noexcept {
  return impl_->isCgroup();
}
const std::string& MemoryLimit::group() const noexcept {
  return impl_->group();
}

void removeEndedMemoryGroups(const MemoryLimitOptions& options) {
  const GroupPlace place = findGroup(options.proc);
  if (place.why_not.empty()) removeEndedGroups(place.parent());
}

#else

std::vector<int> cpuAffinity() {
  throw Error("cores can be chosen on Linux only");
}
void setCpuAffinity(const std::vector<int>&, const std::string&) {
  throw Error("cores can be chosen on Linux only");
}

class MemoryLimit::Impl {
 public:
  std::string text;
};

MemoryLimit::MemoryLimit(std::uint64_t, const MemoryLimitOptions&) {
  throw Error("memory can be limited on Linux only");
}
MemoryLimit::~MemoryLimit() = default;
const std::string& MemoryLimit::text() const noexcept {
  return impl_->text;
}
bool MemoryLimit::isCgroup() const noexcept {
  return false;
}
const std::string& MemoryLimit::group() const noexcept {
  return impl_->text;
}
void removeEndedMemoryGroups(const MemoryLimitOptions&) {}

#endif  // __linux__

}  // namespace v1
}  // namespace gslam
