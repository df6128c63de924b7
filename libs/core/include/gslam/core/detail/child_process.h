// What isolation needs of the system: a child process, a socket to it, memory that both have. All
// calls of the system stand here; it is Linux's.
#ifndef GSLAM_CORE_DETAIL_CHILD_PROCESS_H
#define GSLAM_CORE_DETAIL_CHILD_PROCESS_H

#include <gslam/base/error.h>

#include <cerrno>
#include <chrono>
#include <cstddef>
#include <cstdint>
#include <cstdlib>
#include <cstring>
#include <fstream>
#include <string>
#include <utility>
#include <vector>

#if defined(__linux__)
#include <fcntl.h>
#include <poll.h>
#include <signal.h>
#include <spawn.h>
#include <sys/mman.h>
#include <sys/resource.h>
#include <sys/socket.h>
#include <sys/stat.h>
#include <sys/wait.h>
#include <unistd.h>
#define GSLAM_DETAIL_HAS_ISOLATION 1
#else
#define GSLAM_DETAIL_HAS_ISOLATION 0
#endif

namespace gslam {
inline namespace v1 {
namespace detail {

using Deadline = std::chrono::steady_clock::time_point;

// A limit of 0 is none.
inline Deadline deadlineAfter(std::chrono::milliseconds limit) {
  if (limit.count() <= 0 || limit > std::chrono::hours(24 * 365)) return Deadline::max();
  return std::chrono::steady_clock::now() + limit;
}

// How a child came to its end.
struct ChildEnd {
  enum What { exited, killed, unknown } what;
  int number;  // its status, or the signal
};

// What came of sending or receiving.
enum class Transfer { done, closed, late };

// Where the child finds them.
constexpr int kChildSocket = 3;
constexpr int kChildMemory = 4;

#if GSLAM_DETAIL_HAS_ISOLATION

[[noreturn]] inline void failSystem(const char* what) {
  const int number = errno;
  throw Error(std::string(what) + ": " + std::generic_category().message(number));
}

// An open file of the system's, closed at the end.
class FileHandle {
 public:
  FileHandle() noexcept = default;
  explicit FileHandle(int number) noexcept : number_(number) {}
  FileHandle(FileHandle&& other) noexcept : number_(other.number_) { other.number_ = -1; }
  FileHandle& operator=(FileHandle&& other) noexcept {
    std::swap(number_, other.number_);
    return *this;
  }
  ~FileHandle() { close(); }
  int get() const noexcept { return number_; }
  void close() noexcept {
    if (number_ >= 0) ::close(number_);
    number_ = -1;
  }

 private:
  int number_ = -1;
};

// The same file with a number that no child uses, not inherited by other programs.
inline FileHandle outOfTheWay(int number) {
  const FileHandle old(number);
  FileHandle moved(::fcntl(number, F_DUPFD_CLOEXEC, 10));
  if (moved.get() < 0) failSystem("no file handle is left for a child process");
  return moved;
}

inline std::pair<FileHandle, FileHandle> socketPair() {
  int ends[2] = {-1, -1};
  if (::socketpair(AF_UNIX, SOCK_STREAM | SOCK_CLOEXEC, 0, ends) != 0) {
    failSystem("cannot make a socket for a child process");
  }
  FileHandle second(ends[1]);
  FileHandle parent = outOfTheWay(ends[0]);
  FileHandle child(::fcntl(second.get(), F_DUPFD_CLOEXEC, 10));
  if (child.get() < 0) failSystem("no file handle is left for a child process");
  return {std::move(parent), std::move(child)};
}

// Memory without a name that may be mapped by several processes, and never shrinks: so that a
// broken child cannot take pages from under its parent.
inline FileHandle sharedMemory() {
  const int number = ::memfd_create("gslam frames", MFD_CLOEXEC | MFD_ALLOW_SEALING);
  if (number < 0) failSystem("cannot make shared memory (memfd_create)");
  FileHandle memory = outOfTheWay(number);
  if (::fcntl(memory.get(), F_ADD_SEALS, F_SEAL_SHRINK) != 0) failSystem("cannot seal memory");
  return memory;
}

inline std::size_t pageSize() {
  return std::size_t(::sysconf(_SC_PAGESIZE));
}

// Makes it longer. The pages are there then: using them cannot fail.
inline void growMemory(const FileHandle& memory, std::uint64_t offset, std::uint64_t size) {
  const int problem = ::posix_fallocate(memory.get(), off_t(offset), off_t(size));
  if (problem == 0) return;
  errno = problem;
  failSystem("no memory is left for frames that a child process shares");
}

// A part of shared memory, unmapped at the end.
class MappedMemory {
 public:
  MappedMemory(int memory, std::uint64_t offset, std::uint64_t size) : size_(std::size_t(size)) {
    data_ = ::mmap(nullptr, size_, PROT_READ | PROT_WRITE, MAP_SHARED, memory, off_t(offset));
    if (data_ == MAP_FAILED) failSystem("cannot map memory that a child process shares");
  }
  MappedMemory(const MappedMemory&) = delete;
  MappedMemory& operator=(const MappedMemory&) = delete;
  ~MappedMemory() { ::munmap(data_, size_); }
  unsigned char* data() const noexcept { return static_cast<unsigned char*>(data_); }
  std::size_t size() const noexcept { return size_; }

 private:
  void* data_;
  std::size_t size_;
};

// How often the system ran out of memory and ended a process; 0 where it does not tell.
inline std::uint64_t outOfMemoryCount() {
  std::ifstream facts("/proc/vmstat");
  std::string name;
  std::uint64_t value = 0;
  while (facts >> name >> value) {
    if (name == "oom_kill") return value;
  }
  return 0;
}

inline std::vector<std::string> environmentWith(const std::string& added) {
  std::vector<std::string> all;
  for (char** one = environ; one != nullptr && *one != nullptr; ++one) all.emplace_back(*one);
  all.push_back(added);
  return all;
}

inline std::vector<char*> pointersTo(std::vector<std::string>& texts) {
  std::vector<char*> pointers;
  for (std::string& text : texts) pointers.push_back(&text[0]);
  pointers.push_back(nullptr);
  return pointers;
}

// What posix_spawn() is to do, released at the end.
class SpawnPlan {
 public:
  SpawnPlan() {
    posix_spawn_file_actions_init(&files_);
    posix_spawnattr_init(&attributes_);
  }
  SpawnPlan(const SpawnPlan&) = delete;
  SpawnPlan& operator=(const SpawnPlan&) = delete;
  ~SpawnPlan() {
    posix_spawn_file_actions_destroy(&files_);
    posix_spawnattr_destroy(&attributes_);
  }

  // A group of its own: Ctrl-C is for the parent, and whatever it starts ends with it. No signal is
  // blocked or ignored, there is no input, and what it prints goes to stderr.
  pid_t spawn(const std::string& program, const FileHandle& socket, const FileHandle& memory,
              std::vector<std::string> arguments, std::vector<std::string> environment) {
    sigset_t none, usual;
    sigemptyset(&none);
    sigemptyset(&usual);
    for (const int one : {SIGPIPE, SIGINT, SIGTERM, SIGHUP, SIGQUIT, SIGCHLD, SIGUSR1, SIGUSR2}) {
      sigaddset(&usual, one);
    }
    posix_spawnattr_setpgroup(&attributes_, 0);
    posix_spawnattr_setsigmask(&attributes_, &none);
    posix_spawnattr_setsigdefault(&attributes_, &usual);
    posix_spawnattr_setflags(
        &attributes_, POSIX_SPAWN_SETPGROUP | POSIX_SPAWN_SETSIGMASK | POSIX_SPAWN_SETSIGDEF);
    posix_spawn_file_actions_addopen(&files_, 0, "/dev/null", O_RDONLY, 0);
    posix_spawn_file_actions_adddup2(&files_, 2, 1);  // stdout is for results of this program
    posix_spawn_file_actions_adddup2(&files_, socket.get(), kChildSocket);
    posix_spawn_file_actions_adddup2(&files_, memory.get(), kChildMemory);
    pid_t child = -1;
    const int problem = ::posix_spawn(&child, program.c_str(), &files_, &attributes_,
                                      pointersTo(arguments).data(), pointersTo(environment).data());
    if (problem != 0) throw FileError(program, "cannot be started as a child process", problem);
    return child;
  }

 private:
  posix_spawn_file_actions_t files_;
  posix_spawnattr_t attributes_;
};

// A child process that ends no later than this does.
class ChildProcess {
 public:
  ChildProcess() noexcept = default;
  ChildProcess(const ChildProcess&) = delete;
  ChildProcess& operator=(const ChildProcess&) = delete;
  ~ChildProcess() {
    if (id_ > 0) end();
  }

  void start(const std::string& program, const FileHandle& socket, const FileHandle& memory,
             const std::vector<std::string>& arguments, const std::string& variable) {
    SpawnPlan plan;
    id_ = plan.spawn(program, socket, memory, arguments, environmentWith(variable));
  }

  bool isRunning() const noexcept { return id_ > 0 && !hasEnded(); }
  long id() const noexcept { return id_; }

  // Whether it came to its end, or somebody else in this process waited for it.
  bool hasEnded() const noexcept {
    siginfo_t facts;
    facts.si_pid = 0;
    const int result = ::waitid(P_PID, id_t(id_), &facts, WEXITED | WNOHANG | WNOWAIT);
    return result != 0 ? errno != EINTR : facts.si_pid != 0;
  }

  // Waits for its end; false when it is late.
  bool waitUntil(Deadline deadline) const noexcept {
    for (int pause = 1; !hasEnded(); pause = pause < 20 ? pause * 2 : pause) {
      if (std::chrono::steady_clock::now() >= deadline) return false;
      ::poll(nullptr, 0, pause);
    }
    return true;
  }

  // Ends it and all that it started, and reaps it.
  ChildEnd end() noexcept {
    siginfo_t facts;
    facts.si_pid = 0;
    // Its number is its own until it is reaped; where somebody did that, it may be another's.
    const bool is_ours = ::waitid(P_PID, id_t(id_), &facts, WEXITED | WNOHANG | WNOWAIT) == 0;
    if (is_ours && ::kill(-id_, SIGKILL) != 0) ::kill(id_, SIGKILL);
    int status = 0;
    pid_t reaped = -1;
    do {
      reaped = ::waitpid(id_, &status, 0);
    } while (reaped < 0 && errno == EINTR);
    const bool is_known = reaped == id_;
    id_ = -1;
    if (is_known && WIFEXITED(status)) return {ChildEnd::exited, WEXITSTATUS(status)};
    if (is_known && WIFSIGNALED(status)) return {ChildEnd::killed, WTERMSIG(status)};
    return {ChildEnd::unknown, 0};
  }

 private:
  pid_t id_ = -1;
};

inline int pollTime(Deadline deadline) {
  constexpr int kSlice = 100;  // so that a child's end is seen when others hold its socket open
  if (deadline == Deadline::max()) return kSlice;
  const auto left = std::chrono::duration_cast<std::chrono::milliseconds>(
                        deadline - std::chrono::steady_clock::now())
                        .count() +
                    1;
  return left < kSlice ? (left > 0 ? int(left) : 0) : kSlice;
}

// Waits until `socket` can be used, `child` has ended (closed) or it is late.
inline Transfer waitFor(int socket, short events, const ChildProcess* child, Deadline deadline) {
  for (;;) {
    pollfd one = {socket, events, 0};
    const int count = ::poll(&one, 1, pollTime(deadline));
    if (count > 0) return Transfer::done;
    if (count < 0 && errno != EINTR) return Transfer::closed;
    if (child != nullptr && child->hasEnded()) {
      // What it sent before is still there.
      return ::poll(&one, 1, 0) > 0 ? Transfer::done : Transfer::closed;
    }
    if (std::chrono::steady_clock::now() >= deadline) return Transfer::late;
  }
}

inline bool isToTryAgain() noexcept {
  return errno == EAGAIN || errno == EWOULDBLOCK || errno == EINTR;
}

inline Transfer sendBytes(int socket, const void* data, std::size_t size, const ChildProcess* child,
                          Deadline deadline) {
  const char* at = static_cast<const char*>(data);
  while (size > 0) {
    const ssize_t sent = ::send(socket, at, size, MSG_NOSIGNAL | MSG_DONTWAIT);
    if (sent > 0) {
      at += sent;
      size -= std::size_t(sent);
      continue;
    }
    if (sent < 0 && !isToTryAgain()) return Transfer::closed;
    const Transfer ready = waitFor(socket, POLLOUT, child, deadline);
    if (ready != Transfer::done) return ready;
  }
  return Transfer::done;
}

inline Transfer receiveBytes(int socket, void* data, std::size_t size, const ChildProcess* child,
                             Deadline deadline) {
  char* at = static_cast<char*>(data);
  while (size > 0) {
    const ssize_t received = ::recv(socket, at, size, MSG_DONTWAIT);
    if (received > 0) {
      at += received;
      size -= std::size_t(received);
      continue;
    }
    if (received == 0 || !isToTryAgain()) return Transfer::closed;
    const Transfer ready = waitFor(socket, POLLIN, child, deadline);
    if (ready != Transfer::done) return ready;
  }
  return Transfer::done;
}

inline bool isSocket(int number) noexcept {
  struct stat facts;
  return ::fstat(number, &facts) == 0 && S_ISSOCK(facts.st_mode);
}

inline void keepFromPrograms(int number) noexcept {
  ::fcntl(number, F_SETFD, FD_CLOEXEC);
}

inline void limitMemory(std::uint64_t bytes) {
  const rlimit limit = {rlim_t(bytes), rlim_t(bytes)};
  if (bytes != 0 && ::setrlimit(RLIMIT_AS, &limit) != 0) failSystem("cannot limit memory");
}

// Returns true when the other end of the socket is gone, false when `stop` is readable.
inline bool waitForHangUp(int socket, int stop) noexcept {
  for (;;) {
    pollfd both[2] = {{socket, 0, 0}, {stop, POLLIN, 0}};  // a hang-up is told without being asked
    const int count = ::poll(both, 2, -1);
    if (count < 0 && errno == EINTR) continue;
    if (both[1].revents != 0 || count < 0) return false;
    if (both[0].revents != 0) return true;
  }
}

inline std::string signalName(int number) {
  static const struct {
    int number;
    const char* name;
  } kNames[] = {{SIGSEGV, "SIGSEGV"}, {SIGABRT, "SIGABRT"}, {SIGBUS, "SIGBUS"},
                {SIGFPE, "SIGFPE"},   {SIGILL, "SIGILL"},   {SIGKILL, "SIGKILL"},
                {SIGTERM, "SIGTERM"}, {SIGINT, "SIGINT"},   {SIGTRAP, "SIGTRAP"},
                {SIGSYS, "SIGSYS"},   {SIGPIPE, "SIGPIPE"}, {SIGXCPU, "SIGXCPU"},
                {SIGQUIT, "SIGQUIT"}, {SIGHUP, "SIGHUP"}};
  for (const auto& one : kNames) {
    if (one.number == number) return one.name;
  }
  return "unknown";
}

inline bool isKillSignal(int number) noexcept {
  return number == SIGKILL;
}

#endif  // GSLAM_DETAIL_HAS_ISOLATION

}  // namespace detail
}  // namespace v1
}  // namespace gslam

#endif  // GSLAM_CORE_DETAIL_CHILD_PROCESS_H
