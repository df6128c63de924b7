#ifndef GSLAM_APPS_RUN_PROCESS_H
#define GSLAM_APPS_RUN_PROCESS_H

#include <sys/types.h>

#include <chrono>
#include <mutex>
#include <string>
#include <vector>

namespace app {

/// How a process ended.
struct ProcessEnd {
  bool is_signal = false;
  int number = 0;  ///< signal or exit status
};

/// This program once more, in a process group of its own, for one run. It ends when this process
/// does. stop() and kill() may be called by any thread.
class RunProcess {
 public:
  /// Starts it, with its stdout on stderr and nothing on stdin.
  /// @param arguments  behind the program's name
  /// @param file       that it inherits
  /// @throws Error when it cannot be started
  RunProcess(const std::vector<std::string>& arguments, int file);
  RunProcess(const RunProcess&) = delete;
  RunProcess& operator=(const RunProcess&) = delete;
  /// Kills what still lives.
  ~RunProcess();

  pid_t number() const { return number_; }
  /// Waits for its end, but not longer than that. All that it started and left is killed then.
  bool waitFor(std::chrono::milliseconds time, ProcessEnd& end);
  void stop();  ///< asks it to end
  void kill();  ///< ends it and all that it started

 private:
  bool reap(ProcessEnd& end);
  void send(pid_t target, int signal);

  std::mutex mutex_;  // so that no signal goes to a number that is another's by now
  bool is_alive_ = true;
  pid_t number_ = 0;
  int handle_ = -1;  // becomes readable at its end; -1: this kernel has none
};

}  // namespace app

#endif  // GSLAM_APPS_RUN_PROCESS_H
