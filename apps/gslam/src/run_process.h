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
/// does. stop() and kill() may be called by any thread. What leaves the group (setsid()) is not
/// followed.
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
  /// Waits for its end, but not longer than that. What it used can be read until collect().
  /// @return whether it has ended
  bool waitFor(std::chrono::milliseconds time);
  /// How it ended, once waitFor() says so. Kills all that it started and left.
  ProcessEnd collect();
  void stop();  ///< asks it to end
  void kill();  ///< ends it and all that it started

 private:
  void send(pid_t target, int signal);

  std::mutex mutex_;  // so that no signal goes to a number that is another's by now
  bool is_alive_ = true;
  pid_t number_ = 0;
  int handle_ = -1;  // becomes readable at its end; -1: this kernel has none
};

}  // namespace app

#endif  // GSLAM_APPS_RUN_PROCESS_H
