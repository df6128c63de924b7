#include "run_process.h"

#include <fcntl.h>
#include <gslam/base/error.h>
#include <poll.h>
#include <sys/prctl.h>
#include <sys/syscall.h>
#include <sys/wait.h>
#include <unistd.h>

#include <cerrno>
#include <csignal>
#include <cstring>

namespace app {
namespace {

std::string ownProgram() {
  std::string path(4096, '\0');
  const ssize_t size = readlink("/proc/self/exe", &path[0], path.size());
  if (size <= 0) throw gslam::FileError("/proc/self/exe", "cannot be read", errno);
  path.resize(std::size_t(size));
  // It may have been replaced while it runs.
  return access(path.c_str(), X_OK) == 0 ? path : "/proc/self/exe";
}

// Between fork() and exec(), where little is allowed: only what is safe in signal handlers.
[[noreturn]] void become(const char* program, char* const* arguments, pid_t parent, int file) {
  setpgid(0, 0);
  prctl(PR_SET_PDEATHSIG, SIGKILL);
  if (getppid() != parent) _exit(127);  // it ended before that
  const int null = open("/dev/null", O_RDONLY);
  if (null >= 0) dup2(null, STDIN_FILENO);
  dup2(STDERR_FILENO, STDOUT_FILENO);
  fcntl(file, F_SETFD, 0);
  execv(program, arguments);
  _exit(127);
}

}  // namespace

RunProcess::RunProcess(const std::vector<std::string>& arguments, int file) {
  const std::string program = ownProgram();
  std::vector<std::string> words = {"gslam"};
  words.insert(words.end(), arguments.begin(), arguments.end());
  std::vector<char*> pointers;
  for (std::string& word : words) pointers.push_back(&word[0]);
  pointers.push_back(nullptr);
  const pid_t own = getpid();
  number_ = fork();
  if (number_ < 0) throw gslam::FileError(program, "cannot be started", errno);
  if (number_ == 0) become(program.c_str(), pointers.data(), own, file);
  setpgid(number_, number_);  // whoever of the two is first
  handle_ = int(syscall(SYS_pidfd_open, number_, 0));
}

RunProcess::~RunProcess() {
  kill();
  while (is_alive_ && !waitFor(std::chrono::milliseconds(100))) {
  }
  if (is_alive_) collect();
  if (handle_ >= 0) close(handle_);
}

bool RunProcess::waitFor(std::chrono::milliseconds time) {
  pollfd handle = {handle_, POLLIN, 0};
  poll(&handle, handle_ >= 0 ? 1 : 0, int(time.count()));
  siginfo_t facts = {};
  // Fails when somebody else reaped it.
  return waitid(P_PID, id_t(number_), &facts, WEXITED | WNOHANG | WNOWAIT) != 0 ||
         facts.si_pid != 0;
}

ProcessEnd RunProcess::collect() {
  const std::lock_guard<std::mutex> lock(mutex_);
  ::kill(-number_, SIGKILL);
  int status = 0;
  waitpid(number_, &status, 0);
  is_alive_ = false;
  ProcessEnd end;
  end.is_signal = WIFSIGNALED(status);
  end.number = end.is_signal ? WTERMSIG(status) : WEXITSTATUS(status);
  return end;
}

void RunProcess::send(pid_t target, int signal) {
  const std::lock_guard<std::mutex> lock(mutex_);
  if (is_alive_) ::kill(target, signal);
}

void RunProcess::stop() {
  send(number_, SIGINT);
}

void RunProcess::kill() {
  send(-number_, SIGKILL);
}

}  // namespace app
